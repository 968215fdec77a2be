"""Numbers the values of scalar expressions: equal operations on equal operands are the same node.

Negations move outwards until a sum or difference absorbs them. Each node belongs to the earliest of three stages in
which it can be computed: from parameters, from the configuration, or in the call.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum

LEAVES = ("number", "input", "parameter", "constant")


class Stage(IntEnum):
    """What a value depends on, besides earlier stages."""

    PARAMETERS = 0
    CONFIGURATION = 1
    CALL = 2


class DerivationError(Exception):
    """The derivation broke one of its own rules."""


@dataclass(frozen=True)
class Node:
    """An operation on nodes, or a leaf: a number, a parameter, a constant or an element of an input."""

    op: str
    args: tuple
    stage: Stage

    @property
    def is_leaf(self) -> bool:
        return self.op in LEAVES


class ValueNumbering:
    """Nodes by number."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._numbers: dict[tuple, int] = {}

    def __getitem__(self, number: int) -> Node:
        return self.nodes[number]

    def operands(self, number: int) -> tuple[int, ...]:
        """The nodes that an operation is on; none of a leaf."""
        node = self.nodes[number]
        return () if node.is_leaf else node.args

    def reachable(self, numbers: Iterable[int]) -> set[int]:
        """The nodes and all that they depend on."""
        found, stack = set(), [*numbers]
        while stack:
            i = stack.pop()
            if i not in found:
                found.add(i)
                stack.extend(self.operands(i))
        return found

    def find(self, op: str, *args: int) -> int | None:
        """The number of an operation that exists."""
        return self._numbers.get((op, *args))

    def leaf(self, op: str, value: str | float, stage: Stage) -> int:
        return self._number(op, (value,), stage)

    def operation(self, op: str, *args: int) -> int:
        """The number of an operation, after its negations are moved outwards."""
        if op == "neg":
            return self._negation(args[0])
        if op in ("add", "sub"):
            return self._sum(op, *args)
        if op in ("mul", "div"):
            return self._product(op, *args)
        return self._operation(op, args)

    def _number(self, op: str, args: tuple, stage: Stage) -> int:
        key = (op, *args)
        if key not in self._numbers:
            self._numbers[key] = len(self.nodes)
            self.nodes.append(Node(op, args, stage))
        return self._numbers[key]

    def _operation(self, op: str, args: tuple) -> int:
        return self._number(op, args, max(self[a].stage for a in args))

    def _is_negation(self, a: int) -> bool:
        return self[a].op == "neg"

    def _operand(self, a: int) -> int:
        return self[a].args[0]

    def _negation(self, a: int) -> int:
        node = self[a]
        if node.op == "neg":
            return node.args[0]
        if node.op == "sub":
            return self._sum("sub", node.args[1], node.args[0])
        return self._operation("neg", (a,))

    def _sum(self, op: str, a: int, b: int) -> int:
        if self._is_negation(b):
            return self._sum("sub" if op == "add" else "add", a, self._operand(b))
        if self._is_negation(a):
            if op == "add":
                return self._sum("sub", b, self._operand(a))
            return self._negation(self._sum("add", self._operand(a), b))
        return self._ordered(op, a, b, commutes=op == "add")

    def _product(self, op: str, a: int, b: int) -> int:
        if self._is_negation(a) or self._is_negation(b):
            odd = self._is_negation(a) != self._is_negation(b)
            a = self._operand(a) if self._is_negation(a) else a
            b = self._operand(b) if self._is_negation(b) else b
            product = self._product(op, a, b)
            return self._negation(product) if odd else product
        return self._ordered(op, a, b, commutes=op == "mul")

    def _ordered(self, op: str, a: int, b: int, commutes: bool) -> int:
        """The operation on operands in the order of their numbers, where they commute."""
        return self._operation(op, (b, a) if commutes and a > b else (a, b))
