"""Computes an arm's blocks of the mass matrix and bias from its kinematics, by composite rigid bodies.

Composite body k is link k with all links outboard of it. The augmented first moment of link k,
sigma_k = m_k c_k + (outboard mass) d_k, is constant in the frame of the link; d_k runs from joint k to joint k + 1. In
inertial axes, s_k = sum of sigma_j, j >= k, is the first moment of composite body k about joint k, I_k its inertia
about joint k, and M_jk = I_k + (p_k - p_j) . s_k.
"""

import casadi as ca

from .kinematics import ArmPositions
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, cross, dot, rotate, scale, subtract
from .signatures import Section
from .symbols import LinkSymbols, Symbols


class CompositeInertia:
    """Composite bodies of one arm, from the last link to the first.

    ``mass[k]``, ``first_moment[k]`` s_k and ``inertia[k]`` I_k belong to composite body k, and
    ``augmented_first_moment[k]`` is sigma_k in inertial axes. ``mass_matrix[j][k]``, j <= k, is the arm's block of I_m,
    and ``base_coupling[k]`` the entry of I_bm in the row of the base's rotation.
    """

    def __init__(self, symbols: Symbols, arm: ArmPositions) -> None:
        self.positions = arm
        links = arm.symbols.links
        self.mass = [ZERO] * len(links)
        self.augmented_first_moment: list[Vector] = [ZERO_VECTOR] * len(links)
        self.first_moment: list[Vector] = [ZERO_VECTOR] * len(links)
        self.inertia = [ZERO] * len(links)
        self.mass_matrix = [[ZERO] * len(links) for _ in links]
        outboard_mass = ZERO
        for k in reversed(range(len(links))):
            link = links[k]
            sigma, own_inertia = augmented_body(symbols, link, outboard_mass)
            self.augmented_first_moment[k] = rotate(arm.rotation[k], sigma)
            if k == len(links) - 1:
                self.first_moment[k], self.inertia[k] = self.augmented_first_moment[k], own_inertia
            else:
                offset = dot(arm.link[k], self.first_moment[k + 1])
                self.first_moment[k] = add(self.first_moment[k + 1], self.augmented_first_moment[k])
                self.mass_matrix[k][k + 1] = self.inertia[k + 1] + offset
                self.inertia[k] = (own_inertia + offset) + self.mass_matrix[k][k + 1]
                if offset.is_zero() and self.inertia[k + 1].is_symbolic():  # all outboard links are reaction wheels
                    self.inertia[k] = symbols.constant(
                        f"{link.label}_composite_inertia",
                        self.inertia[k],
                        "kg m^2",
                        "inertia about the joint of this link and all outboard links",
                    )
            self.mass_matrix[k][k] = self.inertia[k]
            outboard_mass = self.mass[k] = symbols.constant(
                f"{link.label}_composite_mass",
                link.mass + outboard_mass,
                "kg",
                "mass of this link and all outboard links",
            )
        for j in reversed(range(len(links) - 1)):
            for k in range(j + 2, len(links)):
                self.mass_matrix[j][k] = self.mass_matrix[j + 1][k] + dot(arm.link[j], self.first_moment[k])
        # one more step of the recursion over j: from the first joint to the base COM
        self.base_coupling = [
            entry + dot(arm.mount, moment) for entry, moment in zip(self.mass_matrix[0], self.first_moment, strict=True)
        ]

    @property
    def section(self) -> Section:
        values = [self.augmented_first_moment, self.first_moment, self.inertia, self.mass_matrix, self.base_coupling]
        return Section(f"{self.positions.symbols.title}, composite inertia", values)


class ArmBias:
    """c_m of one arm, ``joints``, and the ``force`` and the ``moment`` about the base COM that the arm adds to c_b.

    An outward recursion gives the centripetal acceleration a_k of joint k, an inward one
    t_k = sum of omega_j^2 sigma_j, j >= k, and the moment n_k = n_(k+1) + sigma_k x a_k - d_k x t_(k+1).
    """

    def __init__(self, composite: CompositeInertia, angular_velocities: list[ca.SX], base_rate_squared: ca.SX) -> None:
        arm, augmented_first_moment = composite.positions, composite.augmented_first_moment
        acceleration = scale(-base_rate_squared, arm.mount)
        squares = [velocity * velocity for velocity in angular_velocities]
        accelerations = []
        for square, link in zip(squares, arm.link, strict=True):
            accelerations.append(acceleration)
            acceleration = subtract(acceleration, scale(square, link))
        self.joints = [ZERO] * arm.links
        total = ZERO_VECTOR  # t_(k+1)
        for k in reversed(range(arm.links)):
            moment = cross(augmented_first_moment[k], accelerations[k])
            if k < arm.links - 1:
                moment = self.joints[k + 1] + moment - cross(arm.link[k], total)
            total = add(total, scale(squares[k], augmented_first_moment[k]))
            self.joints[k] = moment
        self.force = subtract(scale(composite.mass[0], accelerations[0]), total)
        self.moment = self.joints[0] - cross(arm.mount, total)
        title = arm.symbols.title
        self.sections = [
            Section(f"{title}, outward pass", accelerations),
            Section(f"{title}, inward pass", self.joints, self.force, self.moment),
        ]


def augmented_body(symbols: Symbols, link: LinkSymbols, outboard_mass: ca.SX) -> tuple[Vector, ca.SX]:
    """(sigma, inertia about the joint) of a link with the outboard mass at its end, in the frame of the link."""
    (com_x, com_y), length = link.com, link.length
    sigma_x = symbols.constant(
        f"{link.label}_augmented_first_moment_x",
        link.mass * com_x + outboard_mass * length,
        "kg m",
        "m c_x + (outboard mass) l",
    )
    sigma_y = symbols.constant(f"{link.label}_augmented_first_moment_y", link.mass * com_y, "kg m", "m c_y")
    inertia = symbols.constant(
        f"{link.label}_augmented_inertia",
        link.inertia + link.mass * (com_x * com_x + com_y * com_y) + outboard_mass * (length * length),
        "kg m^2",
        "I + m |c|^2 + (outboard mass) l^2, about the joint",
    )
    return (sigma_x, sigma_y), inertia
