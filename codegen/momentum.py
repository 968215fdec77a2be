"""Computes momentum and kinetic energy of the robot from the motion of its bodies."""

import casadi as ca

from .inputs import STATE
from .kinematics import Kinematics
from .plane_vectors import add, cross, dot, scale
from .signatures import Family, Function, Section, scalar, vector


def momentum(kinematics: Kinematics) -> tuple[ca.SX, ca.SX, ca.SX, list[Section]]:
    """(p, l, T, sections): p and l of eq. (17), l about the inertial origin, and the kinetic energy."""
    symbols, twist = kinematics.symbols, kinematics.inputs.base_twist
    base_velocity = (twist[1], twist[2])
    linear = scale(symbols.base_mass, base_velocity)
    angular = symbols.base_inertia * twist[0]  # about the base COM
    twice_energy = symbols.base_inertia * (twist[0] * twist[0]) + symbols.base_mass * dot(base_velocity, base_velocity)
    sections = []
    for positions, velocities in zip(kinematics.arms, kinematics.velocities, strict=True):
        for k, link in enumerate(positions.symbols.links):
            rate, velocity = velocities.angular[k], velocities.com(k)
            com = add(positions.joint[k], positions.com_offset(k))
            link_momentum = scale(link.mass, velocity)
            linear = add(linear, link_momentum)
            angular = angular + (link.inertia * rate + cross(com, link_momentum))
            twice_energy = twice_energy + (link.inertia * (rate * rate) + dot(link_momentum, velocity))
        sections.append(Section(f"{positions.symbols.title}, momentum and energy", linear, angular, twice_energy))
    angular = angular + cross(kinematics.base_position, linear)
    return ca.vertcat(*linear), angular, 0.5 * twice_energy, sections


def momentum_family(kinematics: Kinematics) -> Family:
    linear, angular, energy, sections = momentum(kinematics)
    function = Function(
        "momentum",
        "Linear momentum, angular momentum about the inertial origin, kinetic energy.",
        "p = sum m v,  l = sum (I omega + r x m v),  T = 1/2 sum (I omega^2 + m v^2)",
        "Raina & Shah (2017), eq. (17)",
        [*STATE],
        [
            vector("linear_momentum", "N s", "[px, py], inertial axes", linear),
            scalar("angular_momentum", "N m s", "about the inertial origin", angular),
            scalar("kinetic_energy", "J", "of all bodies", energy),
        ],
    )
    description = "Momentum and kinetic energy, body by body."
    return Family("momentum", description, [function], [*kinematics.sections, *sections])
