"""Computes rotations and sums of articulated inertias, and which of their parts are constants."""

from dataclasses import dataclass

import casadi as ca

from .plane_vectors import Rotation, Vector, dot, scale, subtract
from .symbols import Symbols


@dataclass(frozen=True)
class ArticulatedInertia:
    """A symmetric 2 x 2 articulated inertia, kg.

    ``difference`` is xx - yy and ``twice_xy`` is 2 xy, where these are constants. Rotation by an angle changes a
    constant diagonal ``constant`` to xx = constant[0] - change and yy = constant[1] + change: a constant term of a sum
    can be added to ``constant`` when the model is built.

    ``remains_of`` is (T, r, 1 / D) of what an elimination has left, A = T - r r^T / D, where products take the inverse
    last: it is a division, and the longest path through several bodies goes from division to division.
    """

    xx: ca.SX
    xy: ca.SX
    yy: ca.SX
    difference: ca.SX | None = None
    constant: Vector | None = None
    change: ca.SX | None = None
    twice_xy: ca.SX | None = None
    remains_of: tuple["ArticulatedInertia", Vector, ca.SX] | None = None

    @property
    def elements(self) -> list[ca.SX]:
        return [self.xx, self.xy, self.yy]

    def rotate(self, rotation: Rotation) -> "ArticulatedInertia":
        """R A R^T in 10 operations, 5 where xy is zero; the trace is invariant.

        ``rotation`` may be a multiple of one if ``difference`` is divided by its square and xy is zero.
        """
        c, s = rotation
        difference = self.xx - self.yy if self.difference is None else self.difference
        twice_xy = self.xy + self.xy if self.twice_xy is None else self.twice_xy
        v = c * twice_xy + s * difference
        change = s * v
        constant = None if self.difference is None else (self.xx, self.yy)
        return ArticulatedInertia(self.xx - change, c * v - self.xy, self.yy + change, None, constant, change)

    def times(self, a: Vector) -> Vector:
        if self.remains_of is None:
            return self.xx * a[0] + self.xy * a[1], self.xy * a[0] + self.yy * a[1]
        total, coupling, inverse = self.remains_of
        return subtract(total.times(a), scale(dot(coupling, a) * inverse, coupling))

    def square(self, a: Vector) -> ca.SX:
        """a . A a."""
        if self.remains_of is None:
            return dot(a, self.times(a))
        total, coupling, inverse = self.remains_of
        along = dot(coupling, a)
        return total.square(a) - along * along * inverse

    def balance(self, b: Vector, determinant_inverse: ca.SX) -> Vector:
        """a of A a + b = 0 by Cramer's rule: a division is on the longest path, and L D L^T has two of them."""
        x = (self.xy * b[1] - self.yy * b[0]) * determinant_inverse
        y = (self.xy * b[0] - self.xx * b[1]) * determinant_inverse
        return x, y

    def plus(self, other: "ArticulatedInertia") -> "ArticulatedInertia":
        return ArticulatedInertia(self.xx + other.xx, self.xy + other.xy, self.yy + other.yy)

    def without(self, coupling: Vector, response: Vector, inverse: ca.SX | None = None) -> "ArticulatedInertia":
        """A - r r^T / D from r, r / D and, where products are to take it last, 1 / D."""
        return ArticulatedInertia(
            self.xx - coupling[0] * response[0],
            self.xy - coupling[0] * response[1],
            self.yy - coupling[1] * response[1],
            remains_of=None if inverse is None else (self, coupling, inverse),
        )

    def xx_plus(self, symbols: Symbols, name: str, term: ca.SX, text: str) -> ca.SX:
        """xx + term for a constant term, which ``name`` and ``text`` describe."""
        if self.constant is None:
            return self.xx + term
        text = f"constant part of {text} + A'_xx"
        return symbols.constant(f"{name}_with_child", self.constant[0] + term, "kg", text) - self.change

    def yy_times_plus(self, symbols: Symbols, name: str, factor: ca.SX, term: ca.SX, text: str) -> ca.SX:
        """factor yy + term for constants factor and term; ``name`` and ``text`` describe the result."""
        if self.constant is None:
            return factor * self.yy + term
        text = f"constant part of {text}"
        constant = symbols.constant(f"{name}_with_child", factor * self.constant[1] + term, "kg", text)
        return factor * self.change + constant
