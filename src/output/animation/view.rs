//! The part of the plane that the picture shows.

use super::clip::short;
use crate::frames::{Frame, FrameMotion, point};
use crate::output::scene::Visual;
use std::fmt::Write as _;

/// Width of the picture, px.
pub(in crate::output) const WIDTH: f64 = 800.0;
/// Least and greatest height of the scene, px.
const HEIGHTS: [f64; 2] = [300.0, 560.0];
/// Free space around it, px.
const MARGIN: f64 = 24.0;
/// Targets that are farther from the robot than this part of its extent do not widen the view.
const NEAR: f64 = 0.2;

/// A rectangle of the plane, m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extent {
    low: [f64; 2],
    high: [f64; 2],
}

impl Extent {
    const EMPTY: Self = Self { low: [f64::MAX; 2], high: [f64::MIN; 2] };

    fn with(self, [x, y]: [f64; 2]) -> Self {
        let Self { low, high } = self;
        Self { low: [low[0].min(x), low[1].min(y)], high: [high[0].max(x), high[1].max(y)] }
    }

    fn sides(&self) -> [f64; 2] {
        [0, 1].map(|i| (self.high[i] - self.low[i]).max(1e-6))
    }

    /// Whether a point is inside, or outside by no more than a part of the longer side.
    fn is_near(&self, at: [f64; 2]) -> bool {
        let far = NEAR * self.sides()[0].max(self.sides()[1]);
        (0..2).all(|i| at[i] >= self.low[i] - far && at[i] <= self.high[i] + far)
    }
}

/// An arrow from a point, m, and its way, px, y upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::output) struct Arrow {
    pub(in crate::output) from: [f64; 2],
    pub(in crate::output) way: [f64; 2],
}

/// How far arrows go below an extent and above it along each axis at a scale, px; what is within the margin is not counted.
fn beyond(extent: Extent, arrows: &[Arrow], scale: f64) -> [[f64; 2]; 2] {
    let most = |over: &dyn Fn(&Arrow, usize) -> f64| {
        [0, 1].map(|i| arrows.iter().map(|arrow| over(arrow, i) - 0.5 * MARGIN).fold(0.0, f64::max))
    };
    [
        most(&|arrow, i| scale * (extent.low[i] - arrow.from[i]) - arrow.way[i]),
        most(&|arrow, i| scale * (arrow.from[i] - extent.high[i]) + arrow.way[i]),
    ]
}

/// Where points of the plane are in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::output) struct View {
    /// px per m.
    pub(in crate::output) scale: f64,
    /// Of the scene, px.
    pub(in crate::output) height: f64,
    /// Middle of what is shown, m.
    centre: [f64; 2],
}

impl View {
    /// That contains the robot at all times, the targets when they are near it, and arrows; `poses` has those of the frames.
    pub(in crate::output) fn new(
        frames: &[Frame],
        visuals: &[Visual],
        poses: &[Vec<[f64; 3]>],
        arrows: &[Arrow],
    ) -> Self {
        let is_target = |frame: &Frame| matches!(frame.motion, FrameMotion::Target(_));
        let outline = |i: usize| {
            let visual = visuals.iter().find(|visual| visual.frame == frames[i].name);
            visual.map(|visual| visual.shape.lines()[0].clone()).unwrap_or_default()
        };
        let bodies = |targets: bool| {
            let chosen = (0..frames.len()).filter(move |i| is_target(&frames[*i]) == targets);
            chosen.map(|i| (i, outline(i))).collect::<Vec<_>>()
        };
        let widened = |extent: Extent, pose: &[f64; 3], corners: &[[f64; 2]]| {
            corners.iter().fold(extent, |extent, corner| extent.with(point(*pose, *corner)))
        };
        let (robot, targets) = (bodies(false), bodies(true));
        let mut extent = Extent::EMPTY;
        for poses in poses {
            extent = robot.iter().fold(extent, |extent, (i, corners)| widened(extent, &poses[*i], corners));
        }
        let near = extent;
        for poses in poses {
            let shown = targets.iter().filter(|(i, _)| near.is_near([poses[*i][1], poses[*i][2]]));
            extent = shown.fold(extent, |extent, (i, corners)| widened(extent, &poses[*i], corners));
        }
        Self::of(extent, arrows)
    }

    fn of(extent: Extent, arrows: &[Arrow]) -> Self {
        let [width, height] = extent.sides();
        let fitting = |[across, down]: [f64; 2]| {
            ((WIDTH - 2.0 * MARGIN - across) / width).min((HEIGHTS[1] - 2.0 * MARGIN - down) / height)
        };
        // beyond the extent in pixels: at a smaller scale, a little more
        let [low, high] = beyond(extent, arrows, 0.8 * fitting([0.0; 2]));
        let more = [0, 1].map(|i| low[i] + high[i]);
        let scale = fitting(more);
        let height = (scale * height + 2.0 * MARGIN + more[1]).clamp(HEIGHTS[0], HEIGHTS[1]).round();
        let centre = [0, 1].map(|i| f64::midpoint(extent.low[i], extent.high[i]) + 0.5 * (high[i] - low[i]) / scale);
        Self { scale, height, centre }
    }

    /// The transformation from metres, y upwards, to pixels, y downwards: its scale and its offset.
    pub(in crate::output) fn offset(&self) -> [f64; 2] {
        [WIDTH / 2.0 - self.scale * self.centre[0], self.height / 2.0 + self.scale * self.centre[1]]
    }

    /// A point in the picture, px.
    pub(in crate::output) fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top] = self.offset();
        [left + self.scale * x, top - self.scale * y]
    }

    /// Lines of a round spacing, and what that is, as elements.
    pub(in crate::output) fn grid(&self) -> String {
        let spacing = self.spacing();
        let [across, along] = self.multiples(spacing);
        let mut lines = String::new();
        for x in across {
            let _ = write!(lines, "M{} 0V{}", short(self.pixel([x, 0.0])[0], 1), self.height);
        }
        for y in along {
            let _ = write!(lines, "M0 {}H{WIDTH}", short(self.pixel([0.0, y])[1], 1));
        }
        let name = format!("<text x=\"{}\" y=\"22\" text-anchor=\"end\">grid {spacing} m</text>\n", WIDTH - 12.0);
        format!("<path class=\"grid\" d=\"{lines}\"/>\n{name}")
    }

    /// The shown multiples of a spacing, along x and along y.
    pub(in crate::output) fn multiples(&self, spacing: f64) -> [Vec<f64>; 2] {
        [(0, WIDTH), (1, self.height)].map(|(i, size)| {
            let half = size / 2.0 / self.scale;
            let (mut at, mut all) = (((self.centre[i] - half) / spacing).ceil() * spacing, Vec::new());
            while at <= self.centre[i] + half {
                all.push(at);
                at += spacing;
            }
            all
        })
    }

    /// The spacing of a grid: 1, 2 or 5 times a power of ten, m.
    pub(in crate::output) fn spacing(&self) -> f64 {
        round_number(80.0 / self.scale)
    }
}

/// The least of 1, 2 and 5 times a power of ten that is not below a number.
pub(in crate::output) fn round_number(least: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(least).floor());
    [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(|step| *step >= least).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::{Arrow, Extent, View, WIDTH, round_number};

    /// Near is within a fifth of the longer side, in both directions.
    #[test]
    fn near_is_near_in_both_directions() {
        let extent = Extent { low: [0.0, 0.0], high: [10.0, 2.0] };
        for (at, is_near) in [
            ([5.0, 1.0], true),
            ([11.9, -1.9], true),
            ([-1.9, 3.9], true),
            ([12.1, 1.0], false),
            ([-2.1, 1.0], false),
            ([5.0, 4.1], false),
            ([5.0, -2.1], false),
        ] {
            assert_eq!(extent.is_near(at), is_near, "{at:?}");
        }
    }

    #[test]
    fn what_is_shown_is_inside_the_picture() {
        for (low, high) in [([-3.0, -1.0], [3.0, 1.0]), ([0.0, 0.0], [0.1, 4.0])] {
            for way in [None, Some([90.0, 0.0]), Some([-30.0, 90.0]), Some([0.0, -90.0])] {
                let arrows: Vec<_> =
                    way.into_iter().flat_map(|way| [low, high].map(|from| Arrow { from, way })).collect();
                let view = View::of(Extent { low, high }, &arrows);
                let ends = arrows.iter().map(|arrow| {
                    let [x, y] = view.pixel(arrow.from);
                    [x + arrow.way[0], y - arrow.way[1]]
                });
                for [x, y] in [low, high].map(|corner| view.pixel(corner)).into_iter().chain(ends) {
                    assert!(x > 5.0 && x < WIDTH - 5.0 && y > 5.0 && y < view.height - 5.0, "{way:?}: {x}, {y}");
                }
                if arrows.is_empty() {
                    let [x, y] = view.pixel(low);
                    assert!(x > 20.0 && y < view.height - 20.0, "{x}, {y}");
                }
            }
        }
    }

    #[test]
    fn spacings_are_round() {
        for (least, round) in [(0.013, 0.02), (0.9, 1.0), (1.0, 1.0), (2.1, 5.0), (70.0, 100.0)] {
            assert!((round_number(least) - round).abs() < 1e-12, "{least}: {}", round_number(least));
        }
    }
}
