"""Computes the responses of one arm, with its mount at rest, to moments on its links and to their rates.

A source at body k is a moment s_k on it and a force b_k at its joint, in the place of forces of the equation of
`eliminated_body.py`. Inboard bodies c < k answer with the angular acceleration s_c / D_c, and each of these accelerates
what is outboard of it:

    s_c = -(z x d_c) . b_(c+1),    b_c = b_(c+1) + r_c s_c / D_c.

The source of a unit moment is s = 1; b then is v_k, and v_k . a also is minus the angular acceleration of body k when
the joint of body c accelerates by a, for M is symmetric. The source of a unit squared rate omega_k^2 is s = h_k and
b = -p_k, and the joint of the child is accelerated by -d_k.
"""

from dataclasses import dataclass

import casadi as ca

from .articulated_body import Child
from .eliminated_body import EliminatedBody
from .inputs import Inputs
from .plane_vectors import ZERO, Rotation, Vector, add, dot, rotate, rotation, scale
from .rigid_body_inertia import RigidBodyInertia
from .signatures import Section
from .symbols import ArmSymbols, Symbols


@dataclass(frozen=True)
class Source:
    """``force[c]`` b_c at the joint of body c, ``moment[c]`` s_c and ``acceleration[c]`` s_c / D_c, for c <= k."""

    force: list[Vector]
    moment: list[ca.SX]
    acceleration: list[ca.SX]

    @property
    def at_mount(self) -> Vector:
        return self.force[0]


class EliminatedArm:
    """The bodies of one arm at one configuration, from the first link to the last, and its sources."""

    def __init__(self, symbols: Symbols, arm: ArmSymbols, inputs: Inputs, base_rotation: Rotation) -> None:
        self.symbols, self.mount = arm, rotate(base_rotation, arm.mount)
        angle, rotations = inputs.base_pose[0] + arm.mount_angle, []
        for k in range(self.links):
            angle = angle + inputs.joint_angles[arm.first_joint + k]
            rotations.append(rotation(angle))
        self.end_effector = scale(arm.links[-1].length, rotations[-1])  # from the last joint
        self.bodies: list[EliminatedBody] = []
        child = None
        for k in reversed(range(self.links)):
            link = arm.links[k]
            own = RigidBodyInertia(link.label, link.mass, link.inertia, link.com)
            if k < self.links - 1:
                child = Child(scale(link.length, rotations[k]), self.bodies[0].inertia)
            self.bodies.insert(0, EliminatedBody(symbols, own, rotations[k], child))
        self.inertia = self.bodies[0].inertia  # at the mount
        self.moments = [self._moment(k) for k in range(self.links)]
        self.rates = [self._rate(k) for k in range(self.links)]

    @property
    def links(self) -> int:
        return len(self.symbols.links)

    @property
    def sections(self) -> list[Section]:
        title = self.symbols.title
        values = [body.configuration_values for body in self.bodies]
        moments = [[source.force, source.acceleration] for source in self.moments]
        rates = [[source.force, source.acceleration] for source in self.rates]
        return [
            Section(f"{title}, articulated inertia", values),
            Section(f"{title}, moments on its links", moments),
            Section(f"{title}, rates of its links", rates),
        ]

    def _moment(self, k: int) -> Source:
        body = self.bodies[k]
        return self._inward(k, body.response, ca.SX(1), body.inverse)

    def _rate(self, k: int) -> Source:
        body = self.bodies[k]
        acceleration = body.centripetal_moment * body.inverse
        force = add(scale(acceleration, body.coupling), scale(ca.SX(-1), body.centripetal))
        return self._inward(k, force, body.centripetal_moment, acceleration)

    def _inward(self, k: int, force: Vector, moment: ca.SX, acceleration: ca.SX) -> Source:
        source = Source([force], [moment], [acceleration])
        for body in reversed(self.bodies[:k]):
            moment = -dot(body.lever, force)
            acceleration = moment * body.inverse
            force = add(force, scale(moment, body.response))
            source.force.insert(0, force)
            source.moment.insert(0, moment)
            source.acceleration.insert(0, acceleration)
        return source

    def of_moment(self, j: int, k: int) -> ca.SX:
        """Angular acceleration of link j by a unit moment on link k, the mount at rest."""
        return self._of_source(j, self.moments[k])

    def of_rate(self, j: int, k: int) -> ca.SX:
        """Angular acceleration of link j by a unit squared rate of link k, the mount at rest."""
        acceleration = self._of_source(j, self.rates[k])
        if j > k:
            acceleration = acceleration + dot(self.moments[j].force[k + 1], self.bodies[k].to_child)
        return acceleration

    def _of_source(self, j: int, source: Source) -> ca.SX:
        total = ZERO
        for moment, acceleration in zip(self.moments[j].moment, source.acceleration, strict=False):  # of common bodies
            total = total + moment * acceleration
        return total
