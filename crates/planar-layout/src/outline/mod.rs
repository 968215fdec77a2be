//! Outlines of bodies: discs, capsules and polygons, and the signed distance of points from them.
//!
//! # Example
//! ```
//! use planar_layout::outline::{Outline, SignedDistance};
//!
//! let capsule = Outline::Capsule { ends: [[0.0, 0.0], [2.0, 0.0]], radius: 0.5 };
//! assert_eq!(capsule.signed_distance([1.0, 3.0]), SignedDistance { distance: 2.5, normal: [0.0, 1.0] });
//! assert_eq!(capsule.signed_distance([2.25, 0.0]).distance, -0.25);
//! assert_eq!(capsule.reach(), 2.5);
//! // clockwise corners are turned round
//! let triangle = Outline::polygon(vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])?;
//! assert_eq!(triangle.corners(), [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]);
//! # Ok::<(), planar_layout::outline::OutlineError>(())
//! ```

mod keys;
mod reader;

pub use keys::FORMAT;
pub use reader::{Body, outline};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The outline of a rigid body in its own frame: that of a link, or one with the COM as its origin.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Outline {
    /// A circle.
    Disc {
        /// [x, y] in m.
        center: [f64; 2],
        /// m, greater than 0.
        radius: f64,
    },
    /// All points within a radius of a segment; with radius 0 the segment itself.
    Capsule {
        /// The ends of the segment, [x, y] in m.
        ends: [[f64; 2]; 2],
        /// m, 0 or more.
        radius: f64,
    },
    /// Straight edges; made by [`Outline::polygon`].
    Polygon {
        /// [x, y] in m, anticlockwise, at least three.
        corners: Vec<[f64; 2]>,
    },
}

/// Most corners of a polygon: every pair of its edges is compared, and more say nothing more about a shape.
pub const MOST_CORNERS: usize = 1000;

/// Why corners are not an outline.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// Fewer than three.
    #[error("a polygon has three corners or more, found {0}")]
    TooFew(usize),
    /// More than [`MOST_CORNERS`].
    #[error("a polygon has {MOST_CORNERS} corners at most, found {0}")]
    TooMany(usize),
    /// Two edges cross or touch.
    #[error("edges {0} and {1} of the polygon meet, expected corners in their order around it")]
    Crossing(usize, usize),
    /// An edge of no length, or all corners on a line.
    #[error("the polygon encloses nothing, expected corners that are not all on a line, each once")]
    Flat,
}

/// The signed distance of a point from an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SignedDistance {
    /// Distance to the outline, m; negative inside.
    pub distance: f64,
    /// Outward normal of the nearest point of the outline, unit length.
    pub normal: [f64; 2],
}

impl Outline {
    /// A disc about the origin; radius in m, greater than 0.
    #[must_use]
    pub const fn disc(radius: f64) -> Self {
        Self::Disc { center: [0.0; 2], radius }
    }

    /// A rectangle with sides of this size along axes turned by the angle (rad) about its centre; m.
    #[must_use]
    pub fn rectangle([cx, cy]: [f64; 2], [width, height]: [f64; 2], angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let corner = |[a, b]: [f64; 2]| {
            let (x, y) = (0.5 * a * width, 0.5 * b * height);
            [cx + cos * x - sin * y, cy + sin * x + cos * y]
        };
        Self::Polygon { corners: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner).to_vec() }
    }

    /// A polygon with these corners, in either direction.
    ///
    /// # Errors
    /// [`OutlineError`].
    pub fn polygon(mut corners: Vec<[f64; 2]>) -> Result<Self, OutlineError> {
        if corners.len() < 3 {
            return Err(OutlineError::TooFew(corners.len()));
        }
        if corners.len() > MOST_CORNERS {
            return Err(OutlineError::TooMany(corners.len()));
        }
        let area: f64 = edges(&corners).map(|(a, b)| cross(a, b)).sum();
        let size = corners.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        if edges(&corners).any(|(a, b)| minus(a, b).iter().all(|x| *x == 0.0)) {
            return Err(OutlineError::Flat);
        }
        let all: Vec<_> = edges(&corners).collect();
        for (i, first) in all.iter().enumerate() {
            let others = all.iter().enumerate().skip(i + 2).filter(|(j, _)| !(i == 0 && *j == all.len() - 1));
            if let Some((j, _)) = others.into_iter().find(|(_, second)| meet(*first, **second)) {
                return Err(OutlineError::Crossing(i + 1, j + 1));
            }
        }
        // after the crossings, which may cancel the area
        if area.abs() <= 1e-12 * size * size {
            return Err(OutlineError::Flat);
        }
        if area < 0.0 {
            corners.reverse();
        }
        Ok(Self::Polygon { corners })
    }

    /// The signed distance of a point in the body's frame.
    #[must_use]
    pub fn signed_distance(&self, [x, y]: [f64; 2]) -> SignedDistance {
        match self {
            Self::Disc { center, radius } => away_from(*center, [x, y], *radius),
            Self::Capsule { ends: [a, b], radius } => away_from(nearest_on_segment(*a, *b, [x, y]), [x, y], *radius),
            Self::Polygon { corners } => polygon_distance(corners, [x, y]),
        }
    }

    /// The corners of the outline, anticlockwise; arcs as chords of at most 7.5°.
    #[must_use]
    pub fn corners(&self) -> Vec<[f64; 2]> {
        let arc = |[cx, cy]: [f64; 2], radius: f64, from: f64, chords: u32, turn: f64| {
            (0..=chords).map(move |i| {
                let angle = from + turn * f64::from(i) / f64::from(chords);
                [cx + radius * libm::cos(angle), cy + radius * libm::sin(angle)]
            })
        };
        match self {
            Self::Disc { center, radius } => arc(*center, *radius, 0.0, 48, TAU).take(48).collect(),
            Self::Capsule { ends: [a, b], radius: 0.0 } => vec![*a, *b],
            Self::Capsule { ends: [a, b], radius } => {
                let [dx, dy] = minus(*b, *a);
                let across = libm::atan2(dy, dx) - FRAC_PI_2;
                arc(*b, *radius, across, 24, PI).chain(arc(*a, *radius, across + PI, 24, PI)).collect()
            }
            Self::Polygon { corners } => corners.clone(),
        }
    }

    /// The largest distance of the outline from the origin of its frame, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self {
            Self::Disc { center, radius } => farthest(&[*center]) + radius,
            Self::Capsule { ends, radius } => farthest(ends) + radius,
            Self::Polygon { corners } => farthest(corners),
        }
    }
}

/// The largest distance of the points from the origin.
#[must_use]
pub fn farthest(points: &[[f64; 2]]) -> f64 {
    points.iter().fold(0.0, |most, [x, y]| libm::hypot(*x, *y).max(most))
}

/// The signed distance from the circle of this radius about a point.
fn away_from(center: [f64; 2], point: [f64; 2], radius: f64) -> SignedDistance {
    let [x, y] = minus(point, center);
    let distance = libm::hypot(x, y);
    let normal = if distance > 0.0 { [x / distance, y / distance] } else { [1.0, 0.0] };
    SignedDistance { distance: distance - radius, normal }
}

/// The point of a segment that is nearest to a point.
#[must_use]
pub fn nearest_on_segment(a: [f64; 2], b: [f64; 2], point: [f64; 2]) -> [f64; 2] {
    let along = minus(b, a);
    let squared = dot(along, along);
    let part = if squared > 0.0 { (dot(minus(point, a), along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    [a[0] + part * along[0], a[1] + part * along[1]]
}

fn polygon_distance(corners: &[[f64; 2]], point: [f64; 2]) -> SignedDistance {
    let mut inside = false;
    let mut at_corner = false;
    let mut nearest = SignedDistance { distance: f64::INFINITY, normal: [1.0, 0.0] };
    for (a, b) in edges(corners) {
        let (along, to) = (minus(b, a), minus(point, a));
        let length = libm::hypot(along[0], along[1]);
        let part = (dot(to, along) / (length * length)).clamp(0.0, 1.0);
        let away = [to[0] - part * along[0], to[1] - part * along[1]];
        let distance = libm::hypot(away[0], away[1]);
        if distance < nearest.distance {
            // the normal points away from the nearest corner; on the outline it is that of the edge
            at_corner = (part <= 0.0 || part >= 1.0) && distance > 1e-9 * length;
            let of_edge = [along[1] / length, -along[0] / length];
            nearest = SignedDistance { distance, normal: if at_corner { away.map(|x| x / distance) } else { of_edge } };
        }
        // a ray along +x crosses the edge
        if (a[1] > point[1]) != (b[1] > point[1]) && point[0] < a[0] + (point[1] - a[1]) / along[1] * along[0] {
            inside = !inside;
        }
    }
    if !inside {
        return nearest;
    }
    // from inside, a re-entrant corner is outwards
    let normal = if at_corner { nearest.normal.map(|x| -x) } else { nearest.normal };
    SignedDistance { distance: -nearest.distance, normal }
}

/// The edges of a polygon, from each corner to the next.
pub fn edges(corners: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

fn minus([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> [f64; 2] {
    [ax - bx, ay - by]
}

fn cross([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    ax * by - ay * bx
}

fn dot([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    ax * bx + ay * by
}

/// Whether two edges have a point in common.
fn meet((a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])) -> bool {
    let side = |from: [f64; 2], to: [f64; 2], point: [f64; 2]| cross(minus(to, from), minus(point, from));
    let [of_c, of_d, of_a, of_b] = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)];
    if of_c == 0.0 && of_d == 0.0 {
        // on one line: where they are along it
        let along = |point| dot(minus(point, a), minus(b, a));
        let (low, high) = (along(c).min(along(d)), along(c).max(along(d)));
        return low <= along(b) && high >= 0.0;
    }
    of_c * of_d <= 0.0 && of_a * of_b <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plus_shape() -> Outline {
        let quarter = [[1.0, -1.0], [3.0, -1.0], [3.0, 1.0]];
        let turn = |[x, y]: [f64; 2], k: usize| (0..k).fold([x, y], |[x, y], _| [-y, x]);
        let corners = (0..4).flat_map(|k| quarter.map(|corner| turn(corner, k))).collect();
        Outline::polygon(corners).expect("an outline with edges on one line")
    }

    #[test]
    fn the_reach_is_that_of_the_farthest_point() {
        let capsule = Outline::Capsule { ends: [[0.0, 0.0], [-3.0, 4.0]], radius: 0.5 };
        let polygon = Outline::polygon(vec![[0.0, 0.0], [6.0, 8.0], [1.0, 0.0]]).expect("a triangle");
        for (outline, reach) in
            [(Outline::Disc { center: [3.0, -4.0], radius: 1.0 }, 6.0), (capsule, 5.5), (polygon, 10.0)]
        {
            assert!((outline.reach() - reach).abs() < 1e-14, "{outline:?}");
        }
    }

    #[test]
    fn signed_distances_of_a_plus() {
        let cases = [
            ([4.0, 0.0], 1.0, [1.0, 0.0]),
            ([2.5, 0.0], -0.5, [1.0, 0.0]),
            ([0.0, -3.5], 0.5, [0.0, -1.0]),
            // off an outer corner, and inside at a re-entrant one
            ([3.3, 1.4], 0.5, [0.6, 0.8]),
            ([0.7, 0.6], -0.5, [0.6, 0.8]),
        ];
        for (point, distance, normal) in cases {
            let signed_distance = plus_shape().signed_distance(point);
            assert!((signed_distance.distance - distance).abs() < 1e-14, "{point:?}: {signed_distance:?}");
            assert!(
                minus(signed_distance.normal, normal).iter().all(|x| x.abs() < 1e-14),
                "{point:?}: {signed_distance:?}"
            );
        }
    }

    #[test]
    fn corners_the_other_way_round_are_the_same_outline() {
        let corners = vec![[0.0, 0.0], [0.0, 1.0], [2.0, 1.0], [2.0, 0.0]];
        let signed_distance = Outline::polygon(corners).expect("a rectangle").signed_distance([1.0, 1.25]);
        assert_eq!(signed_distance, SignedDistance { distance: 0.25, normal: [0.0, 1.0] });
    }

    #[test]
    fn what_is_no_outline() {
        let of = |corners: &[[f64; 2]]| Outline::polygon(corners.to_vec()).expect_err("no outline");
        assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0]]), OutlineError::TooFew(2));
        assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), OutlineError::Flat);
        assert_eq!(of(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 2.0]]), OutlineError::Crossing(1, 3));
        assert_eq!(of(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), OutlineError::Crossing(1, 3));
    }
}
