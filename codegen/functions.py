"""Every function of a generated model: what it computes, from what, with which units, and its derivation.

A *family* shares what depends on the configuration alone (base pose and joint angles); its functions add
velocities and forces.
"""

from collections.abc import Callable

import casadi as ca

from .equations_of_motion import EquationsOfMotion
from .forward_dynamics import ForwardDynamics
from .impact import impact_matrix
from .inputs import CONFIGURATION, Inputs, input_shapes
from .kinematics import Geometry
from .layout import Layout
from .linear_algebra import ldlt_solve, matrix_times
from .momentum import momentum
from .reduced_dynamics import ReducedDynamics
from .signatures import Family, Function, matrix, per_item, pivot, scalar, vector
from .symbols import Symbols


class Model:
    """The families of one layout."""

    def __init__(self, layout: Layout, progress: Callable[[str], None] = lambda family: None) -> None:
        self.layout = layout
        self.symbols = Symbols(layout)
        self.arms, self.joints = len(layout.arms), self.symbols.joints
        self.inputs = Inputs.create(self.arms, self.joints)
        self.input_shapes = input_shapes(self.arms, self.joints)
        self.families = []
        for derive in (
            self._forward_dynamics,
            self._equations_of_motion,
            self._reduced_dynamics,
            self._end_effectors,
            self._bodies,
            self._momentum,
            self._impact,
        ):
            progress(derive.__name__.strip("_").replace("_", " "))
            self.families.append(derive())
        progress("single assignments")

    def _geometry(self) -> Geometry:
        return Geometry(self.symbols, self.inputs)

    def _forward_dynamics(self) -> Family:
        dynamics = ForwardDynamics(self.symbols, self.inputs)
        self.needs_distinct_mounts = dynamics.needs_distinct_mounts
        motion = [*CONFIGURATION, "base_twist", "joint_rates", "joint_torques"]
        variants = [
            ("forward_dynamics", "joint torques alone", motion, (False, False), "[0; tau_m]"),
            (
                "forward_dynamics_with_base_wrench",
                "joint torques and a base wrench",
                [*motion, "base_wrench"],
                (True, False),
                "[F_b; tau_m]",
            ),
            (
                "forward_dynamics_with_wrenches",
                "joint torques, a base wrench and end-effector wrenches",
                [*motion, "base_wrench", "end_effector_wrenches"],
                (True, True),
                "[F_b; tau_m] + [J_be J_me]^T F_e",
            ),
        ]
        functions = []
        for name, what, inputs, absent, right in variants:
            base, joints = dynamics.solve(*absent)
            functions.append(
                Function(
                    name,
                    f"Accelerations of the free-floating robot under {what}.",
                    f"M [base_acceleration; joint_accelerations] + [c_b; c_m] = {right}",
                    "Raina & Shah (2017), eq. (1)",
                    inputs,
                    [
                        vector(
                            "base_acceleration",
                            "rad/s^2, m/s^2, m/s^2",
                            "[alpha, ax, ay] of the base COM, inertial axes",
                            base,
                        ),
                        vector("joint_accelerations", "rad/s^2", "arm by arm", joints),
                        pivot(dynamics.smallest_pivot()),
                    ],
                )
            )
        return Family("forward_dynamics", "Forward dynamics by articulated plane masses in link frames.", functions)

    def _equations_of_motion(self) -> Family:
        equations = EquationsOfMotion(self.symbols, self._geometry())
        return Family(
            "equations_of_motion",
            "Mass matrix and bias in the full coordinates, by composite suffixes in absolute angles.",
            [
                Function(
                    "mass_matrix",
                    "Mass matrix of the full coordinates (base twist, then joint rates); symmetric.",
                    "M = [[I_b, I_bm], [I_bm^T, I_m]]",
                    "Raina & Shah (2017), eq. (1)",
                    list(CONFIGURATION),
                    [matrix("mass_matrix", "kg m^2, kg m, kg", "row-major", equations.mass_matrix())],
                ),
                Function(
                    "bias",
                    "Velocity-dependent forces: the generalized forces that hold all accelerations at zero.",
                    "[c_b; c_m]",
                    "Raina & Shah (2017), eq. (1)",
                    [*CONFIGURATION, "base_twist", "joint_rates"],
                    [vector("bias", "N m, N, N, then N m", "base, then joints", equations.bias())],
                ),
            ],
        )

    def _reduced_dynamics(self) -> Family:
        reduced = ReducedDynamics(self.symbols, EquationsOfMotion(self.symbols, self._geometry()))
        inertia = matrix("generalized_inertia", "kg m^2", "symmetric, row-major", reduced.generalized_inertia())
        bias = vector("generalized_bias", "N m", "arm by arm", reduced.generalized_bias())
        jacobian = matrix(
            "generalized_jacobian",
            "1, m, m per arm",
            "3 rows [omega, vx, vy] per arm, inertial axes: tip twists of a robot of zero momentum",
            reduced.generalized_jacobian(),
        )
        source = "Raina & Shah (2017), eq. (2); Umetani & Yoshida (1989)"
        return Family(
            "reduced_dynamics",
            "The free-floating robot in joint coordinates alone: the base is eliminated.",
            [
                Function(
                    "reduced_dynamics",
                    "Generalized inertia, bias and Jacobian together.",
                    "I = I_m - I_bm^T I_b^-1 I_bm,  c = c_m - I_bm^T I_b^-1 c_b,  J = J_me - J_be I_b^-1 I_bm",
                    source,
                    [*CONFIGURATION, "base_twist", "joint_rates"],
                    [inertia, bias, jacobian, pivot(reduced.smallest_pivot())],
                ),
                Function(
                    "generalized_jacobian",
                    "Generalized Jacobian alone.",
                    "J = J_me - J_be I_b^-1 I_bm",
                    source,
                    list(CONFIGURATION),
                    [jacobian, pivot(reduced.smallest_pivot())],
                ),
            ],
        )

    def _end_effectors(self) -> Family:
        geometry = self._geometry()
        source = "Raina & Shah (2017), eq. (1)"
        return Family(
            "end_effectors",
            "Poses, Jacobian and twists of the tips.",
            [
                Function(
                    "end_effector_poses",
                    "Pose of each tip; the yaw is not wrapped.",
                    "p_e = p_b + R(yaw) mount + sum of R(phi_k) [l_k, 0]",
                    source,
                    list(CONFIGURATION),
                    [
                        per_item(
                            "end_effector_poses",
                            "rad, m, m",
                            "[yaw, x, y] per arm, inertial frame",
                            geometry.end_effector_poses(),
                        )
                    ],
                ),
                Function(
                    "end_effector_jacobian",
                    "Jacobian of the tips in the full coordinates.",
                    "t_e = [J_be J_me] [t_b; joint rates]",
                    source,
                    list(CONFIGURATION),
                    [
                        matrix(
                            "end_effector_jacobian",
                            "1, m",
                            "3 rows [omega, vx, vy] per arm, columns base then joints",
                            geometry.end_effector_jacobian(),
                        )
                    ],
                ),
                Function(
                    "end_effector_twists",
                    "Twist of each tip.",
                    "t_e = J_be t_b + J_me joint rates",
                    source,
                    [*CONFIGURATION, "base_twist", "joint_rates"],
                    [
                        per_item(
                            "end_effector_twists",
                            "rad/s, m/s, m/s",
                            "[omega, vx, vy] per arm, inertial axes",
                            geometry.end_effector_twists(),
                        )
                    ],
                ),
            ],
        )

    def _bodies(self) -> Family:
        geometry = self._geometry()
        return Family(
            "bodies",
            "Motion of every body's COM: the base, then the links arm by arm.",
            [
                Function(
                    "body_poses",
                    "Pose of every body, at its COM.",
                    "[phi_k, p_k + R(phi_k) c_k]",
                    "rigid-body kinematics",
                    list(CONFIGURATION),
                    [
                        per_item(
                            "body_poses",
                            "rad, m, m",
                            "[yaw, x, y] per body, inertial frame",
                            geometry.body_poses(),
                        )
                    ],
                ),
                Function(
                    "body_twists",
                    "Twist of every body's COM.",
                    "v_c = v_b + sum of omega x arm",
                    "rigid-body kinematics",
                    [*CONFIGURATION, "base_twist", "joint_rates"],
                    [
                        per_item(
                            "body_twists",
                            "rad/s, m/s, m/s",
                            "[omega, vx, vy] per body, inertial axes",
                            geometry.body_twists(),
                        )
                    ],
                ),
            ],
        )

    def _momentum(self) -> Family:
        linear, angular, energy = momentum(self._geometry())
        return Family(
            "momentum",
            "Momentum and kinetic energy, body by body.",
            [
                Function(
                    "momentum",
                    "Linear momentum, angular momentum about the inertial origin, kinetic energy.",
                    "p = sum m v,  l = sum (I omega + r x m v),  T = 1/2 sum (I omega^2 + m v^2)",
                    "Raina & Shah (2017), eq. (17)",
                    [*CONFIGURATION, "base_twist", "joint_rates"],
                    [
                        vector("linear_momentum", "N s", "[px, py], inertial axes", linear),
                        scalar("angular_momentum", "N m s", "about the inertial origin", angular),
                        scalar("kinetic_energy", "J", "of all bodies", energy),
                    ],
                )
            ],
        )

    def _impact(self) -> Family:
        targets = ["target_masses", "target_inertias", "contacts", "target_twists"]
        geometry = self._geometry()
        equations = EquationsOfMotion(self.symbols, geometry)
        reduced = ReducedDynamics(self.symbols, equations)
        joints = list(range(self.joints))
        inertia = reduced.generalized_inertia()
        momentum = matrix_times(inertia, self.inputs.joint_rates)
        g, h = impact_matrix(reduced.generalized_jacobian(), inertia, momentum, self.inputs)
        rates, smallest = ldlt_solve(self.symbols, g, h, joints[::-1])
        mass = equations.mass_matrix()
        velocity = ca.vertcat(self.inputs.base_twist, self.inputs.joint_rates)
        full_g, full_h = impact_matrix(
            geometry.end_effector_jacobian(), mass, matrix_times(mass, velocity), self.inputs
        )
        # from the tips to the base: small pivots first, as the tree has them
        order = [*reversed(range(3, 3 + self.joints)), 1, 2, 0]
        after, full_smallest = ldlt_solve(self.symbols, full_g, full_h, order)
        return Family(
            "impact",
            "Rigid capture of one target per arm.",
            [
                Function(
                    "reduced_impact",
                    "The paper's impact, literally; exact only for a robot without momentum after it.",
                    "G = J^T N J + I,  H = J^T J_t^-T I_t t_ti + I joint_rates,  G x = H,  N = J_t^-T I_t J_t^-1",
                    "Raina & Shah (2017), eqs. (15), (16), with the sign of `J_t` corrected",
                    [*CONFIGURATION, "joint_rates", *targets],
                    [
                        matrix("impact_matrix", "kg m^2", "G, symmetric, row-major", g),
                        vector("impact_momentum", "N m s", "H, arm by arm", h),
                        vector("joint_rates_after", "rad/s", "arm by arm", rates),
                        pivot(smallest),
                    ],
                ),
                Function(
                    "full_impact",
                    "The exact impact: the same G and H in the full coordinates.",
                    "G = M + J_e^T N J_e,  H = M v + J_e^T J_t^-T I_t t_ti,  N = J_t^-T I_t J_t^-1,  v_after = G^-1 H",
                    "Raina & Shah (2017), eqs. (1), (3), (13), without the reduction",
                    [*CONFIGURATION, "base_twist", "joint_rates", *targets],
                    [
                        matrix(
                            "impact_matrix",
                            "kg m^2, kg m, kg",
                            "G, symmetric, row-major: mass matrix of the merged robot",
                            full_g,
                        ),
                        vector("impact_momentum", "N m s, N s, N s, then N m s", "H, base then joints", full_h),
                        vector(
                            "base_twist_after",
                            "rad/s, m/s, m/s",
                            "[omega, vx, vy] of the base COM, inertial axes",
                            after[:3],
                        ),
                        vector("joint_rates_after", "rad/s", "arm by arm", after[3:]),
                        pivot(full_smallest),
                    ],
                ),
            ],
        )
