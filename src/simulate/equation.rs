//! The differential equation of a phase, in full or reduced coordinates or in canonical variables.

use crate::control::Control;
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::formulation::{CanonicalVariables, ReducedCoordinates};
use crate::integrate::RungeKutta4;
use crate::simulate::inertial_frame::InertialFrame;
use crate::simulate::system::System;
use crate::state::{Coordinates, State, StateVector, coordinates_mut, split, split_mut};

/// How near to an end of a step a kink is at it, in steps: what is left of the step across it is a millionth of the change.
const KINK_MARGIN: f64 = 1e-6;

/// ẋ = f(t, x) of a system under a control law.
pub(crate) struct Equation<'a> {
    pub(crate) system: &'a System<'a>,
    /// The law, for states of the frame that is integrated in.
    pub(crate) control: InertialFrame<'a>,
    /// Where derivatives of its torques jump, s.
    kink: Option<f64>,
    torques: Vec<f64>,
    form: FormulationWorkspace,
}

/// The coordinates of an equation, with their working space.
pub(crate) enum FormulationWorkspace {
    Full,
    Reduced(ReducedSpace),
    Canonical(CanonicalSpace),
}

/// What [`ReducedCoordinates`] borrows.
pub(crate) struct ReducedSpace {
    momentum: [f64; 3],
    mass_matrix: Vec<f64>,
    generalized_inertia: Vec<f64>,
    generalized_bias: Vec<f64>,
    generalized_jacobian: Vec<f64>,
}

impl ReducedSpace {
    fn borrow(&mut self) -> ReducedCoordinates<'_, f64> {
        ReducedCoordinates {
            momentum: self.momentum,
            mass_matrix: &mut self.mass_matrix,
            generalized_inertia: &mut self.generalized_inertia,
            generalized_bias: &mut self.generalized_bias,
            generalized_jacobian: &mut self.generalized_jacobian,
        }
    }
}

/// What [`CanonicalVariables`] borrows.
pub(crate) struct CanonicalStorage {
    pub(crate) inertias: Vec<[f64; 2]>,
    pub(crate) poses: Vec<[f64; 3]>,
    twists: Vec<[f64; 3]>,
    pub(crate) offsets: Vec<[f64; 2]>,
    pub(crate) leaves: Vec<bool>,
    rates: Vec<f64>,
}

impl CanonicalStorage {
    /// Of a robot, measured in a configuration.
    pub(crate) fn new(model: &AnyModel<f64>, base_pose: &[f64; 3], joint_angles: &[f64]) -> Result<Self, Error> {
        let joints = model.joints();
        let mut storage = Self {
            inertias: vec![[0.0; 2]; joints + 1],
            poses: vec![[0.0; 3]; joints + 1],
            twists: vec![[0.0; 3]; joints + 1],
            offsets: vec![[0.0; 2]; joints],
            leaves: vec![false; joints],
            rates: vec![0.0; joints],
        };
        storage.borrow().measure(model, base_pose, joint_angles)?;
        Ok(storage)
    }

    fn borrow(&mut self) -> CanonicalVariables<'_, f64> {
        CanonicalVariables {
            inertias: &mut self.inertias,
            poses: &mut self.poses,
            twists: &mut self.twists,
            offsets: &mut self.offsets,
            leaves: &mut self.leaves,
            rates: &mut self.rates,
        }
    }
}

/// Canonical variables, and working space of their derivative.
pub(crate) struct CanonicalSpace {
    variables: CanonicalStorage,
    /// With rates in place of momenta.
    x: Vec<f64>,
    /// The vector at the end of the last step, with rates.
    last_x: Vec<f64>,
    /// The same, with momenta.
    last_momenta: Vec<f64>,
    mass_matrix: Vec<f64>,
    bias: Vec<f64>,
    /// 3 + joints.
    results: Vec<f64>,
}

impl FormulationWorkspace {
    /// Reduced coordinates, with the momentum of `x`; [`Error::UnsupportedBodies`] where there are bodies beside the
    /// robot.
    pub(crate) fn reduced(system: &System<'_>, x: &[f64]) -> Result<Self, Error> {
        let count = system.beside();
        if count > 0 {
            return Err(Error::UnsupportedBodies { count });
        }
        let (joints, arms) = (system.model.joints(), system.model.arms());
        let momentum = system.model.momentum(&State::from_vector(x, joints)?)?;
        let [px, py] = momentum.linear_momentum;
        Ok(Self::Reduced(ReducedSpace {
            momentum: [momentum.angular_momentum, px, py],
            mass_matrix: vec![0.0; (3 + joints) * (3 + joints)],
            generalized_inertia: vec![0.0; joints * joints],
            generalized_bias: vec![0.0; joints],
            generalized_jacobian: vec![0.0; 3 * arms * joints],
        }))
    }

    /// Canonical variables, between [`Equation::convert_to_momenta`] and [`Equation::convert_to_rates`].
    pub(crate) fn canonical(system: &System<'_>, x: &[f64]) -> Result<Self, Error> {
        let joints = system.model.joints();
        let size = 3 + joints;
        let at = State::from_vector(x, joints)?;
        let variables = CanonicalStorage::new(system.model, &at.base_pose, at.joint_angles)?;
        Ok(Self::Canonical(CanonicalSpace {
            variables,
            x: x.to_vec(),
            last_x: Vec::new(),
            last_momenta: Vec::new(),
            mass_matrix: vec![0.0; size * size],
            bias: vec![0.0; size],
            results: vec![0.0; size],
        }))
    }
}

impl<'a> Equation<'a> {
    pub(crate) fn new(
        system: &'a System<'a>,
        control: InertialFrame<'a>,
        kink: Option<f64>,
        form: FormulationWorkspace,
    ) -> Self {
        Self { system, control, kink, torques: vec![0.0; system.model.joints()], form }
    }

    /// How far a step may go: to its end, or to a kink within it. What is a rounding error from an end is not within it, and
    /// torques that are held have no kinks.
    pub(crate) fn smooth_until(&self, [from, end]: [f64; 2]) -> f64 {
        let margin = KINK_MARGIN * (end - from);
        let within = self.kink.filter(|kink| (from + margin..end - margin).contains(kink));
        within.filter(|_| self.control.held_steps().is_none()).unwrap_or(end)
    }

    /// d/dt of positions, rates and work.
    pub(crate) fn derivative(&mut self, time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        let Self { system, control, torques, form, .. } = self;
        match form {
            FormulationWorkspace::Reduced(space) => {
                space.borrow().derivative(system.model, control.as_given(), time, x, rate, torques)
            }
            FormulationWorkspace::Full | FormulationWorkspace::Canonical(_) => {
                system.derivative(control.as_given(), time, x, rate, torques)
            }
        }
    }

    /// A step of this motion; the bits of the two ways are the same.
    pub(crate) fn runge_kutta4_step(
        &mut self,
        integrator: &mut RungeKutta4<'_, f64>,
        [time, end]: [f64; 2],
        x: &mut [f64],
    ) -> Result<(), Error> {
        let Self { system, control, torques, form, .. } = self;
        if matches!(form, FormulationWorkspace::Full) && system.constraints.is_empty() {
            let (model, law) = (system.model, control.as_given());
            if law.is_constant() {
                law.joint_torques(time, model, &State::from_vector(x, model.joints())?, torques)?;
                if law.base_torque().is_none() && model.step_at_once(None, [time, end - time], x, torques).is_some() {
                    return Ok(());
                }
            }
            return integrator.robot_step(model, law, time, end - time, x, torques);
        }
        integrator.step(time, end - time, x, |time, x, rate| self.derivative(time, x, rate))
    }

    /// d/dt of positions, momenta and work: `ṗ = f + ∂T/∂q`. Without bodies beside the robot f are the torques, so that
    /// momenta without forces are constant to the last bit; with them `f = M v̇ + c` has the constraint forces too. The
    /// bodies keep twists in place of momenta, as their masses are constant.
    pub(crate) fn canonical_derivative(&mut self, time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        let Self { system, control, torques, form: FormulationWorkspace::Canonical(space), .. } = self else {
            return self.derivative(time, x, rate);
        };
        let (model, joints) = (system.model, system.model.joints());
        let CanonicalSpace { variables, x: with_rates, mass_matrix, bias, results, .. } = space;
        let mut canonical = variables.borrow();
        with_rates.copy_from_slice(x);
        replace(&mut canonical, system, with_rates, results, Direction::ToRates)?;
        system.derivative(control.as_given(), time, with_rates, rate, torques)?;
        let now = State::from_vector(with_rates, joints)?;
        let StateVector { rates, work: [.., base_torque], .. } = split_mut(rate)?;
        if system.beside() == 0 {
            let forces = coordinates_mut(rates, joints)?;
            *forces.base = [*base_torque, 0.0, 0.0];
            forces.joints.copy_from_slice(torques);
        } else {
            model.mass_matrix(&now.base_pose, now.joint_angles, mass_matrix)?;
            model.bias(&now, bias)?;
            let rows = mass_matrix.chunks_exact(3 + joints).zip(bias.iter());
            for (result, (row, bias)) in results.iter_mut().zip(rows) {
                *result = row.iter().zip(rates.iter()).fold(*bias, |sum, (entry, a)| sum + entry * a);
            }
            rates[..3 + joints].copy_from_slice(results);
        }
        canonical.add_energy_gradient(model, &now, &mut rates[..3 + joints])
    }

    /// Replaces rates by canonical momenta: those at the end of the last step where `x` is unchanged since, as the
    /// conversion there and back would round.
    pub(crate) fn convert_to_momenta(&mut self, x: &mut [f64]) -> Result<(), Error> {
        match &self.form {
            FormulationWorkspace::Canonical(space) if space.last_x == x => x.copy_from_slice(&space.last_momenta),
            _ => self.replace(x, Direction::ToMomenta)?,
        }
        Ok(())
    }

    /// Replaces canonical momenta by rates, and keeps the momenta for the next step.
    pub(crate) fn convert_to_rates(&mut self, x: &mut [f64]) -> Result<(), Error> {
        let momenta = x.to_vec();
        self.replace(x, Direction::ToRates)?;
        if let FormulationWorkspace::Canonical(space) = &mut self.form {
            (space.last_x, space.last_momenta) = (x.to_vec(), momenta);
        }
        Ok(())
    }

    /// Exchanges the vectors at the end of the last step, with rates and with momenta, for those of another solution.
    pub(crate) fn exchange_last_step(&mut self, [x, momenta]: &mut [Vec<f64>; 2]) {
        if let FormulationWorkspace::Canonical(space) = &mut self.form {
            std::mem::swap(&mut space.last_x, x);
            std::mem::swap(&mut space.last_momenta, momenta);
        }
    }

    fn replace(&mut self, x: &mut [f64], direction: Direction) -> Result<(), Error> {
        let FormulationWorkspace::Canonical(space) = &mut self.form else { return Ok(()) };
        replace(&mut space.variables.borrow(), self.system, x, &mut space.results, direction)
    }

    /// In reduced coordinates, writes the base twist of the joint rates, eq. (17).
    pub(crate) fn recover(&mut self, x: &mut [f64]) -> Result<(), Error> {
        match &mut self.form {
            FormulationWorkspace::Reduced(space) => space.borrow().recover(self.system.model, x),
            FormulationWorkspace::Full | FormulationWorkspace::Canonical(_) => Ok(()),
        }
    }

    /// After every step: recovers the base twist and projects onto the constraints.
    pub(crate) fn restore(&mut self, x: &mut [f64]) -> Result<(), Error> {
        self.recover(x)?;
        self.system.restore(x)
    }
}

#[derive(Clone, Copy)]
enum Direction {
    ToMomenta,
    ToRates,
}

/// Converts rates to momenta or back in the robot's part of `x`; `results` (3 + joints) is working space.
fn replace(
    canonical: &mut CanonicalVariables<'_, f64>,
    system: &System<'_>,
    x: &mut [f64],
    results: &mut [f64],
    direction: Direction,
) -> Result<(), Error> {
    let joints = system.model.joints();
    let now = State::from_vector(x, joints)?;
    match direction {
        Direction::ToMomenta => canonical.momenta(system.model, &now, results)?,
        Direction::ToRates => {
            let StateVector { rates: momenta, .. } = split(x)?;
            let Coordinates { base, joints: of_joints, .. } = coordinates_mut(results, joints)?;
            let momenta = &momenta[..3 + joints];
            *base = canonical.velocities(system.model, now.base_pose, now.joint_angles, momenta, of_joints)?;
        }
    }
    let StateVector { rates: places, .. } = split_mut(x)?;
    places[..3 + joints].copy_from_slice(results);
    Ok(())
}
