//! Snapshots of robot and targets in the plane, as panels of one scale: of all of them, or close-ups.

use super::cut::cut;
use super::figure::{Axis, AxisRange, Panel, Series};
use super::robot::arrow;

/// Largest distance of a free target from the bounding box of everything else, over the side of that box, at which it
/// still extends the panels.
const MAX_DISTANCE: f64 = 0.25;

/// Side of a close-up over that of what it shows whole.
const ROOM: f64 = 1.25;

/// Largest side of a close-up over that of all.
const CLOSE: f64 = 0.7;

/// Robot and targets at one instant.
#[derive(Default)]
pub(super) struct Snapshot {
    pub(super) title: Option<String>,
    /// Always inside the panel.
    pub(super) series: Vec<Series>,
    /// Inside the panel if they are near.
    pub(super) free: Vec<FreeTarget>,
    /// Points of what a close-up shows whole.
    pub(super) focus: Vec<(f64, f64)>,
}

/// A target that nothing holds.
pub(super) struct FreeTarget {
    pub(super) series: Vec<Series>,
    /// Its COM, m.
    pub(super) centre: [f64; 2],
    /// Largest distance of its outline from the COM, m.
    pub(super) radius: f64,
    /// Always extends the panels.
    pub(super) in_contact: bool,
}

/// A rectangle [x, y], m.
#[derive(Clone, Copy)]
struct BoundingBox {
    low: [f64; 2],
    high: [f64; 2],
}

impl BoundingBox {
    const EMPTY: Self = Self { low: [f64::MAX; 2], high: [f64::MIN; 2] };

    /// Extended to contain the series.
    fn with<'a>(self, series: impl Iterator<Item = &'a Series>) -> Self {
        self.around(series.flat_map(|series| &series.points))
    }

    /// Extended to contain the points.
    fn around<'a>(self, points: impl Iterator<Item = &'a (f64, f64)>) -> Self {
        points.fold(self, |Self { low, high }, (x, y)| Self {
            low: [low[0].min(*x), low[1].min(*y)],
            high: [high[0].max(*x), high[1].max(*y)],
        })
    }

    /// Along x and y.
    fn sides(&self) -> [f64; 2] {
        [0, 1].map(|i| self.high[i] - self.low[i])
    }

    /// The longer side.
    fn side(&self) -> f64 {
        self.sides()[0].max(self.sides()[1])
    }

    fn centre(&self) -> [f64; 2] {
        [0, 1].map(|i| f64::midpoint(self.low[i], self.high[i]))
    }

    fn widened(self, by: [f64; 2]) -> Self {
        Self { low: [0, 1].map(|i| self.low[i] - by[i]), high: [0, 1].map(|i| self.high[i] + by[i]) }
    }

    /// The smallest square about the same centre that contains it.
    fn square(self) -> Self {
        self.square_of(self.side())
    }

    /// The square of a side about the same centre.
    fn square_of(self, side: f64) -> Self {
        let half = side / 2.0;
        Self { low: self.centre().map(|c| c - half), high: self.centre().map(|c| c + half) }
    }

    fn contains(&self, target: &FreeTarget) -> bool {
        let FreeTarget { centre, radius, .. } = target;
        (0..2).all(|i| centre[i] - radius >= self.low[i] && centre[i] + radius <= self.high[i])
    }
}

/// Square panels of one scale that contain all series and the free targets near them; an arrow points to a free target
/// outside.
pub(super) fn panels(snapshots: Vec<Snapshot>) -> Vec<Panel> {
    let always = BoundingBox::EMPTY.with(snapshots.iter().flat_map(|snapshot| &snapshot.series));
    let near = always.widened([MAX_DISTANCE * always.side(); 2]);
    let free = snapshots.iter().flat_map(|snapshot| &snapshot.free);
    let shown = free.filter(|target| target.in_contact || near.contains(target)).flat_map(|target| &target.series);
    let all = always.with(shown);
    let frame = all.widened(all.sides().map(|side| 0.04 * side.max(1e-3))).square();
    snapshots.into_iter().map(|snapshot| panel(snapshot, &frame)).collect()
}

/// Square panels of one scale, each about what it is to show, where that takes far less than to show all; the rest is cut
/// off at its edges.
pub(super) fn close_ups(snapshots: Vec<Snapshot>) -> Vec<Panel> {
    let whole = BoundingBox::EMPTY.with(snapshots.iter().flat_map(|snapshot| &snapshot.series)).side();
    let each: Vec<_> = snapshots.iter().map(|snapshot| BoundingBox::EMPTY.around(snapshot.focus.iter())).collect();
    let side = ROOM * each.iter().map(BoundingBox::side).fold(0.0, f64::max);
    if snapshots.len() < 2 || side <= 0.0 || side > CLOSE * whole {
        return panels(snapshots);
    }
    let close = |(mut snapshot, focus): (Snapshot, BoundingBox)| {
        let frame = focus.square_of(side);
        snapshot.series = snapshot.series.iter().flat_map(|series| cut(series, frame.low, frame.high)).collect();
        panel(snapshot, &frame)
    };
    snapshots.into_iter().zip(each).map(close).collect()
}

fn panel(snapshot: Snapshot, frame: &BoundingBox) -> Panel {
    let Snapshot { title, mut series, free, focus: _ } = snapshot;
    for target in free {
        if frame.contains(&target) {
            series.extend(target.series);
        } else {
            series.extend(pointer(&target, frame));
        }
    }
    let axis =
        |label: &str, i: usize| Axis { label: label.to_owned(), range: AxisRange::Fixed(frame.low[i], frame.high[i]) };
    Panel { title, x: axis("x [m]", 0), y: axis("y [m]", 1), equal_scale: true, series }
}

/// An arrow at the edge of the frame towards a target outside, in its colour.
fn pointer(target: &FreeTarget, frame: &BoundingBox) -> Option<Series> {
    let length = 0.08 * frame.side();
    let within = frame.widened([-0.02 * frame.side(); 2]);
    let head = [0, 1].map(|i| target.centre[i].clamp(within.low[i], within.high[i]));
    let direction = [0, 1].map(|i| target.centre[i] - frame.centre()[i]);
    let distance = libm::hypot(direction[0], direction[1]);
    let along = direction.map(|part| length * part / distance);
    let outline = target.series.first()?;
    let arrow = arrow(outline.label.as_deref()?, [head[0] - along[0], head[1] - along[1]], along)?;
    Some(Series { colour: outline.colour, ..arrow })
}
