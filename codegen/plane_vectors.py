"""Computes sums, products and rotations of plane vectors from their components, which are scalar expressions."""

import casadi as ca

Vector = tuple[ca.SX, ca.SX]
Rotation = tuple[ca.SX, ca.SX]  # (cosine, sine)

ZERO = ca.SX(0)
ZERO_VECTOR: Vector = (ZERO, ZERO)


def add(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1]


def subtract(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1]


def scale(factor: ca.SX, a: Vector) -> Vector:
    return factor * a[0], factor * a[1]


def dot(a: Vector, b: Vector) -> ca.SX:
    return a[0] * b[0] + a[1] * b[1]


def cross(a: Vector, b: Vector) -> ca.SX:
    """The z component of a x b: the moment of a force b that acts at a."""
    return a[0] * b[1] - a[1] * b[0]


def perpendicular(a: Vector) -> Vector:
    """z x a: a, rotated by +90 degrees."""
    return -a[1], a[0]


def rotation(angle: ca.SX) -> Rotation:
    """(cosine, sine) of an angle: one sin/cos pair."""
    return ca.cos(angle), ca.sin(angle)


def rotate(rotation: Rotation, a: Vector) -> Vector:
    """R a: components in the parent frame from those in the rotated frame."""
    c, s = rotation
    return c * a[0] - s * a[1], s * a[0] + c * a[1]


def rotate_inverse(rotation: Rotation, a: Vector) -> Vector:
    """R^T a: components in the rotated frame from those in the parent frame."""
    c, s = rotation
    return c * a[0] + s * a[1], c * a[1] - s * a[0]
