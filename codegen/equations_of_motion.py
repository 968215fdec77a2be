"""Mass matrix and bias by composite suffixes; generalized inertia, bias and Jacobian by eliminating the base.

Augmented first moment of link k: sigma_k = m_k c_k + (mass beyond) d_k, a constant in the link's frame.
In inertial axes, from the tip: s_k = sum of sigma_j, j >= k, is the first moment about joint k of all
that joint k carries, I_k its inertia about joint k, and M_jk = I_k + (p_k - p_j) . s_k.
"""

import casadi as ca

from .kinematics import ArmGeometry, Geometry
from .plane_vectors import Vector, add, cross, dot, rotate, scale, subtract, turn_left
from .symbols import Symbols


class Composite:
    """Composite inertias of one arm, from the tip to the mount, and the arm's part of M."""

    def __init__(self, symbols: Symbols, arm: ArmGeometry, index: int) -> None:
        self.arm = arm
        label = f"arm{index + 1}"
        links = arm.symbols.links
        beyond = ca.SX(0)
        self.mass_from = [None] * len(links)
        self.augmented: list[Vector] = [None] * len(links)  # sigma_k, inertial axes
        self.moment: list[Vector] = [None] * len(links)  # s_k
        self.inertia = [None] * len(links)  # I_k
        self.entry: list[list[ca.SX]] = [[None] * len(links) for _ in links]  # M_jk, j <= k
        for k in reversed(range(len(links))):
            link, name = links[k], f"{label}_link{k + 1}"
            last = k == len(links) - 1
            sigma = (
                symbols.constant(
                    f"{name}_augmented_moment_x",
                    link.mass * link.com_x + beyond * link.length,
                    "kg m",
                    "m c_x + (mass beyond) l",
                ),
                symbols.constant(f"{name}_augmented_moment_y", link.mass * link.com_y, "kg m", "m c_y"),
            )
            own = symbols.constant(
                f"{name}_augmented_inertia",
                link.inertia
                + link.mass * (link.com_x * link.com_x + link.com_y * link.com_y)
                + beyond * (link.length * link.length),
                "kg m^2",
                "I + m |c|^2 + (mass beyond) l^2, about the joint",
            )
            self.augmented[k] = rotate(arm.axis[k], sigma)
            if last:
                self.moment[k], self.inertia[k] = self.augmented[k], own
            else:
                lever = dot(arm.vector[k], self.moment[k + 1])
                self.moment[k] = add(self.moment[k + 1], self.augmented[k])
                self.entry[k][k + 1] = self.inertia[k + 1] + lever
                self.inertia[k] = (own + lever) + self.entry[k][k + 1]
                if lever.is_zero() and self.inertia[k + 1].is_symbolic():  # wheels alone, up to the tip
                    self.inertia[k] = symbols.constant(
                        f"{name}_composite_inertia",
                        self.inertia[k],
                        "kg m^2",
                        "inertia of this link and of all beyond, about the joint",
                    )
            self.entry[k][k] = self.inertia[k]
            beyond = symbols.constant(
                f"{name}_mass_from", link.mass + beyond, "kg", "mass of this link and of all beyond"
            )
            self.mass_from[k] = beyond
        for j in reversed(range(len(links) - 1)):
            for k in range(j + 2, len(links)):
                self.entry[j][k] = self.entry[j + 1][k] + dot(arm.vector[j], self.moment[k])
        # row of the base's rotation: one more step, from the first joint to the base COM
        self.base_entry = [self.entry[0][k] + dot(arm.mount, self.moment[k]) for k in range(len(links))]

    @property
    def mass(self) -> ca.SX:
        return self.mass_from[0]

    def centripetal(self, rates: list[ca.SX], base_rate_squared: ca.SX) -> tuple[list[ca.SX], Vector, ca.SX]:
        """(joint bias, force and moment about the base COM) that the rates alone need.

        With a_k the acceleration of joint k and t_k = sum of omega_j^2 sigma_j, j >= k, the moment about
        joint k is n_k = n_(k+1) + sigma_k x a_k - d_k x t_(k+1).
        """
        arm = self.arm
        a = scale(-base_rate_squared, arm.mount)
        mount_acceleration = a
        squares = [rate * rate for rate in rates]
        accelerations = []
        for k in range(arm.links):
            accelerations.append(a)
            a = subtract(a, scale(squares[k], arm.vector[k]))
        bias: list[ca.SX] = [None] * arm.links
        total = (ca.SX(0), ca.SX(0))  # t_(k+1)
        for k in reversed(range(arm.links)):
            moment = cross(self.augmented[k], accelerations[k])
            if k < arm.links - 1:
                moment = bias[k + 1] + moment - cross(arm.vector[k], total)
            total = add(total, scale(squares[k], self.augmented[k]))
            bias[k] = moment
        force = subtract(scale(self.mass, mount_acceleration), total)
        return bias, force, bias[0] - cross(arm.mount, total)


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
        return symmetric(m)

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
        return symmetric(inertia)

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


def symmetric(lower: ca.SX) -> ca.SX:
    """The full symmetric matrix of its lower triangle."""
    return ca.tril2symm(lower)
