//! Cuts a line into the strokes of a dash pattern.

use super::style::Dash;

/// The strokes of a line through `points`; `points_per_unit` are the scales of x and y.
pub(super) fn strokes(points: &[(f64, f64)], points_per_unit: [f64; 2], dash: Dash) -> Vec<Vec<(f64, f64)>> {
    let lengths = dash.lengths();
    let Some(mut remaining) = lengths.first().copied() else { return vec![points.to_vec()] };
    let (mut index, mut strokes, mut stroke) = (0, Vec::new(), Vec::from_iter(points.first().copied()));
    for pair in points.windows(2) {
        let [(mut x, mut y), (end_x, end_y)] = [pair[0], pair[1]];
        let distance = |x, y| libm::hypot((end_x - x) * points_per_unit[0], (end_y - y) * points_per_unit[1]);
        let mut length = distance(x, y);
        while length >= remaining {
            let part = remaining / length;
            (x, y) = (x + part * (end_x - x), y + part * (end_y - y));
            // strokes and gaps alternate
            if index % 2 == 0 {
                stroke.push((x, y));
                strokes.push(std::mem::take(&mut stroke));
            } else {
                stroke = vec![(x, y)];
            }
            index = (index + 1) % lengths.len();
            remaining = lengths[index];
            length = distance(x, y);
        }
        remaining -= length;
        if index % 2 == 0 {
            stroke.push((end_x, end_y));
        }
    }
    if stroke.len() > 1 {
        strokes.push(stroke);
    }
    strokes
}
