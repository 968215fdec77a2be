//! One impact of a study: exact and paper side by side, with momentum and energy of robot and targets together.

use crate::dynamics::Model;
use crate::error::Error;
use crate::impact::{self, After, Workspace};
use crate::simulate::Motion;
use crate::state::State;
use crate::target::Target;

/// The impact by both models.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// In full coordinates.
    pub exact: ImpactResult,
    /// The paper's literal equations.
    pub paper: ImpactResult,
}

/// What an impact did, by one of the models. Per arm: `None` where the arm captures nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpactResult {
    /// rad/s.
    pub joint_rates_after: Vec<f64>,
    /// [ω, vx, vy] of the base COM; rad/s, m/s.
    pub base_twist_after: [f64; 3],
    /// [ω, vx, vy] of each target's COM.
    pub target_twists_after: Vec<Option<[f64; 3]>>,
    /// [n, fx, fy] on the robot at each tip; N m s, N s.
    pub impulses: Vec<Option<[f64; 3]>>,
    /// [l, px, py] after less before, robot and targets together, about the inertial origin.
    pub momentum_jump: [f64; 3],
    /// The largest jump over the sum of the bodies' momenta, linear or angular.
    pub relative_momentum_jump: f64,
    /// With the targets, J.
    pub kinetic_energy_before: f64,
    /// With the targets, J.
    pub kinetic_energy_after: f64,
}

impl ImpactResult {
    /// Magnitude of [fx, fy] per arm, N s.
    #[must_use]
    pub fn impulse_magnitudes(&self) -> Vec<Option<f64>> {
        self.impulses.iter().map(|impulse| impulse.map(|[_, fx, fy]| fx.hypot(fy))).collect()
    }
}

/// Both models of the impact at the end of an approach.
///
/// # Errors
/// What the model says of the state and the targets.
pub fn capture(model: &dyn Model<f64>, before: &Motion, targets: &[Option<Target<f64>>]) -> Result<Capture, Error> {
    let (joints, arms) = (model.joints(), model.arms());
    let size = 3 + joints;
    let solve = |literal: bool| {
        let mut joint_rates = vec![0.0; joints];
        let mut target_twists = vec![[0.0; 3]; arms];
        let mut impulses = vec![[0.0; 3]; arms];
        let mut after =
            After { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
        let base_twist = if literal {
            let mut workspace = Workspace {
                impact_matrix: &mut vec![0.0; joints * joints],
                impact_momentum: &mut vec![0.0; joints],
                jacobian: &mut vec![0.0; 3 * arms * joints],
                mass_matrix: &mut vec![0.0; size * size],
            };
            impact::paper(model, &before.state(), targets, &mut workspace, &mut after)?
        } else {
            impact::exact(model, &before.state(), targets, &mut after)?
        };
        balance(model, before, targets, base_twist, joint_rates, &target_twists, &impulses)
    };
    Ok(Capture { exact: solve(false)?, paper: solve(true)? })
}

/// Momentum [l, px, py] and energy of robot and targets, and the sum of their parts' magnitudes.
struct Total {
    momentum: [f64; 3],
    magnitude: [f64; 2],
    energy: f64,
}

/// Values in arm order, `None` where an arm captures nothing.
pub(crate) fn per_arm(targets: &[Option<Target<f64>>], values: &[[f64; 3]]) -> Vec<Option<[f64; 3]>> {
    targets.iter().zip(values).map(|(target, value)| target.map(|_| *value)).collect()
}

fn balance(
    model: &dyn Model<f64>,
    before: &Motion,
    targets: &[Option<Target<f64>>],
    base_twist: [f64; 3],
    joint_rates: Vec<f64>,
    target_twists: &[[f64; 3]],
    impulses: &[[f64; 3]],
) -> Result<ImpactResult, Error> {
    let mut tips = vec![[0.0; 3]; model.arms()];
    model.end_effector_poses(&before.base_pose, &before.joint_angles, &mut tips)?;
    let twists_before: Vec<[f64; 3]> = targets.iter().map(|t| t.map_or([0.0; 3], |t| t.twist)).collect();
    let moving = State { base_twist, joint_rates: &joint_rates, ..before.state() };
    let start = total(model, &before.state(), targets, &tips, &twists_before)?;
    let end = total(model, &moving, targets, &tips, target_twists)?;
    let jump: [f64; 3] = std::array::from_fn(|i| end.momentum[i] - start.momentum[i]);
    let relative = |jump: f64, scale: f64| if scale > 0.0 { jump / scale } else { 0.0 };
    let angular = relative(jump[0].abs(), start.magnitude[0].max(end.magnitude[0]));
    let linear = relative(jump[1].hypot(jump[2]), start.magnitude[1].max(end.magnitude[1]));
    Ok(ImpactResult {
        base_twist_after: base_twist,
        target_twists_after: per_arm(targets, target_twists),
        impulses: per_arm(targets, impulses),
        momentum_jump: jump,
        relative_momentum_jump: angular.max(linear),
        kinetic_energy_before: start.energy,
        kinetic_energy_after: end.energy,
        joint_rates_after: joint_rates,
    })
}

fn total(
    model: &dyn Model<f64>,
    state: &State<'_, f64>,
    targets: &[Option<Target<f64>>],
    tips: &[[f64; 3]],
    twists: &[[f64; 3]],
) -> Result<Total, Error> {
    let robot = model.momentum(state)?;
    let [px, py] = robot.linear_momentum;
    let mut total = Total {
        momentum: [robot.angular_momentum, px, py],
        magnitude: [robot.angular_momentum.abs(), px.hypot(py)],
        energy: robot.kinetic_energy,
    };
    for ((target, tip), twist) in targets.iter().zip(tips).zip(twists) {
        let Some(target) = target else { continue };
        let (momentum, energy) = target.momentum(&target.position(tip), twist);
        for (sum, part) in total.momentum.iter_mut().zip(momentum) {
            *sum += part;
        }
        total.magnitude[0] += momentum[0].abs();
        total.magnitude[1] += momentum[1].hypot(momentum[2]);
        total.energy += energy;
    }
    Ok(total)
}
