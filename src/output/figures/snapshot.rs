//! Snapshots of robot and targets in the plane, as panels of one scale.

use super::figure::{Axis, AxisRange, Panel, Series};
use super::robot::arrow;

/// Largest distance of a free target from the bounding box of everything else, over the side of that box, at which it
/// still extends the panels.
const MAX_DISTANCE: f64 = 0.25;

/// Robot and targets at one instant.
#[derive(Default)]
pub(super) struct Snapshot {
    pub(super) title: Option<String>,
    /// Always inside the panel.
    pub(super) series: Vec<Series>,
    /// Inside the panel if they are near.
    pub(super) free: Vec<FreeTarget>,
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
        series.flat_map(|series| &series.points).fold(self, |Self { low, high }, (x, y)| Self {
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
        let half = self.side() / 2.0;
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

fn panel(snapshot: Snapshot, frame: &BoundingBox) -> Panel {
    let Snapshot { title, mut series, free } = snapshot;
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
