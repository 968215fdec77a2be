"""States of four shipped layouts as Pinocchio and MuJoCo see them.

Shares no code with the product except the reader of layouts. Pinocchio and MuJoCo, each with a model
of its own, give the mass matrix, bias, tip poses and Jacobians, accelerations, momentum and energy;
they have to agree. The reduced equations and the impacts follow from Pinocchio's numbers by linear
systems solved as they stand; the exact impact with its impulses as unknowns, so that nothing is
eliminated by hand. Twists are [omega, vx, vy], wrenches [n, fx, fy], poses [yaw, x, y], inertial
axes, SI units; the velocity is the twist of the base COM, then the joint rates. No gravity.

    PYTHONPATH=. python tests/reference/pinocchio_states.py

needs requirements-reference.txt and writes states_LAYOUT.json next to this file: the inputs and the
output of `planar-capture eval` for each state, and MuJoCo's own values of what it computes.
"""

import json
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
from numpy.linalg import solve

from codegen.layout import Layout, content_hash, read

HERE = Path(__file__).parent
LAYOUTS = ("asymmetric_wheel", "boom_7r", "single_arm_2r", "triple_arm_3r")
AGREEMENT = 1e-11  # of Pinocchio and MuJoCo, relative to the largest entry
SEED = 2017

NEAR, FAR = 2.0, 1000.0  # of the base from the inertial origin, m
MEDIUM, LIGHT, HEAVY = (5.0, 80.0), (1e-3, 1e-2), (1e4, 5e4)  # masses of targets, kg
REGIMES = (  # name, angles, speed (rad/s, m/s), distance (m), forces, masses of targets, first is null
    ("at rest under torques", "random", 0.0, NEAR, "t", None, False),
    ("at rest, targets moving", "random", 0.0, NEAR, "", MEDIUM, False),
    ("slow", "random", 1e-4, NEAR, "tb", MEDIUM, False),
    ("moving, nothing acts", "random", 0.5, NEAR, "", None, False),
    ("moving, everything acts", "random", 0.5, NEAR, "tbe", MEDIUM, False),
    ("moving, the first arm captures nothing", "random", 0.5, NEAR, "e", MEDIUM, True),
    ("fast", "random", 10.0, NEAR, "tbe", MEDIUM, True),
    ("folded", "folded", 0.5, NEAR, "te", MEDIUM, False),
    ("stretched", "stretched", 0.5, NEAR, "tb", MEDIUM, False),
    ("far from the origin", "random", 0.5, FAR, "tbe", MEDIUM, False),
    ("turned many times", "turned", 0.5, NEAR, "be", LIGHT, False),
    ("light targets", "random", 0.5, NEAR, "tbe", LIGHT, False),
    ("heavy targets", "random", 0.5, NEAR, "t", HEAVY, False),
)


def from_simulator(size):
    """Both simulators move the base by [x, y, yaw]; where the contract's [yaw, x, y] is in that."""
    return np.array([2, 0, 1, *range(3, size)])


def unwrapped(rotation, near):
    """The angle of a rotation about z, with the turns of an angle that is known."""
    yaw = np.arctan2(rotation[1, 0], rotation[0, 0])
    return yaw + 2 * np.pi * np.round((near - yaw) / (2 * np.pi))


def end_effector_angles(layout, pose, angles):
    """Absolute angles of the tips, with their turns."""
    ends = np.cumsum([len(arm.links) for arm in layout.arms])[:-1]
    mounts = [arm.mount_angle for arm in layout.arms]
    return [pose[0] + mount + sum(part) for mount, part in zip(mounts, np.split(angles, ends), strict=True)]


class Pinocchio:
    """A layout as a Pinocchio model; the base is a composite joint in inertial axes."""

    def __init__(self, layout: Layout):
        self.layout, self.model = layout, pin.Model()
        self.model.gravity = pin.Motion.Zero()
        base = pin.JointModelComposite(3)
        for joint in (pin.JointModelPX(), pin.JointModelPY(), pin.JointModelRZ()):
            base.addJoint(joint)
        root = self._body(0, base, pin.SE3.Identity(), "base", layout.base, (0.0, 0.0))
        self.tips = []
        for arm in layout.arms:
            parent, place = root, pin.SE3(pin.utils.rotate("z", arm.mount_angle), np.array([*arm.mount, 0.0]))
            for k, link in enumerate(arm.links):
                parent = self._body(parent, pin.JointModelRZ(), place, f"{arm.name}.{k}", link, link.com)
                place = pin.SE3(np.eye(3), np.array([link.length, 0.0, 0.0]))
            self.tips.append(self.model.addFrame(pin.Frame(arm.name, parent, place, pin.OP_FRAME)))
        self.data = self.model.createData()

    def _body(self, parent, joint, place, name, body, com):
        inertia = pin.Inertia(body.mass, np.array([*com, 0.0]), body.inertia * np.eye(3))
        index = self.model.addJoint(parent, joint, place, name)
        self.model.appendBodyToJoint(index, inertia, pin.SE3.Identity())
        return index

    def quantities(self, pose, angles, twist, rates, torques, base_wrench, wrenches):
        """What MuJoCo computes too."""
        model, data = self.model, self.data
        order = from_simulator(model.nv)
        q, v = (np.array([*first[1:], first[0], *rest]) for first, rest in ((pose, angles), (twist, rates)))
        upper = np.triu(pin.crba(model, data, q))
        bias = pin.nonLinearEffects(model, data, q, v).copy()
        pin.framesForwardKinematics(model, data, q)
        external = pin.StdVec_Force(model.njoints, pin.Force.Zero())
        poses, jacobian = [], []
        for tip, angle, (n, fx, fy) in zip(
            self.tips, end_effector_angles(self.layout, pose, angles), wrenches, strict=True
        ):
            frame, place = model.frames[tip], data.oMf[tip]
            poses.append([unwrapped(place.rotation, angle), *place.translation[:2]])
            local = pin.computeFrameJacobian(model, data, q, tip, pin.LOCAL)[:, order]
            jacobian.append(np.vstack([local[5], place.rotation[:2, :2] @ local[:2]]))
            # from inertial axes at the tip to the axes and the origin of the joint
            at_joint = pin.SE3(place.rotation.T, frame.placement.translation)
            wrench = pin.Force(np.array([fx, fy, 0.0]), np.array([0.0, 0.0, n]))
            external[frame.parentJoint] = at_joint.act(wrench)
        forces = np.array([*base_wrench[1:], base_wrench[0], *torques])
        acceleration = pin.aba(model, data, q, v, forces, external)[order]
        momentum = pin.computeCentroidalMomentum(model, data, q, v)
        linear, com = momentum.linear[:2], data.com[0]
        return {
            "mass_matrix": (upper + np.triu(upper, 1).T)[np.ix_(order, order)],
            "bias": bias[order],
            "end_effector_poses": np.array(poses),
            "end_effector_jacobian": np.vstack(jacobian),
            "base_acceleration": acceleration[:3],
            "joint_accelerations": acceleration[3:],
            "linear_momentum": linear.copy(),
            "angular_momentum": momentum.angular[2] + com[0] * linear[1] - com[1] * linear[0],
            "kinetic_energy": pin.computeKineticEnergy(model, data, q, v),
        }


class MuJoCo:
    """A layout as a MuJoCo model; the base has two slides and a hinge."""

    def __init__(self, layout: Layout):
        def body(place, angle, joints, inertial, com, inside):
            moment = f"{inertial.inertia!r} " * 3  # of a sphere: those about x and y play no part
            return (
                f'<body pos="{place[0]!r} {place[1]!r} 0" euler="0 0 {angle!r}">{joints}<inertial '
                f'pos="{com[0]!r} {com[1]!r} 0" mass="{inertial.mass!r}" diaginertia="{moment}"/>{inside}</body>'
            )

        hinge = '<joint type="hinge" axis="0 0 1"/>'
        slides = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>'
        arms = ""
        for arm in layout.arms:
            inside = f'<site name="{arm.name}" pos="{arm.links[-1].length!r} 0 0"/>'
            for link, inner in zip(arm.links[:0:-1], arm.links[-2::-1], strict=True):
                inside = body((inner.length, 0.0), 0.0, hinge, link, link.com, inside)
            arms += body(arm.mount, arm.mount_angle, hinge, arm.links[0], arm.links[0].com, inside)
        robot = body((0.0, 0.0), 0.0, slides + hinge, layout.base, (0.0, 0.0), arms)
        options = '<compiler angle="radian" inertiafromgeom="false"/><option gravity="0 0 0"/>'
        xml = f"<mujoco>{options}<worldbody>{robot}</worldbody></mujoco>"
        self.layout, self.model = layout, mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)

    def quantities(self, pose, angles, twist, rates, torques, base_wrench, wrenches):
        """The same as Pinocchio's."""
        model, data = self.model, self.data
        order = from_simulator(model.nv)
        data.qpos[:] = [*pose[1:], pose[0], *angles]
        data.qvel[:] = [*twist[1:], twist[0], *rates]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        data.qfrc_applied[:] = [0.0, 0.0, 0.0, *torques]

        def push(point, body, wrench):
            force, moment = np.array([*wrench[1:], 0.0]), np.array([0.0, 0.0, wrench[0]])
            mujoco.mj_applyFT(model, data, force, moment, point, body, data.qfrc_applied)

        poses, jacobian = [], []
        for site, angle in enumerate(end_effector_angles(self.layout, pose, angles)):
            point, rotation = data.site_xpos[site], data.site_xmat[site].reshape(3, 3)
            poses.append([unwrapped(rotation, angle), *point[:2]])
            moving, turning = np.zeros((3, model.nv)), np.zeros((3, model.nv))
            mujoco.mj_jacSite(model, data, moving, turning, site)
            jacobian.append(np.vstack([turning[2], moving[:2]])[:, order])
            push(point, model.site_bodyid[site], wrenches[site])
        push(data.xipos[1], 1, base_wrench)
        mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        mujoco.mj_subtreeVel(model, data)
        mujoco.mj_energyVel(model, data)
        linear, com = model.body_subtreemass[1] * data.subtree_linvel[1], data.subtree_com[1]
        acceleration = data.qacc[order]
        return {
            "mass_matrix": mass[np.ix_(order, order)],
            "bias": data.qfrc_bias[order],
            "end_effector_poses": np.array(poses),
            "end_effector_jacobian": np.vstack(jacobian),
            "base_acceleration": acceleration[:3],
            "joint_accelerations": acceleration[3:],
            "linear_momentum": linear[:2].copy(),
            "angular_momentum": data.subtree_angmom[1][2] + com[0] * linear[1] - com[1] * linear[0],
            "kinetic_energy": data.energy[1],
        }


def reduced(mass, bias, tips):
    """Eq. (2): generalized inertia, bias and Jacobian."""
    coupling = solve(mass[:3, :3], mass[:3, 3:])
    return {
        "generalized_inertia": mass[3:, 3:] - mass[3:, :3] @ coupling,
        "generalized_bias": bias[3:] - coupling.T @ bias[:3],
        "generalized_jacobian": tips[:, 3:] - tips[:, :3] @ coupling,
    }


def captured(targets, tips, gjm):
    """Arms that capture; their J_t and I_t, block diagonal; target twists; rows of both Jacobians."""
    arms = [i for i, target in enumerate(targets) if target is not None]
    contact, inertia = np.eye(3 * len(arms)), np.zeros(3 * len(arms))
    for i, arm in enumerate(arms):
        rx, ry = targets[arm]["contact"]
        contact[3 * i + 1 : 3 * i + 3, 3 * i] = -ry, rx
        inertia[3 * i : 3 * i + 3] = targets[arm]["inertia"], targets[arm]["mass"], targets[arm]["mass"]
    before = np.array([value for arm in arms for value in targets[arm]["twist"]])
    rows = [3 * arm + k for arm in arms for k in range(3)]
    return arms, contact, np.diag(inertia), before, tips[rows], gjm[rows]


def impacts(known, twist, rates, targets):
    """The paper's reduced equations (15)-(16), and the exact impact."""
    mass, gim = known["mass_matrix"], known["generalized_inertia"]
    jacobians = known["end_effector_jacobian"], known["generalized_jacobian"]
    arms, contact, inertia, before, tips, gjm = captured(targets, *jacobians)
    to_target = solve(contact, gjm)
    matrix = gim + to_target.T @ inertia @ to_target
    momentum = gim @ rates + to_target.T @ inertia @ before
    # M (v_f - v_i) = J_e' F, I_t (t_tf - t_ti) = -J_t' F, J_e v_f = J_t t_tf
    n, m = len(mass), len(before)
    system = np.block(
        [
            [mass, np.zeros((n, m)), -tips.T],
            [np.zeros((m, n)), inertia, contact.T],
            [tips, -contact, np.zeros((m, m))],
        ]
    )
    right = np.concatenate([mass @ np.concatenate([twist, rates]), inertia @ before, np.zeros(m)])
    after, twists, impulses = np.split(solve(system, right), [n, n + m])

    def by_arm(values):
        found = dict(zip(arms, values.reshape(-1, 3), strict=True))
        return [found.get(arm) for arm in range(len(targets))]

    return {
        "impact": {"G": matrix, "H": momentum, "joint_rates_after": solve(matrix, momentum)},
        "capture": {
            "base_twist_after": after[:3],
            "joint_rates_after": after[3:],
            "target_twists_after": by_arm(twists),
            "impulses": by_arm(impulses),
        },
    }


def random_state(random, layout, angles, speed, distance, forces, masses, first_is_null):
    """Inputs as eval's."""
    joints, arms = layout.joints, len(layout.arms)
    some = {
        "random": random.uniform(-np.pi, np.pi, joints),
        "folded": np.tile([3.1, -3.1], joints)[:joints] + random.uniform(-0.02, 0.02, joints),
        "stretched": random.uniform(-0.02, 0.02, joints),
        "turned": random.uniform(-40.0, 40.0, joints),
    }
    yaw = random.uniform(-np.pi, np.pi) * (10.0 if angles == "turned" else 1.0)
    state = {
        "base_pose": [yaw, *random.uniform(-distance, distance, 2)],
        "joint_angles": some[angles],
        "base_twist": speed * random.uniform(-1.0, 1.0, 3),
        "joint_rates": speed * random.uniform(-1.0, 1.0, joints),
    }
    acting = {"t": ("joint_torques", joints), "b": ("base_wrench", 3), "e": ("end_effector_wrenches", (arms, 3))}
    for key in forces:
        name, shape = acting[key]
        state[name] = random.uniform(-10.0, 10.0, shape)
    if masses is not None:
        state["targets"] = [None if arm == 0 and first_is_null else target(random, masses) for arm in range(arms)]
    return state


def target(random, masses):
    """A target with the mass between bounds, and the radius of gyration of a body of about a metre."""
    mass = random.uniform(*masses)
    return {
        "mass": mass,
        "inertia": mass * random.uniform(0.05, 0.4),
        "contact": random.uniform(-0.6, 0.6, 2),
        "twist": random.uniform(-0.5, 0.5, 3),
    }


def main():
    """Write the states of every layout."""
    for number, name in enumerate(LAYOUTS):
        layout = read(HERE.parents[1] / "codegen" / "layouts" / f"{name}.toml")
        simulators, random = (Pinocchio(layout), MuJoCo(layout)), np.random.default_rng([SEED, number])
        states = []
        for regime, *kind in REGIMES:
            state = random_state(random, layout, *kind)
            motion = (state["base_pose"], state["joint_angles"], state["base_twist"], state["joint_rates"])
            forces = (
                state.get("joint_torques", np.zeros(layout.joints)),
                state.get("base_wrench", np.zeros(3)),
                state.get("end_effector_wrenches", np.zeros((len(layout.arms), 3))),
            )
            expect, other = (simulator.quantities(*motion, *forces) for simulator in simulators)
            for quantity, value in expect.items():
                error = np.max(np.abs(value - other[quantity]))
                assert error <= AGREEMENT * np.max(np.abs(value)), (name, regime, quantity, error)
            expect |= reduced(expect["mass_matrix"], expect["bias"], expect["end_effector_jacobian"])
            if "targets" in state:
                expect |= impacts(expect, *motion[2:], state["targets"])
            states.append({"regime": regime, **state, "expect": expect, "mujoco": other})
        modules = (pin, mujoco, np)
        head = {
            "layout": name,
            "sha256": content_hash(layout),
            "made_by": {module.__name__: module.__version__ for module in modules},
        }
        lines = ",\n".join(json.dumps(state, default=lambda array: array.tolist()) for state in states)
        text = f'{json.dumps(head)[:-1]}, "states": [\n{lines}\n]}}\n'
        (HERE / f"states_{name}.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
