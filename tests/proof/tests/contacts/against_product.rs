//! The reference against the product's recursion, elimination and merging in joint coordinates.

use crate::{rigid_targets, robot, scaled_velocities, simulated, targets};
use planar_capture::control::{Control, ZeroTorque};
use planar_capture::dynamics::Model;
use planar_capture::error::Error;
use planar_capture::generated;
use planar_capture::impact::{RigidImpactOutput, exact};
use planar_capture::layout::Layout;
use planar_capture::owned::{CloneModel, RobotState};
use planar_capture::registry;
use planar_capture::state::{Forces, State};
use planar_proof::maximal::body::Body;
use planar_proof::maximal::impact::impact;
use planar_proof::maximal::motion::{accelerations, joint_accelerations, run};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{close, for_every_layout, layout, tolerance};
use proptest::prelude::*;

/// The product's model: generated code where this build has it.
fn model(layout: &Layout) -> Box<dyn CloneModel> {
    registry::generated(layout).unwrap_or_else(|_| registry::generic(layout))
}

/// Poses and twists of bodies, joint coordinates, momentum and energy.
fn check_kinematics(layout: &Layout, s: &RandomState) {
    let all = robot(layout, s);
    let (mut poses, mut twists) = (vec![[0.0; 3]; all.bodies.len()], vec![[0.0; 3]; all.bodies.len()]);
    let model = model(layout);
    model.body_poses(&s.base_pose, &s.joint_angles, &mut poses).expect("poses");
    model.body_twists(&s.state(), &mut twists).expect("twists");
    let of = |value: fn(&Body) -> [f64; 3]| all.bodies.iter().flat_map(value).collect::<Vec<_>>();
    close("poses", &of(|b| b.pose), poses.as_flattened(), tolerance::IDENTITY);
    close("twists", &of(|b| b.twist), twists.as_flattened(), tolerance::IDENTITY);
    close("angles", &all.joint_angles(), &s.joint_angles, tolerance::IDENTITY);
    close("rates", &all.joint_rates(), &s.joint_rates, tolerance::IDENTITY);
    let momentum = model.momentum(&s.state()).expect("momentum");
    let [px, py] = momentum.linear_momentum;
    close("momentum", &all.momentum(), &[momentum.angular_momentum, px, py], tolerance::IDENTITY);
    close("energy", &[all.kinetic_energy()], &[momentum.kinetic_energy], tolerance::IDENTITY);
}

/// Accelerations under joint torques.
fn check_forward_dynamics(layout: &Layout, s: &RandomState) {
    let mut joints = vec![0.0; layout.joints()];
    let forces = Forces::torques(&s.joint_torques);
    let base = model(layout).forward_dynamics(&s.state(), &forces, &mut joints).expect("accelerations");
    let all = robot(layout, s);
    let found = joint_accelerations(&all, &accelerations(&all, &s.joint_torques));
    let flat = |(base, joints): &([f64; 3], Vec<f64>)| base.iter().chain(joints).copied().collect::<Vec<_>>();
    close("accelerations", &flat(&found), &flat(&(base, joints)), tolerance::MAXIMAL_ACCELERATION);
}

/// Exact capture of one target per arm; the bodies afterwards, and the merged model with its motion.
fn check_capture(layout: &Layout, s: &RandomState) -> (System, Box<dyn CloneModel>, RobotState) {
    let mut model = model(layout);
    let (arms, joints) = (layout.arms.len(), layout.joints());
    let (mut joint_rates, mut target_twists, mut impulses) =
        (vec![0.0; joints], vec![[0.0; 3]; arms], vec![[0.0; 3]; arms]);
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
    let base_twist = exact(&*model, &s.state(), &targets(s), &mut after).expect("an impact");
    let mut all = robot(layout, s);
    let contacts = rigid_targets(&mut all, s);
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    close("joint rates", &all.joint_rates(), &joint_rates, tolerance::MAXIMAL_IMPACT);
    close("base twist", &all.bodies[0].twist, &base_twist, tolerance::MAXIMAL_IMPACT);
    let twists: Vec<_> = all.bodies[1 + joints..].iter().flat_map(|body| body.twist).collect();
    close("target twists", &twists, target_twists.as_flattened(), tolerance::MAXIMAL_IMPACT);
    close("impulses", found.impulses.as_flattened(), impulses.as_flattened(), tolerance::MAXIMAL_IMPACT);
    model.merge(&s.base_pose, &s.joint_angles, &targets(s)).expect("a merged robot");
    let motion = RobotState { base_pose: s.base_pose, joint_angles: s.joint_angles.clone(), base_twist, joint_rates };
    (all, model, motion)
}

/// Springs, dampers and a periodic torque at the joints.
pub(crate) fn excitation_torques(time: f64, angles: &[f64], rates: &[f64]) -> Vec<f64> {
    let law = |(angle, rate): (&f64, &f64)| 0.3 * (2.0 * time).sin() - 0.2 * angle - 0.5 * rate;
    angles.iter().zip(rates).map(law).collect()
}

/// The same as a control law.
pub(crate) struct Excitation;

impl Control<f64> for Excitation {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &dyn Model<f64>,
        state: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        torques.copy_from_slice(&excitation_torques(time, state.joint_angles, state.joint_rates));
        Ok(())
    }
}

/// Motion after the capture against that of the merged robot.
fn check_motion(layout: &Layout, s: &RandomState, duration: f64, controlled: bool) {
    let (mut all, merged, motion) = check_capture(layout, s);
    let control: &mut dyn Control<f64> = if controlled { &mut Excitation } else { &mut ZeroTorque };
    let end = simulated(&*merged, control, &motion, duration);
    let zero = |_: f64, angles: &[f64], _: &[f64]| vec![0.0; angles.len()];
    let monitor = run(&mut all, duration, 0.25, if controlled { &excitation_torques } else { &zero });
    let bound = tolerance::MAXIMAL_MOTION;
    close("angles", &all.joint_angles(), &end.joint_angles, bound);
    close("rates", &all.joint_rates(), &end.joint_rates, bound);
    close("base pose", &all.bodies[0].pose, &end.base_pose, bound);
    close("base twist", &all.bodies[0].twist, &end.base_twist, bound);
    assert!(monitor.momentum[0].max(monitor.momentum[1]).max(monitor.energy) < tolerance::MAXIMAL_DRIFT, "{monitor:?}");
    assert!(monitor.projected < tolerance::MAXIMAL_CONSTRAINT, "{monitor:?}");
}

macro_rules! instantly {
    ($($layout:ident)*) => {
        proptest! {
            #![proptest_config(ProptestConfig { cases: 12, ..config() })]
            $(
            #[test]
            fn $layout(s in sample(generated::$layout::ARMS, generated::$layout::JOINTS)) {
                let layout = layout(stringify!($layout));
                check_kinematics(&layout, &s);
                check_forward_dynamics(&layout, &s);
                check_capture(&layout, &s);
            })*
        }
    };
}
for_every_layout!(instantly);

#[test]
fn every_shipped_layout_is_here() {
    assert_eq!(registry::SHIPPED.len(), 7, "one line of `instantly` each");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2, ..config() })]

    #[test]
    fn the_merged_robot_moves_freely(one in sample(2, 6), other in sample(3, 6)) {
        check_motion(&layout("dual_arm_3r"), &scaled_velocities(one, 0.3), 10.0, false);
        check_motion(&layout("asymmetric_wheel"), &scaled_velocities(other, 0.3), 10.0, false);
    }

    #[test]
    fn the_merged_robot_moves_under_torques(one in sample(1, 3), other in sample(3, 9)) {
        check_motion(&layout("single_arm_3r"), &scaled_velocities(one, 0.3), 5.0, true);
        check_motion(&layout("triple_arm_3r"), &scaled_velocities(other, 0.3), 5.0, true);
    }
}
