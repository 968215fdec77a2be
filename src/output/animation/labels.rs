//! Where labels are that are seen together: none over another.

/// Of a character, px, at most of digits and units.
const CHARACTER: f64 = 8.5;
/// Of a line, px.
const LINE: f64 = 18.0;

/// The labels that have a place: [left, right] and baseline, px, and while they are seen, s.
#[derive(Default)]
pub(super) struct Labels {
    placed: Vec<([f64; 2], f64, [f64; 2])>,
}

impl Labels {
    /// The place of a text that would start, or end, at [x, y], below those that are seen at the same time.
    pub(super) fn place(&mut self, [x, y]: [f64; 2], text: &str, ends_there: bool, seen: [f64; 2]) -> [f64; 2] {
        let width = CHARACTER * u32::try_from(text.chars().count()).map_or(0.0, f64::from);
        let across = if ends_there { [x - width, x] } else { [x, x + width] };
        let meet = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a < d && c < b;
        let mut low = y;
        let mut others: Vec<_> =
            self.placed.iter().filter(|(other, _, when)| meet(across, *other) && meet(seen, *when)).collect();
        others.sort_by(|a, b| a.1.total_cmp(&b.1));
        for (_, other, _) in others {
            if (low - other).abs() < LINE {
                low = other + LINE;
            }
        }
        self.placed.push((across, low, seen));
        [x, low]
    }
}

#[cfg(test)]
mod tests {
    use super::{LINE, Labels};

    #[test]
    fn labels_that_are_seen_together_are_below_each_other() {
        let mut labels = Labels::default();
        let mut place = |x: f64, seen| labels.place([x, 10.0], "0.5 N s", false, seen)[1];
        assert_eq!(place(0.0, [0.0, 2.0]).to_bits(), 10.0_f64.to_bits());
        assert_eq!(place(20.0, [1.0, 3.0]).to_bits(), (10.0 + LINE).to_bits());
        assert_eq!(place(0.0, [1.5, 3.0]).to_bits(), (10.0 + 2.0 * LINE).to_bits());
        // elsewhere, and later
        assert_eq!(place(300.0, [1.0, 3.0]).to_bits(), 10.0_f64.to_bits());
        assert_eq!(place(0.0, [4.0, 5.0]).to_bits(), 10.0_f64.to_bits());
    }
}
