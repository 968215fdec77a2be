//! Where the bodies of a robot are.

use crate::layout::Layout;
use crate::registry;

/// One body.
pub(super) struct Place {
    /// kg.
    mass: f64,
    /// About its COM, kg m².
    inertia: f64,
    /// Of its COM, m.
    at: [f64; 2],
}

/// Every body, in the inertial frame; `None` where numbers are too large to be computed with.
pub(super) fn places(layout: &Layout, base_pose: &[f64; 3], joint_angles: &[f64]) -> Option<Vec<Place>> {
    let model = registry::generic(layout);
    let (mut inertias, mut poses) = (vec![[0.0; 2]; model.joints() + 1], vec![[0.0; 3]; model.joints() + 1]);
    model.body_inertias(&mut inertias).ok()?;
    model.body_poses(base_pose, joint_angles, &mut poses).ok()?;
    let place =
        |([mass, inertia], [_, x, y]): (&[f64; 2], &[f64; 3])| Place { mass: *mass, inertia: *inertia, at: [*x, *y] };
    Some(inertias.iter().zip(&poses).map(place).collect())
}

/// Of all bodies together, m.
pub(super) fn center_of_mass(places: &[Place]) -> [f64; 2] {
    let mass: f64 = places.iter().map(|place| place.mass).sum();
    [0, 1].map(|axis: usize| places.iter().map(|place| place.mass * place.at[axis]).sum::<f64>() / mass)
}

/// Of all bodies together about their centre of mass, kg m².
pub(super) fn inertia(places: &[Place]) -> f64 {
    let [x, y] = center_of_mass(places);
    let each = |place: &Place| place.inertia + place.mass * ((place.at[0] - x).powi(2) + (place.at[1] - y).powi(2));
    places.iter().map(each).sum()
}
