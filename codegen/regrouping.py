"""Regroups sums so that their late terms enter last, which shortens the critical path.

A sum of terms that become known one after the other is evaluated in the order of their times: the two earliest first.
The operations remain the same in kind and number; a partial sum that is used elsewhere, too, is not dissolved, nor one
that belongs to an earlier stage. Products keep their order, for a product of three factors may be finite where that of
two of them is not.
"""

import heapq
from collections import Counter
from collections.abc import Iterable

from .value_numbering import Stage, ValueNumbering

# cycles from operands to result on current processors, about
LATENCIES = {
    "add": 4,
    "sub": 4,
    "mul": 4,
    "div": 13,
    "sqrt": 18,
    "sin": 60,
    "cos": 60,
    "atan2": 150,
    "min": 4,
    "neg": 1,
}
SUMS = ("add", "sub")


class Regrouping:
    """``nodes`` has the new node of every node that the results need; a dissolved partial sum has none, which no node
    that is ``named`` is: those are the values of sections."""

    def __init__(self, numbering: ValueNumbering, results: Iterable[int], named: Iterable[int]) -> None:
        self.numbering = numbering
        self._times: dict[int, int] = {}
        results, named = list(results), set(named)
        reached = sorted(numbering.reachable(results))
        uses = Counter(results)
        users: dict[int, int] = {}
        for i in reached:
            for a in numbering.operands(i):
                uses[a] += 1
                users[a] = i
        inner = {i for i in reached if self._is_sum(i) and uses[i] == 1 and i in users and i not in named}
        self._dissolved = {i for i in inner if self._is_sum(users[i]) and self._same_stage(i, users[i])}
        self.nodes: dict[int, int] = {}
        for i in reached:
            if i not in self._dissolved:
                self.nodes[i] = self._sum(i) if self._is_sum(i) else self._copy(i)

    def _is_sum(self, i: int) -> bool:
        return self.numbering[i].op in SUMS

    def _same_stage(self, i: int, k: int) -> bool:
        return self.numbering[i].stage == self.numbering[k].stage

    def _copy(self, i: int) -> int:
        node = self.numbering[i]
        return i if node.is_leaf else self.numbering.operation(node.op, *(self.nodes[a] for a in node.args))

    def _sum(self, i: int) -> int:
        """The sum of the terms of a node, earliest first."""
        queue = [(self._time(node), k, node, sign) for k, (node, sign) in enumerate(self._terms(i, 1))]
        heapq.heapify(queue)
        count = len(queue)
        while len(queue) > 1:
            _, first, a, sign = heapq.heappop(queue)
            _, second, b, other = self._next(queue, a)
            if first > second and count == 2:
                a, sign, b, other = b, other, a, sign
            if sign < 0 < other:
                a, sign, b, other = b, other, a, sign
            total = self.numbering.operation("add" if sign == other else "sub", a, b)
            heapq.heappush(queue, (self._time(total), count, total, sign))
            count += 1
        _, _, total, sign = queue[0]
        return total if sign > 0 else self.numbering.operation("neg", total)

    def _next(self, queue: list[tuple[int, int, int, int]], a: int) -> tuple[int, int, int, int]:
        """Takes the earliest term that can be added to one; what depends on parameters alone is a constant with a name,
        and two of them have no named sum, unless the whole sum depends on parameters alone."""
        passed = []
        while queue and self.numbering[a].stage == self.numbering[queue[0][2]].stage == Stage.PARAMETERS:
            passed.append(heapq.heappop(queue))
        found = heapq.heappop(queue) if queue else passed.pop(0)
        for term in passed:
            heapq.heappush(queue, term)
        return found

    def _terms(self, i: int, sign: int) -> Iterable[tuple[int, int]]:
        node = self.numbering[i]
        for a, own in zip(node.args, (sign, -sign if node.op == "sub" else sign), strict=True):
            if a in self._dissolved:
                yield from self._terms(a, own)
            else:
                yield self.nodes[a], own

    def _time(self, i: int) -> int:
        """Cycles until a node is known."""
        if i not in self._times:
            operands = self.numbering.operands(i)
            start = max((self._time(a) for a in operands), default=0)
            self._times[i] = start + LATENCIES.get(self.numbering[i].op, 0)
        return self._times[i]
