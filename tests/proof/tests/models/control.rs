//! Control laws around other laws, and laws that have nothing to do.
#![allow(clippy::float_cmp, reason = "numbers that are copied, and exact zeros")]

use planar_capture::control::{
    BaseTorque, Control, EndEffectorWorkspace, ResolvedMotionRate, SampledControl, Stabilisation, TorqueLimiter,
    ZeroTorque,
};
use planar_capture::dynamics::{Kinematics, Model};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::{ARMS, JOINTS, Model as DualArm};
use planar_capture::state::State;
use planar_capture::trajectory::EndEffectorPath;

const AT_REST: State<'_, f64> = State {
    base_pose: [0.3, 0.1, -0.2],
    joint_angles: &[0.698, -1.571, 1.047, 2.444, 1.571, -1.047],
    base_twist: [0.0; 3],
    joint_rates: &[0.0; JOINTS],
};

/// A law whose every answer is its own.
#[derive(Default)]
struct Own {
    begun: u32,
}

impl Control<f64> for Own {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &dyn Model<f64>,
        _: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        torques.fill(time);
        Ok(())
    }

    fn begin_step(&mut self, _: f64, _: &dyn Model<f64>, _: &State<'_, f64>) -> Result<(), Error> {
        self.begun += 1;
        if self.begun < 4 { Ok(()) } else { Err(Error::Exchanges { what: "a law", exchanges: 4 }) }
    }

    fn held_steps(&self) -> Option<u32> {
        Some(10 + self.begun)
    }

    fn base_torque(&self) -> Option<BaseTorque<f64>> {
        Some(BaseTorque { torque: 20.0 + f64::from(self.begun), saturated: self.begun == 2 })
    }

    fn saturated(&self) -> &[bool] {
        &[true, false, true, true, false, true]
    }
}

/// Held steps, base torque, saturation, torques.
type Answers = (Option<u32>, Option<BaseTorque<f64>>, Vec<bool>, [f64; JOINTS]);

/// Three steps of a law around [`Own`]: what the law says, and the torques.
fn three_steps(mut law: impl Control<f64>) -> Vec<Answers> {
    let model = DualArm::<f64>::default();
    let steps = [1.0, 2.0, 3.0].map(|time| {
        law.begin_step(time, &model, &AT_REST).expect("a step");
        let mut torques = [f64::NAN; JOINTS];
        law.joint_torques(time, &model, &AT_REST, &mut torques).expect("torques");
        (law.held_steps(), law.base_torque(), law.saturated().to_vec(), torques)
    });
    law.begin_step(4.0, &model, &AT_REST).expect_err("the law's own error");
    steps.to_vec()
}

/// A limiter changes torques and saturation, sampling changes torques and how long they hold; all else is the law's.
#[test]
fn a_law_around_a_law_passes_on_what_it_does_not_change() {
    let own = three_steps(Own::default());
    assert_eq!(three_steps(&mut Own::default()), own);
    let (mut saturated, mut held) = ([false; JOINTS], [f64::NAN; JOINTS]);
    let limited = TorqueLimiter { law: Own::default(), torque_limits: &[1.5; JOINTS], saturated: &mut saturated };
    let sampled = SampledControl::new(Own::default(), 2, &mut held);
    let (limited, sampled) = (three_steps(limited), three_steps(sampled));
    for (i, (steps, base, law_saturated, torques)) in own.iter().enumerate() {
        assert_eq!(limited[i], (*steps, *base, vec![i > 0; JOINTS], torques.map(|torque| torque.min(1.5))));
        // steps 1 and 2 have the first sample
        let (left, torque) = [(2, 1.0), (1, 1.0), (2, 3.0)][i];
        assert_eq!(sampled[i], (Some(left), *base, law_saturated.clone(), [torque; JOINTS]));
    }
}

#[test]
fn no_torque_is_zero_and_continuous() {
    let mut torques = [f64::NAN; JOINTS];
    let mut law = ZeroTorque;
    law.joint_torques(0.0, &DualArm::<f64>::default(), &AT_REST, &mut torques).expect("torques");
    assert_eq!(torques, [0.0; JOINTS]);
    assert_eq!(Control::<f64>::held_steps(&law), None);
    assert!(Control::<f64>::base_torque(&law).is_none() && Control::<f64>::saturated(&law).is_empty());
}

/// A robot at rest needs no torque: actuators without any are not saturated.
#[test]
fn stabilisation_of_a_robot_at_rest_saturates_nothing() {
    const SIZE: usize = 3 + JOINTS;
    let mut law = Stabilisation {
        joint_gain: &[0.5; JOINTS],
        base_gain: 0.5,
        wheels: &[false; JOINTS],
        base_torque_limit: Some(0.0),
        base_torque: None,
        mass_matrix: &mut [f64::NAN; SIZE * SIZE],
        bias: &mut [f64::NAN; SIZE],
    };
    let mut torques = [f64::NAN; JOINTS];
    law.joint_torques(0.0, &DualArm::<f64>::default(), &AT_REST, &mut torques).expect("torques");
    assert_eq!(torques, [0.0; JOINTS]);
    assert_eq!(Control::<f64>::base_torque(&law), Some(BaseTorque { torque: 0.0, saturated: false }));
}

/// What a law of end effector feedback says of a state.
struct Feedback {
    is_limited: bool,
    torques: [f64; JOINTS],
    margin: Option<f64>,
}

/// In one state after the other, with all components of paths that stay at these poses controlled, or none.
fn feedback(states: &[(State<'_, f64>, [[f64; 3]; ARMS])], controlled: bool) -> Vec<Feedback> {
    let still = [[0.0; 3]; ARMS];
    let mut found: Vec<Feedback> = Vec::new();
    for (state, poses) in states {
        let path = EndEffectorPath {
            initial_poses: poses,
            initial_twists: &still,
            final_poses: poses,
            final_twists: &still,
            duration: 1.0,
        };
        let mut law = ResolvedMotionRate {
            path,
            controlled: &[[controlled; 3]; ARMS],
            locked: &[false; JOINTS],
            reach: &[3.0; ARMS],
            pose_gain: 2.0,
            rate_gain: 10.0,
            error_limit: 0.05,
            singularity_threshold: 0.04,
            singularity_margin: None,
            // as the law was left
            is_limited: found.last().is_some_and(|before| before.is_limited),
            workspace: EndEffectorWorkspace {
                generalized_inertia: &mut [f64::NAN; JOINTS * JOINTS],
                generalized_bias: &mut [f64::NAN; JOINTS],
                generalized_jacobian: &mut [f64::NAN; 3 * ARMS * JOINTS],
                end_effector_jacobian: &mut [f64::NAN; 3 * ARMS * (3 + JOINTS)],
                end_effector_poses: &mut [[f64::NAN; 3]; ARMS],
                end_effector_twists: &mut [[f64::NAN; 3]; ARMS],
                rows: &mut [f64::NAN; 3 * ARMS * JOINTS],
                right_hand_side: &mut [f64::NAN; 3 * ARMS],
                joint_accelerations: &mut [f64::NAN; JOINTS],
            },
        };
        let mut torques = [f64::NAN; JOINTS];
        law.joint_torques(0.0, &DualArm::<f64>::default(), state, &mut torques).expect("torques");
        let law: &dyn Control<f64> = &law;
        found.push(Feedback { is_limited: law.is_limited(), torques, margin: law.singularity_margin() });
    }
    found
}

/// With no component controlled there is no Jacobian to be singular, and no limit.
#[test]
fn nothing_controlled_has_no_singularity_margin() {
    for Feedback { is_limited, torques, margin } in feedback(&[(AT_REST, [[0.0; 3]; ARMS])], false) {
        assert_eq!((torques, margin, is_limited), ([0.0; JOINTS], None, false));
    }
}

/// A limit acts where an error is reduced and where a singular direction is damped, and only as long.
#[test]
fn limits_of_end_effector_feedback_are_those_of_the_state() {
    let straight = State { joint_angles: &[0.4, 0.0, 0.0, 2.4, 0.0, 0.0], ..AT_REST };
    let poses = |state: &State<'_, f64>| {
        let mut poses = [[0.0; 3]; ARMS];
        let model = DualArm::<f64>::default();
        Kinematics::end_effector_poses(&model, &state.base_pose, state.joint_angles, &mut poses).expect("poses");
        poses
    };
    let (here, at_singularity) = (poses(&AT_REST), poses(&straight));
    // 0.05 rad, and 0.05 m per m of the reach of 3 m
    let [near, far] = [0.149, 0.151].map(|error| here.map(|[yaw, x, y]| [yaw + 0.049, x - error, y]));
    let found = feedback(
        &[(AT_REST, here), (AT_REST, far), (AT_REST, near), (straight, at_singularity), (AT_REST, near)],
        true,
    );
    assert_eq!(found.iter().map(|found| found.is_limited).collect::<Vec<_>>(), [false, true, false, true, false]);
    let margins: Vec<_> = found.iter().map(|found| found.margin.expect("rows")).collect();
    assert!(margins[0] > 0.04 && margins[3] < 0.04, "{margins:?}");
}
