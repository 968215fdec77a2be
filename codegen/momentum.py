"""Computes momentum and kinetic energy from the motion of every body."""

import casadi as ca

from .kinematics import Geometry
from .plane_vectors import add, cross, dot, scale


def momentum(geometry: Geometry) -> tuple[ca.SX, ca.SX, ca.SX]:
    """(linear momentum, angular momentum about the inertial origin, kinetic energy), body by body."""
    symbols = geometry.symbols
    twist = geometry.inputs.base_twist
    base_velocity = (twist[1], twist[2])
    linear = scale(symbols.base_mass, base_velocity)
    spin = symbols.base_inertia * twist[0]  # about the base COM
    energy = symbols.base_inertia * (twist[0] * twist[0]) + symbols.base_mass * dot(base_velocity, base_velocity)
    for motion in geometry.arm_motions():
        for k, link in enumerate(motion.arm.symbols.links):
            velocity = motion.com_velocity(k)
            momentum = scale(link.mass, velocity)
            com = add(motion.arm.position[k], motion.arm.com_offset(k))
            rate = motion.rate[k]
            linear = add(linear, momentum)
            spin = spin + (link.inertia * rate + cross(com, momentum))
            energy = energy + (link.inertia * (rate * rate) + dot(momentum, velocity))
    return ca.vertcat(*linear), spin + cross(geometry.base_position, linear), 0.5 * energy
