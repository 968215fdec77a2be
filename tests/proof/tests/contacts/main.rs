//! The product's contacts and closed loops against the reference in maximal coordinates, and the reference against
//! mechanics.

mod against_product;
mod constrained_motion;
mod impacts;
mod inverse_inertia;
mod laws;
mod loops;
mod merged;
mod product;
mod scaling;
mod textbook;

use nalgebra::Vector2;
use planar_capture::control::Control;
use planar_capture::dynamics::AnyModel;
use planar_capture::layout::Layout;
use planar_capture::owned::RobotState;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::stepper::Integration;
use planar_capture::simulate::{Timing, simulate};
use planar_capture::target::Target;
use planar_proof::maximal::body::Body;
use planar_proof::maximal::impact::{Contact, Kind};
use planar_proof::maximal::system::System;
use planar_proof::sample::RandomState;

fn robot(layout: &Layout, s: &RandomState) -> System {
    System::new(layout, s.base_pose, &s.joint_angles, s.base_twist, &s.joint_rates)
}

/// Adds a target of the sample with its contact point at an end effector; returns the index of its body.
fn add_target(all: &mut System, target: &([f64; 4], [f64; 3]), arm: usize, yaw: f64) -> usize {
    let ([mass, inertia, rx, ry], twist) = *target;
    let com = all.end_effector(arm) - Vector2::new(rx, ry);
    all.add(Body { mass, inertia, pose: [yaw, com.x, com.y], twist })
}

/// The sample's targets, one per arm, and their rigid contacts in arm order.
fn rigid_targets(all: &mut System, s: &RandomState) -> Vec<Contact> {
    let contact = |(arm, target)| {
        let body = add_target(all, target, arm, 0.3);
        Contact::new(all, arm, body, Kind::Rigid)
    };
    s.targets.iter().enumerate().map(contact).collect()
}

/// The sample with all velocities scaled by a factor, so that joints make few turns in a motion of some seconds.
fn scaled_velocities(mut s: RandomState, factor: f64) -> RandomState {
    let scale = |values: &mut [f64]| values.iter_mut().for_each(|value| *value *= factor);
    scale(&mut s.base_twist);
    scale(&mut s.joint_rates);
    s.targets.iter_mut().for_each(|(_, twist)| scale(twist));
    s
}

/// State of the product's robot for the reference's bodies, at the sample's configuration.
fn robot_state(all: &System, s: &RandomState) -> RobotState {
    RobotState {
        base_pose: s.base_pose,
        joint_angles: s.joint_angles.clone(),
        base_twist: all.bodies[0].twist,
        joint_rates: all.joint_rates(),
    }
}

fn targets(s: &RandomState) -> Vec<Option<Target<f64>>> {
    let target = |([mass, inertia, rx, ry], twist): &([f64; 4], [f64; 3])| {
        Some(Target { mass: *mass, inertia: *inertia, contact: [*rx, *ry], twist: *twist })
    };
    s.targets.iter().map(target).collect()
}

/// State of the product's robot after `duration`, by Runge–Kutta steps of 1 ms.
fn simulated(model: &AnyModel<f64>, control: &mut dyn Control<f64>, start: &RobotState, duration: f64) -> RobotState {
    let timing = Timing { duration, step: 0.001, sample: duration, integration: Integration::default(), kink: None };
    let robot = planar_capture::simulate::system::System::alone(model);
    let phase = simulate(&robot, control, start, &timing, &mut NoEvents, &mut || ()).expect("a phase");
    phase.end().state.clone()
}
