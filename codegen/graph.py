"""The graph of a layout: plain data, single assignments in stages, that can be opened and read."""

import casadi as ca

from .casadi_import import Reader
from .functions import Functions
from .inputs import INPUTS, input_shapes
from .layout import content_hash
from .signatures import Family, Function
from .statements import Statements, count
from .value_numbering import CALL, SETUP, Nodes, is_leaf

FORMAT = 1


def family_graph(reader: Reader, family: Family) -> dict:
    """Statements of one family: the shared configuration stage, then one call stage per function."""
    nodes = reader.nodes
    results = [
        reader.read([e for output in function.outputs for e in output.elements]) for function in family.functions
    ]
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
        operands = [call.operand(root) for root in roots[start : start + len(output.elements)]]
        start += len(output.elements)
        results.append(
            {
                "name": output.name,
                "shape": output.shape,
                "unit": output.unit,
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


def build(functions: Functions, command: str | None = None) -> dict:
    """The whole graph of a layout as plain data; `command` makes it again, without it that of a shipped layout."""
    layout, symbols = functions.layout, functions.symbols
    reader = Reader(functions)
    families = [family_graph(reader, family) for family in functions.families]
    constants = Statements(reader.nodes, "p", {})
    named = {variable.name: variable for variable in symbols.auxiliary_variables if variable.name is not None}
    needed = required_constants(reader, families)
    values = []
    for name in (name for name in named if name in needed):
        constants.define(name, reader.constants[name])
        variable = named[name]
        values.append({"name": name, "unit": variable.unit, "description": variable.description})
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
