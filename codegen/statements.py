"""Nodes as single assignments that can be read, and how many operations they are."""

from .value_numbering import PARAMETER, SETUP, DerivationError, Node, Nodes, is_leaf

COUNTED = ("mul", "add", "sub", "div", "sqrt", "atan2", "neg", "min")


class Statements:
    """Single assignments in an order in which each value is known before its use."""

    def __init__(self, nodes: Nodes, prefix: str, known: dict[int, str]) -> None:
        self.nodes, self.prefix = nodes, prefix
        self.names = dict(known)
        self.lines: list[list] = []

    def operand(self, i: int):
        if i in self.names:
            return self.names[i]
        return self.nodes.nodes[i].args[0]  # a leaf is its own name, or number

    def require(self, root: int, stages: tuple[int, ...]) -> None:
        """Emits what `root` needs from the given stages; earlier stages are known already."""
        stack = [(root, False)]
        while stack:
            i, ready = stack.pop()
            node = self.nodes.nodes[i]
            if i in self.names or is_leaf(node):
                continue
            if node.stage not in stages:
                raise DerivationError(f"{node} is not staged: name it a constant")
            if not ready:
                stack.append((i, True))
                stack.extend((a, False) for a in reversed(node.args))
            else:
                self._emit(i, node)

    def keep(self, i: int) -> None:
        """Emits a value that a later stage uses; an input is copied, for the later stage does not have it."""
        node = self.nodes.nodes[i]
        if node.op == "input" and i not in self.names:
            name = node.args[0].translate(str.maketrans({"[": "_", "]": None}))
            self.lines.append([name, "copy", node.args[0]])
            self.names[i] = name
        self.require(i, (SETUP,))

    def define(self, name: str, root: int) -> None:
        """Emits a constant under its own name, so that later constants can use it."""
        known = root in self.names or is_leaf(self.nodes.nodes[root])
        self.require(root, (PARAMETER,))
        if known or isinstance(self.lines[-1][0], list):
            self.lines.append([name, "copy", self.operand(root)])
        else:
            self.lines[-1][0] = self.names[root] = name

    def _emit(self, i: int, node: Node) -> None:
        number = len(self.lines)
        if node.op in ("sin", "cos"):
            pair = [self.nodes._index.get((op, node.args[0])) for op in ("sin", "cos")]
            targets = [
                f"{op}_{self.prefix}{number}" if p is not None else "_"
                for op, p in zip(("sin", "cos"), pair, strict=True)
            ]
            for p, target in zip(pair, targets, strict=True):
                if p is not None:
                    self.names[p] = target
            self.lines.append([targets, "sin_cos", self.operand(node.args[0])])
            return
        name = f"{self.prefix}{number}"
        self.lines.append([name, node.op, *(self.operand(a) for a in node.args)])
        self.names[i] = name


def count(lines: list[list]) -> dict[str, int]:
    """Operations by kind; a sine and a cosine of one angle are one pair; flops are mul + add + sub + div."""
    counts = dict.fromkeys(COUNTED, 0)
    counts["sin_cos"] = 0
    for line in lines:
        if line[1] != "copy":
            counts[line[1]] += 1
    counts["flops"] = sum(counts[op] for op in ("mul", "add", "sub", "div"))
    return {key: value for key, value in counts.items() if value or key == "flops"}
