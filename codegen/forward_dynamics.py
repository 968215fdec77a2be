"""Forward dynamics: articulated plane masses, one division per link, 2 x 2 at the base.

A revolute joint passes no moment but its torque. What lies beyond joint k therefore acts on the body
before it as a symmetric 2 x 2 articulated mass A and a force b: the force that it needs is F = A a + b,
with a the acceleration of the joint point. All of it is written in link frames. For a link with first
joint P, COM at c, next joint at d = (l, 0), angular acceleration alpha and rate omega,

    F = m a_com + F',     a_com = a + alpha z x c - omega^2 c,    F' = A' (a + alpha z x d - omega^2 d) + b'
    tau - tau' = I_P alpha + m c x a + d x F',                    I_P = I + m |c|^2.

Eliminating alpha with l alpha as the unknown (J = I_P / l^2, mu = m c_x / l, D = J + A'_yy) leaves

    A = [[m + A'_xx - A'_xy^2 / D,  A'_xy e], [.,  J_next - (J - mu) e]],    e = (J - mu) / D,

where J_next = J + m - 2 mu is the inertia about the next joint over l^2: no term cancels. A structurally
off-axis COM, a link of length zero and a base with its mounts anywhere take the general form with r and D.
"""

from dataclasses import dataclass

import casadi as ca

from .kinematics import Inputs
from .layout import Layout
from .planar import Vector, add, cross, rotate, rotate_back, rotation, scale, subtract, turn_left
from .symbols import ArmSymbols, LinkSymbols, Symbols

ZERO = ca.SX(0)


@dataclass(frozen=True)
class PlaneMass:
    """A symmetric 2 x 2 articulated mass, and xx - yy where that is known beforehand."""

    xx: ca.SX
    xy: ca.SX
    yy: ca.SX
    difference: ca.SX | None = None

    def rotate(self, rotation: Vector) -> "PlaneMass":
        """R A R^T in 10 operations, 5 where xy is zero; the trace stays."""
        c, s = rotation
        difference = self.xx - self.yy if self.difference is None else self.difference
        v = c * (self.xy + self.xy) + s * difference
        sv = s * v
        return PlaneMass(self.xx - sv, c * v - self.xy, self.yy + sv)

    def times(self, a: Vector) -> Vector:
        return self.xx * a[0] + self.xy * a[1], self.xy * a[0] + self.yy * a[1]

    def plus(self, other: "PlaneMass") -> "PlaneMass":
        return PlaneMass(self.xx + other.xx, self.xy + other.xy, self.yy + other.yy)


@dataclass(frozen=True)
class Child:
    """What a body carries: an articulated mass at an offset, both in the body's frame."""

    offset: Vector
    mass: PlaneMass


class Body:
    """One body between its first joint and its children: elimination of its angular acceleration."""

    def __init__(
        self,
        symbols: Symbols,
        label: str,
        mass: ca.SX,
        inertia: ca.SX,
        com: Vector,
        children: list[Child],
        general: bool = False,
    ) -> None:
        self.symbols, self.label, self.children = symbols, label, children
        self.mass, self.inertia, self.com = mass, inertia, com
        in_line = len(children) == 1 and com[1].is_zero() and children[0].offset[1].is_zero()
        self.scaled = in_line and not general and not children[0].offset[0].is_zero()
        constant = symbols.constant
        self.pivot_inertia = constant(
            f"{label}_pivot_inertia",
            inertia + mass * (com[0] * com[0] + com[1] * com[1]),
            "kg m^2",
            "I + m |c|^2, about the first joint",
        )
        if self.scaled:
            self._eliminate_scaled()
        else:
            self._eliminate()

    def _eliminate_scaled(self) -> None:
        symbols, label, child = self.symbols, self.label, self.children[0].mass
        length = self.children[0].offset[0]
        self.inverse_length = symbols.inverse_constant(
            f"{label}_inverse_length", length, "1/m", "1 / l, l to the next joint"
        )
        square = self.inverse_length * self.inverse_length
        near = symbols.constant(f"{label}_near_mass", self.pivot_inertia * square, "kg", "J = (I + m c^2) / l^2")
        self.first = symbols.constant(
            f"{label}_first_mass", self.mass * self.com[0] * self.inverse_length, "kg", "mu = m c / l"
        )
        coupling = symbols.constant(f"{label}_coupling_mass", near - self.first, "kg", "J - mu")
        # I + m (l - c)^2 is the inertia about the next joint: a sum of positive terms
        far = symbols.constant(
            f"{label}_far_mass",
            (self.inertia + self.mass * ((length - self.com[0]) * (length - self.com[0]))) * square,
            "kg",
            "(I + m (l - c)^2) / l^2",
        )
        self.inverse = symbols.reciprocal(near + child.yy)
        self.row = child.xy * self.inverse
        self.ratio = coupling * self.inverse
        self.child = child
        self.articulated = PlaneMass(
            self.mass + child.xx - child.xy * self.row, child.xy * self.ratio, far - coupling * self.ratio
        )

    def _eliminate(self) -> None:
        first = (
            self.symbols.constant(f"{self.label}_first_moment_x", self.mass * self.com[0], "kg m", "m c_x"),
            self.symbols.constant(f"{self.label}_first_moment_y", self.mass * self.com[1], "kg m", "m c_y"),
        )
        self.first_moment = first
        self.coupling = turn_left(first)
        pivot = self.pivot_inertia
        # what is carried at the joint itself (behind a wheel) leaves the elimination to parameters alone
        self.constant = all(child.offset[0].is_zero() and child.offset[1].is_zero() for child in self.children)
        total = PlaneMass(self.mass, ZERO, self.mass)
        for child in self.children:
            total = total.plus(child.mass)
            lever = turn_left(child.offset)
            reaction = child.mass.times(lever)
            self.coupling = add(self.coupling, reaction)
            pivot = pivot + (lever[0] * reaction[0] + lever[1] * reaction[1])
        r = self.coupling
        if self.constant:
            self._eliminate_constant(r, pivot)
            return
        self.inverse = self.symbols.reciprocal(pivot)
        self.gain = scale(self.inverse, r)
        self.articulated = PlaneMass(
            total.xx - r[0] * self.gain[0], total.xy - r[0] * self.gain[1], total.yy - r[1] * self.gain[1]
        )

    def _eliminate_constant(self, r: Vector, pivot: ca.SX) -> None:
        named, label = self.symbols.constant, self.label
        self.inverse = self.symbols.inverse_constant(f"{label}_inverse_pivot", pivot, "1/(kg m^2)", "1 / (I + m |c|^2)")
        gain = scale(self.inverse, r)
        self.gain = gain = (
            named(f"{label}_gain_x", gain[0], "1/m", "-m c_y / (I + m |c|^2)"),
            named(f"{label}_gain_y", gain[1], "1/m", "m c_x / (I + m |c|^2)"),
        )
        what = "articulated mass at the first joint"
        xx = named(f"{label}_articulated_mass_xx", self.mass - r[0] * gain[0], "kg", what)
        xy = named(f"{label}_articulated_mass_xy", -r[0] * gain[1], "kg", what)
        yy = named(f"{label}_articulated_mass_yy", self.mass - r[1] * gain[1], "kg", what)
        difference = named(f"{label}_articulated_mass_difference", xx - yy, "kg", "xx - yy of it")
        self.articulated = PlaneMass(xx, xy, yy, difference)
        for child in self.children:
            self.articulated = self.articulated.plus(child.mass)

    def force(self, rate_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        """b of the force F = A a + b that the body needs, all in its frame.

        ``moment`` is what acts on the body besides the forces of its children: its own joint's torque
        less its children's, and the external moments about its first joint.
        """
        if self.scaled:
            x, y = child_forces[0]
            self.centripetal = rate_squared * self.children[0].offset[0]
            x = x - self.centripetal * (self.child.xx + self.first)
            y = y - self.centripetal * self.child.xy
            torque = moment * self.inverse_length
            self.turn = torque - y
            self.free = self.turn * self.inverse
            return x + self.child.xy * self.free, torque - self.ratio * self.turn
        self.rate_squared = rate_squared
        total = (
            scale(-rate_squared, self.first_moment)
            if self.children
            else scale(rate_squared, tuple(-m for m in self.first_moment))
        )
        for child, force in zip(self.children, child_forces, strict=True):
            force = subtract(force, scale(rate_squared, child.mass.times(child.offset)))
            moment = moment - cross(child.offset, force)
            total = add(total, force)
        self.free = moment * self.inverse
        if self.constant:
            return add(total, scale(moment, self.gain))
        return add(total, scale(self.free, self.coupling))

    def accelerate(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        """(angular acceleration, accelerations of the children's joint points) from the first joint's."""
        if self.scaled:
            y = self.free - self.row * a[0] + self.ratio * a[1]
            return (y - a[1]) * self.inverse_length, [(a[0] - self.centripetal, y)]
        alpha = self.free - self.gain[0] * a[0] - self.gain[1] * a[1]
        points = []
        for child in self.children:
            relative = subtract(scale(alpha, turn_left(child.offset)), scale(self.rate_squared, child.offset))
            points.append(add(a, relative))
        return alpha, points


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
            self.bodies[k] = Body(symbols, f"{self.label}_link{k + 1}", link.mass, link.inertia, link_com, children)
            angle = inputs.joint_angles[self.first_joint + k]
            if is_last:
                angle = angle + self.turned
            if k == 0:
                angle = angle + self.symbols.mount_angle
            self.rotations[k] = rotation(angle)
            mass = self.bodies[k].articulated.rotate(self.rotations[k])
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
        self.base = Body(
            symbols,
            "base",
            symbols.base_mass,
            symbols.base_inertia,
            com,
            children,
            general=mounts_coincide(symbols.layout),
        )
        self.needs_distinct_mounts = self.base.scaled
        total = self.base.articulated.plus(self.arms[0].child.mass)
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
