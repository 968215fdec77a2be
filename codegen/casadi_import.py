"""Reads scalar CasADi expressions into value-numbered nodes.

CasADi's instruction list reuses work slots and repeats itself; nodes do neither.
"""

import casadi as ca

from .functions import Functions
from .inputs import CONFIGURATION, element, input_shapes
from .value_numbering import CALL, PARAMETER, SETUP, DerivationError, Nodes

BINARY = {
    ca.OP_ADD: "add",
    ca.OP_SUB: "sub",
    ca.OP_MUL: "mul",
    ca.OP_DIV: "div",
    ca.OP_FMIN: "min",
    ca.OP_ATAN2: "atan2",
}
UNARY = {ca.OP_NEG: "neg", ca.OP_SIN: "sin", ca.OP_COS: "cos", ca.OP_SQRT: "sqrt"}


class Reader:
    """Reads scalar CasADi expressions into nodes."""

    def __init__(self, functions: Functions) -> None:
        self.nodes = Nodes()
        self.leaves: list[tuple[ca.SX, list[int]]] = []  # symbol, node of each element
        for parameter in functions.symbols.parameters:
            self._add_leaf(parameter.symbol, [self.nodes.leaf("parameter", parameter.name, PARAMETER)])
        shapes = input_shapes(len(functions.symbols.arms), functions.symbols.joints)
        for name, shape in shapes.items():
            stage = SETUP if name in CONFIGURATION else CALL
            symbol = getattr(functions.inputs, name)
            ids = [self.nodes.leaf("input", element(name, shape, k), stage) for k in range(symbol.numel())]
            self._add_leaf(symbol, ids)
        self.constants: dict[str, int] = {}
        for variable in functions.symbols.auxiliary_variables:
            (value,) = self.read([variable.expression])
            if variable.name is not None:
                if self.nodes.nodes[value].stage != PARAMETER:
                    raise DerivationError(f"constant {variable.name} depends on more than parameters")
                self.constants[variable.name] = value
                value = self.nodes.leaf("constant", variable.name, PARAMETER)
            self._add_leaf(variable.symbol, [value])

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
