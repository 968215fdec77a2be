"""Computes first moment and inertia of a rigid body about its joint from those about its COM."""

from dataclasses import dataclass

import casadi as ca

from .plane_vectors import Vector
from .symbols import Symbols


@dataclass(frozen=True)
class RigidBodyInertia:
    """Mass, inertia about the COM, and the COM from the joint, of a body; ``label`` starts names of constants."""

    label: str
    mass: ca.SX
    inertia: ca.SX
    com: Vector

    def about_joint(self, symbols: Symbols) -> ca.SX:
        inertia = self.inertia + self.mass * (self.com[0] * self.com[0] + self.com[1] * self.com[1])
        text = "I + m |c|^2, about the joint"
        return symbols.constant(f"{self.label}_joint_inertia", inertia, "kg m^2", text)

    def inverse_about_joint(self, symbols: Symbols) -> ca.SX:
        name, text = f"{self.label}_inverse_joint_inertia", "1 / (I + m |c|^2)"
        return symbols.reciprocal_constant(name, self.about_joint(symbols), "1/(kg m^2)", text)

    def first_moment(self, symbols: Symbols) -> Vector:
        return (
            symbols.constant(f"{self.label}_first_moment_x", self.mass * self.com[0], "kg m", "m c_x"),
            symbols.constant(f"{self.label}_first_moment_y", self.mass * self.com[1], "kg m", "m c_y"),
        )
