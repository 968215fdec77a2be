"""Computes the reduced dynamics, eq. (2), by eliminating the base from the equations of motion."""

import casadi as ca

from .equations_of_motion import EquationsOfMotion
from .plane_vectors import add, cross, dot, scale, subtract
from .symbols import Symbols


class ReducedDynamics:
    """I, c and J of the paper's eq. (2): first the robot's COM is eliminated, then its rotation."""

    def __init__(self, symbols: Symbols, equations: EquationsOfMotion) -> None:
        self.symbols, self.equations = symbols, equations
        self.inverse_mass = symbols.inverse_constant(
            "inverse_total_mass", equations.total_mass, "1/kg", "1 / (mass of the robot)"
        )
        self.com = scale(self.inverse_mass, equations.first_moment)  # from the base COM
        self.inertia = equations.inertia - dot(self.com, equations.first_moment)  # about the robot's COM
        inverse_inertia = symbols.reciprocal(self.inertia)
        # per joint: s_k / mass, row of the rotation after the COM is gone, and that row over its pivot
        self.moment = [moment for arm in equations.arms for moment in arm.moment]
        self.com_shift = [scale(self.inverse_mass, moment) for moment in self.moment]
        base_entry = [entry for arm in equations.arms for entry in arm.base_entry]
        self.row = [entry - dot(self.com, moment) for entry, moment in zip(base_entry, self.moment, strict=True)]
        self.turn = [row * inverse_inertia for row in self.row]

    def smallest_pivot(self) -> ca.SX:
        """Inertia about the robot's COM relative to that about the base COM."""
        return self.inertia / self.equations.inertia

    def generalized_inertia(self) -> ca.SX:
        joints = self.symbols.joints
        inertia = ca.SX(joints, joints)
        for arm in self.equations.arms:
            first = arm.arm.first_joint
            for k in range(arm.arm.links):
                for j in range(k + 1):
                    inertia[first + k, first + j] = arm.entry[j][k]
        for k in range(joints):
            for j in range(k + 1):
                inertia[k, j] = inertia[k, j] - dot(self.moment[k], self.com_shift[j]) - self.row[k] * self.turn[j]
        return ca.tril2symm(inertia)

    def generalized_bias(self) -> ca.SX:
        joints, force, moment = self.equations._centripetal()
        moment = moment - cross(self.com, force)
        reduced = []
        for k, bias in enumerate(joints):
            reduced.append(bias - cross(self.com_shift[k], force) - self.turn[k] * moment)
        return ca.vertcat(*reduced)

    def generalized_jacobian(self) -> ca.SX:
        """3 rows per arm: [own - turn; z x (own reach - s/mass - turn (tip - COM))]."""
        arms = self.equations.arms
        jacobian = ca.SX(3 * len(arms), self.symbols.joints)
        for i, arm in enumerate(self.equations.arms):
            from_com = subtract(arm.arm.tip, self.com)
            reach = {}
            span = (ca.SX(0), ca.SX(0))
            for k in reversed(range(arm.arm.links)):
                span = add(arm.arm.vector[k], span)
                reach[arm.arm.first_joint + k] = span
            for column in range(self.symbols.joints):
                lever = add(self.com_shift[column], scale(self.turn[column], from_com))
                own = column in reach
                jacobian[3 * i, column] = 1 - self.turn[column] if own else -self.turn[column]
                if own:
                    x, y = subtract(lever, reach[column])
                    jacobian[3 * i + 1, column], jacobian[3 * i + 2, column] = y, -x
                else:
                    jacobian[3 * i + 1, column], jacobian[3 * i + 2, column] = lever[1], -lever[0]
        return jacobian
