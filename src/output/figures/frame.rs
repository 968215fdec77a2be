//! What a picture of the plane shows of it: panels of one scale.

use super::figure::{Axis, Panel, Series, Span};
use super::robot::arrow;

/// How far a free target may be outside of everything else, in sides of that, before it is left out.
const FARTHEST: f64 = 0.25;

/// One picture.
#[derive(Default)]
pub(super) struct Picture {
    pub(super) title: Option<String>,
    /// What is always shown.
    pub(super) series: Vec<Series>,
    /// What is shown where it is near.
    pub(super) free: Vec<Free>,
}

/// A target that nothing holds.
pub(super) struct Free {
    pub(super) series: Vec<Series>,
    /// Its COM, m.
    pub(super) middle: [f64; 2],
    /// Of the circle about it that it is in, m.
    pub(super) radius: f64,
    /// Whether it was just touched, and is shown however large it is.
    pub(super) touched: bool,
}

/// Least and greatest x and y, m.
#[derive(Clone, Copy)]
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    fn of(points: impl Iterator<Item = (f64, f64)>) -> Self {
        let none = Self { low: [f64::MAX; 2], high: [f64::MIN; 2] };
        points.fold(none, |Self { low, high }, (x, y)| Self {
            low: [low[0].min(x), low[1].min(y)],
            high: [high[0].max(x), high[1].max(y)],
        })
    }

    fn of_series<'a>(series: impl Iterator<Item = &'a Series>) -> Self {
        Self::of(series.flat_map(|series| &series.points).copied())
    }

    fn side(&self) -> f64 {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1])
    }

    fn with(self, other: &Self) -> Self {
        Self {
            low: [0, 1].map(|i| self.low[i].min(other.low[i])),
            high: [0, 1].map(|i| self.high[i].max(other.high[i])),
        }
    }

    fn widened(self, by: [f64; 2]) -> Self {
        Self { low: [0, 1].map(|i| self.low[i] - by[i]), high: [0, 1].map(|i| self.high[i] + by[i]) }
    }

    /// The square about the same middle.
    fn square(self) -> Self {
        let half = self.side() / 2.0;
        let middle = [0, 1].map(|i| f64::midpoint(self.low[i], self.high[i]));
        Self { low: middle.map(|m| m - half), high: middle.map(|m| m + half) }
    }

    fn holds(&self, free: &Free) -> bool {
        let inside =
            |i: usize| free.middle[i] - free.radius >= self.low[i] && free.middle[i] + free.radius <= self.high[i];
        inside(0) && inside(1)
    }
}

/// Panels of one scale that hold what is always shown, and free targets as long as they are near.
pub(super) fn panels(pictures: Vec<Picture>) -> Vec<Panel> {
    let always = Bounds::of_series(pictures.iter().flat_map(|picture| &picture.series));
    let near = always.widened([FARTHEST * always.side(); 2]);
    let free = pictures.iter().flat_map(|picture| &picture.free);
    let shown = free.filter(|free| free.touched || near.holds(free)).flat_map(|free| &free.series);
    let all = always.with(&Bounds::of_series(shown));
    let margin = [0, 1].map(|i| 0.04 * (all.high[i] - all.low[i]).max(1e-3));
    // square panels: the longer side decides
    let frame = all.widened(margin).square();
    pictures.into_iter().map(|picture| panel(picture, &frame)).collect()
}

fn panel(picture: Picture, frame: &Bounds) -> Panel {
    let Picture { title, mut series, free } = picture;
    for one in free {
        if frame.holds(&one) {
            series.extend(one.series);
        } else if let Some(like) = one.series.first() {
            series.extend(pointer(like, one.middle, frame));
        }
    }
    let axis =
        |label: &str, i: usize| Axis { label: label.to_owned(), span: Span::Between(frame.low[i], frame.high[i]) };
    Panel { title, x: axis("x [m]", 0), y: axis("y [m]", 1), equal_scale: true, series }
}

/// An arrow at the edge of the frame towards a place outside, like the outline of what is there.
fn pointer(like: &Series, to: [f64; 2], frame: &Bounds) -> Option<Series> {
    let length = 0.08 * frame.side();
    let within = frame.widened([-0.02 * frame.side(); 2]);
    let end_effector = [0, 1].map(|i| to[i].clamp(within.low[i], within.high[i]));
    let middle = [0, 1].map(|i| f64::midpoint(frame.low[i], frame.high[i]));
    let way = [0, 1].map(|i| to[i] - middle[i]);
    let far = way[0].hypot(way[1]);
    let along = way.map(|part| length * part / far);
    let label = like.label.clone()?;
    Some(Series {
        colour: like.colour,
        ..arrow(&label, [end_effector[0] - along[0], end_effector[1] - along[1]], along)?
    })
}
