"""Computes the mass matrix and bias of the full coordinates, eq. (1), from the arms' composite inertias."""

from functools import cached_property

import casadi as ca

from .composite_inertia import ArmBias, CompositeInertia
from .inputs import CONFIGURATION, STATE
from .kinematics import Kinematics, angular_velocities
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, dot, perpendicular, rotate
from .signatures import Family, Function, Section, matrix, vector
from .symbols import Symbols


class EquationsOfMotion:
    """M = [[I_b, I_bm], [I_bm^T, I_m]] and [c_b; c_m] of eq. (1).

    ``inertia`` and ``first_moment`` of the robot are about the base COM; ``augmented_inertia`` is that of the base with
    the arms' masses at their mounts.
    """

    def __init__(self, symbols: Symbols, kinematics: Kinematics) -> None:
        self.symbols, self.kinematics = symbols, kinematics
        self.arms = [CompositeInertia(symbols, arm) for arm in kinematics.arms]
        total_mass, base_inertia = symbols.base_mass, symbols.base_inertia
        for arm in self.arms:
            total_mass = total_mass + arm.mass[0]
        self.total_mass = symbols.constant("total_mass", total_mass, "kg", "mass of the robot")
        self.first_moment: Vector = ZERO_VECTOR
        inertia = ZERO
        for i, arm in enumerate(self.arms, start=1):
            mount_x, mount_y = arm.positions.symbols.mount
            base_inertia = base_inertia + arm.mass[0] * (mount_x * mount_x + mount_y * mount_y)
            mount_moment = symbols.constant_vector(
                f"{arm.positions.symbols.label}_mount_first_moment",
                (arm.mass[0] * mount_x, arm.mass[0] * mount_y),
                "kg m",
                f"(mass of arm {i}) mount, base frame",
            )
            at_mount = add(arm.first_moment[0], rotate(kinematics.base_rotation, mount_moment))
            self.first_moment = add(self.first_moment, at_mount)
            offset = dot(arm.positions.mount, arm.first_moment[0])
            inertia = inertia + (arm.inertia[0] + (offset + offset))
        self.augmented_inertia = symbols.constant(
            "base_augmented_inertia",
            base_inertia,
            "kg m^2",
            "inertia about the base COM of the base and the arms' masses at their mounts",
        )
        self.inertia = self.augmented_inertia + inertia

    @property
    def sections(self) -> list[Section]:
        """The parts that depend on the configuration alone."""
        positions, arms = self.kinematics.position_sections, [arm.section for arm in self.arms]
        return [*positions, *arms, Section("robot about the base COM", self.first_moment, self.inertia)]

    def mass_matrix(self) -> ca.SX:
        """M of eq. (1)."""
        size = 3 + self.symbols.joints
        m = ca.SX(size, size)
        m[0, 0] = self.inertia
        m[1, 1] = m[2, 2] = self.total_mass
        m[1, 0], m[2, 0] = perpendicular(self.first_moment)
        for arm in self.arms:
            first = 3 + arm.positions.symbols.first_joint
            for k in range(arm.positions.links):
                m[first + k, 0] = arm.base_coupling[k]
                m[first + k, 1], m[first + k, 2] = perpendicular(arm.first_moment[k])
                for j in range(k + 1):
                    m[first + k, first + j] = arm.mass_matrix[j][k]
        return ca.tril2symm(m)

    def bias(self) -> ca.SX:
        """[c_b; c_m] of eq. (1): the generalized forces at zero accelerations."""
        joints, force, moment = self.bias_terms
        return ca.vertcat(moment, *force, *joints)

    @cached_property
    def arm_biases(self) -> list[ArmBias]:
        inputs = self.kinematics.inputs
        base_rate = inputs.base_twist[0]
        velocities = [angular_velocities(arm, inputs) for arm in self.symbols.arms]
        return [ArmBias(arm, rates, base_rate * base_rate) for arm, rates in zip(self.arms, velocities, strict=True)]

    @property
    def bias_sections(self) -> list[Section]:
        return [part for arm in self.arm_biases for part in arm.sections]

    @property
    def bias_terms(self) -> tuple[list[ca.SX], Vector, ca.SX]:
        """(c_m, force of c_b, moment of c_b about the base COM)."""
        joints: list[ca.SX] = []
        force, moment = ZERO_VECTOR, ZERO
        for arm in self.arm_biases:
            joints += arm.joints
            force = add(force, arm.force)
            moment = moment + arm.moment
        return joints, force, moment


def equations_of_motion_family(equations: EquationsOfMotion) -> Family:
    source = "Raina & Shah (2017), eq. (1)"
    mass_matrix = Function(
        "mass_matrix",
        "Mass matrix of the full coordinates (base twist, then joint rates); symmetric.",
        "M = [[I_b, I_bm], [I_bm^T, I_m]]",
        source,
        [*CONFIGURATION],
        [matrix("mass_matrix", "kg m^2, kg m, kg", "row-major", equations.mass_matrix())],
    )
    bias = Function(
        "bias",
        "Velocity-dependent forces: the generalized forces that hold all accelerations at zero.",
        "[c_b; c_m]",
        source,
        [*STATE],
        [vector("bias", "N m, N, N, then N m", "base, then joints", equations.bias())],
        equations.bias_sections,
    )
    return Family(
        "equations_of_motion",
        "Mass matrix by composite rigid bodies and bias by a Newton-Euler recursion, in the full coordinates.",
        [mass_matrix, bias],
        equations.sections,
    )
