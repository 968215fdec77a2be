//! Momenta for rates and back, the gradient of the energy, and rates from the momentum, for every shipped layout.

use planar_capture::control::{BaseTorque, Control, ZeroTorque};
use planar_capture::dynamics::AnyModel;
use planar_capture::error::Error;
use planar_capture::formulation::{CanonicalVariables, ReducedCoordinates, derivative};
use planar_capture::layout::Layout;
use planar_capture::registry;
use planar_capture::state::{State, vector_length};
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::tolerance;
use proptest::prelude::*;

fn for_every_layout(check: impl Fn(&AnyModel<f64>, &RandomState)) {
    for (name, text) in registry::SHIPPED {
        let layout = Layout::parse(text, name).unwrap_or_else(|report| panic!("{report}"));
        let model = registry::generated(&layout).expect("generated code");
        proptest!(config(), |(s in sample(model.arms(), model.joints()))| check(&*model, &s));
    }
}

/// `M v`, and what its largest terms are.
fn mass_times(model: &AnyModel<f64>, pose: &[f64; 3], angles: &[f64], v: &[f64]) -> (Vec<f64>, f64) {
    let mut mass_matrix = vec![0.0; v.len() * v.len()];
    model.mass_matrix(pose, angles, &mut mass_matrix).expect("a mass matrix");
    let rows = || mass_matrix.chunks_exact(v.len());
    let product = rows().map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum()).collect();
    let terms = rows().map(|row| row.iter().zip(v).map(|(a, b)| (a * b).abs()).sum());
    (product, terms.fold(0.0, f64::max))
}

#[track_caller]
fn close(what: &str, found: &[f64], expected: &[f64], scale: f64, tolerance: f64) {
    planar_proof::assert_close(what, found, expected, tolerance * scale);
}

#[test]
fn canonical_momenta_are_mass_times_rates_and_give_them_back() {
    for_every_layout(|model, s| {
        let (joints, state) = (model.joints(), s.state());
        let v = [&s.base_twist[..], &s.joint_rates].concat();
        let (expected, scale) = mass_times(model, &s.base_pose, &s.joint_angles, &v);
        let mut momenta = vec![0.0; 3 + joints];
        let (mut back, mut gradient) = (vec![0.0; joints], vec![0.0; 3 + joints]);
        with_canonical(model, s, |canonical| {
            canonical.momenta(model, &state, &mut momenta)?;
            canonical.add_energy_gradient(model, &state, &mut gradient)?;
            let twist = canonical.velocities(model, s.base_pose, &s.joint_angles, &momenta, &mut back)?;
            back = [&twist[..], &back].concat();
            Ok(())
        });
        close("momenta", &momenta, &expected, scale, tolerance::IDENTITY);
        let [l, px, py] =
            [momenta[0] + s.base_pose[1] * momenta[2] - s.base_pose[2] * momenta[1], momenta[1], momenta[2]];
        let robot = model.momentum(&state).expect("a momentum");
        let distance = s.base_pose[1].hypot(s.base_pose[2]).max(1.0);
        close("momentum", &[l], &[robot.angular_momentum], distance * scale, tolerance::IDENTITY);
        close("momentum", &[px, py], &robot.linear_momentum, scale, tolerance::IDENTITY);
        let (again, _) = mass_times(model, &s.base_pose, &s.joint_angles, &back);
        close("M of the rates again", &again, &momenta, scale, tolerance::SOLVED_IDENTITY);

        // ∂T/∂q by central differences of ½ vᵀ M v
        let energy = |place: usize, step: f64| {
            let (mut pose, mut angles) = (s.base_pose, s.joint_angles.clone());
            *pose.iter_mut().chain(&mut angles).nth(place).expect("a coordinate") += step;
            let (product, _) = mass_times(model, &pose, &angles, &v);
            0.5 * product.iter().zip(&v).map(|(p, v)| p * v).sum::<f64>()
        };
        let quotients: Vec<f64> = (0..3 + joints).map(|i| (energy(i, 1e-5) - energy(i, -1e-5)) / 2e-5).collect();
        let speed = v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        close("∂T/∂q", &gradient, &quotients, scale * speed, tolerance::ENERGY_GRADIENT);
    });
}

fn with_canonical(
    model: &AnyModel<f64>,
    s: &RandomState,
    work: impl FnOnce(&mut CanonicalVariables<'_, f64>) -> Result<(), Error>,
) {
    let joints = model.joints();
    let mut canonical = CanonicalVariables {
        inertias: &mut vec![[0.0; 2]; joints + 1],
        poses: &mut vec![[0.0; 3]; joints + 1],
        twists: &mut vec![[0.0; 3]; joints + 1],
        offsets: &mut vec![[0.0; 2]; joints],
        leaves: &mut vec![false; joints],
        rates: &mut vec![0.0; joints],
    };
    // measured in another pose than it is used in
    let straight = vec![0.1; joints];
    canonical.measure(model, &[0.3, 2.0, -1.0], &straight).expect("a robot");
    work(&mut canonical).unwrap_or_else(|e| panic!("{e} at {s:?}"));
}

/// Torques of a table, and one on the base, N m.
struct Given<'a>(&'a [f64], f64);

impl Control<f64> for Given<'_> {
    fn joint_torques(
        &mut self,
        _: f64,
        _: &AnyModel<f64>,
        _: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        torques.copy_from_slice(self.0);
        Ok(())
    }

    fn base_torque(&self) -> Option<BaseTorque<f64>> {
        Some(BaseTorque { torque: self.1, saturated: false })
    }
}

/// Eq. (2) at the twist recovered from the momentum, which the base torque has changed since the start, has the joint
/// accelerations of eq. (1) with that momentum, for any previous twist.
#[test]
fn reduced_coordinates_accelerate_as_full_ones() {
    for_every_layout(|model, s| {
        let (joints, state) = (model.joints(), s.state());
        let mut x = vec![0.0; vector_length(joints)];
        state.write(&mut x).expect("room");
        let impulse = 0.9; // of the base torque so far, N m s
        *x.last_mut().expect("an entry") = impulse;
        let (mut full, mut reduced) = (x.clone(), x.clone());
        let mut torques = vec![0.0; joints];
        let mut law = Given(&s.joint_torques, 1.7);
        derivative(model, &mut law, 0.0, &x, &mut full, &mut torques).expect("full coordinates");
        let momentum = model.momentum(&state).expect("a momentum");
        let [px, py] = momentum.linear_momentum;
        let mut equation = ReducedCoordinates {
            momentum: [momentum.angular_momentum - impulse, px, py],
            mass_matrix: &mut vec![0.0; (3 + joints) * (3 + joints)],
            generalized_inertia: &mut vec![0.0; joints * joints],
            generalized_bias: &mut vec![0.0; joints],
            generalized_jacobian: &mut vec![0.0; 3 * model.arms() * joints],
        };
        let mut forgotten = x.clone();
        forgotten[3 + joints..6 + joints].fill(7.0);
        equation.derivative(model, &mut law, 0.0, &forgotten, &mut reduced, &mut torques).expect("reduced coordinates");
        let half = 3 + joints;
        let speed = x[half..].iter().fold(1.0, |most: f64, v| most.max(v.abs()));
        close("rates", &reduced[..half], &full[..half], speed, tolerance::SOLVED_IDENTITY);
        let scale = full.iter().fold(speed, |most, a| most.max(a.abs()));
        let place = half + 3..2 * half;
        close("joint accelerations", &reduced[place.clone()], &full[place], scale, tolerance::SOLVED_IDENTITY);
        close("power", &reduced[2 * half..], &full[2 * half..], 100.0, tolerance::SOLVED_IDENTITY);
        equation.recover(model, &mut forgotten).expect("a twist");
        close("recovered", &forgotten, &x, speed, tolerance::SOLVED_IDENTITY);
        equation.derivative(model, &mut ZeroTorque, 0.0, &x[1..], &mut reduced, &mut torques).expect_err("too short");
    });
}
