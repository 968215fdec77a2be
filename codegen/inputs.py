"""Creates the symbols of all inputs of the model's functions from the numbers of arms and joints."""

from dataclasses import dataclass

import casadi as ca

CONFIGURATION = ("base_pose", "joint_angles")

INPUT_TEXT = {
    "base_pose": (["rad", "m", "m"], "[yaw, x, y] of the base COM, inertial frame"),
    "joint_angles": (["rad"], "relative joint angles, arm by arm"),
    "base_twist": (["rad/s", "m/s", "m/s"], "[omega, vx, vy] of the base COM, inertial axes"),
    "joint_rates": (["rad/s"], "joint rates, arm by arm"),
    "joint_torques": (["N m"], "joint torques, arm by arm"),
    "base_wrench": (["N m", "N", "N"], "[n, fx, fy] on the base at its COM, inertial axes"),
    "end_effector_wrenches": (["N m", "N", "N"], "[n, fx, fy] on the robot at each tip, inertial axes"),
    "target_masses": (["kg"], "mass of each arm's target; 0 (with inertia 0) where the arm captures nothing"),
    "target_inertias": (["kg m^2"], "inertia of each arm's target about its COM"),
    "contacts": (["m"], "[rx, ry] from the target's COM to the contact point, inertial axes"),
    "target_twists": (
        ["rad/s", "m/s", "m/s"],
        "[omega, vx, vy] of each target's COM before the impact, inertial axes",
    ),
}


@dataclass(frozen=True)
class Inputs:
    """Symbols of every input that a function of the model can have."""

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
        return Inputs(**{name: ca.SX.sym(name, *transposed(shape)) for name, shape in shapes.items()})


def transposed(shape: list[int]) -> tuple[int, ...]:
    """CasADi stores by columns, the contract by rows: a list of r twists is held as 3 x r."""
    return tuple(reversed(shape))


def input_shapes(arms: int, joints: int) -> dict[str, list[int]]:
    return {
        "base_pose": [3],
        "joint_angles": [joints],
        "base_twist": [3],
        "joint_rates": [joints],
        "joint_torques": [joints],
        "base_wrench": [3],
        "end_effector_wrenches": [arms, 3],
        "target_masses": [arms],
        "target_inertias": [arms],
        "contacts": [arms, 2],
        "target_twists": [arms, 3],
    }


def element(name: str, shape: list[int], k: int) -> str:
    """`name[i]` or `name[i][j]` of the k-th element in row-major order."""
    if len(shape) == 1:
        return f"{name}[{k}]"
    return f"{name}[{k // shape[1]}][{k % shape[1]}]"
