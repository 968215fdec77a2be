"""Builds the graph of a layout, as plain data for JSON, from the outputs of its functions.

The graph has single assignments in three stages: constants from parameters, then for each family the values that
depend on the configuration, then for each function the rest.
"""

from collections.abc import Iterable

import casadi as ca

from .casadi_import import CasadiImport
from .functions import Functions
from .inputs import INPUTS, input_shapes
from .layout import content_hash
from .signatures import Family, Function
from .statements import Statements, count
from .symbols import Symbols
from .value_numbering import Stage, ValueNumbering

FORMAT = 1


def build(functions: Functions, command: str | None = None) -> dict:
    """The whole graph; `command` derives it again and is by default that of a shipped layout."""
    layout, symbols = functions.layout, functions.symbols
    imported = CasadiImport(functions)
    families = [family_graph(imported, family) for family in functions.families]
    return {
        "format": FORMAT,
        "command": command or f"python -m codegen {layout.name}",
        "casadi": ca.__version__,
        "layout": {
            "name": layout.name,
            "sha256": content_hash(layout),
            "arms": [{"name": arm.name, "links": len(arm.links)} for arm in layout.arms],
            "needs_distinct_mounts": functions.needs_distinct_mounts,
        },
        "inputs": [
            {"name": name, "shape": shape, "unit": INPUTS[name][1], "description": INPUTS[name][2]}
            for name, shape in input_shapes(len(symbols.arms), symbols.joints).items()
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
        "constants": constants_graph(imported, symbols, families),
        "families": families,
    }


def constants_graph(imported: CasadiImport, symbols: Symbols, families: list[dict]) -> dict:
    """Statements of the constants that the families use."""
    statements = Statements(imported.numbering, "p", {})
    used = used_constants(imported, families)
    values = []
    for variable in symbols.auxiliary_variables:
        if variable.name in used:
            statements.assign_constant(variable.name, imported.constants[variable.name])
            values.append({"name": variable.name, "unit": variable.unit, "description": variable.description})
    return {"statements": statements.lines, "values": values, "operations": count(statements.lines)}


def family_graph(imported: CasadiImport, family: Family) -> dict:
    """Statements of one family: those of the configuration, which its functions share, and those of each call."""
    numbering = imported.numbering
    results = [
        imported.nodes_of([element for output in function.outputs for element in output.elements])
        for function in family.functions
    ]
    configuration = Statements(numbering, "c", {})
    for roots in results:
        for root in roots:
            for node in configuration_values(numbering, root):
                configuration.assign_for_call(node)
    functions = [
        function_graph(numbering, configuration.names, function, roots)
        for function, roots in zip(family.functions, results, strict=True)
    ]
    used = {name for function in functions for name in operands(function["statements"], function["outputs"])}
    targets = [name for line in configuration.lines for name in (line[0] if line[1] == "sin_cos" else [line[0]])]
    return {
        "name": family.name,
        "description": family.description,
        "configuration": {
            "statements": configuration.lines,
            "values": [name for name in targets if name in used],
            "operations": count(configuration.lines),
        },
        "functions": functions,
    }


def function_graph(numbering: ValueNumbering, known: dict[int, str], function: Function, roots: list[int]) -> dict:
    """Statements of one call, where values of the configuration are known."""
    call = Statements(numbering, "t", known)
    alone = Statements(numbering, "x", {})  # for the operations that the results depend on
    for root in roots:
        call.assign(root, (Stage.CALL,))
        alone.assign(root, (Stage.CONFIGURATION, Stage.CALL))
    elements = iter(roots)
    return {
        "name": function.name,
        "description": function.description,
        "equation": function.equation,
        "source": function.source,
        "inputs": function.inputs,
        "statements": call.lines,
        "outputs": [
            {
                "name": output.name,
                "shape": output.shape,
                "unit": output.unit,
                "description": output.description,
                "elements": [call.operand(next(elements)) for _ in output.elements],
            }
            for output in function.outputs
        ],
        "operations": count(alone.lines),
    }


def configuration_values(numbering: ValueNumbering, root: int) -> list[int]:
    """Nodes of the configuration or earlier that a root is, or that its call uses, in a fixed order."""
    found, seen, stack = [], set(), [root]
    while stack:
        i = stack.pop()
        if i in seen:
            continue
        seen.add(i)
        if numbering[i].stage <= Stage.CONFIGURATION:
            found.append(i)
        elif not numbering[i].is_leaf:
            stack.extend(reversed(numbering[i].args))
    return found


def operands(statements: Iterable[list], outputs: Iterable[dict] = ()) -> list[str]:
    """Names that statements and outputs use."""
    used = [operand for line in statements for operand in line[2:]]
    used += [element for output in outputs for element in output["elements"]]
    return [name for name in used if isinstance(name, str)]


def used_constants(imported: CasadiImport, families: list[dict]) -> set[str]:
    """Constants that a family or another used constant uses."""
    pending = []
    for family in families:
        pending += operands(family["configuration"]["statements"])
        for function in family["functions"]:
            pending += operands(function["statements"], function["outputs"])
    used = set()
    while pending:
        name = pending.pop()
        if name in imported.constants and name not in used:
            used.add(name)
            pending += constants_below(imported, imported.constants[name])
    return used


def constants_below(imported: CasadiImport, root: int) -> list[str]:
    """Names of the constants in an expression."""
    names, stack = [], [root]
    while stack:
        node = imported.numbering[stack.pop()]
        if node.op == "constant":
            names.append(node.args[0])
        elif not node.is_leaf:
            stack.extend(node.args)
    return names
