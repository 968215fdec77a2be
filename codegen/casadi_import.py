"""Numbers the values of CasADi expressions: CasADi's instruction list in, nodes of a value numbering out.

CasADi's instructions reuse work slots and compute equal values again; nodes do neither. Symbols of auxiliary variables
are replaced by the nodes of their expressions.
"""

from collections.abc import Iterator
from itertools import groupby

import casadi as ca

from .functions import Functions
from .inputs import CONFIGURATION, element, input_shapes
from .signatures import Section
from .statements import NodeSection
from .symbols import AuxiliaryVariable
from .value_numbering import DerivationError, Stage, ValueNumbering

BINARY = {
    ca.OP_ADD: "add",
    ca.OP_SUB: "sub",
    ca.OP_MUL: "mul",
    ca.OP_DIV: "div",
    ca.OP_FMIN: "min",
    ca.OP_ATAN2: "atan2",
}
UNARY = {ca.OP_NEG: "neg", ca.OP_SIN: "sin", ca.OP_COS: "cos", ca.OP_SQRT: "sqrt"}


def grouped(variables: list[AuxiliaryVariable]) -> Iterator[list[AuxiliaryVariable]]:
    """Variables of one group together, others alone."""

    def key(item: tuple[int, AuxiliaryVariable]) -> tuple[bool, int]:
        place, variable = item
        return (False, place) if variable.group is None else (True, variable.group)

    for _, part in groupby(enumerate(variables), key):
        yield [variable for _, variable in part]


class CasadiImport:
    """The nodes of a layout's expressions; ``constants`` has the node of each named constant's expression."""

    def __init__(self, functions: Functions) -> None:
        self.numbering = ValueNumbering()
        self.constants: dict[str, int] = {}
        self._symbols: list[tuple[ca.SX, list[int]]] = []  # symbol, node of each element
        leaf, symbols = self.numbering.leaf, functions.symbols
        for parameter in symbols.parameters:
            self._symbols.append((parameter.symbol, [leaf("parameter", parameter.name, Stage.PARAMETERS)]))
        for name, shape in input_shapes(len(symbols.arms), symbols.joints).items():
            stage = Stage.CONFIGURATION if name in CONFIGURATION else Stage.CALL
            symbol = getattr(functions.inputs, name)
            elements = [leaf("input", element(name, shape, k), stage) for k in range(symbol.numel())]
            self._symbols.append((symbol, elements))
        for name, direction in functions.directions.items():
            size = direction.symbol.numel()
            elements = [leaf("input", element(name, direction.shape, k), Stage.CALL) for k in range(size)]
            self._symbols.append((direction.symbol, elements))
        for variables in grouped(symbols.auxiliary_variables):
            values = self.nodes_of([variable.expression for variable in variables])
            for variable, value in zip(variables, values, strict=True):
                if variable.name is not None:
                    if self.numbering[value].stage != Stage.PARAMETERS:
                        raise DerivationError(f"constant {variable.name} depends on more than parameters")
                    self.constants[variable.name] = value
                    value = leaf("constant", variable.name, Stage.PARAMETERS)
                self._symbols.append((variable.symbol, [value]))

    def nodes_of(self, expressions: list[ca.SX]) -> list[int]:
        """The nodes of scalar expressions."""
        symbols = [symbol for symbol, _ in self._symbols]
        function = ca.Function("f", symbols, [ca.vertcat(*expressions)], {"allow_free": False})
        work: dict[int, int] = {}
        results = [0] * len(expressions)
        for i in range(function.n_instructions()):
            op = function.instruction_id(i)
            args, targets = function.instruction_input(i), function.instruction_output(i)
            if op == ca.OP_OUTPUT:
                results[targets[1]] = work[args[0]]
            elif op == ca.OP_INPUT:
                work[targets[0]] = self._symbols[args[0]][1][args[1]]
            elif op == ca.OP_CONST:
                work[targets[0]] = self._number(float(function.instruction_constant(i)))
            else:
                work[targets[0]] = self._operation(op, [work[a] for a in args])
        return results

    def section_nodes(self, parts: list[list[Section]]) -> list[list[NodeSection]]:
        """The nodes of all sections' values, imported at once: (section, nodes) part by part."""
        nodes = iter(self.nodes_of([value for sections in parts for section in sections for value in section.values]))
        return [[(section.name, [next(nodes) for _ in section.values]) for section in sections] for sections in parts]

    def _number(self, value: float) -> int:
        return self.numbering.leaf("number", value, Stage.PARAMETERS)

    def _operation(self, op: int, args: list[int]) -> int:
        operation = self.numbering.operation
        if op in BINARY:
            return operation(BINARY[op], *args)
        if op in UNARY:
            return operation(UNARY[op], *args)
        if op == ca.OP_SQ:
            return operation("mul", args[0], args[0])
        if op == ca.OP_TWICE:
            return operation("add", args[0], args[0])
        if op == ca.OP_INV:
            return operation("div", self._number(1.0), args[0])
        raise DerivationError(f"CasADi operation {op} has no name in the graph")
