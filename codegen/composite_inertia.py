"""Computes an arm's part of the mass matrix and bias, as composite inertias, from its kinematics.

Augmented first moment of link k: sigma_k = m_k c_k + (mass beyond) d_k, a constant in the link's frame.
In inertial axes, from the tip: s_k = sum of sigma_j, j >= k, is the first moment about joint k of all
that joint k carries, I_k its inertia about joint k, and M_jk = I_k + (p_k - p_j) . s_k.
"""

import casadi as ca

from .kinematics import ArmGeometry
from .plane_vectors import Vector, add, cross, dot, rotate, scale, subtract
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
