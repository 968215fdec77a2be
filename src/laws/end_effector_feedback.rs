//! Resolved motion rate control of an approach: end effector paths from a scenario, and the law's working space.

use crate::control::{EndEffectorWorkspace, ResolvedMotionRate};
use crate::dynamics::AnyModel;
use crate::scenario::{EndEffectorGoal, FinalRates, Scenario};
use crate::simulate::PhaseError;
use crate::trajectory::EndEffectorPath;

/// Larger errors of the end effectors' poses are cut to this: rad, m per m of reach. An arm whose goal is out of reach
/// then does not take the other from its path, and its joints are no stiffer than √(2 · 10 · 0.05)/0.04 = 25 1/s with
/// the default gains.
const ERROR_LIMIT: f64 = 0.05;

/// What [`ResolvedMotionRate`] borrows.
#[derive(Clone, Debug)]
pub struct EndEffectorFeedback {
    initial_poses: Vec<[f64; 3]>,
    initial_twists: Vec<[f64; 3]>,
    final_poses: Vec<[f64; 3]>,
    final_twists: Vec<[f64; 3]>,
    duration: f64,
    wanted: Vec<[bool; 3]>,
    held: Vec<bool>,
    reach: Vec<f64>,
    generalized_inertia: Vec<f64>,
    generalized_bias: Vec<f64>,
    generalized_jacobian: Vec<f64>,
    end_effector_jacobian: Vec<f64>,
    end_effector_poses: Vec<[f64; 3]>,
    end_effector_twists: Vec<[f64; 3]>,
    rows: Vec<f64>,
    right: Vec<f64>,
    joint_accelerations: Vec<f64>,
}

impl EndEffectorFeedback {
    /// Paths from the initial poses and twists of the end effectors to the desired ones, yaws by less than a turn. Arms
    /// without a goal hold their joint angles.
    ///
    /// # Errors
    /// Those of the model at the initial state.
    pub fn new(model: &AnyModel<f64>, scenario: &Scenario) -> Result<Self, PhaseError> {
        let (arms, joints) = (model.arms(), model.joints());
        let start = scenario.initial.view();
        let (mut initial_poses, mut initial_twists) = (vec![[0.0; 3]; arms], vec![[0.0; 3]; arms]);
        model
            .end_effector_poses(&start.base_pose, start.joint_angles, &mut initial_poses)
            .and_then(|()| model.end_effector_twists(&start, &mut initial_twists))
            .map_err(|source| PhaseError { time: 0.0, source })?;
        let goals = scenario.approach.final_end_effector_poses.clone().unwrap_or(vec![EndEffectorGoal::Any; arms]);
        let (mut final_poses, mut wanted) = (initial_poses.clone(), vec![[false; 3]; arms]);
        for (i, (goal, initial)) in goals.iter().zip(&initial_poses).enumerate() {
            for (part, error) in goal.errors(initial) {
                final_poses[i][part] += error;
                wanted[i][part] = true;
            }
        }
        let final_twists = match &scenario.approach.end {
            FinalRates::EndEffectorTwists(twists) => {
                twists.iter().map(|twist| twist.map(|part| part.unwrap_or(0.0))).collect()
            }
            FinalRates::Rest | FinalRates::JointRates(_) => vec![[0.0; 3]; arms],
        };
        let layout = &scenario.layout.arms;
        let held =
            layout.iter().zip(&goals).flat_map(|(arm, goal)| std::iter::repeat_n(goal.is_empty(), arm.links.len()));
        let reach = layout.iter().map(|arm| if arm.reach() > 0.0 { arm.reach() } else { 1.0 });
        Ok(Self {
            initial_poses,
            initial_twists,
            final_poses,
            final_twists,
            duration: scenario.approach.trajectory_time(),
            wanted,
            held: held.collect(),
            reach: reach.collect(),
            generalized_inertia: vec![0.0; joints * joints],
            generalized_bias: vec![0.0; joints],
            generalized_jacobian: vec![0.0; 3 * arms * joints],
            end_effector_jacobian: vec![0.0; 3 * arms * (3 + joints)],
            end_effector_poses: vec![[0.0; 3]; arms],
            end_effector_twists: vec![[0.0; 3]; arms],
            rows: vec![0.0; 3 * arms * joints],
            right: vec![0.0; 3 * arms],
            joint_accelerations: vec![0.0; joints],
        })
    }

    /// The law with gains of poses and rates, 1/s.
    #[must_use]
    pub fn law(&mut self, [pose_gain, rate_gain]: [f64; 2], singularity_threshold: f64) -> ResolvedMotionRate<'_, f64> {
        ResolvedMotionRate {
            path: EndEffectorPath {
                initial_poses: &self.initial_poses,
                initial_twists: &self.initial_twists,
                final_poses: &self.final_poses,
                final_twists: &self.final_twists,
                duration: self.duration,
            },
            controlled: &self.wanted,
            locked: &self.held,
            reach: &self.reach,
            pose_gain,
            rate_gain,
            error_limit: ERROR_LIMIT,
            singularity_threshold,
            singularity_margin: None,
            is_limited: false,
            workspace: EndEffectorWorkspace {
                generalized_inertia: &mut self.generalized_inertia,
                generalized_bias: &mut self.generalized_bias,
                generalized_jacobian: &mut self.generalized_jacobian,
                end_effector_jacobian: &mut self.end_effector_jacobian,
                end_effector_poses: &mut self.end_effector_poses,
                end_effector_twists: &mut self.end_effector_twists,
                rows: &mut self.rows,
                right_hand_side: &mut self.right,
                joint_accelerations: &mut self.joint_accelerations,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::EndEffectorFeedback;
    use crate::control::Control;
    use crate::registry::{self, SHIPPED};
    use crate::scenario::Scenario;
    use crate::state::State;
    use planar_proof::{file, layout};

    #[test]
    fn the_singularity_margin_is_that_of_the_last_state() {
        let scenario = Scenario::read(&file("scenarios/resolved_motion_rate.toml"), SHIPPED).expect("a scenario");
        let model = registry::generic(&layout("dual_arm_3r"));
        let mut feedback = EndEffectorFeedback::new(&*model, &scenario).expect("paths");
        let mut law = feedback.law([2.0, 10.0], 0.04);
        let mut margin = |joint_angles: &[f64]| {
            let (base_pose, base_twist, joint_rates) = ([0.0; 3], [0.0; 3], &[0.0; 6]);
            let state = State { base_pose, joint_angles, base_twist, joint_rates };
            law.joint_torques(0.0, &*model, &state, &mut [0.0; 6]).expect("torques");
            Control::<f64>::singularity_margin(&law).expect("rows")
        };
        let bent = &scenario.initial.joint_angles;
        let [first, stretched, last] =
            [bent, &vec![0.0, 1e-3, 0.0, 3.0, 0.0, -1e-3], bent].map(|angles| margin(angles));
        assert!(stretched < 0.1 * first, "{stretched} {first}");
        assert_eq!(first.to_bits(), last.to_bits());
    }
}
