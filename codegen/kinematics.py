"""Positions, Jacobians, body motions and momentum, in absolute link angles: one sin/cos pair per body."""

from functools import cached_property

import casadi as ca

from .inputs import Inputs
from .plane_vectors import Vector, add, rotate, rotation, scale, turn_left
from .symbols import Symbols


class ArmGeometry:
    """One arm at one configuration, in inertial axes, positions relative to the base COM.

    ``axis[k]`` is the unit vector along link k, ``vector[k]`` runs from joint k to joint k + 1 (the last
    one to the tip), ``position[k]`` is joint k; ``position[-1]`` is the tip.
    """

    def __init__(self, symbols: Symbols, inputs: Inputs, arm: int, base_rotation: Vector) -> None:
        self.symbols = symbols.arms[arm]
        self.first_joint = sum(len(a.links) for a in symbols.arms[:arm])
        self.mount = rotate(base_rotation, (self.symbols.mount_x, self.symbols.mount_y))
        angle = inputs.base_pose[0] + self.symbols.mount_angle
        self.angle = []
        for k in range(len(self.symbols.links)):
            angle = angle + inputs.joint_angles[self.first_joint + k]
            self.angle.append(angle)
        self.axis = [rotation(angle) for angle in self.angle]
        self.vector = [scale(link.length, axis) for link, axis in zip(self.symbols.links, self.axis, strict=True)]
        self.position = [self.mount]
        for vector in self.vector:
            self.position.append(add(self.position[-1], vector))

    @property
    def links(self) -> int:
        return len(self.symbols.links)

    @property
    def tip(self) -> Vector:
        return self.position[-1]

    def com_offset(self, k: int) -> Vector:
        """From joint k to the COM of link k."""
        link = self.symbols.links[k]
        return rotate(self.axis[k], (link.com_x, link.com_y))


class Geometry:
    """The whole robot at one configuration."""

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.symbols = symbols
        self.inputs = inputs
        self.base_rotation = rotation(inputs.base_pose[0])
        self.arms = [ArmGeometry(symbols, inputs, i, self.base_rotation) for i in range(len(symbols.arms))]

    @cached_property
    def base_position(self) -> Vector:
        return self.inputs.base_pose[1], self.inputs.base_pose[2]

    def end_effector_poses(self) -> ca.SX:
        """Per arm [yaw, x, y]; the yaw is not wrapped."""
        columns = []
        for arm in self.arms:
            tip = add(self.base_position, arm.tip)
            columns.append(ca.vertcat(arm.angle[-1], *tip))
        return ca.horzcat(*columns)

    def end_effector_jacobian(self) -> ca.SX:
        """[J_be J_me], 3 rows per arm: [1, 0, 0], then z x (tip - pivot) for every axis of rotation."""
        size = 3 + self.symbols.joints
        jacobian = ca.SX(3 * len(self.arms), size)
        for i, arm in enumerate(self.arms):
            row = 3 * i
            jacobian[row, 0] = 1
            jacobian[row + 1, 1] = 1
            jacobian[row + 2, 2] = 1
            jacobian[row + 1, 0], jacobian[row + 2, 0] = turn_left(arm.tip)
            reach = (ca.SX(0), ca.SX(0))
            for k in reversed(range(arm.links)):
                reach = add(arm.vector[k], reach)
                column = 3 + arm.first_joint + k
                jacobian[row, column] = 1
                jacobian[row + 1, column], jacobian[row + 2, column] = turn_left(reach)
        return jacobian

    def end_effector_twists(self) -> ca.SX:
        """Per arm [omega, vx, vy] of the tip: J_be t_b + J_me joint rates, by a sweep along the arm."""
        columns = []
        for motion in self.arm_motions():
            columns.append(ca.vertcat(motion.rate[-1], *motion.velocity[-1]))
        return ca.horzcat(*columns)

    def arm_motions(self) -> list["ArmMotion"]:
        return [ArmMotion(arm, self.inputs) for arm in self.arms]

    def body_poses(self) -> ca.SX:
        """[yaw, x, y] of every body's COM: the base, then the links arm by arm."""
        columns = [self.inputs.base_pose]
        for arm in self.arms:
            for k in range(arm.links):
                com = add(add(self.base_position, arm.position[k]), arm.com_offset(k))
                columns.append(ca.vertcat(arm.angle[k], *com))
        return ca.horzcat(*columns)

    def body_twists(self) -> ca.SX:
        """[omega, vx, vy] of every body's COM: the base, then the links arm by arm."""
        columns = [self.inputs.base_twist]
        for motion in self.arm_motions():
            for k in range(motion.arm.links):
                columns.append(ca.vertcat(motion.rate[k], *motion.com_velocity(k)))
        return ca.horzcat(*columns)


class ArmMotion:
    """Absolute rates and joint velocities of one arm: ``velocity[k]`` is joint k, ``velocity[-1]`` the tip."""

    def __init__(self, arm: ArmGeometry, inputs: Inputs) -> None:
        self.arm = arm
        twist = inputs.base_twist
        velocity = add((twist[1], twist[2]), scale(twist[0], turn_left(arm.mount)))
        self.velocity = [velocity]
        self.rate = []
        rate = twist[0]
        for k in range(arm.links):
            rate = rate + inputs.joint_rates[arm.first_joint + k]
            velocity = add(velocity, scale(rate, turn_left(arm.vector[k])))
            self.rate.append(rate)
            self.velocity.append(velocity)

    def com_velocity(self, k: int) -> Vector:
        return add(self.velocity[k], scale(self.rate[k], turn_left(self.arm.com_offset(k))))
