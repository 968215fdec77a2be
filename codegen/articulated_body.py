"""Computes articulated inertia and bias force of one body from its inertia and those of its child bodies.

A revolute joint transmits no moment but its torque. The parent of a body therefore sees the body, with all that is
outboard of it, as a symmetric 2 x 2 articulated inertia A and a bias force b: the force that the joint transmits to
the body is F = A a + b, with a the acceleration of the joint point (Featherstone's articulated-body algorithm, with
the joint's rotation eliminated). All vectors are in the frame of the body. For a body with its joint at P, its COM at
c from P, angular velocity omega and angular acceleration alpha, and children whose joints are at d from P,

    F = m a_com + sum F',     a_com = a + alpha z x c - omega^2 c,    F' = A' (a + alpha z x d - omega^2 d) + b',
    n = I_P alpha + m c x a + sum d x F',                             I_P = I + m |c|^2,

where n is the moment on the body besides that of its children's forces. Eliminating alpha gives A and b. Each class
of bodies does so for one geometry; `articulated_body` chooses.
"""

from dataclasses import dataclass

import casadi as ca

from .articulated_inertia import ArticulatedInertia
from .plane_vectors import ZERO, Vector, add, cross, dot, perpendicular, scale, subtract
from .rigid_body_inertia import RigidBodyInertia
from .symbols import Symbols

MASS_AND_ADDED = "mass, with a point mass at the own joint"


@dataclass(frozen=True)
class Child:
    """A child body: the position of its joint and its articulated inertia, in the frame of the parent."""

    position: Vector
    inertia: ArticulatedInertia

    @property
    def at_joint(self) -> bool:
        """Whether its joint coincides with that of the parent."""
        return self.position[0].is_zero() and self.position[1].is_zero()


class LengthRatios:
    """J, mu and J - mu of a body with its COM and the joint of its only child on the x axis, in kg."""

    def __init__(self, symbols: Symbols, own: RigidBodyInertia, length: ca.SX) -> None:
        label, constant = own.label, symbols.constant
        self.label, self.length = label, length
        self.inverse_length = symbols.reciprocal_constant(f"{label}_inverse_length", length, "1/m", "1 / l")
        square = self.inverse_length * self.inverse_length
        self.distal = constant(
            f"{label}_distal_mass", own.about_joint(symbols) * square, "kg", "mass at the child's joint, J = I_P / l^2"
        )
        first_moment = own.mass * own.com[0] * self.inverse_length
        self.first_moment = constant(f"{label}_first_moment_ratio", first_moment, "kg", "mu = m c / l")
        self.coupling = constant(f"{label}_coupling_mass", self.distal - self.first_moment, "kg", "J - mu")


class CollinearBody:
    """COM and the joint of the only child on the x axis, the joint at l.

    Across its axis the body has the mass matrix [[J', mu - J], [mu - J, J]] for the accelerations of its two joints,
    with J = I_P / l^2, J' = (I + m (l - c)^2) / l^2, mu = m c / l and determinant m I / l^2. One division, and no
    cancellation however short l is: with l alpha as the unknown, D = J + A'_yy and f = (mu + A'_yy) / D,

        A_xx = m + A'_xx - A'_xy^2 / D,  A_xy = (J - mu) A'_xy / D,  A_yy = (m I / l^2 + J' A'_yy) / D,
        l alpha = (n / l - b'_y - A'_xy a_x) / D - f a_y,  b_y = b'_y + f (n / l - b'_y).

    (A_yy = J' - (J - mu) (1 - f) would save an operation, and another with 1 - f = (J - mu) / D in place of f; but
    their rounding errors grow with 1 / l^2 and 1 / l.) ``added`` is a point mass at the own joint.
    """

    def __init__(self, symbols: Symbols, own: RigidBodyInertia, child: Child, added: ca.SX) -> None:
        label, constant = own.label, symbols.constant
        ratios = self.ratios = LengthRatios(symbols, own, child.position[0])
        square = ratios.inverse_length * ratios.inverse_length
        to_child = ratios.length - own.com[0]
        proximal = constant(
            f"{label}_proximal_mass",
            (own.inertia + own.mass * (to_child * to_child)) * square + added,
            "kg",
            "mass at the own joint, J' = (I + m (l - c)^2) / l^2, and the point mass there",
        )
        determinant = constant(
            f"{label}_mass_determinant",
            own.mass * (own.inertia * square) + added * ratios.distal,
            "kg^2",
            "J J' - (J - mu)^2; m I / l^2 without a point mass",
        )
        mass = constant(f"{label}_mass_and_added", own.mass + added, "kg", MASS_AND_ADDED)
        self.child = child.inertia
        self.inverse = symbols.reciprocal(
            self.child.yy_times_plus(symbols, f"{label}_distal_mass", ca.SX(1), ratios.distal, "J + A'_yy")
        )
        across = self.child.yy_times_plus(
            symbols, f"{label}_first_moment_ratio_across", ca.SX(1), ratios.first_moment, "mu + A'_yy"
        )
        self.own_share = across * self.inverse  # f
        self.xy_ratio = self.child.xy * self.inverse
        xx = self.child.xx_plus(symbols, f"{label}_mass", mass, "m")
        yy = self.child.yy_times_plus(
            symbols, f"{label}_mass_determinant", proximal, determinant, "m I / l^2 + J' A'_yy"
        )
        self.inertia = ArticulatedInertia(
            xx - self.child.xy * self.xy_ratio, ratios.coupling * self.xy_ratio, yy * self.inverse
        )
        self.centripetal_mass = self.child.xx_plus(symbols, f"{label}_first_moment_ratio", ratios.first_moment, "mu")

    @property
    def configuration_values(self) -> list[ca.SX]:
        return [*self.inertia.elements, self.xy_ratio, self.own_share, self.centripetal_mass]

    def bias_force(self, angular_velocity_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        x, y = child_forces[0]
        self.centripetal = angular_velocity_squared * self.ratios.length
        x = x - self.centripetal * self.centripetal_mass
        y = y - self.centripetal * self.child.xy
        residual = moment * self.ratios.inverse_length - y
        self.y_0 = residual * self.inverse  # y acceleration of the child's joint for a = 0
        return x + self.child.xy * self.y_0, y + self.own_share * residual

    def accelerations(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        relative = self.y_0 - self.xy_ratio * a[0] - self.own_share * a[1]  # l alpha
        return relative * self.ratios.inverse_length, [(a[0] - self.centripetal, a[1] + relative)]


class TwoMassBody(CollinearBody):
    """The same body as point masses mu at the child's joint, m - mu at its own, and a moment of inertia (J - mu) l^2.

    The masses are in the inertias of the child and of whatever else is at the own joint, as constants, which leaves

        A_xx = A'_xx - A'_xy^2 / D,  A_xy = (J - mu) A'_xy / D,  A_yy = (J - mu) f,  D = J - mu + A'_yy,  f = A'_yy / D.

    Rounding errors grow with c / l, as mu does.
    """

    def __init__(self, symbols: Symbols, ratios: LengthRatios, child: ArticulatedInertia) -> None:
        self.ratios, self.child = ratios, child
        self.inverse = symbols.reciprocal(
            child.yy_times_plus(symbols, f"{ratios.label}_coupling_mass", ca.SX(1), ratios.coupling, "J - mu + A'_yy")
        )
        self.own_share = child.yy * self.inverse
        self.xy_ratio = child.xy * self.inverse
        self.inertia = ArticulatedInertia(
            child.xx - child.xy * self.xy_ratio, ratios.coupling * self.xy_ratio, ratios.coupling * self.own_share
        )
        self.centripetal_mass = child.xx


class LeafBody:
    """No children, or children whose joints coincide with its own, as those of a reaction wheel.

    Of its own inertia, A = m 1 - r r^T / I_P with r = m z x c, written without a difference: m / I_P times
    [[I + m c_x^2, m c_x c_y], [., I + m c_y^2]].
    """

    def __init__(self, symbols: Symbols, own: RigidBodyInertia, children: list[Child], added: ca.SX) -> None:
        label, constant = own.label, symbols.constant
        self.first_moment = own.first_moment(symbols)
        r = perpendicular(self.first_moment)
        self.inverse = own.inverse_about_joint(symbols)
        self.angular_response = (
            constant(f"{label}_angular_response_x", r[0] * self.inverse, "1/m", "-m c_y / (I + m |c|^2)"),
            constant(f"{label}_angular_response_y", r[1] * self.inverse, "1/m", "m c_x / (I + m |c|^2)"),
        )
        ratio = constant(f"{label}_mass_ratio", own.mass * self.inverse, "1/m^2", "m / (I + m |c|^2)")
        (x, y), (mx, my) = own.com, self.first_moment
        what = "articulated inertia at the joint"
        xx = own.mass if y.is_zero() else ratio * (own.inertia + mx * x)
        xy = constant(f"{label}_articulated_inertia_xy", ratio * (mx * y), "kg", what)
        self.inertia = ArticulatedInertia(
            constant(f"{label}_articulated_inertia_xx", xx + added, "kg", what),
            xy,
            constant(f"{label}_articulated_inertia_yy", ratio * (own.inertia + my * y) + added, "kg", what),
            constant(
                f"{label}_articulated_inertia_difference",
                ratio * (mx * x - my * y),
                "kg",
                "xx - yy of the articulated inertia at the joint",
            ),
            twice_xy=constant(f"{label}_articulated_inertia_twice_xy", xy + xy, "kg", f"2 xy of the {what}"),
        )
        self.children = len(children)
        for child in children:
            self.inertia = self.inertia.plus(child.inertia)

    @property
    def configuration_values(self) -> list[ca.SX]:
        return self.inertia.elements

    def bias_force(self, angular_velocity_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        self.alpha_0 = moment * self.inverse  # for a = 0
        total = scale(-angular_velocity_squared, self.first_moment)
        for force in child_forces:
            total = add(total, force)
        return add(total, scale(moment, self.angular_response))

    def accelerations(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        return angular_acceleration(self.alpha_0, self.angular_response, a), [a] * self.children


class TipBody:
    """The last link, with axes along and across the line from its joint to its COM, and |c| as unit of length.

    What rotates its vectors to the frame of the parent then is [C, -S; S, C] with (C, S) the COM there: neither the
    direction nor the distance of the COM has to be known, and nothing is undefined where it is at the joint. With
    k = m^2 / I_P,

        A = m 1 - k [S^2, -C S; -C S, C^2],  b = -m omega^2 (C, S) + n m / I_P (-S, C),
        alpha = (n - m (C a_y - S a_x)) / I_P.

    ``added`` is a point mass at the joint.
    """

    def __init__(self, symbols: Symbols, own: RigidBodyInertia, added: ca.SX) -> None:
        label, constant = own.label, symbols.constant
        self.mass = own.mass
        self.inverse = own.inverse_about_joint(symbols)
        ratio = constant(f"{label}_mass_ratio", own.mass * self.inverse, "1/m^2", "m / (I + m |c|^2)")
        self.angular_response = (ZERO, ratio)
        what = "articulated inertia at the joint"
        self.inertia = ArticulatedInertia(
            constant(f"{label}_articulated_inertia_xx", own.mass + added, "kg", f"{what}, along c"),
            ZERO,
            constant(f"{label}_articulated_inertia_yy", ratio * own.inertia + added, "kg", f"{what}, across c"),
            constant(
                f"{label}_articulated_inertia_difference",
                own.mass * ratio,
                "kg/m^2",
                "(xx - yy) / |c|^2 of the articulated inertia at the joint, m^2 / (I + m |c|^2)",
            ),
        )

    @property
    def configuration_values(self) -> list[ca.SX]:
        return self.inertia.elements

    def bias_force(self, angular_velocity_squared: ca.SX, moment: ca.SX, _: list[Vector]) -> Vector:
        self.alpha_0 = moment * self.inverse  # for a = 0
        return -angular_velocity_squared * self.mass, moment * self.angular_response[1]

    def accelerations(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        return angular_acceleration(self.alpha_0, self.angular_response, a), []


class GeneralBody:
    """Any number of children anywhere: r = m z x c + sum A' (z x d), D = I_P + sum (z x d) . A' (z x d)."""

    def __init__(self, symbols: Symbols, own: RigidBodyInertia, children: list[Child], added: ca.SX) -> None:
        self.children = children
        self.first_moment = own.first_moment(symbols)
        self.coupling = perpendicular(self.first_moment)  # r
        pivot = own.about_joint(symbols)  # D
        mass = symbols.constant(f"{own.label}_mass_and_added", own.mass + added, "kg", MASS_AND_ADDED)
        total = ArticulatedInertia(mass, ZERO, mass)
        for child in children:
            total = total.plus(child.inertia)
            lever = perpendicular(child.position)
            reaction = child.inertia.times(lever)
            self.coupling = add(self.coupling, reaction)
            pivot = pivot + dot(lever, reaction)
        r = self.coupling
        self.inverse = symbols.reciprocal(pivot)
        response = self.angular_response = scale(self.inverse, r)
        self.inertia = ArticulatedInertia(
            total.xx - r[0] * response[0], total.xy - r[0] * response[1], total.yy - r[1] * response[1]
        )

    @property
    def configuration_values(self) -> list[ca.SX]:
        centripetal = [force for child in self.children for force in child.inertia.times(child.position)]
        return [*self.inertia.elements, *self.angular_response, *self.coupling, *centripetal]

    def bias_force(self, angular_velocity_squared: ca.SX, moment: ca.SX, child_forces: list[Vector]) -> Vector:
        self.angular_velocity_squared = angular_velocity_squared
        total = scale(-angular_velocity_squared, self.first_moment)
        for child, force in zip(self.children, child_forces, strict=True):
            force = subtract(force, scale(angular_velocity_squared, child.inertia.times(child.position)))
            moment = moment - cross(child.position, force)
            total = add(total, force)
        self.alpha_0 = moment * self.inverse  # for a = 0
        return add(total, scale(self.alpha_0, self.coupling))

    def accelerations(self, a: Vector) -> tuple[ca.SX, list[Vector]]:
        alpha = angular_acceleration(self.alpha_0, self.angular_response, a)
        points = []
        for child in self.children:
            tangential = scale(alpha, perpendicular(child.position))
            centripetal = scale(self.angular_velocity_squared, child.position)
            points.append(add(a, subtract(tangential, centripetal)))
        return alpha, points


def angular_acceleration(alpha_0: ca.SX, angular_response: Vector, a: Vector) -> ca.SX:
    """alpha from that for a = 0."""
    return alpha_0 - angular_response[0] * a[0] - angular_response[1] * a[1]


ArticulatedBody = CollinearBody | LeafBody | TipBody | GeneralBody


def articulated_body(
    symbols: Symbols, own: RigidBodyInertia, children: list[Child], added: ca.SX = ZERO
) -> ArticulatedBody:
    """A body with its angular acceleration eliminated, and a point mass ``added`` at its joint.

    ``inertia`` is its articulated inertia A, and ``configuration_values`` are all that the passes use of the
    configuration. ``bias_force(omega^2, n, bias forces of the children)`` gives b; after it, ``accelerations(a)`` gives
    alpha and the accelerations of the children's joints.
    """
    if all(child.at_joint for child in children):
        return LeafBody(symbols, own, children, added)
    if len(children) == 1 and is_collinear(own.com, children[0].position):
        return CollinearBody(symbols, own, children[0], added)
    return GeneralBody(symbols, own, children, added)


def is_collinear(com: Vector, child: Vector) -> bool:
    """Whether COM and the child's joint are on the x axis, the latter not at the own joint."""
    return com[1].is_zero() and child[1].is_zero() and not child[0].is_zero()
