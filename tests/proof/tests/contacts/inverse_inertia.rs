//! The inverse inertia at an end effector, and impulses, effective masses and ellipses from it, against dense algebra
//! and impacts.

use crate::product::{both_models, solve_impact};
use nalgebra::{DMatrix, Matrix2, Matrix3, Vector2};
use planar_capture::body::Body;
use planar_capture::contact::{Contact, ContactLaw, ContactPartner, InverseInertia};
use planar_capture::dynamics::Model;
use planar_capture::error::Error;
use planar_capture::generated;
use planar_capture::layout::Layout;
use planar_capture::registry;
use planar_capture::target::Target;
use planar_dynamics::nalgebra::matrix;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, close, for_every_layout, layout, tolerance};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

fn of_end_effector(model: &dyn Model<f64>, s: &RandomState, arm: usize) -> Result<InverseInertia<f64>, Error> {
    let (mut wrenches, mut scratch) = (vec![[f64::NAN; 3]; model.arms()], vec![f64::NAN; 2 * model.joints()]);
    InverseInertia::of_end_effector(model, &s.base_pose, &s.joint_angles, arm, &mut wrenches, &mut scratch)
}

/// J M⁻¹ Jᵀ of one arm, from the generic M and J.
fn dense(layout: &Layout, s: &RandomState, arm: usize) -> DMatrix<f64> {
    let model = registry::generic(layout);
    let size = 3 + layout.joints();
    let (mut mass, mut jacobian) = (vec![0.0; size * size], vec![0.0; 3 * layout.arms.len() * size]);
    model.mass_matrix(&s.base_pose, &s.joint_angles, &mut mass).expect("M");
    model.end_effector_jacobian(&s.base_pose, &s.joint_angles, &mut jacobian).expect("J");
    let mass = DMatrix::from_row_slice(size, size, &mass);
    let jacobian = DMatrix::from_row_slice(3 * layout.arms.len(), size, &jacobian).rows(3 * arm, 3).into_owned();
    &jacobian * mass.cholesky().expect("positive definite").solve(&jacobian.transpose())
}

fn check_end_effectors(layout: &Layout, s: &RandomState) {
    for arm in 0..layout.arms.len() {
        let expected = dense(layout, s, arm);
        for model in both_models(layout) {
            let found = of_end_effector(&*model, s, arm).expect("an inverse inertia");
            // symmetric: columns are rows
            close("J M⁻¹ Jᵀ", found.0.as_flattened(), expected.as_slice(), tolerance::SAME_IMPACT);
            let missing = of_end_effector(&*model, s, layout.arms.len());
            assert!(matches!(missing, Err(Error::Index { what: "arm", .. })), "{missing:?}");
        }
    }
}

macro_rules! end_effectors {
    ($($layout:ident)*) => {
        proptest! {
            #![proptest_config(ProptestConfig { cases: 16, ..config() })]
            $(
            #[test]
            fn $layout(s in sample(generated::$layout::ARMS, generated::$layout::JOINTS)) {
                check_end_effectors(&layout(stringify!($layout)), &s);
            })*
        }
    };
}
for_every_layout!(end_effectors);

/// Its symmetric linear part, velocity per impulse.
fn force_part(inertia: &InverseInertia<f64>) -> Matrix2<f64> {
    let [_, [_, a, b], [_, c, d]] = inertia.0;
    Matrix2::new(a, b, c, d)
}

/// Semi-axes and direction against the eigenvectors of G².
fn check_ellipse(inertia: &InverseInertia<f64>) {
    let g = force_part(inertia);
    let eigen = (g * g).symmetric_eigen();
    let small = usize::from(eigen.eigenvalues[0] >= eigen.eigenvalues[1]);
    let [longer, shorter] = [small, 1 - small].map(|i| 1.0 / eigen.eigenvalues[i].sqrt());
    let ellipse = inertia.impulse_ellipse();
    close("semi-axes", &ellipse.semi_axes, &[longer, shorter], tolerance::ELLIPSE);
    assert!(ellipse.direction > -FRAC_PI_2 && ellipse.direction <= FRAC_PI_2, "{ellipse:?}");
    let axis = Vector2::new(ellipse.direction.cos(), ellipse.direction.sin());
    let across = axis.perp(&eigen.eigenvectors.column(small).into_owned());
    // the direction of a near circle is ill-conditioned
    assert!(across.abs() * (longer - shorter) <= tolerance::ELLIPSE * longer, "{ellipse:?} {eigen:?}");
    for (axis, length) in [(axis, longer), (Vector2::new(-axis.y, axis.x), shorter)] {
        let on_it = (g * axis * length).norm();
        assert!((on_it - 1.0).abs() * (longer - shorter) <= tolerance::ELLIPSE * longer, "{on_it} {ellipse:?}");
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn inverse_inertia_of_a_free_body(s in sample(1, 3)) {
        let ([mass, inertia, rx, ry], twist) = s.targets[0];
        let target = Target { mass, inertia, contact: [rx, ry], twist };
        let jacobian = matrix(&target.contact_jacobian());
        let inverse = Matrix3::from_diagonal(&[1.0 / inertia, 1.0 / mass, 1.0 / mass].into());
        let expected = jacobian * inverse * jacobian.transpose();
        close("J I⁻¹ Jᵀ", InverseInertia::of_body(mass, inertia, [rx, ry]).0.as_flattened(), expected.as_slice(), tolerance::POLYNOMIAL);
    }

    /// Stopping impulse, effective mass and ellipse by their definitions.
    #[test]
    fn impulses_at_a_point(s in sample(2, 6), direction in -3.2..3.2_f64) {
        let layout = layout("dual_arm_3r");
        let model = registry::generated(&layout).expect("generated code");
        let ([mass, inertia, rx, ry], [_, vx, vy]) = s.targets[0];
        let of_end_effector = of_end_effector(&*model, &s, 0).expect("an inverse inertia");
        let of_body = InverseInertia::of_body(mass, inertia, [rx, ry]);
        let both = of_end_effector.plus(&of_body);
        let sum = matrix(&of_end_effector.0) + matrix(&of_body.0);
        close("sum", both.0.as_flattened(), sum.as_slice(), tolerance::POLYNOMIAL);
        for inertia in [of_end_effector, of_body, both] {
            let g = force_part(&inertia);
            let stopped = Vector2::new(vx, vy) + g * Vector2::from(inertia.stopping_impulse(&[vx, vy]));
            let size = g.norm() * Vector2::from(inertia.stopping_impulse(&[vx, vy])).norm();
            assert_close("stopped", stopped.as_slice(), &[0.0; 2], tolerance::IDENTITY * size);
            let normal = Vector2::new(direction.cos(), direction.sin());
            let weight = inertia.effective_mass(&normal.into());
            assert_close("1 m/s", &[normal.dot(&(g * normal)) * weight], &[1.0], tolerance::IDENTITY);
            check_ellipse(&inertia);
        }
    }

    /// The impulse of a pin is the stopping impulse of the relative velocity; that of a bounce is 1 + e times the
    /// effective mass times the approach speed.
    #[test]
    fn a_plastic_pin_is_the_stopping_impulse(s in sample(2, 6), direction in -3.2..3.2_f64, restitution in 0.0..1.0_f64) {
        let layout = layout("dual_arm_3r");
        let model = registry::generated(&layout).expect("generated code");
        let ([mass, inertia, rx, ry], twist @ [omega, vx, vy]) = s.targets[0];
        let body = Body { mass, inertia, pose: [0.0; 3], twist };
        let mut twists = [[0.0; 3]; 2];
        model.end_effector_twists(&s.state(), &mut twists).expect("twists");
        let closing = [twists[1][1] - (vx - omega * ry), twists[1][2] - (vy + omega * rx)];
        let speed = Vector2::from(closing);
        let both = of_end_effector(&*model, &s, 1).expect("an inverse inertia").plus(&InverseInertia::of_body(mass, inertia, [rx, ry]));
        let impulse = |law| {
            let contact = Contact { arm: 1, partner: ContactPartner::Body(0), offset: [rx, ry], law };
            solve_impact(&*model, &s.state(), &[body], &[contact]).expect("an impact").impulses[0]
        };
        let [fx, fy] = both.stopping_impulse(&closing);
        close("pin", &impulse(ContactLaw::Pin), &[0.0, fx, fy], tolerance::SAME_IMPACT);
        let towards = Vector2::new(direction.cos(), direction.sin());
        let normal = -towards * towards.dot(&speed).signum();
        let expected = normal * ((1.0 + restitution) * -normal.dot(&speed) * both.effective_mass(&normal.into()));
        close("bounce", &impulse(ContactLaw::Bounce { normal: normal.into(), restitution }), &[0.0, expected.x, expected.y], tolerance::SAME_IMPACT);
    }
}

/// Directions at the ends of their range, and a circle.
#[test]
fn ellipses_along_the_axes() {
    let of = |a: f64, b: f64, c: f64| InverseInertia([[1.0, 0.0, 0.0], [0.0, a, b], [0.0, b, c]]);
    for (inertia, direction) in [
        (of(1.0, 0.0, 4.0), 0.0),
        (of(4.0, 0.0, 1.0), FRAC_PI_2),
        (of(4.0, -0.0, 1.0), FRAC_PI_2),
        (of(4.0, 1e-300, 1.0), FRAC_PI_2),
        (of(2.0, 1.0, 2.0), -FRAC_PI_4),
        (of(2.0, -1.0, 2.0), FRAC_PI_4),
    ] {
        check_ellipse(&inertia);
        assert_close("direction", &[inertia.impulse_ellipse().direction], &[direction], tolerance::POLYNOMIAL);
    }
    let circle = of(0.5, 0.0, 0.5).impulse_ellipse();
    assert_close("circle", &circle.semi_axes, &[2.0, 2.0], tolerance::POLYNOMIAL);
}
