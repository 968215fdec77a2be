//! The parts of lines and points within a rectangle.

use super::figure::{Mark, Series};

/// What of a series is between two corners: a line leaves and enters the rectangle, each part of it is a series.
pub(super) fn cut(series: &Series, low: [f64; 2], high: [f64; 2]) -> Vec<Series> {
    let of = |points| Series { points, ..series.clone() };
    let is_inside = |(x, y): &(f64, f64)| (low[0]..=high[0]).contains(x) && (low[1]..=high[1]).contains(y);
    if !matches!(series.mark, Mark::Line(..)) {
        let points: Vec<_> = series.points.iter().copied().filter(is_inside).collect();
        return if points.is_empty() { Vec::new() } else { vec![of(points)] };
    }
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in series.points.windows(2) {
        let Some([from, to]) = segment([pair[0], pair[1]], low, high) else { continue };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts.into_iter().map(of).collect()
}

/// The part of a segment within a rectangle, by its parameters at the four edges (Liang and Barsky).
fn segment([a, b]: [(f64, f64); 2], low: [f64; 2], high: [f64; 2]) -> Option<[(f64, f64); 2]> {
    let (from, along) = ([a.0, a.1], [b.0 - a.0, b.1 - a.1]);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for i in 0..2 {
        for (way, room) in [(-along[i], from[i] - low[i]), (along[i], high[i] - from[i])] {
            match way {
                0.0 if room < 0.0 => return None,
                0.0 => {}
                way if way < 0.0 => enter = enter.max(room / way),
                way => leave = leave.min(room / way),
            }
        }
    }
    let at = |part: f64| (from[0] + part * along[0], from[1] + part * along[1]);
    // ends inside stay as they are
    let ends = [if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }];
    (enter <= leave).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::super::style::{Colour, Dash, Symbol};
    use super::{Series, cut};

    #[test]
    fn lines_end_at_the_edges_and_points_outside_are_left_out() {
        let points = vec![(-2.0, 0.5), (0.5, 0.5), (0.5, 3.0), (0.75, 3.0), (0.75, 0.0)];
        let [low, high] = [[0.0; 2], [1.0; 2]];
        let line = Series::line("line", Colour::BLACK, Dash::Solid, 1.0, points.clone());
        let parts: Vec<_> = cut(&line, low, high).into_iter().map(|part| part.points).collect();
        assert_eq!(parts, [vec![(0.0, 0.5), (0.5, 0.5), (0.5, 1.0)], vec![(0.75, 1.0), (0.75, 0.0)]]);
        assert!(cut(&line, [5.0; 2], [6.0; 2]).is_empty());
        let symbols = Series::symbols("points", Colour::BLACK, Symbol::Circle, points);
        assert_eq!(cut(&symbols, low, high)[0].points, [(0.5, 0.5), (0.75, 0.0)]);
    }
}
