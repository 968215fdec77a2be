//! One state at a time.

use crate::Problem;
use crate::evaluated::Robot;
use crate::states::States;
use planar_capture::dynamics;
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::Model;
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;
use std::hint::black_box;

/// Number of states of a call.
pub const STATES: usize = 64;

/// Calls of a function for one state after the other.
pub type Call<'a> = Box<dyn FnMut() + 'a>;

/// Of compiled code and of the graph, whose results are the same.
pub fn calls<'a>(function: &'a str, robot: &'a Robot, states: &'a States) -> Result<[Call<'a>; 2], Problem> {
    let code = Model::<f64>::default();
    for instance in 0..STATES {
        let [expected, found] =
            [call(&code, function, states, instance)?, call(&robot.model, function, states, instance)?];
        if expected.map(f64::to_bits) != found.map(f64::to_bits) {
            return Err(format!("{function}: the results have other bits").into());
        }
    }
    let all = move |model: &dyn dynamics::Model<f64>| {
        for instance in 0..STATES {
            black_box(call(model, function, states, instance).expect("regular"));
        }
    };
    Ok([Box::new(move || all(&code)), Box::new(move || all(&robot.model))])
}

/// The last results of a function.
fn call(model: &dyn dynamics::Model<f64>, function: &str, states: &States, instance: usize) -> Result<[f64; 6], Error> {
    let triple = |name| states.of(name, instance).first_chunk().copied().unwrap_or_default();
    let state = State {
        base_pose: triple("base_pose"),
        joint_angles: states.of("joint_angles", instance),
        base_twist: triple("base_twist"),
        joint_rates: states.of("joint_rates", instance),
    };
    let (mut matrix, mut jacobian, mut momentum, mut joints) = ([0.0; 36], [0.0; 36], [0.0; 6], [0.0; 6]);
    let target = |arm: usize| {
        Some(Target {
            mass: states.of("target_masses", instance)[arm],
            inertia: states.of("target_inertias", instance)[arm],
            contact: states.of("contacts", instance).as_chunks().0[arm],
            twist: states.of("target_twists", instance).as_chunks().0[arm],
        })
    };
    match function {
        "forward_dynamics" => {
            let torques = states.of("joint_torques", instance);
            black_box(model.forward_dynamics(&state, &Forces::torques(torques), &mut joints)?);
        }
        "reduced_dynamics" => {
            model.reduced_dynamics(&state, &mut matrix, &mut joints, &mut jacobian)?;
            black_box((matrix, jacobian));
        }
        "reduced_impact" => {
            model.reduced_impact(&state, &[target(0), target(1)], &mut matrix, &mut momentum, &mut joints)?;
            black_box((matrix, momentum));
        }
        _ => {
            black_box(model.full_impact(&state, &[target(0), target(1)], &mut joints)?);
        }
    }
    Ok(joints)
}
