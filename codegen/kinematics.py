"""Computes poses, twists and Jacobians of bodies and end effectors from the base's pose and twist and the joints'.

Absolute link angles are used throughout: one sin/cos pair per body.
"""

from functools import cached_property

import casadi as ca

from .inputs import CONFIGURATION, STATE, Inputs
from .plane_vectors import ZERO_VECTOR, Rotation, Vector, add, perpendicular, rotate, rotation, scale
from .signatures import Family, Function, Section, list_of_vectors, matrix
from .symbols import ArmSymbols, Symbols


class ArmPositions:
    """Positions of one arm at one configuration, in inertial axes and relative to the base COM.

    ``angle[k]`` is the absolute angle of link k and ``rotation[k]`` its rotation. ``joint[k]`` is the position of joint
    k, ``link[k]`` the vector from it to joint k + 1 (from the last joint to the end effector), and
    ``to_end_effector[k]`` the vector from it to the end effector.
    """

    def __init__(self, symbols: ArmSymbols, inputs: Inputs, base_rotation: Rotation) -> None:
        self.symbols = symbols
        self.mount = rotate(base_rotation, symbols.mount)
        angle = inputs.base_pose[0] + self.symbols.mount_angle
        self.angle = []
        for k in range(self.links):
            angle = angle + inputs.joint_angles[symbols.first_joint + k]
            self.angle.append(angle)
        self.rotation = [rotation(angle) for angle in self.angle]
        self.link = [scale(link.length, axis) for link, axis in zip(symbols.links, self.rotation, strict=True)]
        self.joint, position = [], self.mount
        for link in self.link:
            self.joint.append(position)
            position = add(position, link)
        self.end_effector = position
        self.to_end_effector: list[Vector] = [ZERO_VECTOR] * self.links
        vector = ZERO_VECTOR
        for k in reversed(range(self.links)):
            vector = self.to_end_effector[k] = add(self.link[k], vector)

    @property
    def links(self) -> int:
        return len(self.symbols.links)

    @property
    def section(self) -> Section:
        values = [self.mount, self.rotation, self.link, self.joint, self.end_effector, self.to_end_effector]
        return Section(f"{self.symbols.title}, positions", values)

    def com_offset(self, k: int) -> Vector:
        """From joint k to the COM of link k."""
        return rotate(self.rotation[k], self.symbols.links[k].com)


class ArmVelocities:
    """Angular velocity of each link of one arm, and the velocities of its joints and end effector."""

    def __init__(self, positions: ArmPositions, inputs: Inputs) -> None:
        self.positions = positions
        twist = inputs.base_twist
        self.angular = angular_velocities(positions.symbols, inputs)
        velocity = add((twist[1], twist[2]), scale(twist[0], perpendicular(positions.mount)))
        self.joint = []
        for angular, link in zip(self.angular, positions.link, strict=True):
            self.joint.append(velocity)
            velocity = add(velocity, scale(angular, perpendicular(link)))
        self.end_effector = velocity

    @property
    def section(self) -> Section:
        values = [self.angular, self.joint, self.end_effector]
        return Section(f"{self.positions.symbols.title}, velocities", values)

    def com(self, k: int) -> Vector:
        """Velocity of the COM of link k."""
        return add(self.joint[k], scale(self.angular[k], perpendicular(self.positions.com_offset(k))))


def angular_velocities(arm: ArmSymbols, inputs: Inputs) -> list[ca.SX]:
    """Absolute angular velocity of each link of an arm."""
    velocities, velocity = [], inputs.base_twist[0]
    for k in range(len(arm.links)):
        velocity = velocity + inputs.joint_rates[arm.first_joint + k]
        velocities.append(velocity)
    return velocities


class Kinematics:
    """The whole robot in one state."""

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.symbols = symbols
        self.inputs = inputs
        self.base_rotation = rotation(inputs.base_pose[0])
        self.arms = [ArmPositions(arm, inputs, self.base_rotation) for arm in symbols.arms]

    @cached_property
    def velocities(self) -> list[ArmVelocities]:
        return [ArmVelocities(arm, self.inputs) for arm in self.arms]

    @property
    def position_sections(self) -> list[Section]:
        return [Section("base, rotation", self.base_rotation), *(arm.section for arm in self.arms)]

    @property
    def sections(self) -> list[Section]:
        return [*self.position_sections, *(arm.section for arm in self.velocities)]

    @property
    def base_position(self) -> Vector:
        return self.inputs.base_pose[1], self.inputs.base_pose[2]

    def end_effector_poses(self) -> ca.SX:
        """A column [yaw, x, y] per arm; the yaw is not wrapped."""
        columns = []
        for arm in self.arms:
            columns.append(ca.vertcat(arm.angle[-1], *add(self.base_position, arm.end_effector)))
        return ca.horzcat(*columns)

    def end_effector_jacobian(self) -> ca.SX:
        """[J_be J_me] of eq. (1), 3 rows per arm: [1, 0, 0], then z x (end effector - joint) for every joint."""
        jacobian = ca.SX(3 * len(self.arms), 3 + self.symbols.joints)
        for i, arm in enumerate(self.arms):
            row = 3 * i
            jacobian[row, 0] = 1
            jacobian[row + 1, 1] = 1
            jacobian[row + 2, 2] = 1
            jacobian[row + 1, 0], jacobian[row + 2, 0] = perpendicular(arm.end_effector)
            for k in range(arm.links):
                column = 3 + arm.symbols.first_joint + k
                jacobian[row, column] = 1
                jacobian[row + 1, column], jacobian[row + 2, column] = perpendicular(arm.to_end_effector[k])
        return jacobian

    def end_effector_twists(self) -> ca.SX:
        """A column [omega, vx, vy] = J_be t_b + J_me joint_rates per arm, by a recursion along the arm."""
        return ca.horzcat(*[ca.vertcat(arm.angular[-1], *arm.end_effector) for arm in self.velocities])

    def body_poses(self) -> ca.SX:
        """A column [yaw, x, y] per body, at its COM: the base, then the links arm by arm."""
        columns = [self.inputs.base_pose]
        for arm in self.arms:
            for k in range(arm.links):
                com = add(add(self.base_position, arm.joint[k]), arm.com_offset(k))
                columns.append(ca.vertcat(arm.angle[k], *com))
        return ca.horzcat(*columns)

    def body_twists(self) -> ca.SX:
        """A column [omega, vx, vy] per body, of its COM: the base, then the links arm by arm."""
        columns = [self.inputs.base_twist]
        for arm in self.velocities:
            for k, angular in enumerate(arm.angular):
                columns.append(ca.vertcat(angular, *arm.com(k)))
        return ca.horzcat(*columns)


def end_effectors_family(kinematics: Kinematics) -> Family:
    source = "Raina & Shah (2017), eq. (1)"
    poses, poses_text = kinematics.end_effector_poses(), "[yaw, x, y] per arm, inertial frame"
    jacobian = kinematics.end_effector_jacobian()
    jacobian_text = "3 rows [omega, vx, vy] per arm, columns base then joints"
    twists, twists_text = kinematics.end_effector_twists(), "[omega, vx, vy] per arm, inertial axes"
    functions = [
        Function(
            "end_effector_poses",
            "Pose of each end effector; the yaw is not wrapped.",
            "p_e = p_b + R(yaw) mount + sum of R(phi_k) [l_k, 0]",
            source,
            [*CONFIGURATION],
            [list_of_vectors("end_effector_poses", "rad, m, m", poses_text, poses)],
        ),
        Function(
            "end_effector_jacobian",
            "Jacobian of the end effectors in the full coordinates.",
            "t_e = [J_be J_me] [t_b; joint rates]",
            source,
            [*CONFIGURATION],
            [matrix("end_effector_jacobian", "1, m", jacobian_text, jacobian)],
        ),
        Function(
            "end_effector_twists",
            "Twist of each end effector.",
            "t_e = J_be t_b + J_me joint rates",
            source,
            [*STATE],
            [list_of_vectors("end_effector_twists", "rad/s, m/s, m/s", twists_text, twists)],
        ),
    ]
    description = "Poses, Jacobian and twists of the end effectors."
    return Family("end_effectors", description, functions, kinematics.sections)


def bodies_family(kinematics: Kinematics) -> Family:
    source = "rigid-body kinematics"
    poses, poses_text = kinematics.body_poses(), "[yaw, x, y] per body, inertial frame"
    twists, twists_text = kinematics.body_twists(), "[omega, vx, vy] per body, inertial axes"
    functions = [
        Function(
            "body_poses",
            "Pose of every body, at its COM.",
            "[phi_k, p_k + R(phi_k) c_k]",
            source,
            [*CONFIGURATION],
            [list_of_vectors("body_poses", "rad, m, m", poses_text, poses)],
        ),
        Function(
            "body_twists",
            "Twist of every body's COM.",
            "v_c = v_b + sum of omega x arm",
            source,
            [*STATE],
            [list_of_vectors("body_twists", "rad/s, m/s, m/s", twists_text, twists)],
        ),
    ]
    description = "Motion of every body's COM: the base, then the links arm by arm."
    return Family("bodies", description, functions, kinematics.sections)
