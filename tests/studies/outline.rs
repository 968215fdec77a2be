//! Signed distances from outlines, and the corners that are none.

use planar_capture::outline::{NoOutline, Outline, SignedDistance};

fn plus_shape() -> Outline {
    let quarter = [[1.0, -1.0], [3.0, -1.0], [3.0, 1.0]];
    let turn = |[x, y]: [f64; 2], k: usize| (0..k).fold([x, y], |[x, y], _| [-y, x]);
    let corners = (0..4).flat_map(|k| quarter.map(|corner| turn(corner, k))).collect();
    Outline::polygon(corners).expect("an outline with edges on one line")
}

#[test]
fn gaps_of_a_plus() {
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
        let [x, y] = signed_distance.normal;
        assert!((x - normal[0]).hypot(y - normal[1]) < 1e-14, "{point:?}: {signed_distance:?}");
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
    assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0]]), NoOutline::TooFew(2));
    assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), NoOutline::Flat);
    assert_eq!(of(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 2.0]]), NoOutline::Crossing(1, 3));
    assert_eq!(of(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), NoOutline::Crossing(1, 3));
}
