//! How far the exact impact is from each of the paper's equations, which shows where the fault is.

use super::Run;
use super::markdown::table;
use crate::capture::CaseResult;
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::impact::{RigidImpactOutput, exact};
use crate::owned::RobotState;
use crate::state::Forces;
use crate::target::Target;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// What is added to the base twist for a robot with momentum: [ω, vx, vy], rad/s, m/s.
const DRIFT: [f64; 3] = [0.01, 0.02, -0.01];
/// Residuals below it are rounding.
const ROUNDING: f64 = 1e-9;
/// Heads of the rows and units, in the order of the residuals.
const EQUATIONS: [(&str, &str); 9] = [
    ("(2), with unit wrenches at both end effectors", "N m"),
    ("(11)", "N m s"),
    ("(12)", "N m s, N s"),
    ("(13), as printed", "rad/s, m/s"),
    ("(13), with J_b I_b⁻¹ h_i", "rad/s, m/s"),
    ("(13), with J_b I_b⁻¹ (h_i + J_bᵀ F̄)", "rad/s, m/s"),
    ("(17), with h_i, the momentum before", "rad/s, m/s"),
    ("(17), with h_i + J_bᵀ F̄, the momentum after", "rad/s, m/s"),
    ("(15), (16), with M, J_e, v for I, J, θ̇", "N m s, N s"),
];

/// A row per equation, a column per robot: that of the first case, and the same one drifting.
pub(super) fn residuals(run: &Run, model: &AnyModel<f64>) -> Result<String, Error> {
    let still = run.study.approach.end().state.clone();
    let mut drifting = still.clone();
    drifting.base_twist = [0, 1, 2].map(|i| still.base_twist[i] + DRIFT[i]);
    let targets = targets(&run.study.cases[0], model.arms());
    let columns = [Impact::new(model, &still, &targets)?, Impact::new(model, &drifting, &targets)?];
    let columns = [columns[0].residuals(model)?, columns[1].residuals(model)?];
    let shown = |value: f64| if value < ROUNDING { "0 (< 1e-9)".to_owned() } else { format!("{value:.1e}") };
    let rows = EQUATIONS.iter().enumerate().map(|(i, (equation, unit))| {
        vec![(*equation).to_owned(), (*unit).to_owned(), shown(columns[0][i]), shown(columns[1][i])]
    });
    let head = ["equation", "unit", "no momentum before", "drifting robot"];
    Ok(table(&head, &rows.collect::<Vec<_>>()))
}

/// The targets of a case by arm.
fn targets(case: &CaseResult, arms: usize) -> Vec<Option<Target<f64>>> {
    let mut targets = vec![None; arms];
    for result in case.capture.iter().flat_map(|capture| &capture.impact.contacts) {
        let body = &case.targets[result.contact.target];
        let (mass, inertia, twist) = (body.mass, body.inertia, body.twist);
        targets[result.contact.arm] = Some(Target { mass, inertia, contact: result.contact.offset, twist });
    }
    targets
}

/// Velocities before and after an exact impact, with the matrices of its configuration.
struct Impact<'a> {
    state: &'a RobotState,
    targets: &'a [Option<Target<f64>>],
    /// [base twist; joint rates] before and after.
    velocities: [DVector<f64>; 2],
    /// `J_t t_tf`, all arms.
    contact_twists: DVector<f64>,
    /// F̄, all arms.
    impulses: DVector<f64>,
    /// M.
    mass: DMatrix<f64>,
    /// `[J_b J_m]`.
    jacobian: DMatrix<f64>,
}

impl<'a> Impact<'a> {
    fn new(model: &AnyModel<f64>, state: &'a RobotState, targets: &'a [Option<Target<f64>>]) -> Result<Self, Error> {
        let (arms, joints) = (model.arms(), model.joints());
        let (mut rates, mut twists) = (vec![0.0; joints], vec![[0.0; 3]; arms]);
        let mut impulses = vec![[0.0; 3]; arms];
        let mut after =
            RigidImpactOutput { joint_rates: &mut rates, target_twists: &mut twists, impulses: &mut impulses };
        let base_twist = exact(model, &state.view(), targets, &mut after)?;
        let of_contact = targets.iter().zip(&twists).flat_map(|(target, twist)| {
            let rows = target.map_or([[0.0; 3]; 3], |target| target.contact_jacobian());
            rows.map(|row| row.iter().zip(twist).map(|(a, b)| a * b).sum::<f64>())
        });
        let stacked = |base: [f64; 3], joints: &[f64]| DVector::from_vec([&base[..], joints].concat());
        let size = 3 + joints;
        let (mut mass, mut jacobian) = (vec![0.0; size * size], vec![0.0; 3 * arms * size]);
        model.mass_matrix(&state.base_pose, &state.joint_angles, &mut mass)?;
        model.end_effector_jacobian(&state.base_pose, &state.joint_angles, &mut jacobian)?;
        Ok(Self {
            state,
            targets,
            contact_twists: DVector::from_vec(of_contact.collect()),
            velocities: [stacked(state.base_twist, &state.joint_rates), stacked(base_twist, &rates)],
            impulses: DVector::from_vec(impulses.concat()),
            mass: DMatrix::from_row_slice(size, size, &mass),
            jacobian: DMatrix::from_row_slice(3 * arms, size, &jacobian),
        })
    }

    /// The largest component of each equation's left-hand less its right-hand side.
    fn residuals(&self, model: &AnyModel<f64>) -> Result<[f64; 9], Error> {
        let joints = model.joints();
        let (mass, jacobian) = (&self.mass, &self.jacobian);
        let (of_base, of_joints) = (mass.fixed_view::<3, 3>(0, 0).into_owned(), mass.view((0, 3), (3, joints)));
        let by_base = jacobian.fixed_columns::<3>(0);
        let singular = Error::Singular { what: "a matrix of the paper's impact", pivot: 0.0, limit: 0.0 };
        let inverse = of_base.try_inverse().ok_or(singular)?;
        let (mut inertia, mut bias) = (vec![0.0; joints * joints], vec![0.0; joints]);
        let mut generalized = vec![0.0; jacobian.nrows() * joints];
        model.reduced_dynamics(&self.state.view(), &mut inertia, &mut bias, &mut generalized)?;
        let inertia = DMatrix::from_row_slice(joints, joints, &inertia);
        let generalized = DMatrix::from_row_slice(jacobian.nrows(), joints, &generalized);
        let [before, after] = &self.velocities;
        let (rates_before, rates_after) = (before.rows(3, joints), after.rows(3, joints));
        let jump = &inertia * (rates_after - rates_before);
        let momentum: Vector3<f64> = mass.fixed_rows::<3>(0) * before;
        let gained: Vector3<f64> = by_base.transpose() * &self.impulses;
        let transposed = generalized.transpose().lu();
        let impulses = transposed.solve(&jump).ok_or(singular)?;
        let by_joints = &generalized * rates_after - &self.contact_twists;
        let base_twist =
            |momentum: Vector3<f64>| after.fixed_rows::<3>(0) - inverse * (momentum - of_joints * rates_after);
        let (known, all) = (by_base * (inverse * momentum), by_base * (inverse * (momentum + gained)));
        Ok([
            self.reduced_motion(model, &inertia, &bias, &generalized)?,
            (generalized.transpose() * &self.impulses - &jump).amax(),
            (impulses - &self.impulses).amax(),
            by_joints.amax(),
            (&by_joints + known).amax(),
            (&by_joints + all).amax(),
            base_twist(momentum).amax(),
            base_twist(momentum + gained).amax(),
            self.in_full_coordinates(),
        ])
    }

    /// Eq. (2) with the accelerations of eq. (1), under unit wrenches at the end effectors.
    fn reduced_motion(
        &self,
        model: &AnyModel<f64>,
        inertia: &DMatrix<f64>,
        bias: &[f64],
        generalized: &DMatrix<f64>,
    ) -> Result<f64, Error> {
        let (arms, joints) = (model.arms(), model.joints());
        let wrenches = vec![[1.0; 3]; arms];
        let (torques, mut accelerations) = (vec![0.0; joints], vec![0.0; joints]);
        let forces = Forces { end_effector_wrenches: Some(&wrenches), ..Forces::torques(&torques) };
        model.forward_dynamics(&self.state.view(), &forces, &mut accelerations)?;
        let wrenches = DVector::from_element(3 * arms, 1.0);
        let (accelerations, bias) = (DVector::from_vec(accelerations), DVector::from_column_slice(bias));
        Ok((inertia * accelerations + bias - generalized.transpose() * wrenches).amax())
    }

    /// `G v_f − H`, by `G = M + J_eᵀ N J_e` and `H = M v_i + J_eᵀ J_t⁻ᵀ I_t t_ti`.
    fn in_full_coordinates(&self) -> f64 {
        let arms = self.targets.len();
        let mut of_targets = DMatrix::zeros(3 * arms, 3 * arms);
        let mut momentum = DVector::zeros(3 * arms);
        for (i, target) in self.targets.iter().enumerate() {
            let Some(target) = target else { continue };
            let inertia = Matrix3::from_diagonal(&[target.inertia, target.mass, target.mass].into());
            // of columns; the determinant is 1
            let Some(inverse) = Matrix3::from(target.contact_jacobian()).transpose().try_inverse() else { continue };
            of_targets.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&(inverse.transpose() * inertia * inverse));
            let twist = Vector3::from(target.twist);
            momentum.fixed_rows_mut::<3>(3 * i).copy_from(&(inverse.transpose() * inertia * twist));
        }
        let [before, after] = &self.velocities;
        let matrix = &self.mass + self.jacobian.transpose() * of_targets * &self.jacobian;
        (matrix * after - &self.mass * before - self.jacobian.transpose() * momentum).amax()
    }
}
