//! The reference in maximal coordinates, held to what the product has by another way, and to mechanics.

#[path = "../support/maximal/mod.rs"]
mod maximal;
#[path = "../support/mod.rs"]
mod support;

mod against_product;
mod contacts;
mod holds;
mod impacts;
mod loops;
mod product;
mod responses;
mod studies;
mod textbook;

use maximal::body::Body;
use maximal::impact::{Contact, Kind};
use maximal::system::System;
use nalgebra::Vector2;
use planar_capture::control::Control;
use planar_capture::dynamics::Model;
use planar_capture::layout::Layout;
use planar_capture::models::SHIPPED;
use planar_capture::owned::RobotState;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::integration::Integration;
use planar_capture::simulate::{Timing, simulate};
use planar_capture::state::State;
use planar_capture::target::Target;
use support::assert_close;
use support::sample::Sample;

fn layout(name: &str) -> Layout {
    let (_, text) = SHIPPED.iter().find(|(shipped, _)| *shipped == name).expect("shipped");
    Layout::parse(text, name).unwrap_or_else(|report| panic!("{report}"))
}

/// Largest difference over the largest entry.
#[track_caller]
fn close(what: &str, found: &[f64], wanted: &[f64], tolerance: f64) {
    let size = wanted.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    assert_close(what, found, wanted, tolerance * size);
}

fn robot(layout: &Layout, s: &Sample) -> System {
    System::new(layout, s.base_pose, &s.joint_angles, s.base_twist, &s.joint_rates)
}

fn state(s: &Sample) -> State<'_, f64> {
    State {
        base_pose: s.base_pose,
        joint_angles: &s.joint_angles,
        base_twist: s.base_twist,
        joint_rates: &s.joint_rates,
    }
}

/// The sample's targets, one per arm, held so by the tips: contacts in arm order.
fn rigid_targets(all: &mut System, s: &Sample) -> Vec<Contact> {
    let hold = |(arm, ([mass, inertia, rx, ry], twist)): (usize, &([f64; 4], [f64; 3]))| {
        let com = all.position(&all.tips[arm]) - Vector2::new(*rx, *ry);
        let body = all.add(Body { mass: *mass, inertia: *inertia, pose: [0.3, com.x, com.y], twist: *twist });
        Contact::new(all, arm, body, Kind::Rigid)
    };
    s.targets.iter().enumerate().map(hold).collect()
}

fn targets(s: &Sample) -> Vec<Option<Target<f64>>> {
    let target = |([mass, inertia, rx, ry], twist): &([f64; 4], [f64; 3])| {
        Some(Target { mass: *mass, inertia: *inertia, contact: [*rx, *ry], twist: *twist })
    };
    s.targets.iter().map(target).collect()
}

/// How the product's robot moves for a time, by Runge–Kutta steps of a millisecond.
fn simulated(model: &dyn Model<f64>, control: &mut dyn Control<f64>, start: &RobotState, duration: f64) -> RobotState {
    let timing = Timing { duration, step: 0.001, sample: duration, integration: Integration::default() };
    let robot = planar_capture::simulate::system::System::alone(model);
    let phase = simulate(&robot, control, start, &timing, &mut NoEvents, &mut || ()).expect("a phase");
    phase.end().expect("an end").state.clone()
}
