"""Elimination of one body's angular acceleration, so that the body before it sees a mass and a force.

A revolute joint passes no moment but its torque. What lies beyond a joint therefore acts on the body
before it as a symmetric 2 x 2 articulated mass A and a force b: the force that it needs is F = A a + b,
with a the acceleration of the joint point. All of it is written in the body's frame. For a body with
first joint P, COM at c, angular acceleration alpha and rate omega, and children at d,

    F = m a_com + sum F',     a_com = a + alpha z x c - omega^2 c,    F' = A' (a + alpha z x d - omega^2 d) + b'
    n = I_P alpha + m c x a + sum d x F',                             I_P = I + m |c|^2,

n being the moment that acts on the body besides its children's forces. Eliminating alpha leaves A and b.
Each class below is one way to do it; `body` chooses.
"""

from dataclasses import dataclass

import casadi as ca

from .plane_vectors import Vector, add, cross, scale, subtract, turn_left
from .symbols import Symbols

ZERO = ca.SX(0)


@dataclass(frozen=True)
class PlaneMass:
    """A symmetric 2 x 2 articulated mass.

    ``difference`` is xx - yy where that is known beforehand. A rotated constant is its constant plus a swing,
    xx = fixed[0] - swing and yy = fixed[1] + swing: what is added to it can be added to the constant.
    """

    xx: ca.SX
    xy: ca.SX
    yy: ca.SX
    difference: ca.SX | None = None
    fixed: tuple[ca.SX, ca.SX] | None = None
    swing: ca.SX | None = None

    def rotate(self, rotation: Vector) -> "PlaneMass":
        """R A R^T in 10 operations, 5 where xy is zero; the trace stays."""
        c, s = rotation
        difference = self.xx - self.yy if self.difference is None else self.difference
        v = c * (self.xy + self.xy) + s * difference
        swing = s * v
        fixed = None if self.difference is None else (self.xx, self.yy)
        return PlaneMass(self.xx - swing, c * v - self.xy, self.yy + swing, None, fixed, swing)

    def times(self, a: Vector) -> Vector:
        return self.xx * a[0] + self.xy * a[1], self.xy * a[0] + self.yy * a[1]

    def plus(self, other: "PlaneMass") -> "PlaneMass":
        return PlaneMass(self.xx + other.xx, self.xy + other.xy, self.yy + other.yy)

    def xx_plus(self, symbols: Symbols, name: str, term: ca.SX, text: str) -> ca.SX:
        """xx + term, for a term that is a constant."""
        if self.fixed is None:
            return self.xx + term
        return (
            symbols.constant(f"{name}_with_child", self.fixed[0] + term, "kg", f"{text} + (child's A_xx without swing)")
            - self.swing
        )

    def yy_times_plus(self, symbols: Symbols, name: str, factor: ca.SX, term: ca.SX, text: str) -> ca.SX:
        """factor yy + term, for a factor and a term that are constants."""
        if self.fixed is None:
            return factor * self.yy + term
        constant = symbols.constant(
            f"{name}_with_child", factor * self.fixed[1] + term, "kg", f"{text}, A'_yy without swing"
        )
        return factor * self.swing + constant


@dataclass(frozen=True)
class Child:
    """What a body carries: an articulated mass at an offset, both in the body's frame."""

    offset: Vector
    mass: PlaneMass

    @property
    def at_joint(self) -> bool:
        """Whether it is carried where the body itself is held."""
        return self.offset[0].is_zero() and self.offset[1].is_zero()


@dataclass(frozen=True)
class Inertia:
    """Mass, inertia about the COM, and the COM from the first joint, of a body called `label`."""

    label: str
    mass: ca.SX
    inertia: ca.SX
    com: Vector

    def about_joint(self, symbols: Symbols) -> ca.SX:
        return symbols.constant(
            f"{self.label}_pivot_inertia",
            self.inertia + self.mass * (self.com[0] * self.com[0] + self.com[1] * self.com[1]),
            "kg m^2",
            "I + m |c|^2, about the first joint",
        )

    def first_moment(self, symbols: Symbols) -> Vector:
        return (
            symbols.constant(f"{self.label}_first_moment_x", self.mass * self.com[0], "kg m", "m c_x"),
            symbols.constant(f"{self.label}_first_moment_y", self.mass * self.com[1], "kg m", "m c_y"),
        )


class InLine:
    """COM and the one child on the x axis, the child at l: one division, and nothing cancels however short l is.

    With l alpha as the unknown, J = I_P / l^2, mu = m c / l and D = J + A'_yy,

        A_xx = m + A'_xx - A'_xy^2 / D,  A_xy = A'_xy e,  A_yy = (m I / l^2 + J' A'_yy) / D,  e = (J - mu) / D,

    where J' = (I + m (l - c)^2) / l^2 belongs to the inertia about the child's joint. (A_yy = J' - (J - mu) e
    would save an operation, and loses digits as the square of a short l.)
    """

    def __init__(self, symbols: Symbols, own: Inertia, child: Child) -> None:
        label, com, constant = own.label, own.com[0], symbols.constant
        self.length, self.child = child.offset[0], child.mass
        self.inverse_length = symbols.inverse_constant(f"{label}_inverse_length", self.length, "1/m", "1 / l")
        square = self.inverse_length * self.inverse_length
        near = constant(f"{label}_near_mass", own.about_joint(symbols) * square, "kg", "J = (I + m c^2) / l^2")
        first = constant(f"{label}_first_mass", own.mass * com * self.inverse_length, "kg", "mu = m c / l")
        coupling = constant(f"{label}_coupling_mass", near - first, "kg", "J - mu")
        beyond = self.length - com
        far = constant(
            f"{label}_far_mass",
            (own.inertia + own.mass * (beyond * beyond)) * square,
            "kg",
            "J' = (I + m (l - c)^2) / l^2",
        )
        turning = constant(f"{label}_turning_mass", own.mass * (own.inertia * square), "kg^2", "m I / l^2")
        self.inverse = symbols.reciprocal(
            child.mass.yy_times_plus(symbols, f"{label}_near_mass", ca.SX(1), near, "J + A'_yy")
        )
        self.row = self.child.xy * self.inverse
        self.ratio = coupling * self.inverse
        xx = self.child.xx_plus(symbols, f"{label}_mass", own.mass, "m")
        yy = self.child.yy_times_plus(symbols, f"{label}_turning_mass", far, turning, "m I / l^2 + J' A'_yy")
        self.mass = PlaneMass(xx - self.child.xy * self.row, self.child.xy * self.ratio, yy * self.inverse)
        self.pull = self.child.xx_plus(symbols, f"{label}_first_mass", first, "mu")

    def force(self, rate_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        x, y = child_forces[0]
        self.centripetal = rate_squared * self.length
        x = x - self.centripetal * self.pull
        y = y - self.centripetal * self.child.xy
        torque = moment * self.inverse_length
        turn = torque - y
        self.free = turn * self.inverse
        return x + self.child.xy * self.free, torque - self.ratio * turn

    def accelerate(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        y = self.free - self.row * a[0] + self.ratio * a[1]
        return (y - a[1]) * self.inverse_length, [(a[0] - self.centripetal, y)]


class Tip:
    """No children but at the joint itself (behind a wheel): everything depends on the parameters alone.

    A = m 1 - r r^T / I_P with r = m z x c, written without a difference: m / I_P times
    [[I + m c_x^2, m c_x c_y], [., I + m c_y^2]].
    """

    def __init__(self, symbols: Symbols, own: Inertia, children: list[Child]) -> None:
        label, named = own.label, symbols.constant
        self.first_moment = own.first_moment(symbols)
        r = turn_left(self.first_moment)
        pivot = own.about_joint(symbols)
        self.inverse = symbols.inverse_constant(f"{label}_inverse_pivot", pivot, "1/(kg m^2)", "1 / (I + m |c|^2)")
        self.gain = (
            named(f"{label}_gain_x", r[0] * self.inverse, "1/m", "-m c_y / (I + m |c|^2)"),
            named(f"{label}_gain_y", r[1] * self.inverse, "1/m", "m c_x / (I + m |c|^2)"),
        )
        share = named(f"{label}_mass_share", own.mass * self.inverse, "1/m^2", "m / (I + m |c|^2)")
        (x, y), (mx, my) = own.com, self.first_moment
        what = "articulated mass at the first joint"
        xx = own.mass if y.is_zero() else share * (own.inertia + mx * x)
        self.mass = PlaneMass(
            named(f"{label}_articulated_mass_xx", xx, "kg", what),
            named(f"{label}_articulated_mass_xy", share * (mx * y), "kg", what),
            named(f"{label}_articulated_mass_yy", share * (own.inertia + my * y), "kg", what),
            named(f"{label}_articulated_mass_difference", share * (mx * x - my * y), "kg", "xx - yy of it"),
        )
        self.places = [child.offset for child in children]
        for child in children:
            self.mass = self.mass.plus(child.mass)

    def force(self, rate_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        self.free = moment * self.inverse
        total = tuple(-m * rate_squared for m in self.first_moment)
        for force in child_forces:
            total = add(total, force)
        return add(total, scale(moment, self.gain))

    def accelerate(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        alpha = self.free - self.gain[0] * a[0] - self.gain[1] * a[1]
        return alpha, [a for _ in self.places]


class General:
    """Any number of children anywhere: r = m z x c + sum A' (z x d), D = I_P + sum (z x d) . A' (z x d)."""

    def __init__(self, symbols: Symbols, own: Inertia, children: list[Child]) -> None:
        self.children = children
        self.first_moment = own.first_moment(symbols)
        self.coupling = turn_left(self.first_moment)
        pivot = own.about_joint(symbols)
        total = PlaneMass(own.mass, ZERO, own.mass)
        for child in children:
            total = total.plus(child.mass)
            lever = turn_left(child.offset)
            reaction = child.mass.times(lever)
            self.coupling = add(self.coupling, reaction)
            pivot = pivot + (lever[0] * reaction[0] + lever[1] * reaction[1])
        r = self.coupling
        self.inverse = symbols.reciprocal(pivot)
        self.gain = scale(self.inverse, r)
        self.mass = PlaneMass(
            total.xx - r[0] * self.gain[0], total.xy - r[0] * self.gain[1], total.yy - r[1] * self.gain[1]
        )

    def force(self, rate_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        self.rate_squared = rate_squared
        total = scale(-rate_squared, self.first_moment)
        for child, force in zip(self.children, child_forces, strict=True):
            force = subtract(force, scale(rate_squared, child.mass.times(child.offset)))
            moment = moment - cross(child.offset, force)
            total = add(total, force)
        self.free = moment * self.inverse
        return add(total, scale(self.free, self.coupling))

    def accelerate(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        alpha = self.free - self.gain[0] * a[0] - self.gain[1] * a[1]
        points = []
        for child in self.children:
            relative = subtract(scale(alpha, turn_left(child.offset)), scale(self.rate_squared, child.offset))
            points.append(add(a, relative))
        return alpha, points


Body = InLine | Tip | General


def body(symbols: Symbols, own: Inertia, children: list[Child], general: bool = False) -> Body:
    """A body with its angular acceleration eliminated.

    ``mass`` is its articulated mass A; ``force(rate squared, moment, children's forces)`` gives b, and then
    ``accelerate(a)`` the angular acceleration and the accelerations of the children's joint points.
    ``general`` forbids the form that divides by the child's distance.
    """
    if all(child.at_joint for child in children):
        return Tip(symbols, own, children)
    in_line = len(children) == 1 and own.com[1].is_zero() and children[0].offset[1].is_zero()
    if in_line and not general:
        return InLine(symbols, own, children[0])
    return General(symbols, own, children)
