//! The traits of a robot's dynamics, by the functions of a graph.

use super::function::Results;
use super::model::GraphModel;
use super::targets::by_arm;
use planar_dynamics::dynamics::{ForwardDynamics, Impact, Momentum, MomentumAndEnergy, ReducedDynamics, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::manifest::ParameterKind;
use planar_dynamics::objection::{to_accelerations_of, to_parameters};
use planar_dynamics::state::{Forces, State};
use planar_dynamics::target::Target;
use planar_dynamics::validate::{
    finite, finite_configuration, finite_state, finite_target, is_regular_and_finite, length, pivot_of, store,
};
use planar_dynamics::{element, with_quantities};

macro_rules! traits {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        $(impl planar_dynamics::dynamics::$trait<f64> for GraphModel {
            $(traits!(@method $method($inputs) $kind);)*
        })*
    };
    (@method $method:ident(configuration) $kind:ident) => {
        fn $method(&self, base_pose: &[f64; 3], joint_angles: &[f64], into: &mut [element!($kind f64)]) -> Result<(), Error> {
            finite_configuration(base_pose, joint_angles)?;
            length("joint_angles", self.joints(), joint_angles.len())?;
            self.call(self.evaluator().functions.$method, &[base_pose, joint_angles], |results| {
                let values: Vec<f64> = results.elements(0).collect();
                store(stringify!($method), &values, traits!(@flat $kind into))
            })
        }
    };
    (@method $method:ident(state) $kind:ident) => {
        fn $method(&self, state: &State<'_, f64>, into: &mut [element!($kind f64)]) -> Result<(), Error> {
            self.check(state)?;
            finite_state(state)?;
            self.call(self.evaluator().functions.$method, &of_state(state), |results| {
                let values: Vec<f64> = results.elements(0).collect();
                store(stringify!($method), &values, traits!(@flat $kind into))
            })
        }
    };
    (@flat triples $into:ident) => { $into.as_flattened_mut() };
    (@flat $kind:ident $into:ident) => { $into };
}

with_quantities!(traits);

/// The inputs of a function of the state.
fn of_state<'a>(state: &'a State<'_, f64>) -> [&'a [f64]; 4] {
    [&state.base_pose, state.joint_angles, &state.base_twist, state.joint_rates]
}

/// An output of three elements.
fn triple(results: &Results<'_>, output: usize) -> [f64; 3] {
    let mut elements = results.elements(output);
    [(); 3].map(|()| elements.next().unwrap_or(f64::NAN))
}

impl GraphModel {
    /// The lengths of a state.
    fn check(&self, state: &State<'_, f64>) -> Result<(), Error> {
        length("joint_angles", self.joints(), state.joint_angles.len())?;
        length("joint_rates", self.joints(), state.joint_rates.len())
    }

    /// Targets with finite numbers, one per arm.
    pub(super) fn check_targets(&self, targets: &[Option<Target<f64>>]) -> Result<(), Error> {
        length("targets", self.arms(), targets.len())?;
        targets.iter().flatten().try_for_each(finite_target)
    }

    /// The place of a number among the parameters.
    pub(super) fn position(&self, kind: ParameterKind, arm: usize, link: usize) -> Result<usize, Error> {
        let mut parameters = self.evaluator().structure().parameters.iter();
        parameters.position(|parameter| *parameter == (kind, arm, link)).ok_or(Error::Parameter { kind, arm, link })
    }
}

impl Robot<f64> for GraphModel {
    fn arms(&self) -> usize {
        self.evaluator().structure().links.len()
    }

    fn joints(&self) -> usize {
        self.evaluator().structure().links.iter().sum()
    }

    fn body_inertias(&self, inertias: &mut [[f64; 2]]) -> Result<(), Error> {
        let links = self.evaluator().structure().links.iter().enumerate();
        let links = links.flat_map(|(arm, links)| (0..*links).map(move |link| (arm, link)));
        let kinds = [ParameterKind::LinkMass, ParameterKind::LinkInertia];
        let base = ([ParameterKind::BaseMass, ParameterKind::BaseInertia], (0, 0));
        length("body_inertias", self.joints() + 1, inertias.len())?;
        for (place, (kinds, (arm, link))) in
            inertias.iter_mut().zip(std::iter::once(base).chain(links.map(|link| (kinds, link))))
        {
            let [mass, inertia] = kinds.map(|kind| self.position(kind, arm, link));
            *place = [self.parameters()[mass?], self.parameters()[inertia?]];
        }
        finite("body_inertias", inertias.as_flattened())
    }
}

impl ReducedDynamics<f64> for GraphModel {
    fn reduced_dynamics(
        &self,
        state: &State<'_, f64>,
        generalized_inertia: &mut [f64],
        generalized_bias: &mut [f64],
        generalized_jacobian: &mut [f64],
    ) -> Result<(), Error> {
        self.check(state)?;
        finite_state(state)?;
        self.call(self.evaluator().functions.reduced_dynamics, &of_state(state), |results| {
            pivot_of(|| self.parameters(), "the base inertia", results.scalar(3))?;
            let [inertia, bias, jacobian] = [0, 1, 2].map(|output| results.elements(output).collect::<Vec<_>>());
            store("generalized_inertia", &inertia, generalized_inertia)?;
            store("generalized_bias", &bias, generalized_bias)?;
            store("generalized_jacobian", &jacobian, generalized_jacobian)
        })
    }
}

impl ForwardDynamics<f64> for GraphModel {
    fn forward_dynamics(
        &self,
        state: &State<'_, f64>,
        forces: &Forces<'_, f64>,
        joint_accelerations: &mut [f64],
    ) -> Result<[f64; 3], Error> {
        self.check(state)?;
        length("joint_torques", self.joints(), forces.joint_torques.len())?;
        length("joint_accelerations", self.joints(), joint_accelerations.len())?;
        let [pose, angles, twist, rates] = of_state(state);
        finite("base_pose", pose)?;
        finite("base_twist", twist)?;
        let wrench = forces.base_wrench.unwrap_or([0.0; 3]);
        let wrenches = forces.end_effector_wrenches.unwrap_or_default();
        let inputs = [pose, angles, twist, rates, forces.joint_torques, &wrench, wrenches.as_flattened()];
        let (function, count) = match (forces.end_effector_wrenches, forces.base_wrench) {
            (Some(_), _) => (2, 7),
            (None, Some(_)) => (1, 6),
            (None, None) => (0, 5),
        };
        if function == 2 {
            length("end_effector_wrenches", self.arms(), wrenches.len())?;
        }
        self.call(self.evaluator().functions.forward_dynamics[function], &inputs[..count], |results| {
            for (place, value) in joint_accelerations.iter_mut().zip(results.elements(1)) {
                *place = value;
            }
            let (base, smallest) = (triple(results, 0), results.scalar(2));
            if is_regular_and_finite(smallest, [&base, joint_accelerations]) {
                Ok(base)
            } else {
                let inputs = [angles, rates, forces.joint_torques];
                let wrenches = [&wrench[..], wrenches.as_flattened()];
                let objection = to_accelerations_of(inputs, &wrenches, smallest, &base, joint_accelerations);
                joint_accelerations.fill(0.0);
                Err(objection.unless_of_parameters(|| to_parameters(self.parameters())).error())
            }
        })
    }
}

impl MomentumAndEnergy<f64> for GraphModel {
    fn momentum(&self, state: &State<'_, f64>) -> Result<Momentum<f64>, Error> {
        self.check(state)?;
        finite_state(state)?;
        self.call(self.evaluator().functions.momentum, &of_state(state), |results| {
            let mut linear = results.elements(0);
            let linear_momentum = [(); 2].map(|()| linear.next().unwrap_or(f64::NAN));
            let (angular_momentum, kinetic_energy) = (results.scalar(1), results.scalar(2));
            finite("linear_momentum", &linear_momentum)?;
            finite("angular_momentum", &[angular_momentum])?;
            finite("kinetic_energy", &[kinetic_energy])?;
            Ok(Momentum { linear_momentum, angular_momentum, kinetic_energy })
        })
    }
}

impl Impact<f64> for GraphModel {
    fn reduced_impact(
        &self,
        state: &State<'_, f64>,
        targets: &[Option<Target<f64>>],
        impact_matrix: &mut [f64],
        impact_momentum: &mut [f64],
        joint_rates_after: &mut [f64],
    ) -> Result<(), Error> {
        self.check(state)?;
        finite_state(state)?;
        self.check_targets(targets)?;
        let [masses, inertias, contacts, twists] = by_arm(targets);
        let inputs: [&[f64]; 7] =
            [&state.base_pose, state.joint_angles, state.joint_rates, &masses, &inertias, &contacts, &twists];
        self.call(self.evaluator().functions.reduced_impact, &inputs, |results| {
            pivot_of(|| self.parameters(), "the impact matrix G", results.scalar(3))?;
            let [matrix, momentum, rates] = [0, 1, 2].map(|output| results.elements(output).collect::<Vec<_>>());
            store("impact_matrix", &matrix, impact_matrix)?;
            store("impact_momentum", &momentum, impact_momentum)?;
            store("joint_rates_after", &rates, joint_rates_after)
        })
    }

    fn full_impact(
        &self,
        state: &State<'_, f64>,
        targets: &[Option<Target<f64>>],
        joint_rates_after: &mut [f64],
    ) -> Result<[f64; 3], Error> {
        self.check(state)?;
        finite_state(state)?;
        self.check_targets(targets)?;
        let [masses, inertias, contacts, twists] = by_arm(targets);
        let [pose, angles, twist, rates] = of_state(state);
        let inputs = [pose, angles, twist, rates, &masses, &inertias, &contacts, &twists];
        self.call(self.evaluator().functions.full_impact, &inputs, |results| {
            pivot_of(|| self.parameters(), "the impact matrix G in full coordinates", results.scalar(2))?;
            let (base, after) = (triple(results, 0), results.elements(1).collect::<Vec<_>>());
            finite("base_twist_after", &base)?;
            store("joint_rates_after", &after, joint_rates_after)?;
            Ok(base)
        })
    }
}
