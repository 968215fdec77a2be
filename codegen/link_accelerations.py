"""Computes the accelerations of all links in inertial axes, and the moments by which the rotation of a link acts."""

from dataclasses import dataclass

import casadi as ca

from .eliminated_arm import EliminatedArm
from .inputs import Inputs
from .kinematics import angular_velocities
from .mobility import Base, Mobility
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, dot, perpendicular, scale, subtract
from .signatures import Section


@dataclass(frozen=True)
class Forces:
    """Which forces there are besides the joint torques."""

    base_wrench: bool = False
    end_effector_wrenches: bool = False


class ArmPass:
    """The inward pass of one arm, and its outward pass once the mount's acceleration is known."""

    def __init__(self, arm: EliminatedArm, inputs: Inputs, index: int, forces: Forces) -> None:
        self.arm = arm
        first = arm.symbols.first_joint
        self.squares = [rate * rate for rate in angular_velocities(arm.symbols, inputs)]
        torques = [inputs.joint_torques[first + k] for k in range(arm.links)]
        moments = [here - outboard for here, outboard in zip(torques, [*torques[1:], ZERO], strict=True)]
        self.external = ZERO_VECTOR
        if forces.end_effector_wrenches:
            wrench = inputs.end_effector_wrenches[:, index]
            self.external = (wrench[1], wrench[2])
            moments[-1] = moments[-1] + (wrench[0] + dot(perpendicular(arm.end_effector), self.external))
        self.forces: list[Vector] = [ZERO_VECTOR] * arm.links  # b_k
        self.at_rest = [ZERO] * arm.links  # angular acceleration for a = 0
        force = scale(ca.SX(-1), self.external)
        for k in reversed(range(arm.links)):
            body, square = arm.bodies[k], self.squares[k]
            moment = moments[k] + square * body.centripetal_moment
            if k < arm.links - 1:
                moment = moment - dot(body.lever, force)
            self.at_rest[k] = moment * body.inverse
            force = add(subtract(force, scale(square, body.centripetal)), scale(moment, body.response))
            self.forces[k] = force

    def outward(self, acceleration: Vector) -> None:
        """Sets ``angular`` alpha_k, and ``rotation_moments``: sigma . a + d . F' - omega^2 I_P of each link."""
        self.angular, self.rotation_moments = [], []
        for k, body in enumerate(self.arm.bodies):
            alpha = self.at_rest[k] - dot(body.response, acceleration)
            moment = dot(body.first_moment, acceleration) - self.squares[k] * body.joint_inertia
            if k < self.arm.links - 1:
                tangential, centripetal = scale(alpha, body.lever), scale(self.squares[k], body.to_child)
                next_acceleration = add(acceleration, subtract(tangential, centripetal))
                force = add(body.child.times(next_acceleration), self.forces[k + 1])
                moment = moment + dot(body.to_child, force)
                acceleration = next_acceleration
            else:
                moment = moment - dot(self.arm.end_effector, self.external)
            self.angular.append(alpha)
            self.rotation_moments.append(moment)


class LinkAccelerations:
    """``base`` [alpha, a_x, a_y], ``arms`` with ``angular`` and ``rotation_moments`` per link."""

    def __init__(self, mobility: Mobility, forces: Forces) -> None:
        inputs = mobility.inputs
        self.arms = [ArmPass(arm, inputs, index, forces) for index, arm in enumerate(mobility.arms)]
        base_square = inputs.base_twist[0] * inputs.base_twist[0]
        moment = base_square * mobility.centripetal_moment
        force = scale(base_square, mobility.centripetal)
        for arm, lever in zip(self.arms, mobility.levers, strict=True):
            moment = moment - inputs.joint_torques[arm.arm.symbols.first_joint] - dot(lever, arm.forces[0])
            force = subtract(force, arm.forces[0])
        if forces.base_wrench:
            wrench = inputs.base_wrench
            moment, force = moment + wrench[0], add(force, (wrench[1], wrench[2]))
        self.base: Base = mobility.base_response((moment, *force))
        for index, arm in enumerate(self.arms):
            arm.outward(mobility.mount_acceleration(index, self.base, base_square))

    @property
    def column(self) -> list[ca.SX]:
        """[alpha, a_x, a_y] of the base, then alpha of all links."""
        return [*self.base, *(alpha for arm in self.arms for alpha in arm.angular)]

    @property
    def sections(self) -> list[Section]:
        return [
            *(Section(f"arm {i}, inward pass", arm.forces, arm.at_rest) for i, arm in enumerate(self.arms, start=1)),
            Section("base, acceleration", self.base),
            *(
                Section(f"arm {i}, outward pass", arm.angular, arm.rotation_moments)
                for i, arm in enumerate(self.arms, start=1)
            ),
        ]
