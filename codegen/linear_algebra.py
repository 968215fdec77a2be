"""Computes the solution of a symmetric linear system, and a matrix-vector product, from structural nonzeros alone."""

import casadi as ca

from .plane_vectors import ZERO
from .signatures import Section
from .symbols import Symbols


def ldlt_solve(symbols: Symbols, matrix: ca.SX, right: ca.SX, order: list[int]) -> tuple[ca.SX, ca.SX, list[Section]]:
    """(x, smallest pivot relative to its diagonal entry, sections) of matrix x = right, by L D L^T in the given order.

    With the joints before the base, blocks of different arms do not fill in.
    """
    size = len(order)
    work = {
        (i, j): matrix[order[i], order[j]]
        for i in range(size)
        for j in range(i + 1)
        if matrix.sparsity().has_nz(order[i], order[j])
    }
    diagonal = [work[i, i] for i in range(size)]
    x = [right[order[i]] for i in range(size)]
    inverse, smallest = [], None
    for k in range(size):
        ratio = work[k, k] / diagonal[k]
        if k > 0:
            smallest = ratio if smallest is None else ca.fmin(smallest, ratio)
        inverse.append(symbols.reciprocal(work[k, k]))
        column = [i for i in range(k + 1, size) if (i, k) in work]
        factor = {i: work[i, k] * inverse[k] for i in column}
        for i in column:
            for j in [j for j in column if j <= i]:
                work[i, j] = work.get((i, j), ZERO) - factor[i] * work[j, k]
            x[i] = x[i] - factor[i] * x[k]
        for i in column:
            work[i, k] = factor[i]
    sections = [Section("factorization", list(work.values()), inverse), Section("forward substitution", x)]
    for k in reversed(range(size)):
        x[k] = x[k] * inverse[k]
        for i in range(k + 1, size):
            if (i, k) in work:
                x[k] = x[k] - work[i, k] * x[i]
    solution = ca.SX(size, 1)
    for i, value in zip(order, x, strict=True):
        solution[i] = value
    sections.append(Section("back substitution", x))
    return solution, ca.SX(1) if smallest is None else smallest, sections


def matrix_times(matrix: ca.SX, vector: ca.SX) -> ca.SX:
    """matrix vector."""
    rows, columns = matrix.shape
    result = []
    for i in range(rows):
        total = ZERO
        for j in range(columns):
            if matrix.sparsity().has_nz(i, j):
                total = total + matrix[i, j] * vector[j]
        result.append(total)
    return ca.vertcat(*result)
