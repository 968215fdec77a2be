"""Writes nodes as single assignments in an order of evaluation, and counts their operations."""

from .value_numbering import DerivationError, Stage, ValueNumbering

COUNTED = ("mul", "add", "sub", "div", "sqrt", "atan2", "neg", "min")


class Statements:
    """Single assignments ``[name, operation, operand, ...]``; each operand is known before its use.

    ``names`` has the name of each node that is assigned, here or (``known``) in an earlier stage; new names are the
    prefix and a number.
    """

    def __init__(self, numbering: ValueNumbering, prefix: str, known: dict[int, str]) -> None:
        self.numbering, self.prefix = numbering, prefix
        self.names = dict(known)
        self.lines: list[list] = []

    def operand(self, node: int) -> str | float:
        """The name of a node; a leaf that is not assigned is its own name, or a number."""
        return self.names[node] if node in self.names else self.numbering[node].args[0]

    def assign(self, root: int, stages: tuple[Stage, ...]) -> None:
        """Assigns a node, and before it all that it depends on; this must belong to the stages, or be known."""
        stack = [(root, False)]
        while stack:
            i, operands_known = stack.pop()
            node = self.numbering[i]
            if i in self.names or node.is_leaf:
                continue
            if node.stage not in stages:
                raise DerivationError(f"{node} belongs to another stage: name it a constant")
            if operands_known:
                self._assign(i)
            else:
                stack.append((i, True))
                stack.extend((a, False) for a in reversed(node.args))

    def assign_for_call(self, root: int) -> None:
        """Assigns a value of the configuration that the call uses; an input is copied, as the call does not have it."""
        node = self.numbering[root]
        if node.op == "input" and root not in self.names:
            name = node.args[0].translate(str.maketrans({"[": "_", "]": None}))
            self.lines.append([name, "copy", node.args[0]])
            self.names[root] = name
        self.assign(root, (Stage.CONFIGURATION,))

    def assign_constant(self, name: str, root: int) -> None:
        """Assigns a constant under its own name, so that later constants can use it."""
        known = root in self.names or self.numbering[root].is_leaf
        self.assign(root, (Stage.PARAMETERS,))
        if known or isinstance(self.lines[-1][0], list):
            self.lines.append([name, "copy", self.operand(root)])
        else:
            self.lines[-1][0] = self.names[root] = name

    def _assign(self, i: int) -> None:
        node, number = self.numbering[i], len(self.lines)
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


def count(lines: list[list]) -> dict[str, int]:
    """Operations by kind; sine and cosine of one angle are one pair; flops are mul + add + sub + div."""
    counts = dict.fromkeys((*COUNTED, "sin_cos"), 0)
    for _, operation, *_ in lines:
        if operation != "copy":
            counts[operation] += 1
    counts["flops"] = sum(counts[op] for op in ("mul", "add", "sub", "div"))
    return {key: value for key, value in counts.items() if value or key == "flops"}
