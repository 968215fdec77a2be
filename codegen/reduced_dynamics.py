"""Computes the reduced dynamics, eq. (2), by eliminating the base twist from the equations of motion, eq. (1)."""

import casadi as ca

from .equations_of_motion import EquationsOfMotion
from .inputs import CONFIGURATION, STATE
from .plane_vectors import add, cross, dot, scale, subtract
from .signatures import Family, Function, Output, Section, matrix, smallest_pivot, vector
from .symbols import Symbols


class ReducedDynamics:
    """I, c and J of eq. (2): the translation of the robot's COM is eliminated first, then the base's rotation.

    For joint k over all arms, ``first_moment[k]`` is s_k, ``com_lever[k]`` = s_k / (mass of the robot), so that
    z x com_lever is the column of the COM's Jacobian, ``coupling[k]`` the angular momentum about the robot's COM per
    joint rate, and ``rotation_response[k]`` the row of I_b^-1 I_bm that belongs to the base's rotation.
    """

    def __init__(self, symbols: Symbols, equations: EquationsOfMotion) -> None:
        self.symbols, self.equations = symbols, equations
        inverse_mass = symbols.reciprocal_constant(
            "inverse_total_mass", equations.total_mass, "1/kg", "1 / (mass of the robot)"
        )
        self.com = scale(inverse_mass, equations.first_moment)  # of the robot, from the base COM
        self.inertia = equations.inertia - dot(self.com, equations.first_moment)  # about the robot's COM
        inverse_inertia = symbols.reciprocal(self.inertia)
        self.first_moment = [moment for arm in equations.arms for moment in arm.first_moment]
        self.com_lever = [scale(inverse_mass, moment) for moment in self.first_moment]
        base_coupling = [entry for arm in equations.arms for entry in arm.base_coupling]
        self.coupling = [
            entry - dot(self.com, moment) for entry, moment in zip(base_coupling, self.first_moment, strict=True)
        ]
        self.rotation_response = [coupling * inverse_inertia for coupling in self.coupling]

    @property
    def sections(self) -> list[Section]:
        """The parts that depend on the configuration alone."""
        about_com = Section("robot about its COM", self.com, self.inertia, self.com_lever, self.coupling)
        return [*self.equations.sections, about_com, Section("elimination of the base", self.rotation_response)]

    def smallest_pivot(self) -> ca.SX:
        """Inertia about the robot's COM relative to that about the base COM."""
        return self.inertia / self.equations.inertia

    def generalized_inertia(self) -> ca.SX:
        """I = I_m - I_bm^T I_b^-1 I_bm of eq. (2)."""
        joints = self.symbols.joints
        inertia = ca.SX(joints, joints)
        for arm in self.equations.arms:
            first = arm.positions.symbols.first_joint
            for k in range(arm.positions.links):
                for j in range(k + 1):
                    inertia[first + k, first + j] = arm.mass_matrix[j][k]
        for k in range(joints):
            for j in range(k + 1):
                translation = dot(self.first_moment[k], self.com_lever[j])
                inertia[k, j] = inertia[k, j] - translation - self.coupling[k] * self.rotation_response[j]
        return ca.tril2symm(inertia)

    def generalized_bias(self) -> ca.SX:
        """c = c_m - I_bm^T I_b^-1 c_b of eq. (2)."""
        joints, force, moment = self.equations.bias_terms
        moment = moment - cross(self.com, force)  # about the robot's COM
        reduced = []
        for k, bias in enumerate(joints):
            reduced.append(bias - cross(self.com_lever[k], force) - self.rotation_response[k] * moment)
        return ca.vertcat(*reduced)

    def generalized_jacobian(self) -> ca.SX:
        """J = J_me - J_be I_b^-1 I_bm of eq. (2), 3 rows [omega, vx, vy] per arm.

        Joint k of rotation response r_k moves an end effector at e by
        [1 - r_k; z x (e - p_k - com_lever_k - r_k (e - COM))] per joint rate if it belongs to the arm, else without 1
        and e - p_k.
        """
        jacobian = ca.SX(3 * len(self.equations.arms), self.symbols.joints)
        for i, arm in enumerate(self.equations.arms):
            positions = arm.positions
            from_com = subtract(positions.end_effector, self.com)
            first = positions.symbols.first_joint
            for joint in range(self.symbols.joints):
                response = self.rotation_response[joint]
                lever = add(self.com_lever[joint], scale(response, from_com))
                if first <= joint < first + positions.links:
                    x, y = subtract(lever, positions.to_end_effector[joint - first])
                    column = (1 - response, y, -x)
                else:
                    column = (-response, lever[1], -lever[0])
                jacobian[3 * i : 3 * i + 3, joint] = ca.vertcat(*column)
        return jacobian


def generalized_matrices(inertia: ca.SX, jacobian: ca.SX) -> list[Output]:
    """I and J as results."""
    twists = "3 rows [omega, vx, vy] per arm, inertial axes: end-effector twists of a robot of zero momentum"
    return [
        matrix("generalized_inertia", "kg m^2", "symmetric, row-major", inertia),
        matrix("generalized_jacobian", "1, m, m per arm", twists, jacobian),
    ]


def reduced_dynamics_family(reduced: ReducedDynamics) -> Family:
    inertia, jacobian = generalized_matrices(reduced.generalized_inertia(), reduced.generalized_jacobian())
    bias = vector("generalized_bias", "N m", "arm by arm", reduced.generalized_bias())
    pivot = smallest_pivot(reduced.smallest_pivot())
    source = "Raina & Shah (2017), eq. (2); Umetani & Yoshida (1989)"
    all_together = Function(
        "reduced_dynamics",
        "Generalized inertia, bias and Jacobian together.",
        "I = I_m - I_bm^T I_b^-1 I_bm,  c = c_m - I_bm^T I_b^-1 c_b,  J = J_me - J_be I_b^-1 I_bm",
        source,
        [*STATE],
        [inertia, bias, jacobian, pivot],
        reduced.equations.bias_sections,
    )
    jacobian_alone = Function(
        "generalized_jacobian",
        "Generalized Jacobian alone.",
        "J = J_me - J_be I_b^-1 I_bm",
        source,
        [*CONFIGURATION],
        [jacobian, pivot],
    )
    return Family(
        "reduced_dynamics",
        "Dynamics of the free-floating robot in joint coordinates alone, with the base eliminated.",
        [all_together, jacobian_alone],
        reduced.sections,
    )
