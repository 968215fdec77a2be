"""Computes the motion of a free base whose arms are articulated inertias A at their mounts m, in inertial axes.

With a and alpha of the base COM, the moment n on the base, and the forces A a_m + b of the mounts, which move by
a_m = a + alpha z x m,

    P alpha + c . a = n - sum (z x m) . b,   (m_0 + sum A) a + c alpha = - sum b,
    P = I_0 + sum (z x m) . A (z x m),       c = sum A (z x m).

The rotation is eliminated first, which leaves a 2 x 2 system.
"""

import casadi as ca

from .articulated_inertia import ArticulatedInertia
from .plane_vectors import ZERO, ZERO_VECTOR, Vector, add, dot, perpendicular, scale
from .symbols import Symbols


class FreeBase:
    """``mounts`` are the arms' positions from the base COM with their inertias; ``pivot_inverse`` is 1 / P,
    ``coupling`` c, ``response`` c / P, and ``inertia`` the 2 x 2 matrix without the rotation."""

    def __init__(self, symbols: Symbols, mounts: list[tuple[Vector, ArticulatedInertia]]) -> None:
        total = ArticulatedInertia(symbols.base_mass, ZERO, symbols.base_mass)
        coupling, pivot = ZERO_VECTOR, symbols.base_inertia
        for mount, inertia in mounts:
            lever = perpendicular(mount)
            across = inertia.times(lever)
            total, coupling, pivot = total.plus(inertia), add(coupling, across), pivot + dot(lever, across)
        self.coupling, self.pivot = coupling, pivot
        self.pivot_inverse = symbols.reciprocal(pivot)
        x, y = self.response = scale(self.pivot_inverse, coupling)
        self.inertia = ArticulatedInertia(
            total.xx - coupling[0] * x, total.xy - coupling[0] * y, total.yy - coupling[1] * y
        )
        self.diagonal = self.inertia.xx * self.inertia.yy
        self.determinant = self.diagonal - self.inertia.xy * self.inertia.xy
        self.determinant_inverse = symbols.reciprocal(self.determinant)

    def smallest_pivot(self) -> ca.SX:
        """As that of `forward_dynamics.py`, for the base COM in place of a mount."""
        return self.determinant / self.diagonal

    def relative_pivots(self, mass: ca.SX, inertia: ca.SX) -> list[ca.SX]:
        """All three, relative to what they would be if all moved with the base without turning, which is more: how many
        digits the differences have lost. ``mass`` and ``inertia`` about the base COM are those of such a motion."""
        xx = self.inertia.xx
        return [self.pivot / inertia, xx / mass, self.determinant / (xx * mass)]

    def acceleration(self, force: Vector, moment: ca.SX) -> tuple[ca.SX, Vector]:
        """(alpha, a) from sum b and n - sum (z x m) . b."""
        alpha_0 = moment * self.pivot_inverse
        a = self.inertia.balance(add(force, scale(alpha_0, self.coupling)), self.determinant_inverse)
        return alpha_0 - dot(self.response, a), a
