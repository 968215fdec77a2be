"""Computes the mass matrix and bias of the full coordinates, eq. (1), from the arms' composite inertias."""

import casadi as ca

from .composite_inertia import Composite
from .kinematics import Geometry
from .plane_vectors import Vector, add, dot, rotate, turn_left
from .symbols import Symbols


class EquationsOfMotion:
    """M and [c_b; c_m] of the full coordinates."""

    def __init__(self, symbols: Symbols, geometry: Geometry) -> None:
        self.symbols, self.geometry = symbols, geometry
        self.arms = [Composite(symbols, arm, i) for i, arm in enumerate(geometry.arms)]
        self.total_mass = symbols.base_mass
        for arm in self.arms:
            self.total_mass = self.total_mass + arm.mass
        self.total_mass = symbols.constant("total_mass", self.total_mass, "kg", "mass of the robot")
        base_inertia = symbols.base_inertia
        self.first_moment = (ca.SX(0), ca.SX(0))  # of the robot about the base COM
        inertia = ca.SX(0)
        for i, arm in enumerate(self.arms, start=1):
            mount = arm.arm.mount
            own = arm.arm.symbols
            base_inertia = base_inertia + arm.mass * (own.mount_x * own.mount_x + own.mount_y * own.mount_y)
            sigma = tuple(
                symbols.constant(
                    f"arm{i}_mount_moment_{axis}",
                    arm.mass * value,
                    "kg m",
                    f"(mass of arm {i}) mount, base frame, {axis}",
                )
                for axis, value in zip("xy", (own.mount_x, own.mount_y), strict=True)
            )
            mounted = add(arm.moment[0], rotate(geometry.base_rotation, sigma))
            self.first_moment = add(self.first_moment, mounted)
            lever = dot(mount, arm.moment[0])
            inertia = inertia + (arm.inertia[0] + (lever + lever))
        named = symbols.constant(
            "base_augmented_inertia",
            base_inertia,
            "kg m^2",
            "inertia of the base with the arms' masses at their mounts",
        )
        self.inertia = named + inertia  # M[0][0], about the base COM

    def mass_matrix(self) -> ca.SX:
        size = 3 + self.symbols.joints
        m = ca.SX(size, size)
        m[0, 0] = self.inertia
        m[1, 1] = m[2, 2] = self.total_mass
        m[1, 0], m[2, 0] = turn_left(self.first_moment)
        for arm in self.arms:
            first = 3 + arm.arm.first_joint
            for k in range(arm.arm.links):
                m[first + k, 0] = arm.base_entry[k]
                m[first + k, 1], m[first + k, 2] = turn_left(arm.moment[k])
                for j in range(k + 1):
                    m[first + k, first + j] = arm.entry[j][k]
        return ca.tril2symm(m)

    def bias(self) -> ca.SX:
        """[c_b; c_m]: what holds all accelerations at zero."""
        joints, force, moment = self._centripetal()
        return ca.vertcat(moment, *force, *joints)

    def _centripetal(self) -> tuple[list[ca.SX], Vector, ca.SX]:
        inputs = self.geometry.inputs
        base_rate = inputs.base_twist[0]
        joints: list[ca.SX] = []
        force, moment = (ca.SX(0), ca.SX(0)), ca.SX(0)
        for arm in self.arms:
            rates, rate = [], base_rate
            for k in range(arm.arm.links):
                rate = rate + inputs.joint_rates[arm.arm.first_joint + k]
                rates.append(rate)
            bias, pull, turn = arm.centripetal(rates, base_rate * base_rate)
            joints += bias
            force = add(force, pull)
            moment = moment + turn
        return joints, force, moment
