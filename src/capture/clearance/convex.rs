//! Convex parts of outlines, and the signed distance of two of them.

use crate::outline::{Outline, nearest_on_segment};
use earcut::Earcut;

/// All points within a radius of a convex polygon, a segment or a point, in the frame of its body.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ConvexPart {
    /// [x, y] in m, anticlockwise; two for a segment, one for a point.
    pub(super) corners: Vec<[f64; 2]>,
    /// m, 0 or more.
    pub(super) radius: f64,
}

impl ConvexPart {
    /// Parts whose union is the outline: a concave polygon as convex ones.
    pub(super) fn of(outline: &Outline) -> Vec<Self> {
        match outline {
            Outline::Disc { center, radius } => vec![Self { corners: vec![*center], radius: *radius }],
            Outline::Capsule { ends: [a, b], radius } => {
                let corners = if a == b { vec![*a] } else { vec![*a, *b] };
                vec![Self { corners, radius: *radius }]
            }
            Outline::Polygon { corners } => {
                convex_polygons(corners).into_iter().map(|corners| Self { corners, radius: 0.0 }).collect()
            }
        }
    }

    /// The largest distance of a corner from the origin of the frame, m.
    pub(super) fn reach(&self) -> f64 {
        self.corners.iter().fold(0.0, |most, [x, y]| x.hypot(*y).max(most))
    }
}

/// The triangles of a polygon, joined along their common edges as long as the parts are convex (Hertel & Mehlhorn 1983).
fn convex_polygons(corners: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    if is_convex(corners) {
        return vec![corners.to_vec()];
    }
    let mut indices: Vec<usize> = Vec::new();
    Earcut::new().earcut(corners.iter().copied(), &[], &mut indices);
    let mut parts: Vec<Vec<usize>> = indices.chunks_exact(3).map(<[usize]>::to_vec).collect();
    for part in &mut parts {
        if area(&points(corners, part)) < 0.0 {
            part.reverse();
        }
    }
    let mut first = 0;
    while first < parts.len() {
        let joined = (first + 1..parts.len()).find_map(|second| {
            let union = join(&parts[first], &parts[second])?;
            is_convex(&points(corners, &union)).then_some((second, union))
        });
        match joined {
            Some((second, union)) => {
                parts[first] = union;
                parts.remove(second);
            }
            None => first += 1,
        }
    }
    parts.iter().map(|part| points(corners, part)).filter(|part| area(part) > 0.0).collect()
}

fn points(corners: &[[f64; 2]], part: &[usize]) -> Vec<[f64; 2]> {
    part.iter().map(|i| corners[*i]).collect()
}

/// Two polygons with a common edge as one.
fn join(a: &[usize], b: &[usize]) -> Option<Vec<usize>> {
    for (i, from) in a.iter().enumerate() {
        let to = a[(i + 1) % a.len()];
        if let Some(j) = (0..b.len()).find(|j| b[*j] == to && b[(j + 1) % b.len()] == *from) {
            let rest = (1..=a.len()).map(|k| a[(i + k) % a.len()]);
            return Some(rest.chain((2..b.len()).map(|k| b[(j + k) % b.len()])).collect());
        }
    }
    None
}

fn area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|([ax, ay], [bx, by])| 0.5 * (ax * by - ay * bx)).sum()
}

/// Whether an anticlockwise polygon turns left, or not at all, at every corner.
fn is_convex(corners: &[[f64; 2]]) -> bool {
    let count = corners.len();
    (0..count).all(|i| {
        let [a, b, c] = [0, 1, 2].map(|k| corners[(i + k) % count]);
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) >= 0.0
    })
}

/// The signed distance of two convex parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Separation {
    /// m; negative for parts that overlap: the shortest translation that separates them.
    pub(super) distance: f64,
    /// The direction of that translation of the second part, unit length: for all directions n the first part ends
    /// before the second one begins by at most `distance`, and along this one by `distance`.
    pub(super) normal: [f64; 2],
}

/// The separation of two parts with corners in the same frame, by the theorem of the separating axis: the largest
/// distance between their projections on the normals of their edges, or, where that is positive, the smallest distance
/// of a corner from an edge.
///
/// A library (parry2d 0.31) was tried: it finds no depth for overlapping polygons with a common corner or edge line.
pub(super) fn separation(a: &[[f64; 2]], b: &[[f64; 2]], radii: f64) -> Separation {
    let mut deepest = Separation { distance: f64::NEG_INFINITY, normal: [1.0, 0.0] };
    for_each_axis(a, |normal| deepest = larger(deepest, gap(a, b, normal), normal));
    for_each_axis(b, |normal| {
        let normal = [-normal[0], -normal[1]];
        deepest = larger(deepest, gap(a, b, normal), normal);
    });
    let cores =
        if deepest.distance > 0.0 || (a.len() == 1 && b.len() == 1) { nearest(a, b, deepest.normal) } else { deepest };
    Separation { distance: cores.distance - radii, ..cores }
}

fn larger(best: Separation, distance: f64, normal: [f64; 2]) -> Separation {
    if distance > best.distance { Separation { distance, normal } } else { best }
}

/// Calls with the outward normals of the edges; for a segment also with its two directions.
fn for_each_axis(corners: &[[f64; 2]], mut call: impl FnMut([f64; 2])) {
    let next = corners.iter().cycle().skip(1);
    for ([ax, ay], [bx, by]) in corners.iter().zip(next).filter(|_| corners.len() > 1) {
        let (dx, dy) = (bx - ax, by - ay);
        let length = dx.hypot(dy);
        if length > 0.0 {
            call([dy / length, -dx / length]);
            if corners.len() == 2 {
                call([dx / length, dy / length]);
            }
        }
    }
}

fn gap(a: &[[f64; 2]], b: &[[f64; 2]], [nx, ny]: [f64; 2]) -> f64 {
    let along = |[x, y]: &[f64; 2]| nx * x + ny * y;
    let end = a.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    b.iter().map(along).fold(f64::INFINITY, f64::min) - end
}

/// The nearest points of two parts that do not overlap.
fn nearest(a: &[[f64; 2]], b: &[[f64; 2]], otherwise: [f64; 2]) -> Separation {
    let mut best = Separation { distance: f64::INFINITY, normal: otherwise };
    let mut compare = |[dx, dy]: [f64; 2]| {
        let distance = dx.hypot(dy);
        if distance < best.distance {
            let normal = if distance > 0.0 { [dx / distance, dy / distance] } else { otherwise };
            best = Separation { distance, normal };
        }
    };
    let from_corners = |corners: &[[f64; 2]], edges: &[[f64; 2]], compare: &mut dyn FnMut([f64; 2])| {
        for point in corners {
            for (from, to) in edges.iter().zip(edges.iter().cycle().skip(1)) {
                let [x, y] = nearest_on_segment(*from, *to, *point);
                compare([x - point[0], y - point[1]]);
            }
        }
    };
    from_corners(a, b, &mut compare);
    from_corners(b, a, &mut |[dx, dy]| compare([-dx, -dy]));
    best
}
