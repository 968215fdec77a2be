"""Computes the motion of a free base whose arms are articulated inertias A at their mounts m, in inertial axes.

With a and alpha of the base COM, the moment n on the base, and the forces A a_m + b of the mounts, which move by
a_m = a + alpha z x m,

    P alpha + c . a = n - sum (z x m) . b,   T a + c alpha = - sum b,
    P = I_0 + sum (z x m) . A (z x m),       c = sum A (z x m),   T = m_0 + sum A.
"""

import casadi as ca

from .articulated_inertia import ArticulatedInertia
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, dot, perpendicular, scale
from .symbols import Symbols

Mounts = list[tuple[Vector, ArticulatedInertia]]


class FreeBase:
    """``mounts`` are the arms' positions from the base COM with their inertias.

    ``total`` is T, ``coupling`` c and ``pivot`` P.
    """

    def __init__(self, symbols: Symbols, mounts: Mounts) -> None:
        self.total = ArticulatedInertia(symbols.base_mass, ZERO, symbols.base_mass)
        self.coupling, self.pivot = ZERO_VECTOR, symbols.base_inertia
        for mount, inertia in mounts:
            lever = perpendicular(mount)
            self.total, self.coupling = self.total.plus(inertia), add(self.coupling, inertia.times(lever))
            self.pivot = self.pivot + inertia.square(lever)


class RotationFirst(FreeBase):
    """The rotation is eliminated first, which leaves a 2 x 2 system.

    ``pivot_inverse`` is 1 / P, ``response`` c / P, and ``inertia`` the 2 x 2 matrix without the rotation.
    """

    def __init__(self, symbols: Symbols, mounts: Mounts) -> None:
        super().__init__(symbols, mounts)
        self.pivot_inverse = symbols.reciprocal(self.pivot)
        self.response = scale(self.pivot_inverse, self.coupling)
        self.inertia = self.total.without(self.coupling, self.response)
        self.diagonal = self.inertia.xx * self.inertia.yy
        self.determinant = self.diagonal - self.inertia.xy * self.inertia.xy
        self.determinant_inverse = symbols.reciprocal(self.determinant)

    def smallest_pivot(self) -> ca.SX:
        """As that of `forward_dynamics.py`, for the base COM in place of a mount."""
        return self.determinant / self.diagonal


class TranslationFirst(FreeBase):
    """The translation is eliminated first: P is ready last, after all arms, and one division follows it instead of two.

    ``determinant`` is that of T, ``adjugate_coupling`` adj(T) c, and ``remaining_pivot`` P without the translation.
    """

    def __init__(self, symbols: Symbols, mounts: Mounts) -> None:
        super().__init__(symbols, mounts)
        total, (x, y) = self.total, self.coupling
        self.determinant = total.xx * total.yy - total.xy * total.xy
        self.determinant_inverse = symbols.reciprocal(self.determinant)
        self.adjugate_coupling = (total.yy * x - total.xy * y, total.xx * y - total.xy * x)
        self.remaining_pivot = self.pivot - dot(self.coupling, self.adjugate_coupling) * self.determinant_inverse

    def relative_pivots(self, mass: ca.SX, inertia: ca.SX) -> list[ca.SX]:
        """All three, relative to what they would be if all moved with the base without turning, which is more: how many
        digits the differences have lost. ``mass`` and ``inertia`` about the base COM are those of such a motion."""
        xx = self.total.xx
        return [xx / mass, self.determinant / (xx * mass), self.remaining_pivot / inertia]

    def acceleration(self, force: Vector, moment: ca.SX) -> tuple[ca.SX, Vector]:
        """(alpha, a) from sum b and n - sum (z x m) . b."""
        a_0 = self.total.balance(force, self.determinant_inverse)
        alpha = (moment - dot(self.coupling, a_0)) / self.remaining_pivot
        x, y = scale(self.determinant_inverse, self.adjugate_coupling)
        return alpha, (a_0[0] - x * alpha, a_0[1] - y * alpha)
