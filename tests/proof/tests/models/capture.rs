//! The impact solved in full coordinates against accelerations of the merged robot.

use planar_capture::dynamics::{EquationsOfMotion, ForwardDynamics, Impact, Kinematics, Merge, MomentumAndEnergy};
use planar_capture::generated::dual_arm_3r::Model;
use planar_capture::impact::{self, PaperImpactWorkspace, RigidImpactOutput};
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;
use planar_proof::{assert_close, tolerance};

const ANGLES: [f64; 6] = [0.3, -1.2, 0.7, 2.1, 1.4, -0.6];
const RATES: [f64; 6] = [0.4, -0.2, 0.9, -0.5, 0.3, 0.8];

fn state() -> State<'static, f64> {
    State { base_pose: [0.9, 1.5, -2.5], joint_angles: &ANGLES, base_twist: [0.2, -0.3, 0.1], joint_rates: &RATES }
}

fn target(scale: f64) -> Target<f64> {
    Target { mass: 12.0 * scale, inertia: 3.0 * scale, contact: [0.3, -0.4], twist: [-0.7, 0.2, 0.6] }
}

fn choices() -> [Vec<Option<Target<f64>>>; 4] {
    [
        vec![Some(target(1.0)), Some(target(40.0))],
        vec![Some(target(0.01)), None],
        vec![None, Some(target(1.0))],
        vec![None, None],
    ]
}

/// `M + J_eᵀ N J_e` is the mass matrix of the merged robot, so `v_f` is its forward dynamics at zero velocity with
/// `M v_i + J_eᵀ J_t⁻ᵀ I_t t_ti` in place of the forces.
#[test]
fn impact_is_forward_dynamics_of_the_merged_robot() {
    let state = state();
    for targets in choices() {
        let model = Model::<f64>::default();
        let mut rates = [0.0; 6];
        let base = Impact::full_impact(&model, &state, &targets, &mut rates).expect("an impact");

        let mut mass = [0.0; 81];
        let mut jacobian = [0.0; 54];
        EquationsOfMotion::mass_matrix(&model, &state.base_pose, &ANGLES, &mut mass).expect("M");
        Kinematics::end_effector_jacobian(&model, &state.base_pose, &ANGLES, &mut jacobian).expect("J_e");
        let velocity: Vec<f64> = state.base_twist.iter().chain(&RATES).copied().collect();
        let mut momentum: Vec<f64> =
            mass.chunks(9).map(|row| row.iter().zip(&velocity).map(|(m, v)| m * v).sum()).collect();
        for (target, rows) in targets.iter().zip(jacobian.chunks(27)) {
            // J_t⁻ᵀ I_t t_t: the target's momentum about the contact point
            let Some(t) = target else { continue };
            let [px, py] = [t.mass * t.twist[1], t.mass * t.twist[2]];
            let spin = t.inertia * t.twist[0] + t.contact[1] * px - t.contact[0] * py;
            for (value, row) in [spin, px, py].into_iter().zip(rows.chunks(9)) {
                for (sum, entry) in momentum.iter_mut().zip(row) {
                    *sum += entry * value;
                }
            }
        }
        let mut merged = model;
        Merge::merge(&mut merged, &state.base_pose, &ANGLES, &targets).expect("a merged robot");
        let still = State { base_twist: [0.0; 3], joint_rates: &[0.0; 6], ..state };
        let forces = Forces {
            joint_torques: &momentum[3..],
            base_wrench: Some([momentum[0], momentum[1], momentum[2]]),
            end_effector_wrenches: None,
        };
        let mut joints = [0.0; 6];
        let twist = ForwardDynamics::forward_dynamics(&merged, &still, &forces, &mut joints).expect("accelerations");
        assert_close("base twist", &base, &twist, tolerance::SAME_IMPACT);
        assert_close("joint rates", &rates, &joints, tolerance::SAME_IMPACT);
    }
}

/// The merged robot, moving with the velocities after the impact, has the momentum and energy of robot and targets.
#[test]
fn the_merged_robot_carries_the_momentum_of_robot_and_targets() {
    let state = state();
    for targets in choices() {
        let model = Model::<f64>::default();
        let mut rates = [0.0; 6];
        let base_twist = Impact::full_impact(&model, &state, &targets, &mut rates).expect("an impact");
        let after = State { base_twist, joint_rates: &rates, ..state };
        let mut merged = model;
        Merge::merge(&mut merged, &state.base_pose, &ANGLES, &targets).expect("a merged robot");
        let whole = MomentumAndEnergy::momentum(&merged, &after).expect("momentum");

        let robot = MomentumAndEnergy::momentum(&model, &state).expect("momentum");
        let mut tips = [[0.0; 3]; 2];
        Kinematics::end_effector_poses(&model, &state.base_pose, &ANGLES, &mut tips).expect("tips");
        let mut sum = [robot.angular_momentum, robot.linear_momentum[0], robot.linear_momentum[1]];
        let mut energy = robot.kinetic_energy;
        for (target, tip) in targets.iter().zip(&tips) {
            let Some(target) = target else { continue };
            let (momentum, more) = target.momentum(&target.position(tip), &target.twist);
            sum.iter_mut().zip(momentum).for_each(|(s, m)| *s += m);
            energy += more;
        }
        let found = [whole.angular_momentum, whole.linear_momentum[0], whole.linear_momentum[1]];
        let size = 2000.0; // kg m²/s and kg m/s that these states have at most
        assert_close("momentum", &found, &sum, tolerance::MOMENTUM_JUMP * size);
        assert!(whole.kinetic_energy <= energy * (1.0 + 1e-12), "an inelastic impact does not make energy");
        if targets.iter().all(Option::is_none) {
            assert_close("energy without impact", &[whole.kinetic_energy], &[energy], 1e-10);
            assert_close("rates without impact", &rates, &RATES, tolerance::SAME_IMPACT);
        }
    }
}

/// Eq. (17) finds the base twist with which the robot alone keeps its momentum, wherever it is and however it moves.
#[test]
fn the_papers_base_twist_keeps_the_robots_momentum() {
    let state = state();
    let model = Model::<f64>::default();
    let (mut joint_rates, mut target_twists, mut impulses) = ([0.0; 6], [[0.0; 3]; 2], [[0.0; 3]; 2]);
    let mut workspace = PaperImpactWorkspace {
        impact_matrix: &mut [0.0; 36],
        impact_momentum: &mut [0.0; 6],
        jacobian: &mut [0.0; 36],
        mass_matrix: &mut [0.0; 81],
    };
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
    let targets = [Some(target(1.0)), Some(target(40.0))];
    let base_twist = impact::paper(&model, &state, &targets, &mut workspace, &mut after).expect("an impact");
    let moving = State { base_twist, joint_rates: &joint_rates, ..state };
    let [expected, found] = [&state, &moving].map(|state| {
        let momentum = MomentumAndEnergy::momentum(&model, state).expect("momentum");
        [momentum.angular_momentum, momentum.linear_momentum[0], momentum.linear_momentum[1]]
    });
    let [l, px, py] = expected;
    assert!(l.abs().min(px.abs()).min(py.abs()) > 10.0, "a robot that is at rest would show nothing");
    let size = 2000.0; // kg m²/s and kg m/s that this state has at most
    assert_close("momentum", &found, &expected, tolerance::MOMENTUM_JUMP * size);
}

/// v + ω × r at the contact, and `J_t⁻¹` back: with R in place of −R both fail.
#[test]
fn contact_jacobian_is_rigid_body_motion() {
    let target = target(1.0);
    let [omega, vx, vy] = target.twist;
    let [rx, ry] = target.contact;
    let at_contact = [omega, vx - omega * ry, vy + omega * rx];
    let by_matrix: Vec<f64> =
        target.contact_jacobian().iter().map(|row| row.iter().zip(&target.twist).map(|(j, t)| j * t).sum()).collect();
    assert_close("J_t t_t", &by_matrix, &at_contact, tolerance::POLYNOMIAL);
    assert_close("J_t⁻¹", &target.twist_from_contact(&at_contact), &target.twist, tolerance::POLYNOMIAL);
}
