"""Forward dynamics: articulated plane masses from the tips to the base, one division per link, 2 x 2 at the base.

`articulated_body.py` has the step from body to body. The arms meet at the base, which is treated as one more
body, held at the first arm's mount: what is left is the 2 x 2 balance of forces there.
"""

import casadi as ca

from .articulated_body import ZERO, Body, Child, Inertia, InLine, body
from .inputs import Inputs
from .layout import Layout
from .plane_vectors import Vector, add, cross, rotate, rotate_back, rotation, scale, subtract, turn_left
from .symbols import ArmSymbols, LinkSymbols, Symbols


class Arm:
    """One arm: link bodies from the tip to the mount, at one configuration."""

    def __init__(self, symbols: Symbols, inputs: Inputs, index: int) -> None:
        self.symbols: ArmSymbols = symbols.arms[index]
        self.index = index
        self.label = f"arm{index + 1}"
        self.first_joint = sum(len(a.links) for a in symbols.arms[:index])
        self.links = len(self.symbols.links)
        last = self.symbols.links[-1]
        # the frame of the last link is turned until its COM lies on x: its articulated mass is diagonal
        self.turned, com, self.tip = self._turn_to_com(symbols, last)
        self.bodies: list[Body] = [None] * self.links
        self.rotations: list[Vector] = [None] * self.links
        children: list[Child] = []
        for k in reversed(range(self.links)):
            link = self.symbols.links[k]
            is_last = k == self.links - 1
            link_com = com if is_last else (link.com_x, link.com_y)
            own = Inertia(f"{self.label}_link{k + 1}", link.mass, link.inertia, link_com)
            self.bodies[k] = body(symbols, own, children)
            angle = inputs.joint_angles[self.first_joint + k]
            if is_last:
                angle = angle + self.turned
            if k == 0:
                angle = angle + self.symbols.mount_angle
            self.rotations[k] = rotation(angle)
            mass = self.bodies[k].mass.rotate(self.rotations[k])
            offset = (self.symbols.links[k - 1].length, ZERO) if k > 0 else (self.symbols.mount_x, self.symbols.mount_y)
            children = [Child(offset, mass)]
        self.child = children[0]

    def _turn_to_com(self, symbols: Symbols, last: LinkSymbols) -> tuple[ca.SX, Vector, Vector]:
        name = f"{self.label}_com"
        angle = symbols.constant(
            f"{name}_angle",
            ca.atan2(last.com_y, last.com_x),
            "rad",
            "direction of the last link's COM in its frame",
        )
        distance = symbols.constant(
            f"{name}_distance",
            ca.sqrt(last.com_x * last.com_x + last.com_y * last.com_y),
            "m",
            "|c| of the last link",
        )
        tip_x = symbols.constant(
            f"{self.label}_tip_x", last.length * ca.cos(angle), "m", "tip along the last link's COM"
        )
        tip_y = symbols.constant(
            f"{self.label}_tip_y", -last.length * ca.sin(angle), "m", "tip across the last link's COM"
        )
        return angle, (distance, ZERO), (tip_x, tip_y)

    def force(self, inputs: Inputs, base_rate: ca.SX, base_rotation: Vector, with_wrench: bool) -> Vector:
        """b of this arm at its mount, in the base frame; leaves what the sweep outwards needs."""
        rates, rate = [], base_rate
        for k in range(self.links):
            rate = rate + inputs.joint_rates[self.first_joint + k]
            rates.append(rate)
        torques = [inputs.joint_torques[self.first_joint + k] for k in range(self.links)]
        moment = torques[-1]
        external = (ZERO, ZERO)
        if with_wrench:
            wrench = inputs.end_effector_wrenches[:, self.index]
            external = rotate_back(base_rotation, (wrench[1], wrench[2]))
            for turn in self.rotations:
                external = rotate_back(turn, external)
            moment = moment + (wrench[0] + cross(self.tip, external))
        b: list[Vector] = []
        for k in reversed(range(self.links)):
            if k < self.links - 1:
                moment = torques[k] - torques[k + 1]
            b = [self.bodies[k].force(rates[k] * rates[k], moment, b)]
            if k == self.links - 1 and with_wrench:
                b = [subtract(b[0], external)]
            b = [rotate(self.rotations[k], b[0])]
        return b[0]

    def accelerate(self, a: Vector, base_acceleration: ca.SX) -> list[ca.SX]:
        """Joint accelerations from the acceleration of the mount, in the base frame."""
        accelerations, before = [], base_acceleration
        for k in range(self.links):
            a = rotate_back(self.rotations[k], a)
            alpha, points = self.bodies[k].accelerate(a)
            accelerations.append(alpha - before)
            before = alpha
            if points:
                a = points[0]
        return accelerations


class ForwardDynamics:
    """The robot at one configuration, ready for any velocities and forces."""

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.symbols, self.inputs = symbols, inputs
        self.arms = [Arm(symbols, inputs, i) for i in range(len(symbols.arms))]
        first = self.arms[0].child.offset
        com = (-first[0], -first[1])  # the base COM from the first arm's mount
        children = []
        for i, arm in enumerate(self.arms[1:], start=2):
            offset = subtract(arm.child.offset, first)
            named = tuple(
                symbols.constant(
                    f"arm{i}_mount_offset_{axis}",
                    value,
                    "m",
                    f"mount of arm {i} from that of arm 1, base frame, {axis}",
                )
                for axis, value in zip("xy", offset, strict=True)
            )
            children.append(Child(named, arm.child.mass))
        self.com = com
        own = Inertia("base", symbols.base_mass, symbols.base_inertia, com)
        self.base = body(symbols, own, children, general=mounts_coincide(symbols.layout))
        self.needs_distinct_mounts = isinstance(self.base, InLine)
        total = self.base.mass.plus(self.arms[0].child.mass)
        # L D L^T of the 2 x 2 that is left
        self.total = total
        self.inverse_xx = symbols.reciprocal(total.xx)
        self.lower = total.xy * self.inverse_xx
        self.pivot = total.yy - self.lower * total.xy
        self.inverse_pivot = symbols.reciprocal(self.pivot)

    def smallest_pivot(self) -> ca.SX:
        """The last pivot relative to its diagonal entry; those before it are bounded by the parameters."""
        return self.pivot / self.total.yy

    def solve(self, base_wrench: bool, end_effector_wrenches: bool) -> tuple[ca.SX, ca.SX]:
        """(base acceleration, joint accelerations); what is absent costs nothing."""
        inputs = self.inputs
        base_rotation = rotation(inputs.base_pose[0])
        base_rate = inputs.base_twist[0]
        forces = [arm.force(inputs, base_rate, base_rotation, end_effector_wrenches) for arm in self.arms]
        moment = -inputs.joint_torques[self.arms[0].first_joint]
        for arm in self.arms[1:]:
            moment = moment - inputs.joint_torques[arm.first_joint]
        external = (ZERO, ZERO)
        if base_wrench:
            wrench = inputs.base_wrench
            external = rotate_back(base_rotation, (wrench[1], wrench[2]))
            moment = moment + (wrench[0] + cross(self.com, external))
        rate_squared = base_rate * base_rate
        b = add(self.base.force(rate_squared, moment, forces[1:]), forces[0])
        if base_wrench:
            b = subtract(b, external)
        y = (self.lower * b[0] - b[1]) * self.inverse_pivot
        x = -(b[0] * self.inverse_xx) - self.lower * y
        alpha, points = self.base.accelerate((x, y))
        accelerations = []
        for arm, point in zip(self.arms, [(x, y), *points], strict=True):
            accelerations += arm.accelerate(point, alpha)
        at_com = add((x, y), subtract(scale(alpha, turn_left(self.com)), scale(rate_squared, self.com)))
        linear = rotate(base_rotation, at_com)
        return ca.vertcat(alpha, *linear), ca.vertcat(*accelerations)


def mounts_coincide(layout: Layout) -> bool:
    """Whether the second arm is mounted where the first one is: then their distance cannot be divided by."""
    return len(layout.arms) > 1 and tuple(layout.arms[0].mount) == tuple(layout.arms[1].mount)
