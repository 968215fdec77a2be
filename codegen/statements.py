"""Writes nodes as single assignments, in named sections and in an order of evaluation, and counts their operations."""

from collections.abc import Iterable, Iterator

from .value_numbering import DerivationError, ValueNumbering

COUNTED = ("mul", "add", "sub", "div", "sqrt", "atan2", "neg", "min")

NodeSection = tuple[str, list[int]]  # its name, the nodes of its values


def evaluation_order(numbering: ValueNumbering, sections: Iterable[NodeSection]) -> Iterator[tuple[str, int]]:
    """(section, node) of all nodes that the sections depend on, operands first.

    A node belongs to the first section that depends on it, so that no section depends on a later one.
    """
    visited = set()
    for name, values in sections:
        stack = [(value, False) for value in reversed(values)]
        while stack:
            i, operands_visited = stack.pop()
            if operands_visited:
                yield name, i
            elif i not in visited:
                visited.add(i)
                stack.append((i, True))
                stack.extend((a, False) for a in reversed(numbering.operands(i)))


class Statements:
    """Single assignments ``[name, operation, operand, ...]``; each operand is known before its use.

    ``names`` has the name of each node that is assigned, here or (``known``) in an earlier stage; new names are the
    prefix and a number. ``sections`` has the name of each section and the index of its first statement.
    """

    def __init__(self, numbering: ValueNumbering, prefix: str, known: dict[int, str]) -> None:
        self.numbering, self.prefix = numbering, prefix
        self.names = dict(known)
        self.lines: list[list] = []
        self.nodes: list[int] = []
        self.sections: list[list] = []

    def operand(self, node: int) -> str | float:
        """The name of a node; a leaf that is not assigned is its own name, or a number."""
        if node in self.names:
            return self.names[node]
        if not self.numbering[node].is_leaf:
            raise DerivationError(f"{self.numbering[node]} is not assigned: name what depends on parameters a constant")
        return self.numbering[node].args[0]

    def assign(self, i: int, section: str = "") -> None:
        """Assigns an operation whose operands are known, and its cosine with a sine or the reverse."""
        if i in self.names:
            return
        node, number = self.numbering[i], len(self.lines)
        self._begin(section)
        self.nodes.append(i)
        if node.op not in ("sin", "cos"):
            self.names[i] = f"{self.prefix}{number}"
            self.lines.append([self.names[i], node.op, *(self.operand(a) for a in node.args)])
            return
        targets = []
        for op in ("sin", "cos"):
            value = self.numbering.find(op, node.args[0])
            targets.append("_" if value is None else f"{op}_{self.prefix}{number}")
            if value is not None:
                self.names[value] = targets[-1]
        self.lines.append([targets, "sin_cos", self.operand(node.args[0])])

    def _begin(self, section: str) -> None:
        if not self.sections or self.sections[-1][0] != section:
            self.sections.append([section, len(self.lines)])

    def copy_input(self, i: int, section: str) -> None:
        """Copies an element of an input, for a later stage that does not have the input."""
        self._begin(section)
        element = self.numbering[i].args[0]
        self.names[i] = element.translate(str.maketrans({"[": "_", "]": None}))
        self.lines.append([self.names[i], "copy", element])

    def assign_constant(self, name: str, root: int) -> None:
        """Assigns a constant under its own name, so that later constants can use it."""
        new = [i for _, i in evaluation_order(self.numbering, [(name, [root])]) if not self.numbering[i].is_leaf]
        known = root in self.names or not new
        for i in new:
            self.assign(i)
        if known or isinstance(self.lines[-1][0], list):
            self.lines.append([name, "copy", self.operand(root)])
        else:
            self.lines[-1][0] = self.names[root] = name


def count(numbering: ValueNumbering, nodes: Iterable[int]) -> dict[str, int]:
    """Operations by kind; sine and cosine of one angle are one pair; flops are mul + add + sub + div."""
    counts, angles = dict.fromkeys((*COUNTED, "sin_cos"), 0), set()
    for node in (numbering[i] for i in nodes if not numbering[i].is_leaf):
        if node.op in ("sin", "cos"):
            angles.add(node.args[0])
        else:
            counts[node.op] += 1
    counts["sin_cos"] = len(angles)
    counts["flops"] = sum(counts[op] for op in ("mul", "add", "sub", "div"))
    return {key: value for key, value in counts.items() if value or key == "flops"}
