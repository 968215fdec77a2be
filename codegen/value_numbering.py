"""Value-numbered operations: building the same value twice gives the same node.

Negations are moved to where they vanish into a subtraction. Each node is put in the earliest of three
stages in which it can be computed: parameters, configuration, call.
"""

from dataclasses import dataclass

PARAMETER, SETUP, CALL = 0, 1, 2
LEAVES = ("number", "input", "parameter", "constant")


class DerivationError(Exception):
    """The derivation broke one of its own rules."""


@dataclass(frozen=True)
class Node:
    """An operation on nodes, or a leaf: a number, an element of an input, a parameter or constant."""

    op: str
    args: tuple
    stage: int


class Nodes:
    """Value-numbered nodes: building the same operation twice gives the same node."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._index: dict[tuple, int] = {}

    def leaf(self, op: str, value, stage: int) -> int:
        return self._intern(op, (value,), stage)

    def _intern(self, op: str, args: tuple, stage: int) -> int:
        key = (op, *args)
        if key not in self._index:
            self._index[key] = len(self.nodes)
            self.nodes.append(Node(op, args, stage))
        return self._index[key]

    def _is_negative(self, a: int) -> bool:
        return self.nodes[a].op == "neg"

    def _inner(self, a: int) -> int:
        return self.nodes[a].args[0]

    def operation(self, op: str, *args: int) -> int:
        if op == "neg":
            return self._negate(args[0])
        if op in ("add", "sub"):
            return self._sum(op, *args)
        if op in ("mul", "div"):
            return self._product(op, *args)
        return self._intern(op, args, self._stage(args))

    def _stage(self, args: tuple) -> int:
        return max(self.nodes[a].stage for a in args)

    def _negate(self, a: int) -> int:
        node = self.nodes[a]
        if node.op == "neg":
            return node.args[0]
        if node.op == "sub":
            return self._sum("sub", node.args[1], node.args[0])
        return self._intern("neg", (a,), node.stage)

    def _sum(self, op: str, a: int, b: int) -> int:
        if self._is_negative(b):
            return self._sum("sub" if op == "add" else "add", a, self._inner(b))
        if self._is_negative(a):
            if op == "add":
                return self._sum("sub", b, self._inner(a))
            return self._negate(self._sum("add", self._inner(a), b))
        if op == "add" and a > b:
            a, b = b, a
        return self._intern(op, (a, b), self._stage((a, b)))

    def _product(self, op: str, a: int, b: int) -> int:
        if self._is_negative(a) or self._is_negative(b):
            odd = self._is_negative(a) != self._is_negative(b)
            a = self._inner(a) if self._is_negative(a) else a
            b = self._inner(b) if self._is_negative(b) else b
            product = self._product(op, a, b)
            return self._negate(product) if odd else product
        if op == "mul" and a > b:
            a, b = b, a
        return self._intern(op, (a, b), self._stage((a, b)))


def is_leaf(node: Node) -> bool:
    return node.op in LEAVES
