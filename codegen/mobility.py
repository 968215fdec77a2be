"""Computes the inverse of the mass matrix and the response to squared rates, for absolute angles of the links.

The robot's accelerations [alpha_0, a_x, a_y] of the base and alpha_k of the links answer linearly to moments n_k on the
links and to omega_k^2. At the base the arms are articulated inertias A at their mounts at m, which leaves a symmetric
3 x 3 system with the inverse H. What an arm does with its mount at rest, `eliminated_arm.py` has; the force on its
mount moves the base, and the base moves all mounts.
"""

import casadi as ca

from .articulated_inertia import ArticulatedInertia
from .eliminated_arm import EliminatedArm
from .free_base import RotationFirst
from .inputs import Inputs
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, dot, perpendicular, rotation, scale, subtract
from .signatures import Section
from .symbols import Symbols

Base = tuple[ca.SX, ca.SX, ca.SX]  # [alpha, a_x, a_y] of the base COM, or [n, f_x, f_y] there


class Mobility:
    """The whole robot at one configuration.

    For link k over all arms, ``moments[k]`` and ``rates[k]`` are the columns of accelerations, first the base's three,
    then those of all links, by a unit moment on it and by its unit squared rate; ``base_rate`` is that column of the
    base. ``inverse`` is H.
    """

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.symbols, self.inputs = symbols, inputs
        base_rotation = rotation(inputs.base_pose[0])
        self.arms = [EliminatedArm(symbols, arm, inputs, base_rotation) for arm in symbols.arms]
        self.levers = [perpendicular(arm.mount) for arm in self.arms]
        self.base = RotationFirst(symbols, [(arm.mount, arm.inertia) for arm in self.arms])
        self.inverse = self._inverse()
        self.centripetal, self.centripetal_moment = ZERO_VECTOR, ZERO
        for arm, lever in zip(self.arms, self.levers, strict=True):
            along = arm.inertia.times(arm.mount)
            self.centripetal = add(self.centripetal, along)
            self.centripetal_moment = self.centripetal_moment + dot(lever, along)
        self.mount_responses = [self._mount_response(lever) for lever in self.levers]
        self._set_moments()
        self._set_rates()

    def _inverse(self) -> list[list[ca.SX]]:
        """H."""
        base, factor = self.base, self.base.determinant_inverse
        linear = ArticulatedInertia(base.inertia.yy * factor, -(base.inertia.xy * factor), base.inertia.xx * factor)
        both = linear.times(base.response)
        angular = base.pivot_inverse + dot(base.response, both)
        return [
            [angular, -both[0], -both[1]],
            [-both[0], linear.xx, linear.xy],
            [-both[1], linear.xy, linear.yy],
        ]

    def _mount_response(self, lever: Vector) -> list[Vector]:
        """Rows [alpha, a_x, a_y] of the base's response to a force at a mount, H [(z x m)^T; 1]."""
        return [(row[1] + row[0] * lever[0], row[2] + row[0] * lever[1]) for row in self.inverse]

    def _set_moments(self) -> None:
        self.base_of_moment: list[Base] = []
        for arm, response in zip(self.arms, self.mount_responses, strict=True):
            for source in arm.moments:
                self.base_of_moment.append(tuple(-dot(row, source.at_mount) for row in response))
        # of each mount by a moment on each link; by reciprocity, of each link by a force at each mount
        self.of_force = [
            [add((base[1], base[2]), scale(base[0], lever)) for base in self.base_of_moment] for lever in self.levers
        ]
        joints = self.symbols.joints
        entries: dict[tuple[int, int], ca.SX] = {}
        for index, arm in enumerate(self.arms):
            first = arm.symbols.first_joint
            for k in range(arm.links):
                for j in range(first + k + 1):
                    entry = -dot(self.of_force[index][j], arm.moments[k].at_mount)
                    if j >= first:
                        entry = entry + arm.of_moment(j - first, k)
                    entries[j, first + k] = entries[first + k, j] = entry
        self.moments = [[*self.base_of_moment[k], *(entries[j, k] for j in range(joints))] for k in range(joints)]

    def _set_rates(self) -> None:
        self.rates = []
        for index, arm in enumerate(self.arms):
            first = arm.symbols.first_joint
            for k, source in enumerate(arm.rates):
                column = [-dot(row, source.at_mount) for row in self.mount_responses[index]]
                for j in range(self.symbols.joints):
                    entry = -dot(self.of_force[index][j], source.at_mount)
                    if first <= j < first + arm.links:
                        entry = entry + arm.of_rate(j - first, k)
                    column.append(entry)
                self.rates.append(column)
        base = self.base_response((self.centripetal_moment, *self.centripetal))
        self.base_rate = [*base, *self.links_of_base(base, ca.SX(1))]

    def base_response(self, wrench: Base) -> Base:
        """H wrench."""
        return tuple(row[0] * wrench[0] + row[1] * wrench[1] + row[2] * wrench[2] for row in self.inverse)

    def mount_acceleration(self, index: int, base: Base, rate_squared: ca.SX) -> Vector:
        """a + alpha z x m - omega^2 m."""
        tangential = scale(base[0], self.levers[index])
        return add((base[1], base[2]), subtract(tangential, scale(rate_squared, self.arms[index].mount)))

    def links_of_base(self, base: Base, rate_squared: ca.SX) -> list[ca.SX]:
        """Angular accelerations of all links by a motion of the base."""
        found = []
        for index, arm in enumerate(self.arms):
            mount = self.mount_acceleration(index, base, rate_squared)
            found += [-dot(source.at_mount, mount) for source in arm.moments]
        return found

    def of_joints(self, column: list[ca.SX]) -> list[ca.SX]:
        """The same accelerations with those of the joints in place of the links': differences along each arm."""
        found = column[:3]
        for arm in self.arms:
            before = column[0]
            for k in range(arm.links):
                entry = column[3 + arm.symbols.first_joint + k]
                found.append(entry - before)
                before = entry
        return found

    @property
    def sections(self) -> list[Section]:
        """The parts that depend on the configuration alone."""
        arms = [section for arm in self.arms for section in arm.sections]
        base = [
            *self.inverse,
            self.mount_responses,
            self.centripetal,
            self.centripetal_moment,
            self.base.smallest_pivot(),
        ]
        return [
            *arms,
            Section("base, mobility", base),
            Section("accelerations by moments", self.of_force, self.moments),
            Section("accelerations by rates", self.rates, self.base_rate),
        ]
