"""Computes the velocities after an exact impact from the momenta that the targets lose, body by body.

With the merged robot's mass matrix G of `impact.py`, G (v' - v) = sum K^T I_t (t - K v): what a target loses, seen from
the robot, is an impulse on the last link that holds it. The change of velocity therefore is the acceleration of the
merged robot by a force on each last link, at rest and without torques, which articulated bodies have in one division
per link, where the factors of G grow with the cube of an arm's links. With ``a`` the change of velocity of the joint of
a body and ``alpha`` that of its angular velocity, in inertial axes and with the names of `eliminated_body.py`,

    F = A a + b,   alpha = alpha_0 - (r / D) . a,   b = F_0 + r alpha_0,   alpha_0 = n / D,

where n and -F_0 are moment about the joint and force on the body: those of the lost momentum on a last link, and on the
others, of the child's joint at d, -(z x d) . b' and -b'.
"""

from dataclasses import replace
from functools import reduce

import casadi as ca

from .articulated_body import Child
from .articulated_inertia import ArticulatedInertia
from .composite_inertia import CompositeInertia
from .eliminated_body import EliminatedBody
from .equations_of_motion import EquationsOfMotion
from .free_base import TranslationFirst
from .inputs import Inputs
from .kinematics import ArmVelocities
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, cross, dot, perpendicular, scale, subtract
from .rigid_body_inertia import RigidBodyInertia
from .signatures import Section
from .symbols import Symbols


class MergedLink:
    """A last link with the target that it holds, as one body: ``pivot`` D, ``inverse`` 1 / D, ``response`` r / D and
    ``inertia`` A."""

    def __init__(self, symbols: Symbols, arm: CompositeInertia, inputs: Inputs, index: int) -> None:
        mass, link = inputs.target_masses[index], arm.positions.symbols.links[-1]
        contact = (inputs.contacts[0, index], inputs.contacts[1, index])
        self.to_target = subtract(arm.positions.link[-1], contact)  # from the joint to the target's COM
        about_joint = inputs.target_inertias[index] + mass * dot(self.to_target, self.to_target)
        coupling = perpendicular(add(arm.augmented_first_moment[-1], scale(mass, self.to_target)))
        self.coupling = coupling
        self.pivot = arm.inertia[-1] + about_joint
        self.inverse = symbols.reciprocal(self.pivot)
        self.response = scale(self.inverse, coupling)
        total = ArticulatedInertia(link.mass + mass, ZERO, link.mass + mass)
        self.inertia = total.without(coupling, self.response, self.inverse)


class CapturingArm:
    """The bodies of one arm that captures a target, from the last link to the mount.

    ``inertia`` and ``force`` are A and b at the mount. ``smallest_pivot`` is that of the links: of the last relative to
    what it is without a target, not below 1 unless the target's mass or inertia is negative; of others relative to what
    they would be if what is outboard did not turn with them, which is more: how many digits A' has lost.
    """

    def __init__(
        self, symbols: Symbols, arm: CompositeInertia, velocities: ArmVelocities, inputs: Inputs, index: int
    ) -> None:
        positions, links = arm.positions, arm.positions.symbols.links
        self.positions = positions
        last = MergedLink(symbols, arm, inputs, index)
        rate = velocities.angular[-1]
        spin, *velocity = ca.vertsplit(inputs.target_twists[:, index])
        # the velocity of the target's COM as a part of the last link
        carried = add(velocities.joint[-1], scale(rate, perpendicular(last.to_target)))
        force = scale(inputs.target_masses[index], subtract((velocity[0], velocity[1]), carried))
        moment = inputs.target_inertias[index] * (spin - rate) + cross(last.to_target, force)
        self.alpha_0 = [moment * last.inverse]
        self.bodies: list[MergedLink | EliminatedBody] = [last]
        self.force = subtract(scale(self.alpha_0[0], last.coupling), force)
        owns = [RigidBodyInertia(link.label, link.mass, link.inertia, link.com) for link in links]
        relative_pivots = [last.pivot * owns[-1].inverse_about_joint(symbols)]
        for k in reversed(range(len(links) - 1)):
            child = Child(positions.link[k], self.bodies[0].inertia)
            body = EliminatedBody(symbols, owns[k], positions.rotation[k], child)
            if not child.at_joint:
                outboard = arm.mass[k + 1] + inputs.target_masses[index]
                scale_of_pivot = body.joint_inertia + outboard * (links[k].length * links[k].length)
                relative_pivots.append(body.pivot / scale_of_pivot)
            alpha_0 = -dot(body.lever, self.force) * body.inverse
            self.force = add(self.force, scale(alpha_0, body.coupling))
            self.bodies.insert(0, body)
            self.alpha_0.insert(0, alpha_0)
        # at the base its elements are on the longest path anyway, and fewer operations with them
        self.inertia = replace(self.bodies[0].inertia, remains_of=None)
        self.smallest_pivot = reduce(ca.fmin, relative_pivots)
        title = positions.symbols.title
        self.sections = [
            Section(f"{title}, lost momentum", force, moment),
            Section(
                f"{title}, merged",
                [[body.response, *body.inertia.elements] for body in self.bodies],
                self.force,
                self.smallest_pivot,
            ),
        ]

    def changes(self, a: Vector, base: ca.SX) -> list[ca.SX]:
        """Changes of the joint rates by those of the mount's velocity and of the base's angular velocity."""
        changes, parent = [], base
        for alpha_0, body, link in zip(self.alpha_0, self.bodies, self.positions.link, strict=True):
            alpha = alpha_0 - dot(body.response, a)
            changes.append(alpha - parent)
            parent, a = alpha, add(a, scale(alpha, perpendicular(link)))
        return changes


class RigidCapture:
    """The whole robot: ``velocity`` v' of base and joints, and the ``smallest_pivot`` of G, by which rounding shows
    beside a target that is heavier than all measure."""

    def __init__(self, equations: EquationsOfMotion, inputs: Inputs) -> None:
        symbols, velocities = equations.symbols, equations.kinematics.velocities
        arms = [
            CapturingArm(symbols, arm, velocities[index], inputs, index) for index, arm in enumerate(equations.arms)
        ]
        base = TranslationFirst(symbols, [(arm.positions.mount, arm.inertia) for arm in arms])
        mass, inertia = equations.total_mass, equations.augmented_inertia
        for arm, target_mass in zip(arms, ca.vertsplit(inputs.target_masses), strict=True):
            mass = mass + target_mass
            inertia = inertia + target_mass * dot(arm.positions.symbols.mount, arm.positions.symbols.mount)
        of_arms = [arm.smallest_pivot for arm in arms]
        self.smallest_pivot = reduce(ca.fmin, [*of_arms, *base.relative_pivots(mass, inertia)])
        force, moment = ZERO_VECTOR, ZERO
        for arm in arms:
            force = add(force, arm.force)
            moment = moment - dot(perpendicular(arm.positions.mount), arm.force)
        alpha, a = base.acceleration(force, moment)
        self.sections = [
            *(section for arm in arms for section in arm.sections),
            Section("base, change of twist", self.smallest_pivot, alpha, a),
        ]
        changes = [alpha, *a]
        for arm in arms:
            mount = add(a, scale(alpha, perpendicular(arm.positions.mount)))
            joints = arm.changes(mount, alpha)
            self.sections.append(Section(f"{arm.positions.symbols.title}, changes of joint rates", joints))
            changes += joints
        self.velocity = ca.vertcat(inputs.base_twist, inputs.joint_rates) + ca.vertcat(*changes)
