"""Impact matrices: the paper's (16) in reduced coordinates, and the same in full coordinates, which is exact.

v_contact = v + omega x r, so J_t = [[1, 0, 0], [-r_y, 1, 0], [r_x, 0, 1]] per target (the print has r's
cross-product matrix with the other sign). K = J_t^-1 J maps the robot's velocities to the twist that the
target's COM has when it moves with the tip, so J^T J_t^-T I_t J_t^-1 J = K^T I_t K: a sum of squares.
A target of zero mass and inertia is no target: its arm captures nothing.
"""

import casadi as ca

from .inputs import Inputs


def captured_jacobian(jacobian: ca.SX, arm: int, contact: tuple[ca.SX, ca.SX]) -> list[ca.SX]:
    """Rows [omega, vx, vy] of K = J_t^-1 J for one arm."""
    spin, x, y = (jacobian[3 * arm + row, :] for row in range(3))
    return [spin, x + contact[1] * spin, y - contact[0] * spin]


def impact_matrix(jacobian: ca.SX, inertia: ca.SX, momentum: ca.SX, inputs: Inputs) -> tuple[ca.SX, ca.SX]:
    """(G, H) = (inertia + sum K^T I_t K, momentum + sum K^T I_t t_ti)."""
    size = inertia.shape[0]
    lower = ca.SX(ca.tril(inertia))
    right = ca.SX(momentum)
    for arm in range(inputs.contacts.shape[1]):
        rows = captured_jacobian(jacobian, arm, (inputs.contacts[0, arm], inputs.contacts[1, arm]))
        weights = [inputs.target_inertias[arm], inputs.target_masses[arm], inputs.target_masses[arm]]
        for row, weight, twist in zip(rows, weights, ca.vertsplit(inputs.target_twists[:, arm]), strict=True):
            for k in range(size):
                if not row.sparsity().has_nz(0, k):
                    continue
                weighted = weight * row[0, k]
                right[k] = right[k] + weighted * twist
                for j in range(k + 1):
                    if row.sparsity().has_nz(0, j):
                        lower[k, j] = lower[k, j] + weighted * row[0, j]
    return ca.tril2symm(lower), right
