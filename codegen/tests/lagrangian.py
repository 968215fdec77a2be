"""Computes all outputs a second time: T from the bodies' positions, M and the bias from T by CasADi's AD.

With q = [base pose; joint angles] the generalised velocity is v = dq/dt, so that

    T = 1/2 sum (m |dp/dt|^2 + I omega^2),   M = d2T/dv2,   bias = d/dt (dT/dv) - dT/dq  at dv/dt = 0,

and everything else follows by numeric linear solves. Nothing of the derivation under test is imported.
"""

from functools import cached_property

import casadi as ca
import numpy as np

from codegen.layout import Layout


def rotate(angle: ca.SX, x: float, y: float) -> ca.SX:
    return ca.vertcat(ca.cos(angle) * x - ca.sin(angle) * y, ca.sin(angle) * x + ca.cos(angle) * y)


def solve(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """matrix^-1 right of a symmetric positive matrix, scaled to a unit diagonal: kg and kg m^2 mix badly."""
    scale = 1 / np.sqrt(np.diag(matrix))
    scaled_right = (right.T * scale).T
    return (np.linalg.solve(matrix * np.outer(scale, scale), scaled_right).T * scale).T


def smallest_pivot(matrix: np.ndarray, order: list[int]) -> float:
    """Smallest L D L^T pivot relative to its diagonal entry; the first is 1 by definition."""
    permuted = matrix[np.ix_(order, order)]
    return min(np.diag(np.linalg.cholesky(permuted)) ** 2 / np.diag(permuted), default=1.0)


class Lagrangian:
    """All functions of a generated model for one layout, by name: inputs by name to outputs by name."""

    def __init__(self, layout: Layout) -> None:
        self.layout, self.arms = layout, len(layout.arms)
        self.joints = sum(len(arm.links) for arm in layout.arms)
        self.size = 3 + self.joints
        q, v = ca.SX.sym("q", self.size), ca.SX.sym("v", self.size)
        origin, yaw = q[1:3], q[0]
        bodies = [(layout.base.mass, layout.base.inertia, ca.vertcat(yaw, origin))]
        end_effectors, joint = [], 3
        for arm in layout.arms:
            point, angle = origin + rotate(yaw, *arm.mount), yaw + arm.mount_angle
            for link in arm.links:
                angle = angle + q[joint]
                joint += 1
                bodies.append((link.mass, link.inertia, ca.vertcat(angle, point + rotate(angle, *link.com))))
                point = point + rotate(angle, link.length, 0.0)
            end_effectors.append(ca.vertcat(angle, point))
        twists = [ca.jtimes(pose, q, v) for _, _, pose in bodies]
        energy = sum(0.5 * (i * t[0] ** 2 + m * ca.sumsqr(t[1:])) for (m, i, _), t in zip(bodies, twists, strict=True))
        angular = sum(i * t[0] + m * (p[1] * t[2] - p[2] * t[1]) for (m, i, p), t in zip(bodies, twists, strict=True))
        momentum = ca.gradient(energy, v)
        end_effector = ca.vertcat(*end_effectors)
        mount = origin + rotate(yaw, *layout.arms[0].mount)
        self.results = {
            "mass": ca.hessian(energy, v)[0],
            "bias": ca.jtimes(momentum, q, v) - ca.gradient(energy, q),
            "energy": energy,
            "linear": sum(m * t[1:] for (m, _, _), t in zip(bodies, twists, strict=True)),
            "angular": angular,
            "body_poses": ca.horzcat(*[pose for _, _, pose in bodies]).T,
            "body_twists": ca.horzcat(*twists).T,
            "end_effectors": ca.horzcat(*end_effectors).T,
            "end_effector_jacobian": ca.jacobian(end_effector, q),
            "mount_jacobian": ca.jacobian(mount, q),
        }
        self.function = ca.Function("lagrangian", [q, v], list(self.results.values()))

    def at(self, state: dict[str, np.ndarray]) -> "State":
        """The robot in one state."""
        q = np.concatenate([state["base_pose"], state["joint_angles"]])
        v = np.concatenate([state["base_twist"], state["joint_rates"]])
        values = zip(self.results, self.function(q, v), strict=True)
        return State(self, state, v, {name: value.full() for name, value in values})


class State:
    """Everything in one state: ``outputs[function][output]``."""

    def __init__(self, robot: Lagrangian, inputs: dict, v: np.ndarray, values: dict[str, np.ndarray]) -> None:
        self.robot, self.inputs, self.v = robot, inputs, v
        self.values = values
        self.mass, self.bias, self.jacobian = values["mass"], values["bias"].ravel(), values["end_effector_jacobian"]

    @cached_property
    def outputs(self) -> dict[str, dict[str, np.ndarray | float]]:
        values, robot, inputs = self.values, self.robot, self.inputs
        jacobian = {"generalized_jacobian": self.generalized_jacobian, "smallest_pivot": self.reduced_pivot}
        torques = np.concatenate([np.zeros(3), inputs["joint_torques"]])
        base = np.concatenate([inputs["base_wrench"], np.zeros(robot.joints)])
        end_effectors = self.jacobian.T @ inputs["end_effector_wrenches"].ravel()
        return {
            "forward_dynamics": self.accelerations(torques),
            "forward_dynamics_with_base_wrench": self.accelerations(torques + base),
            "forward_dynamics_with_wrenches": self.accelerations(torques + base + end_effectors),
            "mass_matrix": {"mass_matrix": self.mass},
            "bias": {"bias": self.bias},
            "reduced_dynamics": {
                "generalized_inertia": self.generalized_inertia,
                "generalized_bias": self.bias[3:] - self.mass[3:, :3] @ solve(self.mass[:3, :3], self.bias[:3]),
                **jacobian,
            },
            "generalized_jacobian": jacobian,
            "end_effector_poses": {"end_effector_poses": values["end_effectors"]},
            "end_effector_jacobian": {"end_effector_jacobian": self.jacobian},
            "end_effector_twists": {"end_effector_twists": (self.jacobian @ self.v).reshape(-1, 3)},
            "body_poses": {"body_poses": values["body_poses"]},
            "body_twists": {"body_twists": values["body_twists"]},
            "momentum": {
                "linear_momentum": values["linear"].ravel(),
                "angular_momentum": values["angular"].item(),
                "kinetic_energy": values["energy"].item(),
            },
            "reduced_impact": self.reduced_impact(),
            "full_impact": self.full_impact(),
        }

    def accelerations(self, forces: np.ndarray) -> dict:
        """M a = forces - bias."""
        a = solve(self.mass, forces - self.bias)
        return {"base_acceleration": a[:3], "joint_accelerations": a[3:], "smallest_pivot": self.mount_pivot}

    @cached_property
    def base_response(self) -> np.ndarray:
        """I_b^-1 I_bm."""
        return solve(self.mass[:3, :3], self.mass[:3, 3:])

    @cached_property
    def generalized_inertia(self) -> np.ndarray:
        return self.mass[3:, 3:] - self.mass[3:, :3] @ self.base_response

    @cached_property
    def generalized_jacobian(self) -> np.ndarray:
        return self.jacobian[:, 3:] - self.jacobian[:, :3] @ self.base_response

    @property
    def reduced_pivot(self) -> float:
        """Inertia of the robot about its COM over that about the base COM: I_b, translations eliminated first."""
        return smallest_pivot(self.mass[:3, :3], [1, 2, 0])

    @property
    def mount_pivot(self) -> float:
        """1 / (A_yy A^-1_yy) of the articulated inertia A at the first mount, base axes, A^-1 = J_p M^-1 J_p^T."""
        yaw = self.inputs["base_pose"][0]
        to_base = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])
        jacobian = to_base @ self.values["mount_jacobian"]
        mobility = jacobian @ solve(self.mass, jacobian.T)
        return 1 / (np.linalg.inv(mobility)[1, 1] * mobility[1, 1])

    def capture(self, inertia: np.ndarray, jacobian: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(G, H) of the paper's (16) with J_t's sign right: v_contact = v + omega x r."""
        inputs = self.inputs
        g, h = inertia.copy(), inertia @ v
        for arm in range(self.robot.arms):
            rx, ry = inputs["contacts"][arm]
            contact = np.array([[1, 0, 0], [-ry, 1, 0], [rx, 0, 1]])
            mass = inputs["target_masses"][arm]
            target = np.diag([inputs["target_inertias"][arm], mass, mass])
            rows = jacobian[3 * arm : 3 * arm + 3]
            coupling = np.linalg.solve(contact.T, target)  # J_t^-T I_t
            g += rows.T @ np.linalg.solve(contact.T, coupling.T).T @ rows
            h += rows.T @ coupling @ inputs["target_twists"][arm]
        return g, h

    def reduced_impact(self) -> dict:
        g, h = self.capture(self.generalized_inertia, self.generalized_jacobian, self.v[3:])
        pivot = smallest_pivot(g, list(reversed(range(self.robot.joints))))
        return {"impact_matrix": g, "impact_momentum": h, "joint_rates_after": solve(g, h), "smallest_pivot": pivot}

    def full_impact(self) -> dict:
        g, h = self.capture(self.mass, self.jacobian, self.v)
        after = solve(g, h)
        return {
            "impact_matrix": g,
            "impact_momentum": h,
            "base_twist_after": after[:3],
            "joint_rates_after": after[3:],
            "smallest_pivot": self.merged_pivot(g),
        }

    def merged_pivot(self, g: np.ndarray) -> float:
        """Smallest pivot of G, from the last links to the base, relative to its value if all bodies outboard moved
        without turning; those of last links and of links without length are left out, which are not below 1."""
        order = [*reversed(range(3, self.robot.size)), 1, 2, 0]
        pivots = dict(zip(order, np.diag(np.linalg.cholesky(g[np.ix_(order, order)])) ** 2, strict=True))
        layout, joint, ratios = self.robot.layout, 3, []
        mass, inertia = layout.base.mass, layout.base.inertia
        for arm, target in zip(layout.arms, self.inputs["target_masses"], strict=True):
            outboard = sum(link.mass for link in arm.links) + target
            mass, inertia = mass + outboard, inertia + outboard * np.dot(arm.mount, arm.mount)
            for k, link in enumerate(arm.links):
                outboard -= link.mass
                if k < len(arm.links) - 1 and link.length != 0:
                    own = link.inertia + link.mass * np.dot(link.com, link.com)
                    ratios.append(pivots[joint] / (own + outboard * link.length**2))
                joint += 1
        return min([*ratios, pivots[0] / inertia, pivots[1] / mass, pivots[2] / mass])
