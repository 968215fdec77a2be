//! Convex parts of outlines, and the signed distance of two of them.

use crate::frames::turned;
use crate::outline::{Outline, edges, farthest};
use earcut::Earcut;
use multiversion::multiversion;

/// All points within a radius of a convex polygon, a segment or a point, in the frame of its body.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::capture) struct ConvexPart {
    /// [x, y] in m, anticlockwise; two for a segment, one for a point.
    pub(in crate::capture) corners: Vec<[f64; 2]>,
    /// m, 0 or more.
    pub(in crate::capture) radius: f64,
    /// The largest distance of a corner from the origin of the frame, m.
    pub(in crate::capture) reach: f64,
    /// The largest distance of two of its points, m; of more than two corners at least half of it.
    pub(in crate::capture) size: f64,
    axes: Vec<Axis>,
}

/// A direction on which the projections of two parts are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    /// The outward normal of an edge, or a direction of a segment.
    normal: [f64; 2],
    /// Index of a corner in which the part ends along the normal; an edge goes on from it.
    corner: usize,
    /// Of the edge, m; 0 for the direction of a segment.
    length: f64,
}

/// Corners and axes of a part in another frame.
#[derive(Default)]
pub(in crate::capture) struct PlacedPart {
    corners: Vec<[f64; 2]>,
    axes: Vec<Axis>,
    radius: f64,
}

impl PlacedPart {
    /// Places a part whose frame has its origin at [x, y] and is turned by an angle of this sine and cosine.
    pub(in crate::capture) fn place(&mut self, part: &ConvexPart, [x, y]: [f64; 2], turn: (f64, f64)) {
        self.corners.clear();
        self.corners.extend(part.corners.iter().map(|corner| {
            let [dx, dy] = turned(*corner, turn);
            [x + dx, y + dy]
        }));
        self.axes.clear();
        self.axes.extend(part.axes.iter().map(|axis| Axis { normal: turned(axis.normal, turn), ..*axis }));
        self.radius = part.radius;
    }
}

impl ConvexPart {
    /// The origin of the frame.
    pub(in crate::capture) fn point() -> Self {
        Self::new(vec![[0.0; 2]], 0.0)
    }

    /// Parts whose union is the outline: a concave polygon as convex ones.
    pub(in crate::capture) fn of(outline: &Outline) -> Vec<Self> {
        match outline {
            Outline::Disc { center, radius } => vec![Self::new(vec![*center], *radius)],
            Outline::Capsule { ends: [a, b], radius } => {
                let mut corners = vec![*a, *b];
                corners.dedup();
                vec![Self::new(corners, *radius)]
            }
            Outline::Polygon { corners } => {
                convex_polygons(corners).into_iter().map(|corners| Self::new(corners, 0.0)).collect()
            }
        }
    }

    fn new(corners: Vec<[f64; 2]>, radius: f64) -> Self {
        let (reach, axes) = (farthest(&corners), axes(&corners));
        let from_first = corners.iter().map(|[x, y]| libm::hypot(x - corners[0][0], y - corners[0][1]));
        let size = from_first.fold(0.0, f64::max) + 2.0 * radius;
        Self { corners, radius, reach, size, axes }
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
    edges(corners).map(|([ax, ay], [bx, by])| 0.5 * (ax * by - ay * bx)).sum()
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
pub(in crate::capture) struct Separation {
    /// m; negative for parts that overlap: the shortest translation that separates them.
    pub(in crate::capture) distance: f64,
    /// The direction of that translation of the second part, unit length: for all directions n the first part ends
    /// before the second one begins by at most `distance`, and along this one by `distance`.
    pub(in crate::capture) normal: [f64; 2],
    /// The part of which this is the normal of an edge.
    pub(in crate::capture) edge_of: Option<usize>,
}

/// Distance below which the nearest points give no direction, m: the largest gap along a normal takes its place.
const TOUCHING: f64 = 1e-9;

/// The separation of a part and another one that is placed in its frame, by the theorem of the separating axis: the
/// largest distance between their projections on the normals of their edges, or, where that is positive, the smallest
/// distance of a corner from an edge beside it or from a corner.
///
/// A library (parry2d 0.31) was tried: it finds no depth for overlapping polygons with a common corner or edge line.
#[multiversion(targets("x86_64+avx2"))]
pub(in crate::capture) fn separation(a: &ConvexPart, b: &PlacedPart) -> Separation {
    let mut deepest = Separation { distance: f64::NEG_INFINITY, normal: [1.0, 0.0], edge_of: None };
    let mut beside = Separation { distance: f64::INFINITY, ..deepest };
    for (part, axes, own, other) in [(0, &a.axes, &a.corners, &b.corners), (1, &b.axes, &b.corners, &a.corners)] {
        for Axis { normal: [nx, ny], corner, length } in axes {
            let from = own[*corner];
            let (mut lowest, mut lowest_beside) = (f64::INFINITY, f64::INFINITY);
            for corner in other {
                let (dx, dy) = (corner[0] - from[0], corner[1] - from[1]);
                let (outwards, along) = (nx * dx + ny * dy, nx * dy - ny * dx);
                lowest = lowest.min(outwards);
                if outwards > 0.0 && along >= 0.0 && along <= *length {
                    lowest_beside = lowest_beside.min(outwards);
                }
            }
            let of_axis = |distance| {
                let normal = if part == 0 { [*nx, *ny] } else { [-nx, -ny] };
                Separation { distance, normal, edge_of: Some(part) }
            };
            if lowest > deepest.distance {
                deepest = of_axis(lowest);
            }
            if lowest_beside < beside.distance {
                beside = of_axis(lowest_beside);
            }
        }
    }
    let is_apart = deepest.distance > TOUCHING || (a.axes.is_empty() && b.axes.is_empty());
    let cores = if is_apart { nearest(&a.corners, &b.corners, &beside, deepest.normal) } else { deepest };
    // the normal of an edge has all its digits, that of a short difference of large coordinates has few
    let is_of_edge = cores.edge_of.is_none() && cores.distance - deepest.distance <= TOUCHING;
    let cores = if is_of_edge { Separation { distance: cores.distance, ..deepest } } else { cores };
    Separation { distance: cores.distance - a.radius - b.radius, ..cores }
}

/// The nearest points of two parts that do not overlap: a corner and the edge that it is `beside`, or two corners, whose
/// difference is `otherwise` where it has no direction.
fn nearest(a: &[[f64; 2]], b: &[[f64; 2]], beside: &Separation, otherwise: [f64; 2]) -> Separation {
    let (mut squared, mut shortest) = (f64::INFINITY, [0.0; 2]);
    for [ax, ay] in a {
        for [bx, by] in b {
            let [dx, dy] = [bx - ax, by - ay];
            let other = dx * dx + dy * dy;
            if other < squared {
                (squared, shortest) = (other, [dx, dy]);
            }
        }
    }
    let distance = squared.sqrt();
    if beside.distance <= distance {
        return *beside;
    }
    let normal = if distance > 0.0 { shortest.map(|x| x / distance) } else { otherwise };
    Separation { distance, normal, edge_of: None }
}

/// The outward normals of the edges, anticlockwise; for a segment also its two directions.
fn axes(corners: &[[f64; 2]]) -> Vec<Axis> {
    let mut axes = Vec::new();
    for (corner, ([ax, ay], [bx, by])) in edges(corners).enumerate() {
        let (dx, dy) = (bx - ax, by - ay);
        let length = (dx * dx + dy * dy).sqrt();
        if length > 0.0 {
            axes.push(Axis { normal: [dy / length, -dx / length], corner, length });
            if corners.len() == 2 {
                axes.push(Axis { normal: [dx / length, dy / length], corner: 1 - corner, length: 0.0 });
            }
        }
    }
    axes
}

/// The separation of parts whose corners are given where they are.
#[cfg(test)]
pub(in crate::capture) fn separation_of(a: &[[f64; 2]], b: &[[f64; 2]], radii: f64) -> Separation {
    let [a, b] = [(a, radii), (b, 0.0)].map(|(corners, radius)| ConvexPart::new(corners.to_vec(), radius));
    let mut placed = PlacedPart::default();
    placed.place(&b, [0.0; 2], (0.0, 1.0));
    separation(&a, &placed)
}

#[cfg(test)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    clippy::float_cmp,
    reason = "random numbers and exact ones"
)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Numbers in 0 to 1, xorshift.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }

        /// A point, a segment, or corners on an ellipse, some on a grid of quarters so that edges are aligned.
        fn part(&mut self) -> Vec<[f64; 2]> {
            let (center, size, turn) =
                ([self.next() - 0.5, self.next() - 0.5], [self.next(), self.next()], self.next());
            let count = [1, 2, 3, 4, 6][(self.next() * 5.0) as usize];
            let grid = self.next() < 0.3;
            let corner = |k: i32| {
                let (sin, cos) = (TAU * (turn + f64::from(k) / f64::from(count))).sin_cos();
                let corner = [center[0] + size[0] * cos, center[1] + size[1] * sin];
                if grid { corner.map(|x| (4.0 * x).round() / 4.0) } else { corner }
            };
            let mut corners: Vec<_> = (0..count).map(corner).collect();
            corners.dedup();
            if corners.len() > 2 && (!is_convex(&corners) || area(&corners) < 1e-3) { vec![center] } else { corners }
        }
    }

    /// The distance between the projections on a direction.
    fn gap(a: &[[f64; 2]], b: &[[f64; 2]], [nx, ny]: [f64; 2]) -> f64 {
        let along = |[x, y]: &[f64; 2]| nx * x + ny * y;
        let end = a.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
        b.iter().map(along).fold(f64::INFINITY, f64::min) - end
    }

    /// The signed distance is the largest gap over all directions: here over 20,000 of them, from below.
    #[test]
    fn signed_distances_against_all_directions() {
        let mut random = Random(12345);
        let mut overlaps = 0;
        for _ in 0..400 {
            let (a, b) = (random.part(), random.part());
            let Separation { distance, normal, .. } = separation_of(&a, &b, 0.0);
            let directions = (0..20_000).map(|k| (TAU * f64::from(k) / 20_000.0).sin_cos());
            let largest = directions.map(|(sin, cos)| gap(&a, &b, [cos, sin])).fold(f64::NEG_INFINITY, f64::max);
            assert!(
                (distance - largest).abs() < 4e-4 && distance >= largest - 1e-12,
                "{distance} {largest} {a:?} {b:?}"
            );
            assert!((gap(&a, &b, normal) - distance).abs() < 1e-12, "the gap along the normal is the distance");
            overlaps += u32::from(distance < -1e-3);
        }
        assert!(overlaps > 50, "{overlaps}");
    }

    #[test]
    fn rectangles_with_a_common_corner_overlap() {
        let a = [[-1.25, -1.25], [-0.5, -1.25], [-0.5, 0.25], [-1.25, 0.25]];
        let b = [[-2.25, -0.5], [-0.5, -0.5], [-0.5, 0.25], [-2.25, 0.25]];
        assert_eq!(separation_of(&a, &b, 0.0).distance, -0.75);
        assert_eq!(separation_of(&a, &[[0.5, 0.0]], 0.25).distance, 0.75);
    }

    /// The parts of a concave polygon cover it without overlapping.
    #[test]
    fn parts_of_concave_polygons() {
        let plus = [
            [1., -1.],
            [3., -1.],
            [3., 1.],
            [1., 1.],
            [1., 3.],
            [-1., 3.],
            [-1., 1.],
            [-3., 1.],
            [-3., -1.],
            [-1., -1.],
            [-1., -3.],
            [1., -3.],
        ];
        let star: Vec<[f64; 2]> = (0..14)
            .map(|k| {
                let (sin, cos) = (TAU * f64::from(k) / 14.0).sin_cos();
                let radius = if k % 2 == 0 { 2.0 } else { 0.6 };
                [radius * cos, radius * sin]
            })
            .collect();
        for corners in [plus.to_vec(), star] {
            let parts = ConvexPart::of(&Outline::polygon(corners.clone()).expect("a polygon"));
            let sum: f64 = parts.iter().map(|part| area(&part.corners)).sum();
            assert!(parts.len() > 1 && parts.len() < corners.len() - 2, "{} parts", parts.len());
            assert!((sum - area(&corners)).abs() < 1e-12 && parts.iter().all(|part| is_convex(&part.corners)));
            let outline = Outline::polygon(corners).expect("a polygon");
            let mut random = Random(7);
            for _ in 0..500 {
                let point = [6.0 * random.next() - 3.0, 6.0 * random.next() - 3.0];
                let least = parts.iter().map(|part| separation_of(&[point], &part.corners, 0.0).distance);
                let (least, expected) = (least.fold(f64::INFINITY, f64::min), outline.signed_distance(point).distance);
                assert!(if expected > 0.0 { (least - expected).abs() < 1e-12 } else { least <= 1e-12 }, "{point:?}");
            }
        }
    }
}
