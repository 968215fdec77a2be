"""Plane vectors as pairs of scalar expressions; rotations as (cosine, sine)."""

import casadi as ca

Vector = tuple[ca.SX, ca.SX]


def add(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1]


def subtract(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1]


def scale(factor: ca.SX, a: Vector) -> Vector:
    return factor * a[0], factor * a[1]


def dot(a: Vector, b: Vector) -> ca.SX:
    return a[0] * b[0] + a[1] * b[1]


def cross(a: Vector, b: Vector) -> ca.SX:
    """The moment of b at a: the z component of a x b."""
    return a[0] * b[1] - a[1] * b[0]


def turn_left(a: Vector) -> Vector:
    """z x a, a quarter turn anticlockwise."""
    return -a[1], a[0]


def rotation(angle: ca.SX) -> Vector:
    """(cosine, sine) of an angle: one sin/cos pair."""
    return ca.cos(angle), ca.sin(angle)


def rotate(rotation: Vector, a: Vector) -> Vector:
    """Components of a in the parent frame, from those in a frame turned by the rotation."""
    c, s = rotation
    return c * a[0] - s * a[1], s * a[0] + c * a[1]


def rotate_back(rotation: Vector, a: Vector) -> Vector:
    """Components of a in the turned frame, from those in the parent frame."""
    c, s = rotation
    return c * a[0] + s * a[1], c * a[1] - s * a[0]
