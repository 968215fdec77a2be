"""Independent numeric model of the dual-arm capture of Raina & Shah (2017).

Shares no code with the product. Every body has an absolute planar pose; the stacked body Jacobian
B(q) gives the body twists B v, so that M = B' Mbar B and bias = B' Mbar Bdot v. A captured target
is one more body on the last link. Linear systems are solved as they stand and time is integrated
with DOP853 close to round-off. Twists are [omega, vx, vy], wrenches [n, fx, fy], poses
[yaw, x, y], inertial axes, SI units; the velocity v is the twist of the base COM, then the joint
rates. No gravity.

    python tests/reference/independent_model.py

needs numpy and scipy, and writes raina_shah_2017.json next to this file.
"""

import json
from pathlib import Path

import numpy as np
from numpy.linalg import solve
from scipy.integrate import solve_ivp

INITIAL = np.array([0.698, -1.571, 1.047, 2.444, 1.571, -1.047])
FINAL = np.array([-0.524, -1.393, -0.035, 2.618, -1.393, -0.035])
TIP_TWISTS = np.array([0.0, -0.1, 0.0, 0.0, 0.1, 0.0])
APPROACH, POST_IMPACT = 20.0, 50.0
PROPORTIONAL, DERIVATIVE = 49.0, 14.0
TARGET_MASS, TARGET_INERTIA = 10.0, 1.0
CONTACTS = np.array([[0.0, 0.5], [0.0, -0.5]])  # from the target's COM to the contact point
SPINS = {"case1": (0.2, 0.2), "case2": (0.0, 0.0), "case3": (0.2, -0.2)}
SCENARIOS = {  # name: (tracking, final rate that the polynomial reaches / rate put into it)
    "raina_shah_2017": ("pd", 1.0),
    "raina_shah_2017_exact_tracking": ("exact", 1.0),
    "raina_shah_2017_as_printed": ("pd", 1.0 / APPROACH),
}


def turn(vectors):
    """The plane's vectors rotated by +90 degrees: the velocity of a point at unit rate."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


class Robot:
    """A base with arms of revolute joints; link 0 is the base, its frame at the base COM."""

    def __init__(self, base, mounts, links):
        """base = (mass, inertia), mounts = [(x, y)], links = arm by arm [(length, m, I)]."""
        self.parents, self.offsets = [None], [np.zeros(2)]  # of each link's joint
        self.bodies = [(0, np.zeros(2), *base)]  # link, COM in the link's frame, mass, inertia
        self.tips = []
        for mount, arm in zip(mounts, links, strict=False):
            parent, offset = 0, np.array(mount)
            for length, mass, inertia in arm:
                self.parents.append(parent)
                self.offsets.append(offset)
                parent, offset = len(self.parents) - 1, np.array([length, 0.0])
                self.bodies.append((parent, offset / 2, mass, inertia))
            self.tips.append((parent, offset))
        count = len(self.parents)
        self.moves = np.eye(count)  # [i, j] = 1: joint j turns link i
        for link in range(1, count):
            self.moves[link] += self.moves[self.parents[link]]

    def merged(self, q, com):
        """The robot with one target per arm fixed to the last link, its COM at `com` now."""
        other = Robot((0.0, 0.0), [], [])
        vars(other).update(vars(self), bodies=list(self.bodies))
        angles, origins = self.frames(q)
        for (link, _), point in zip(self.tips, com, strict=False):
            cos, sin = np.cos(angles[link]), np.sin(angles[link])
            local = np.array([[cos, sin], [-sin, cos]]) @ (point - origins[link])
            other.bodies.append((link, local, TARGET_MASS, TARGET_INERTIA))
        return other

    def frames(self, q):
        """Absolute angle and origin of every link."""
        angles = self.moves @ np.concatenate([q[:1], q[3:]])
        cos, sin = np.cos(angles), np.sin(angles)
        origins = [q[1:3]]
        for parent, (x, y) in zip(self.parents[1:], self.offsets[1:], strict=False):
            c, s = cos[parent], sin[parent]
            origins.append(origins[parent] + [c * x - s * y, s * x + c * y])
        return angles, np.array(origins)

    def points(self, q, v, fixed):
        """Poses, Jacobians and Jdot v of points given by (link, position in the link's frame)."""
        angles, origins = self.frames(q)
        links = np.array([item[0] for item in fixed])
        local = np.array([item[1] for item in fixed])
        cos, sin = np.cos(angles[links]), np.sin(angles[links])
        position = origins[links] + np.stack(
            [
                cos * local[:, 0] - sin * local[:, 1],
                sin * local[:, 0] + cos * local[:, 1],
            ],
            axis=-1,
        )
        rates = np.concatenate([v[:1], v[3:]])

        def levers(at, moved_by):  # velocity per unit rate of each joint: point, joint, axis
            return turn(at[:, None] - origins[None]) * moved_by[:, :, None]

        lever = levers(position, self.moves[links])
        speed = v[1:3] + np.einsum("pja,j->pa", lever, rates)
        speed_joint = v[1:3] + np.einsum("pja,j->pa", levers(origins, self.moves), rates)
        change = turn(speed[:, None] - speed_joint[None]) * self.moves[links][:, :, None]

        jacobian = np.zeros((len(fixed), 3, len(v)))
        turning = np.concatenate([self.moves[links][:, :, None], lever], axis=-1)
        jacobian[:, :, 0] = turning[:, 0]
        jacobian[:, 1, 1] = jacobian[:, 2, 2] = 1.0
        jacobian[:, :, 3:] = turning[:, 1:].transpose(0, 2, 1)
        drift = np.zeros((len(fixed), 3))
        drift[:, 1:] = np.einsum("pja,j->pa", change, rates)
        poses = np.column_stack([angles[links], position])
        return poses, jacobian.reshape(-1, len(v)), drift.reshape(-1)

    def body_inertia(self):
        """The diagonal of Mbar: (inertia, mass, mass) of every body."""
        return np.array([[inertia, mass, mass] for _, _, mass, inertia in self.bodies]).ravel()

    def dynamics(self, q, v):
        """Mass matrix and bias."""
        _, jacobian, drift = self.points(q, v, self.bodies)
        weighted = jacobian.T * self.body_inertia()
        return weighted @ jacobian, weighted @ drift

    def end_effector_motion(self, q, v):
        """Tip poses and the stacked tip Jacobian [J_be J_me]."""
        poses, jacobian, _ = self.points(q, v, self.tips)
        return poses, jacobian

    def reduced(self, q):
        """Generalized inertia (GIM), generalized Jacobian (GJM), and base rates per joint rate."""
        mass, _ = self.dynamics(q, np.zeros(len(q)))
        _, tips = self.end_effector_motion(q, np.zeros(len(q)))
        coupling = -solve(mass[:3, :3], mass[:3, 3:])
        gim = mass[3:, 3:] + mass[3:, :3] @ coupling
        return gim, tips[:, 3:] + tips[:, :3] @ coupling, coupling

    def momentum(self, q, v):
        """[l, px, py] about the inertial origin, body by body, and the kinetic energy."""
        poses, jacobian, _ = self.points(q, v, self.bodies)
        return momentum_of(poses, (jacobian @ v).reshape(-1, 3), self.body_inertia())


def momentum_of(poses, twists, inertia):
    """[l, px, py] about the inertial origin and kinetic energy of free bodies."""
    spin, px, py = (inertia.reshape(-1, 3) * twists).T
    angular = spin + poses[:, 1] * py - poses[:, 2] * px
    return (
        np.array([angular.sum(), px.sum(), py.sum()]),
        0.5 * np.sum(inertia * twists.ravel() ** 2),
    )


def integrate(rate, start, times):
    """States at `times` (from time 0); the error of a step is kept near round-off."""
    result = solve_ivp(
        rate,
        (0.0, times[-1]),
        start,
        method="DOP853",
        t_eval=times,
        rtol=1e-13,
        atol=1e-14,
    )
    assert result.success, result.message
    return result.y.T


def quartic(initial, final, duration, end_rate):
    """Eqs. (6)-(7) with a dimensionless s: t -> (angles, rates), reaching `end_rate`."""

    def at(t):
        x = t / duration
        angle = initial + (
            (final - initial) * (10 * x**3 - 15 * x**4 + 6 * x**5)
            + end_rate * duration * (-4 * x**3 + 7 * x**4 - 3 * x**5)
        )
        rate = (final - initial) / duration * (30 * x**2 - 60 * x**3 + 30 * x**4) + end_rate * (
            -12 * x**2 + 28 * x**3 - 15 * x**4
        )
        return angle, rate

    return at


def cycloidal(initial, final, duration):
    """ReDySim's trajectory: t -> (angles, rates)."""

    def at(t):
        phase = 2 * np.pi * t / duration
        mean = (final - initial) / duration
        return initial + mean * (t - np.sin(phase) * duration / (2 * np.pi)), mean * (1 - np.cos(phase))

    return at


def track_exactly(robot, trajectory, duration):
    """From rest at the origin, joints exactly on the trajectory: zero momentum moves the base."""

    def rate(t, pose):
        angles, rates = trajectory(t)
        return robot.reduced(np.concatenate([pose, angles]))[2] @ rates

    angles, rates = trajectory(duration)
    q = np.concatenate([integrate(rate, np.zeros(3), [duration])[-1], angles])
    return q, np.concatenate([robot.reduced(q)[2] @ rates, rates])


def forward(robot, torques):
    """The state's time derivative under joint torques(t, angles, rates)."""

    def rate(t, state):
        q, v = np.split(state, 2)
        mass, bias = robot.dynamics(q, v)
        force = np.concatenate([np.zeros(3), torques(t, q[3:], v[3:])])
        return np.concatenate([v, solve(mass, force - bias)])

    return rate


def track_pd(robot, trajectory, times):
    """From rest at the origin under PD control without feed-forward: states at `times`."""

    def torques(t, angles, rates):
        wanted, wanted_rates = trajectory(t)
        return PROPORTIONAL * (wanted - angles) + DERIVATIVE * (wanted_rates - rates)

    angles = trajectory(0.0)[0]
    start = np.concatenate([np.zeros(3), angles, np.zeros(3 + len(angles))])
    return integrate(forward(robot, torques), start, times)


def terminal_rates(robot, ratio):
    """Fixed point: track exactly -> final pose -> GJM inverse -> joint rates at the end."""
    rates = np.zeros(6)
    for _ in range(15):  # contracts to round-off in about ten
        trajectory = quartic(INITIAL, FINAL, APPROACH, rates * ratio)
        q, _ = track_exactly(robot, trajectory, APPROACH)
        previous, rates = rates, solve(robot.reduced(q)[1], TIP_TWISTS)
    assert np.max(np.abs(rates - previous)) < 1e-13, "the end rates did not converge"
    return rates, quartic(INITIAL, FINAL, APPROACH, rates * ratio)


def contact_jacobian(contacts):
    """J_t, block diagonal: twist of the contact point from the twist of the target's COM."""
    jacobian = np.eye(3 * len(contacts))
    for i, (x, y) in enumerate(contacts):
        jacobian[3 * i + 1, 3 * i], jacobian[3 * i + 2, 3 * i] = -y, x
    return jacobian


def exact_capture(robot, q, v, contact, inertia, before):
    """(M + Je' N Je) v_f = M v_i + Je' Jt^-T It t_ti: v_f and the target twists."""
    mass, _ = robot.dynamics(q, v)
    _, tips = robot.end_effector_motion(q, v)
    to_target = solve(contact, tips)
    after = solve(
        mass + to_target.T * inertia @ to_target,
        mass @ v + to_target.T @ (inertia * before),
    )
    return after, to_target @ after


def paper_capture(robot, q, v, contact, inertia, before):
    """Eqs. (14)-(17) as they stand; (17) gets the robot's momentum before the impact."""
    gim, gjm, _ = robot.reduced(q)
    to_target = solve(contact, gjm)
    rates = solve(
        gim + to_target.T * inertia @ to_target,
        gim @ v[3:] + to_target.T @ (inertia * before),
    )
    (angular, px, py), _ = robot.momentum(q, v)
    mass, _ = robot.dynamics(q, v)
    about_base = np.array([angular - (q[1] * py - q[2] * px), px, py])
    base = solve(mass[:3, :3], about_base - mass[:3, 3:] @ rates)
    return np.concatenate([base, rates]), to_target @ rates


def impact(capture, robot, q, v, spins):
    """The contract's impact record, and the velocity after."""
    contact = contact_jacobian(CONTACTS)
    inertia = np.tile([TARGET_INERTIA, TARGET_MASS, TARGET_MASS], 2)
    before = np.zeros(6)
    before[::3] = spins
    after, targets = capture(robot, q, v, contact, inertia, before)
    impulses = -solve(contact.T, inertia * (targets - before)).reshape(-1, 3)
    poses = robot.end_effector_motion(q, v)[0]
    poses[:, 1:] -= CONTACTS
    old, new = (
        [
            np.add(robot_part, target_part)
            for robot_part, target_part in zip(
                robot.momentum(q, speed),
                momentum_of(poses, twists.reshape(-1, 3), inertia),
                strict=False,
            )
        ]
        for speed, twists in ((v, before), (after, targets))
    )
    return after, {
        "joint_rates_after": after[3:],
        "base_twist_after": after[:3],
        "target_twists_after": targets.reshape(-1, 3),
        "impulses": impulses,
        "impulse_magnitudes": np.hypot(impulses[:, 1], impulses[:, 2]),
        "momentum_jump": new[0] - old[0],
        "kinetic_energy_before": old[1],
        "kinetic_energy_after": new[1],
    }


def record(q, v):
    """The contract's names for a state."""
    return {
        "base_pose": q[:3],
        "base_twist": v[:3],
        "joint_angles": q[3:],
        "joint_rates": v[3:],
    }


def scenario(robot, name):
    """One scenario of the paper, all cases."""
    tracking, ratio = SCENARIOS[name]
    rates, trajectory = terminal_rates(robot, ratio)
    if tracking == "exact":
        q, v = track_exactly(robot, trajectory, APPROACH)
    else:
        q, v = np.split(track_pd(robot, trajectory, [APPROACH])[-1], 2)
    poses, tips = robot.end_effector_motion(q, v)
    approach = {
        "duration": APPROACH,
        **record(q, v),
        "end_effector_poses": poses,
        "end_effector_twists": (tips @ v).reshape(-1, 3),
    }
    combined = robot.merged(q, poses[:, 1:] - CONTACTS)
    free = forward(combined, lambda t, angles, rates: np.zeros(6))
    cases = []
    for case, spins in SPINS.items():
        after, exact = impact(exact_capture, robot, q, v, spins)
        _, paper = impact(paper_capture, robot, q, v, spins)
        last = integrate(free, np.concatenate([q, after]), [POST_IMPACT])[-1]
        cases.append(
            {
                "name": case,
                "approach": approach,
                "impact": {"exact": exact, "paper": paper},
                "post_impact": {"duration": POST_IMPACT, **record(*np.split(last, 2))},
            }
        )
    return {"scenario": name, "designed_joint_rates": rates, "cases": cases}


def paper_robot(arms=2):
    """Table 1; joint 1 of either arm is measured from the base x axis."""
    return Robot(
        (500.0, 83.61),
        [(0.5, 0.0), (-0.5, 0.0)][:arms],
        [[(1.0, 10.0, 1.05)] * 3] * arms,
    )


def redysim():
    """The runs whose output ReDySim ships: one arm over 20 s, both arms over 30 s."""
    one = np.array([0.3803, -0.6198, 1.2867]), np.full(3, -np.pi / 2)
    two = (
        np.array([0.3803, -0.6198, 1.2867, 2.4411, 1.7062, -1.0058]),
        np.array([-0.2530, -1.8050, -0.0364, 3.3946, 1.8050, 0.0364]),
    )
    out = {}
    for name, arms, (initial, final), times in (
        ("one_arm", 1, one, [5.0, 10.0, 15.0, 20.0]),
        ("both_arms", 2, two, [10.0, 20.0, 30.0]),
    ):
        states = track_pd(paper_robot(arms), cycloidal(initial, final, times[-1]), times)
        out[name] = [{"time": t, **record(*np.split(y, 2))} for t, y in zip(times, states, strict=False)]
    return out


def main():
    """Write raina_shah_2017.json."""
    robot = paper_robot()
    result = {
        "source": "tests/reference/independent_model.py",
        "scenarios": [scenario(robot, name) for name in SCENARIOS],
        "redysim": redysim(),
    }
    text = json.dumps(result, indent=1, default=lambda array: array.tolist())
    Path(__file__).with_name("raina_shah_2017.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
