"""Computes the solution of a symmetric linear system, and a matrix-vector product, from structural nonzeros alone."""

import casadi as ca

from .plane_vectors import ZERO
from .signatures import Section
from .symbols import Symbols


class LdltFactors:
    """L D L^T of a symmetric matrix in the given order.

    With the joints before the base, blocks of different arms do not fill in. ``smallest_pivot`` is relative to its
    diagonal entry.
    """

    def __init__(self, symbols: Symbols, matrix: ca.SX, order: list[int]) -> None:
        self.order, self.size = order, len(order)
        work = self.entries = {
            (i, j): matrix[order[i], order[j]]
            for i in range(self.size)
            for j in range(i + 1)
            if matrix.sparsity().has_nz(order[i], order[j])
        }
        diagonal = [work[i, i] for i in range(self.size)]
        self.inverse, smallest = [], None
        for k in range(self.size):
            ratio = work[k, k] / diagonal[k]
            if k > 0:
                smallest = ratio if smallest is None else ca.fmin(smallest, ratio)
            self.inverse.append(symbols.reciprocal(work[k, k]))
            column = [i for i in range(k + 1, self.size) if (i, k) in work]
            factor = {i: work[i, k] * self.inverse[k] for i in column}
            for i in column:
                for j in [j for j in column if j <= i]:
                    work[i, j] = work.get((i, j), ZERO) - factor[i] * work[j, k]
            for i in column:
                work[i, k] = factor[i]
        self.smallest_pivot = ca.SX(1) if smallest is None else smallest

    @property
    def section(self) -> Section:
        return Section("factorization", list(self.entries.values()), self.inverse)

    def solve(self, right: ca.SX) -> tuple[ca.SX, list[Section]]:
        """(x, sections) of matrix x = right."""
        x = [right[i] for i in self.order]
        for k in range(self.size):
            for i in range(k + 1, self.size):
                if (i, k) in self.entries:
                    x[i] = x[i] - self.entries[i, k] * x[k]
        forward = Section("forward substitution", x)
        x = [*x]
        for k in reversed(range(self.size)):
            x[k] = x[k] * self.inverse[k]
            for i in range(k + 1, self.size):
                if (i, k) in self.entries:
                    x[k] = x[k] - self.entries[i, k] * x[i]
        solution = ca.SX(self.size, 1)
        for i, value in zip(self.order, x, strict=True):
            solution[i] = value
        return solution, [forward, Section("back substitution", x)]


def ldlt_solve(symbols: Symbols, matrix: ca.SX, right: ca.SX, order: list[int]) -> tuple[ca.SX, ca.SX, list[Section]]:
    """(x, smallest pivot relative to its diagonal entry, sections) of matrix x = right, by L D L^T in this order."""
    factors = LdltFactors(symbols, matrix, order)
    solution, sections = factors.solve(right)
    return solution, factors.smallest_pivot, [factors.section, *sections]


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
