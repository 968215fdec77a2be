"""CasADi expressions to a single-assignment graph that can be opened and read.

CasADi's instruction list reuses work slots and repeats itself; here every distinct value becomes one node
(value numbering), negations are moved where they vanish into a subtraction, and each node is put in the
earliest of three stages in which it can be computed: parameters, configuration, call.
"""

from dataclasses import dataclass

import casadi as ca

from .layout import content_hash
from .model import CONFIGURATION, INPUT_TEXT, Family, Function, Model

FORMAT = 1
PARAMETER, SETUP, CALL = 0, 1, 2
BINARY = {
    ca.OP_ADD: "add",
    ca.OP_SUB: "sub",
    ca.OP_MUL: "mul",
    ca.OP_DIV: "div",
    ca.OP_FMIN: "min",
    ca.OP_ATAN2: "atan2",
}
UNARY = {ca.OP_NEG: "neg", ca.OP_SIN: "sin", ca.OP_COS: "cos", ca.OP_SQRT: "sqrt"}
COUNTED = ("mul", "add", "sub", "div", "sqrt", "atan2", "neg", "min")


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


class Reader:
    """Reads scalar CasADi expressions into nodes."""

    def __init__(self, model: Model) -> None:
        self.model, self.nodes = model, Nodes()
        self.leaves: list[tuple[ca.SX, list[int]]] = []  # symbol, node of each element
        for parameter in model.symbols.parameters:
            self._add_leaf(parameter.symbol, [self.nodes.leaf("parameter", parameter.name, PARAMETER)])
        for name, shape in model.input_shapes.items():
            stage = SETUP if name in CONFIGURATION else CALL
            symbol = getattr(model.inputs, name)
            ids = [self.nodes.leaf("input", element(name, shape, k), stage) for k in range(symbol.numel())]
            self._add_leaf(symbol, ids)
        self.constants: dict[str, int] = {}
        for cut in model.symbols.cuts:
            (value,) = self.read([cut.expression])
            if cut.name is not None:
                if self.nodes.nodes[value].stage != PARAMETER:
                    raise DerivationError(f"constant {cut.name} depends on more than parameters")
                self.constants[cut.name] = value
                value = self.nodes.leaf("constant", cut.name, PARAMETER)
            self._add_leaf(cut.symbol, [value])

    def _add_leaf(self, symbol: ca.SX, ids: list[int]) -> None:
        self.leaves.append((symbol, ids))

    def read(self, expressions: list[ca.SX]) -> list[int]:
        """Nodes of scalar expressions."""
        function = ca.Function(
            "f", [symbol for symbol, _ in self.leaves], [ca.vertcat(*expressions)], {"allow_free": False}
        )
        work: dict[int, int] = {}
        results: list[int] = [0] * len(expressions)
        for i in range(function.n_instructions()):
            op = function.instruction_id(i)
            args, targets = function.instruction_input(i), function.instruction_output(i)
            if op == ca.OP_OUTPUT:
                results[targets[1]] = work[args[0]]
            elif op == ca.OP_INPUT:
                work[targets[0]] = self.leaves[args[0]][1][args[1]]
            elif op == ca.OP_CONST:
                work[targets[0]] = self.nodes.leaf("number", float(function.instruction_constant(i)), PARAMETER)
            else:
                work[targets[0]] = self._operation(op, [work[a] for a in args])
        return results

    def _operation(self, op: int, args: list[int]) -> int:
        build = self.nodes.operation
        if op in BINARY:
            return build(BINARY[op], *args)
        if op in UNARY:
            return build(UNARY[op], *args)
        if op == ca.OP_SQ:
            return build("mul", args[0], args[0])
        if op == ca.OP_TWICE:
            return build("add", args[0], args[0])
        if op == ca.OP_INV:
            return build("div", self.nodes.leaf("number", 1.0, PARAMETER), args[0])
        raise DerivationError(f"CasADi operation {op} has no name in the graph")


def element(name: str, shape: list[int], k: int) -> str:
    """`name[i]` or `name[i][j]` of the k-th element in row-major order."""
    if len(shape) == 1:
        return f"{name}[{k}]"
    return f"{name}[{k // shape[1]}][{k % shape[1]}]"


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


def is_leaf(node: Node) -> bool:
    return node.op in ("number", "input", "parameter", "constant")


def count(lines: list[list]) -> dict[str, int]:
    """Operations by kind; a sine and a cosine of one angle are one pair; flops are mul + add + sub + div."""
    counts = dict.fromkeys(COUNTED, 0)
    counts["sin_cos"] = 0
    for line in lines:
        if line[1] != "copy":
            counts[line[1]] += 1
    counts["flops"] = sum(counts[op] for op in ("mul", "add", "sub", "div"))
    return {key: value for key, value in counts.items() if value or key == "flops"}


def family_graph(reader: Reader, family: Family) -> dict:
    """Statements of one family: the shared configuration stage, then one call stage per function."""
    nodes = reader.nodes
    results = [reader.read([e for output in function.outputs for e in output.flat]) for function in family.functions]
    setup = Statements(nodes, "c", {})
    for roots in results:
        for root in roots:
            for i in reachable(nodes, root, SETUP):
                setup.keep(i)
    functions = [
        function_graph(nodes, setup, function, roots) for function, roots in zip(family.functions, results, strict=True)
    ]
    used = {name for function in functions for name in used_names(function)}
    names = [name for line in setup.lines for name in (line[0] if line[1] == "sin_cos" else [line[0]])]
    return {
        "name": family.name,
        "description": family.description,
        "configuration": {
            "statements": setup.lines,
            "values": [name for name in names if name in used],
            "operations": count(setup.lines),
        },
        "functions": functions,
    }


def reachable(nodes: Nodes, root: int, stage: int) -> list[int]:
    """Nodes of a stage that a root needs directly or through later stages, in a fixed order."""
    found, seen, stack = [], set(), [root]
    while stack:
        i = stack.pop()
        node = nodes.nodes[i]
        if i in seen:
            continue
        seen.add(i)
        if node.stage <= stage:
            found.append(i)
        elif not is_leaf(node):
            stack.extend(reversed(node.args))
    return found


def function_graph(nodes: Nodes, setup: Statements, function: Function, roots: list[int]) -> dict:
    call = Statements(nodes, "t", setup.names)
    for root in roots:
        call.require(root, (CALL,))
    results, start = [], 0
    for output in function.outputs:
        operands = [call.operand(root) for root in roots[start : start + len(output.flat)]]
        start += len(output.flat)
        results.append(
            {
                "name": output.name,
                "shape": output.shape,
                "unit": output.units,
                "description": output.description,
                "elements": operands,
            }
        )
    alone = Statements(nodes, "x", {})  # what this function costs when nothing is shared
    for root in roots:
        alone.require(root, (SETUP, CALL))
    return {
        "name": function.name,
        "description": function.description,
        "equation": function.equation,
        "source": function.source,
        "inputs": function.inputs,
        "statements": call.lines,
        "outputs": results,
        "operations": count(alone.lines),
    }


def used_names(function: dict) -> list:
    arguments = [a for line in function["statements"] for a in line[2:]]
    return [a for a in [*arguments, *(e for o in function["outputs"] for e in o["elements"])] if isinstance(a, str)]


def build(model: Model) -> dict:
    """The whole graph of a layout as plain data."""
    layout, symbols = model.layout, model.symbols
    reader = Reader(model)
    families = [family_graph(reader, family) for family in model.families]
    constants = Statements(reader.nodes, "p", {})
    named = {cut.name: cut for cut in symbols.cuts if cut.name is not None}
    needed = required_constants(reader, families)
    values = []
    for name in (name for name in named if name in needed):
        constants.define(name, reader.constants[name])
        cut = named[name]
        values.append({"name": name, "unit": cut.unit, "description": cut.description})
    return {
        "format": FORMAT,
        "command": f"python -m codegen {layout.name}",
        "casadi": ca.__version__,
        "layout": {
            "name": layout.name,
            "sha256": content_hash(layout),
            "arms": [{"name": arm.name, "links": len(arm.links)} for arm in layout.arms],
            "needs_distinct_mounts": model.needs_distinct_mounts,
        },
        "inputs": [
            {
                "name": name,
                "shape": shape,
                "unit": ", ".join(INPUT_TEXT[name][0]),
                "description": INPUT_TEXT[name][1],
            }
            for name, shape in model.input_shapes.items()
        ],
        "parameters": [
            {
                "name": p.name,
                "quantity": p.quantity,
                "arm": p.arm,
                "link": p.link,
                "unit": p.unit,
                "default": p.default,
                "description": p.description,
            }
            for p in symbols.parameters
        ],
        "constants": {"statements": constants.lines, "values": values, "operations": count(constants.lines)},
        "families": families,
    }


def required_constants(reader: Reader, families: list[dict]) -> set[str]:
    """Constants that a later stage or another needed constant uses."""
    used: set[str] = set()
    for family in families:
        lines = [
            *family["configuration"]["statements"],
            *(line for f in family["functions"] for line in f["statements"]),
        ]
        used.update(a for line in lines for a in line[2:] if a in reader.constants)
        used.update(
            a for f in family["functions"] for o in f["outputs"] for a in o["elements"] if a in reader.constants
        )
    pending = list(used)
    while pending:
        for name in constants_below(reader, reader.constants[pending.pop()]):
            if name not in used:
                used.add(name)
                pending.append(name)
    return used


def constants_below(reader: Reader, root: int) -> list[str]:
    names, stack = [], [root]
    while stack:
        node = reader.nodes.nodes[stack.pop()]
        if node.op == "constant":
            names.append(node.args[0])
        elif not is_leaf(node):
            stack.extend(node.args)
    return names
