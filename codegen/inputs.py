"""Creates the symbols of the inputs of all functions from the numbers of arms and joints."""

from dataclasses import dataclass

import casadi as ca

CONFIGURATION = ("base_pose", "joint_angles")
STATE = (*CONFIGURATION, "base_twist", "joint_rates")
TARGETS = ("target_masses", "target_inertias", "contacts", "target_twists")

# name: (shape, unit, description)
INPUTS = {
    "base_pose": ((3,), "rad, m, m", "[yaw, x, y] of the base COM, inertial frame"),
    "joint_angles": (("joints",), "rad", "relative joint angles, arm by arm"),
    "base_twist": ((3,), "rad/s, m/s, m/s", "[omega, vx, vy] of the base COM, inertial axes"),
    "joint_rates": (("joints",), "rad/s", "joint rates, arm by arm"),
    "joint_torques": (("joints",), "N m", "joint torques, arm by arm"),
    "base_wrench": ((3,), "N m, N, N", "[n, fx, fy] on the base at its COM, inertial axes"),
    "end_effector_wrenches": (("arms", 3), "N m, N, N", "[n, fx, fy] on the robot at each end effector, inertial axes"),
    "target_masses": (
        ("arms",),
        "kg",
        "mass of each arm's target; 0 (with inertia 0) where the arm captures nothing",
    ),
    "target_inertias": (("arms",), "kg m^2", "inertia of each arm's target about its COM"),
    "contacts": (("arms", 2), "m", "[rx, ry] from the target's COM to the contact point, inertial axes"),
    "target_twists": (
        ("arms", 3),
        "rad/s, m/s, m/s",
        "[omega, vx, vy] of each target's COM before the impact, inertial axes",
    ),
}


@dataclass(frozen=True)
class Inputs:
    """The symbols of all inputs; a list of vectors is held as columns, for CasADi stores matrices by columns."""

    base_pose: ca.SX
    joint_angles: ca.SX
    base_twist: ca.SX
    joint_rates: ca.SX
    joint_torques: ca.SX
    base_wrench: ca.SX
    end_effector_wrenches: ca.SX
    target_masses: ca.SX
    target_inertias: ca.SX
    contacts: ca.SX
    target_twists: ca.SX

    @staticmethod
    def create(arms: int, joints: int) -> "Inputs":
        shapes = input_shapes(arms, joints)
        return Inputs(**{name: ca.SX.sym(name, *reversed(shape)) for name, shape in shapes.items()})


def input_shapes(arms: int, joints: int) -> dict[str, list[int]]:
    """Shapes in row-major order: a list of vectors has one row for each."""
    sizes = {"arms": arms, "joints": joints}
    return {name: [sizes.get(size, size) for size in shape] for name, (shape, _, _) in INPUTS.items()}


def element(name: str, shape: list[int], k: int) -> str:
    """`name[i]` or `name[i][j]` of the k-th element in row-major order."""
    if len(shape) == 1:
        return f"{name}[{k}]"
    return f"{name}[{k // shape[1]}][{k % shape[1]}]"
