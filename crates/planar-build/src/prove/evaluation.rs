//! Every quantity of the table at one instant, by any model of the robot.
//!
//! # Example
//! ```
//! use planar_build::prove::evaluation::{EvaluationInput, evaluate};
//! use planar_build::prove::generic::Generic;
//! use planar_build::prove::owned::RobotState;
//! use planar_dynamics::quantity::Quantity;
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let (joint_angles, joint_rates, base_twist) = (vec![0.5; 6], vec![0.0; 6], [0.0, 0.1, 0.0]);
//! let instant = EvaluationInput {
//!     state: RobotState { base_pose: [0.0; 3], joint_angles, base_twist, joint_rates },
//!     joint_torques: vec![0.0; 6],
//!     base_wrench: None,
//!     end_effector_wrenches: None,
//!     targets: vec![None, None],
//! };
//! let values = evaluate(&Generic::new(&layout), &instant)?;
//! // 560 kg at 0.1 m/s
//! let energy = values.get(Quantity::KineticEnergy).expect("what every robot has");
//! assert!((energy[0] - 2.8).abs() < 1e-12);
//! assert_eq!(values.get(Quantity::CaptureImpulses), None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::prove::owned::{CloneModel, RobotState};
use planar_dynamics::dynamics::Model;
use planar_dynamics::error::Error;
use planar_dynamics::impact::{self, RigidImpactOutput};
use planar_dynamics::quantity::Quantity;
use planar_dynamics::scalar::Real;
use planar_dynamics::state::{Forces, State};
use planar_dynamics::target::Target;
use planar_dynamics::validate::finite;
use planar_dynamics::with_quantities;

/// The robot's state, the forces on it, and the targets that it captures at that instant.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluationInput<T = f64> {
    /// Pose, angles, twist, rates.
    pub state: RobotState<T>,
    /// N m.
    pub joint_torques: Vec<T>,
    /// [n, fx, fy] at the base COM, inertial axes; `None` is zero.
    pub base_wrench: Option<[T; 3]>,
    /// [n, fx, fy] on the robot at each end effector, inertial axes; `None` is zero.
    pub end_effector_wrenches: Option<Vec<[T; 3]>>,
    /// One per arm; `None` where the arm captures nothing.
    pub targets: Vec<Option<Target<T>>>,
}

impl<T: Real> EvaluationInput<T> {
    /// The same with each number rounded to another scalar.
    #[must_use]
    pub fn rounded<U: Real>(&self) -> EvaluationInput<U> {
        let one = |x: T| U::constant(x.to_f64());
        let all = |values: &[T]| values.iter().map(|x| one(*x)).collect();
        let RobotState { base_pose, joint_angles, base_twist, joint_rates } = &self.state;
        let state = RobotState {
            base_pose: base_pose.map(one),
            joint_angles: all(joint_angles),
            base_twist: base_twist.map(one),
            joint_rates: all(joint_rates),
        };
        let target = |Target { mass, inertia, contact, twist }: Target<T>| Target {
            mass: one(mass),
            inertia: one(inertia),
            contact: contact.map(one),
            twist: twist.map(one),
        };
        let wrenches = self.end_effector_wrenches.as_ref();
        EvaluationInput {
            state,
            joint_torques: all(&self.joint_torques),
            base_wrench: self.base_wrench.map(|wrench| wrench.map(one)),
            end_effector_wrenches: wrenches.map(|wrenches| wrenches.iter().map(|wrench| wrench.map(one)).collect()),
            targets: self.targets.iter().map(|captured| captured.map(target)).collect(),
        }
    }

    fn forces(&self) -> Forces<'_, T> {
        Forces {
            joint_torques: &self.joint_torques,
            base_wrench: self.base_wrench,
            end_effector_wrenches: self.end_effector_wrenches.as_deref(),
        }
    }
}

/// Values of quantities at one instant, row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    arms: usize,
    joints: usize,
    /// In the table's order.
    by_quantity: Vec<Option<Vec<f64>>>,
}

impl Values {
    /// The values of one quantity; `None` for an impact without a target, and where it was not evaluated.
    #[must_use]
    pub fn get(&self, quantity: Quantity) -> Option<&[f64]> {
        self.by_quantity[quantity as usize].as_deref()
    }

    /// Number of entries along each axis of a quantity.
    #[must_use]
    pub fn shape(&self, quantity: Quantity) -> Vec<usize> {
        quantity.row().shape.iter().map(|extent| extent.count(self.arms, self.joints)).collect()
    }

    pub(super) fn set<T: Real>(&mut self, quantity: Quantity, value: &[T]) {
        self.by_quantity[quantity as usize] = Some(value.iter().map(|x| x.to_f64()).collect());
    }
}

/// Computes every quantity by a model, except those of the merged robot.
///
/// # Errors
/// Those of the model, and [`Error::NotFinite`] for a result that overflows.
pub fn evaluate<T: Real>(model: &dyn Model<T>, instant: &EvaluationInput<T>) -> Result<Values, Error> {
    let by_quantity = vec![None; Quantity::ALL.len()];
    let mut values = Values { arms: model.arms(), joints: model.joints(), by_quantity };
    let state = instant.state.view();
    let momentum = model.momentum(&state)?;
    values.set(Quantity::LinearMomentum, &momentum.linear_momentum);
    values.set(Quantity::AngularMomentum, &[momentum.angular_momentum]);
    values.set(Quantity::KineticEnergy, &[momentum.kinetic_energy]);

    functions(model, &state, &mut values)?;

    let joints = values.joints;
    let mut inertias = vec![[T::ZERO; 2]; joints + 1];
    model.body_inertias(&mut inertias)?;
    values.set(Quantity::BodyInertias, inertias.as_flattened());

    let (mut inertia, mut bias) = (vec![T::ZERO; joints * joints], vec![T::ZERO; joints]);
    let mut jacobian = vec![T::ZERO; 3 * values.arms * joints];
    model.reduced_dynamics(&state, &mut inertia, &mut bias, &mut jacobian)?;
    values.set(Quantity::GeneralizedInertia, &inertia);
    values.set(Quantity::GeneralizedBias, &bias);
    values.set(Quantity::GeneralizedJacobian, &jacobian);

    let mut joint_accelerations = vec![T::ZERO; joints];
    let base = model.forward_dynamics(&state, &instant.forces(), &mut joint_accelerations)?;
    values.set(Quantity::BaseAcceleration, &base);
    values.set(Quantity::JointAccelerations, &joint_accelerations);

    if instant.targets.iter().any(Option::is_some) {
        reduced_impact(model, instant, &mut values)?;
        capture(model, instant, &mut values)?;
    }
    Ok(values)
}

/// Computes every quantity by a model.
///
/// # Errors
/// As [`evaluate`].
pub fn evaluate_all<T: Real>(model: &dyn CloneModel<T>, instant: &EvaluationInput<T>) -> Result<Values, Error> {
    let mut values = evaluate(model, instant)?;
    if instant.targets.iter().any(Option::is_some) {
        merged(model, instant, &mut values)?;
    }
    Ok(values)
}

macro_rules! functions {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        /// The functions of configuration or state alone.
        fn functions<T: Real>(model: &dyn Model<T>, state: &State<'_, T>, values: &mut Values) -> Result<(), Error> {
            $($(
                let mut result = vec![T::ZERO; values.shape(Quantity::$quantity).iter().product()];
                call!(model.$method($inputs state), entries!($kind result))?;
                values.set(Quantity::$quantity, &result);
            )*)*
            Ok(())
        }
    };
}

macro_rules! call {
    ($model:ident.$method:ident(configuration $state:ident), $into:expr) => {
        $model.$method(&$state.base_pose, $state.joint_angles, $into)
    };
    ($model:ident.$method:ident(state $state:ident), $into:expr) => {
        $model.$method($state, $into)
    };
}

macro_rules! entries {
    (triples $values:ident) => {
        $values.as_chunks_mut().0
    };
    ($matrix_or_vector:ident $values:ident) => {
        &mut $values
    };
}

with_quantities!(functions);

fn reduced_impact<T: Real>(
    model: &dyn Model<T>,
    instant: &EvaluationInput<T>,
    values: &mut Values,
) -> Result<(), Error> {
    let joints = values.joints;
    let (mut matrix, mut momentum, mut rates) =
        (vec![T::ZERO; joints * joints], vec![T::ZERO; joints], vec![T::ZERO; joints]);
    model.reduced_impact(&instant.state.view(), &instant.targets, &mut matrix, &mut momentum, &mut rates)?;
    values.set(Quantity::ImpactMatrix, &matrix);
    values.set(Quantity::ImpactMomentum, &momentum);
    values.set(Quantity::ImpactJointRates, &rates);
    Ok(())
}

fn capture<T: Real>(model: &dyn Model<T>, instant: &EvaluationInput<T>, values: &mut Values) -> Result<(), Error> {
    let mut joint_rates = vec![T::ZERO; values.joints];
    let (mut target_twists, mut impulses) = (vec![[T::ZERO; 3]; values.arms], vec![[T::ZERO; 3]; values.arms]);
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
    let base_twist = impact::exact(model, &instant.state.view(), &instant.targets, &mut after)?;
    finite("target_twists_after", target_twists.as_flattened())?;
    finite("impulses", impulses.as_flattened())?;
    values.set(Quantity::CaptureBaseTwist, &base_twist);
    values.set(Quantity::CaptureJointRates, &joint_rates);
    values.set(Quantity::CaptureTargetTwists, target_twists.as_flattened());
    values.set(Quantity::CaptureImpulses, impulses.as_flattened());
    Ok(())
}

/// The robot that holds its targets; its mass matrix G, and H = G v after the capture.
fn merged<T: Real>(model: &dyn CloneModel<T>, instant: &EvaluationInput<T>, values: &mut Values) -> Result<(), Error> {
    let (joints, state) = (values.joints, instant.state.view());
    let mut model = model.clone_box();
    model.merge(&state.base_pose, state.joint_angles, &instant.targets)?;
    let mut inertias = vec![[T::ZERO; 2]; joints + 1];
    model.body_inertias(&mut inertias)?;
    values.set(Quantity::MergedBodyInertias, inertias.as_flattened());
    let mut mass_matrix = vec![T::ZERO; (3 + joints) * (3 + joints)];
    model.mass_matrix(&state.base_pose, state.joint_angles, &mut mass_matrix)?;
    let after = [Quantity::CaptureBaseTwist, Quantity::CaptureJointRates];
    let after = after.map(|part| values.get(part).unwrap_or_default()).concat();
    let rows = mass_matrix.chunks_exact(3 + joints);
    let momentum: Vec<f64> =
        rows.map(|row| row.iter().zip(&after).map(|(entry, v)| entry.to_f64() * v).sum()).collect();
    values.set(Quantity::CaptureMomentum, &momentum);
    values.set(Quantity::MergedMassMatrix, &mass_matrix);
    let mut joint_accelerations = vec![T::ZERO; joints];
    let base = model.forward_dynamics(&state, &instant.forces(), &mut joint_accelerations)?;
    values.set(Quantity::MergedBaseAcceleration, &base);
    values.set(Quantity::MergedJointAccelerations, &joint_accelerations);
    Ok(())
}
