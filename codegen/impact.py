"""Computes matrix and momentum of a rigid capture, eq. (16), from the Jacobian, inertia and momentum of the robot.

The contact point of a target has the velocity v + omega x r, so that J_t = [[1, 0, 0], [-r_y, 1, 0], [r_x, 0, 1]] per
target in eq. (5); the print has the cross-product matrix of r with the other sign. After the capture, t_tf = K v with
K = J_t^-1 J, eqs. (13) and (14). The momentum balance of eqs. (10) and (11) then reads G v_f = H, eq. (15). It is
exact in the full coordinates, where J, I and θ̇ are [J_be J_me], M and v of eq. (1); `rigid_capture.py` solves it there
body by body.

In the reduced coordinates all joints are coupled, and single assignments grow with their cube. Above a size a module
computes eqs. (15) and (16) in loops, from I and J, which the function then has as matrices.
"""

import casadi as ca

from .equations_of_motion import EquationsOfMotion
from .inputs import CONFIGURATION, STATE, TARGETS, Inputs
from .linear_algebra import ldlt_solve, matrix_times
from .reduced_dynamics import ReducedDynamics, generalized_matrices
from .rigid_capture import RigidCapture
from .signatures import Family, Function, Section, matrix, smallest_pivot, vector

# Products in G and in its factorization: with more of them loops are not slower than single assignments, which leave
# the processor's instruction cache, and compile faster. Two arms of five links have 933, three of three 972.
LARGEST_IN_ASSIGNMENTS = 950


def target_jacobian(jacobian: ca.SX, arm: int, contact: tuple[ca.SX, ca.SX]) -> list[ca.SX]:
    """Rows [omega, vx, vy] of K = J_t^-1 J of one arm's target, eq. (14)."""
    angular, x, y = (jacobian[3 * arm + row, :] for row in range(3))
    return [angular, x + contact[1] * angular, y - contact[0] * angular]


def impact_equations(
    jacobian: ca.SX, inertia: ca.SX, momentum: ca.SX, inputs: Inputs
) -> tuple[ca.SX, ca.SX, list[Section]]:
    """(G, H, sections) of eq. (16), as G = inertia + sum K^T I_t K and H = momentum + sum K^T I_t t_ti.

    An arm whose target has no mass and no inertia captures nothing.
    """
    size = inertia.shape[0]
    g = ca.SX(ca.tril(inertia))
    h = ca.SX(momentum)
    sections = [Section("momentum before the impact", momentum)]
    for arm in range(inputs.contacts.shape[1]):
        rows = target_jacobian(jacobian, arm, (inputs.contacts[0, arm], inputs.contacts[1, arm]))
        weights = [inputs.target_inertias[arm], inputs.target_masses[arm], inputs.target_masses[arm]]  # I_t
        for row, weight, twist in zip(rows, weights, ca.vertsplit(inputs.target_twists[:, arm]), strict=True):
            for k in range(size):
                if not row.sparsity().has_nz(0, k):
                    continue
                weighted = weight * row[0, k]
                h[k] = h[k] + weighted * twist
                for j in range(k + 1):
                    if row.sparsity().has_nz(0, j):
                        g[k, j] = g[k, j] + weighted * row[0, j]
        sections.append(Section(f"target of arm {arm + 1}", g, h))
    return ca.tril2symm(g), h, sections


def is_in_loops(arms: int, joints: int) -> bool:
    """Whether a module computes the reduced impact in loops."""
    return 3 * arms * joints**2 + joints**3 // 3 > LARGEST_IN_ASSIGNMENTS


def reduced_impact(reduced: ReducedDynamics, inputs: Inputs) -> Function:
    """Eqs. (15) and (16) in the reduced coordinates, as the paper has them."""
    inertia, jacobian = reduced.generalized_inertia(), reduced.generalized_jacobian()
    reduced_sections = [Section("generalized inertia", inertia), Section("generalized Jacobian", jacobian)]
    g, h, equations = impact_equations(jacobian, inertia, matrix_times(inertia, inputs.joint_rates), inputs)
    joints = reduced.symbols.joints
    rates, pivot, solution = ldlt_solve(reduced.symbols, g, h, [*reversed(range(joints))])
    in_loops = is_in_loops(inputs.contacts.shape[1], joints)
    return Function(
        "reduced_impact",
        "Impact by the paper's equations; exact only if the robot has no momentum after it.",
        "G = J^T N J + I,  H = J^T J_t^-T I_t t_ti + I joint_rates,  G x = H,  N = J_t^-T I_t J_t^-1",
        "Raina & Shah (2017), eqs. (15), (16), with the sign of `J_t` corrected",
        [*CONFIGURATION, "joint_rates", *TARGETS],
        [
            matrix("impact_matrix", "kg m^2", "G, symmetric, row-major", g),
            vector("impact_momentum", "N m s", "H, arm by arm", h),
            vector("joint_rates_after", "rad/s", "arm by arm", rates),
            smallest_pivot(pivot),
        ],
        [*reduced_sections, *equations, *solution],
        generalized_matrices(inertia, jacobian) if in_loops else [],
    )


def full_impact(equations: EquationsOfMotion, inputs: Inputs) -> Function:
    """Eqs. (15) and (16) in the full coordinates, where they are exact."""
    jacobian, mass = equations.kinematics.end_effector_jacobian(), equations.mass_matrix()
    velocity = ca.vertcat(inputs.base_twist, inputs.joint_rates)
    full_sections = [Section("mass matrix", mass), Section("end-effector Jacobian", jacobian)]
    g, h, impact = impact_equations(jacobian, mass, matrix_times(mass, velocity), inputs)
    capture = RigidCapture(equations, inputs)
    matrix_text = "G, symmetric, row-major: mass matrix of the merged robot"
    base_text = "[omega, vx, vy] of the base COM, inertial axes"
    return Function(
        "full_impact",
        "Exact impact: the same equations in the full coordinates.",
        "G = M + J_e^T N J_e,  H = M v + J_e^T J_t^-T I_t t_ti,  N = J_t^-T I_t J_t^-1,  v_after = G^-1 H",
        "Raina & Shah (2017), eqs. (1), (3), (13), without the reduction",
        [*STATE, *TARGETS],
        [
            matrix("impact_matrix", "kg m^2, kg m, kg", matrix_text, g),
            vector("impact_momentum", "N m s, N s, N s, then N m s", "H, base then joints", h),
            vector("base_twist_after", "rad/s, m/s, m/s", base_text, capture.velocity[:3]),
            vector("joint_rates_after", "rad/s", "arm by arm", capture.velocity[3:]),
            smallest_pivot(capture.smallest_pivot),
        ],
        [*full_sections, *impact, *capture.sections],
    )


def impact_family(reduced: ReducedDynamics, inputs: Inputs) -> Family:
    functions = [reduced_impact(reduced, inputs), full_impact(reduced.equations, inputs)]
    return Family("impact", "Rigid capture of one target per arm.", functions, reduced.sections)
