//! Where labels of arrows are that are seen together: none on another, and none on an arrow.

use super::view::WIDTH;

/// Of a character, px, at most of digits and units.
const CHARACTER: f64 = 8.5;
/// Of a line, px.
const LINE: f64 = 18.0;
/// Between a tip and its label, px.
const BESIDE: f64 = 8.0;
/// From the edges of the picture, px.
const EDGE: f64 = 4.0;
/// Most lines by which a label is above or below where it would be.
const LINES: u8 = 6;

/// Where a text begins, ends or has its middle, and its baseline, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) at: [f64; 2],
    /// In SVG.
    pub(super) anchor: &'static str,
}

/// Arrows, and the labels that have a place, each while it is seen, s.
pub(super) struct Labels {
    /// Of the scene, px.
    height: f64,
    arrows: Vec<([[f64; 2]; 2], [f64; 2])>,
    /// Lower and upper corner.
    placed: Vec<([[f64; 2]; 2], [f64; 2])>,
}

impl Labels {
    /// In a scene of a height, px.
    pub(super) const fn new(height: f64) -> Self {
        Self { height, arrows: Vec::new(), placed: Vec::new() }
    }

    /// An arrow from one end to the other: labels that are placed later are off it.
    pub(super) fn arrow(&mut self, ends: [[f64; 2]; 2], seen: [f64; 2]) {
        self.arrows.push((ends, seen));
    }

    /// The place of a text at the tip of an arrow, which points along `way`: beside it or beyond, where that is free, or as few
    /// lines above or below as will do.
    pub(super) fn place(&mut self, [x, y]: [f64; 2], way: [f64; 2], text: &str, seen: [f64; 2]) -> Place {
        let width = CHARACTER * u32::try_from(text.chars().count()).map_or(0.0, f64::from);
        let right = Place { at: [x + BESIDE, y + 4.0], anchor: "start" };
        let left = Place { at: [x - BESIDE, y + 4.0], anchor: "end" };
        let beyond = Place { at: [x, y + if way[1] < 0.0 { -BESIDE } else { LINE }], anchor: "middle" };
        let wanted = if way[0] < 0.0 { [left, right, beyond] } else { [right, left, beyond] };
        let lines = (0..=LINES).flat_map(|line| [-f64::from(line), f64::from(line)]);
        let mut all = lines.flat_map(|line| wanted.map(|place| self.inside(place, line * LINE, width)));
        let first = self.inside(wanted[0], 0.0, width);
        let place = all.find(|place| self.is_free(frame(*place, width), seen)).unwrap_or(first);
        self.placed.push((frame(place, width), seen));
        place
    }

    /// Moved down, and into the picture.
    fn inside(&self, Place { at: [x, y], anchor }: Place, down: f64, width: f64) -> Place {
        let before = before(anchor, width);
        let left = (x - before).min(WIDTH - EDGE - width).max(EDGE);
        Place { at: [left + before, (y + down).min(self.height - EDGE).max(LINE)], anchor }
    }

    fn is_free(&self, frame: [[f64; 2]; 2], seen: [f64; 2]) -> bool {
        let meet = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a < d && c < b;
        let along = |[low, high]: [[f64; 2]; 2], axis: usize| [low[axis], high[axis]];
        let covers = |other: [[f64; 2]; 2]| (0..2).all(|axis| meet(along(frame, axis), along(other, axis)));
        !self.placed.iter().any(|(other, when)| meet(seen, *when) && covers(*other))
            && !self.arrows.iter().any(|(arrow, when)| meet(seen, *when) && passes(*arrow, frame))
    }
}

/// How much of a text is left of its anchor, px.
fn before(anchor: &str, width: f64) -> f64 {
    match anchor {
        "end" => width,
        "middle" => width / 2.0,
        _ => 0.0,
    }
}

/// The rectangle of a text, with a margin.
fn frame(Place { at: [x, y], anchor }: Place, width: f64) -> [[f64; 2]; 2] {
    let left = x - before(anchor, width);
    [[left - 2.0, y - LINE + 4.0], [left + width + 2.0, y + 4.0]]
}

/// Whether a segment passes through a rectangle: what of it is between the sides along one axis is, in part, along the other.
fn passes([from, to]: [[f64; 2]; 2], [low, high]: [[f64; 2]; 2]) -> bool {
    let (mut enter, mut leave): (f64, f64) = (0.0, 1.0);
    for axis in 0..2 {
        let way = to[axis] - from[axis];
        if way == 0.0 {
            if from[axis] < low[axis] || from[axis] > high[axis] {
                return false;
            }
            continue;
        }
        let [a, b] = [low[axis], high[axis]].map(|side| (side - from[axis]) / way);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    enter <= leave
}

#[cfg(test)]
mod tests {
    use super::{LINE, Labels, Place, frame, passes};

    const ALONG: [f64; 2] = [1.0, 0.0];

    #[test]
    fn labels_that_are_seen_together_are_apart() {
        let mut labels = Labels::new(400.0);
        let mut place = |x: f64, seen| labels.place([x, 100.0], ALONG, "0.5 N s", seen);
        let first = place(200.0, [0.0, 2.0]);
        assert_eq!(first, Place { at: [208.0, 104.0], anchor: "start" });
        // to the left of its own tip there is as much room
        assert_eq!(place(220.0, [4.0, 5.0]), Place { at: [228.0, 104.0], anchor: "start" }, "later");
        assert_eq!(place(400.0, [1.0, 3.0]), Place { at: [408.0, 104.0], anchor: "start" }, "elsewhere");
        let second = place(204.0, [1.0, 3.0]);
        assert_eq!(second, Place { at: [196.0, 104.0], anchor: "end" });
        let third = place(202.0, [1.5, 3.0]);
        assert!((third.at[1] - 104.0).abs() >= LINE - 4.0, "{third:?}");
    }

    #[test]
    fn labels_are_off_arrows_and_inside_the_picture() {
        let mut labels = Labels::new(400.0);
        // of another impulse, over where the label would be
        let other = [[230.0, 60.0], [230.0, 180.0]];
        labels.arrow([[100.0, 100.0], [200.0, 100.0]], [0.0, 2.0]);
        labels.arrow(other, [0.0, 2.0]);
        let place = labels.place([200.0, 100.0], ALONG, "0.5 N s", [0.0, 2.0]);
        assert!(!labels.arrows.iter().any(|(arrow, _)| passes(*arrow, frame(place, 7.0 * 8.5))), "{place:?}");
        assert_eq!(place.at[0].to_bits(), if place.anchor == "end" { 192.0_f64 } else { 200.0 }.to_bits(), "{place:?}");
        let at_edge = labels.place([790.0, 2.0], ALONG, "0.5 N s", [3.0, 4.0]);
        let [low, high] = frame(at_edge, 7.0 * 8.5);
        assert!(low[0] > 0.0 && low[1] >= 0.0 && high[0] < 800.0, "{at_edge:?}");
    }

    #[test]
    fn segments_pass_through_rectangles() {
        let of = |from: [f64; 2], to: [f64; 2]| passes([from, to], [[0.0, 0.0], [2.0, 1.0]]);
        assert!(of([-1.0, 0.5], [3.0, 0.5]) && of([1.0, 0.5], [1.0, 0.6]) && of([-1.0, -1.0], [3.0, 2.0]));
        assert!(!of([-1.0, 2.0], [3.0, 2.0]) && !of([-1.0, 0.5], [-0.1, 0.5]) && !of([-1.0, 1.0], [1.0, 3.0]));
    }
}
