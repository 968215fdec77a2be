"""Builds the graph of a layout, as plain data for JSON, from the outputs of its functions.

The graph has single assignments in three stages: constants from parameters, then for each family the values that
depend on the configuration, then for each function the rest. Those of the last two are in named sections.
"""

from collections.abc import Iterable
from itertools import chain

import casadi as ca

from .casadi_import import CasadiImport
from .functions import Functions
from .inputs import INPUTS, input_shapes
from .layout import content_hash
from .regrouping import Regrouping
from .signatures import Family, Function, Output
from .statements import NodeSection, Statements, count, evaluation_order
from .symbols import Symbols
from .value_numbering import Stage, ValueNumbering

FORMAT = 3


def build(functions: Functions, command: str | None = None) -> dict:
    """The whole graph; `command` derives it again and is by default that of a shipped layout."""
    layout, symbols = functions.layout, functions.symbols
    imported = CasadiImport(functions)
    families = [family_graph(imported, family) for family in functions.families]
    return {
        "format": FORMAT,
        "command": command or f"python -m codegen {layout.name}",
        "casadi": ca.__version__,
        **({"options": options} if (options := functions.derivatives.options()) else {}),
        "layout": {
            "name": layout.name,
            "sha256": content_hash(layout),
            "arms": [{"name": arm.name, "links": len(arm.links)} for arm in layout.arms],
            "needs_distinct_mounts": functions.needs_distinct_mounts,
        },
        "inputs": [
            *(
                {"name": name, "shape": shape, "unit": INPUTS[name][1], "description": INPUTS[name][2]}
                for name, shape in input_shapes(len(symbols.arms), symbols.joints).items()
            ),
            *(
                {"name": name, "shape": direction.shape, "unit": direction.unit, "description": direction.description}
                for name, direction in functions.directions.items()
            ),
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
    """Statements of the constants that the families need; ``values`` are those that they read."""
    numbering, statements = imported.numbering, Statements(imported.numbering, "p", {})
    stages = [stage for family in families for stage in (family["configuration"], *family["functions"])]
    read = {name for stage in stages for name in operands(stage["statements"], results_of(stage))}
    needed, pending = set(), [*(read & imported.constants.keys())]
    while pending:
        name = pending.pop()
        if name not in needed:
            needed.add(name)
            below = [numbering[i] for i in numbering.reachable([imported.constants[name]])]
            pending += [node.args[0] for node in below if node.op == "constant"]
    values = []
    for variable in symbols.auxiliary_variables:
        if variable.name in needed:
            statements.assign_constant(variable.name, imported.constants[variable.name])
        if variable.name in read:
            values.append({"name": variable.name, "unit": variable.unit, "description": variable.description})
    return {"statements": statements.lines, "values": values, "operations": count(numbering, statements.nodes)}


def family_graph(imported: CasadiImport, family: Family) -> dict:
    """Statements of one family: those of the configuration, which its functions share, and those of each call."""
    numbering = imported.numbering
    shared, *own = imported.section_nodes([family.sections, *(function.sections for function in family.functions)])
    results = [
        [i for _, values in sections[-len(function.results) :] for i in values]
        for sections, function in zip(own, family.functions, strict=True)
    ]
    shared, *own = (with_negated(numbering, sections) for sections in (shared, *own))
    named = {i for sections in (shared, *own) for _, values in sections for i in values}
    regrouping = Regrouping(numbering, chain(*results), named)
    shared, *own = (regrouped(regrouping, sections) for sections in (shared, *own))
    results = [[regrouping.nodes[i] for i in roots] for roots in results]
    configuration = configuration_statements(numbering, [*shared, *chain(*own)], [*chain(*results)])
    functions = [
        function_graph(numbering, configuration.names, function, [*shared, *sections], roots)
        for function, sections, roots in zip(family.functions, own, results, strict=True)
    ]
    used = {name for function in functions for name in operands(function["statements"], results_of(function))}
    targets = [name for line in configuration.lines for name in (line[0] if line[1] == "sin_cos" else [line[0]])]
    return {
        "name": family.name,
        "description": family.description,
        "configuration": {
            "sections": configuration.sections,
            "statements": configuration.lines,
            "values": [name for name in targets if name in used],
            "operations": count(numbering, configuration.nodes),
        },
        "functions": functions,
    }


def with_negated(numbering: ValueNumbering, sections: Iterable[NodeSection]) -> list[NodeSection]:
    """The same sections, with the operand of each negation: the sum that uses the value may have absorbed it."""

    def nodes(i: int) -> list[int]:
        return [numbering[i].args[0], i] if numbering[i].op == "neg" else [i]

    return [(name, [node for i in values for node in nodes(i)]) for name, values in sections]


def regrouped(regrouping: Regrouping, sections: Iterable[NodeSection]) -> list[NodeSection]:
    """The same sections, without the values that are dissolved or not needed."""
    nodes = regrouping.nodes
    return [(name, [nodes[i] for i in values if i in nodes]) for name, values in sections]


def configuration_statements(
    numbering: ValueNumbering, sections: Iterable[NodeSection], results: Iterable[int]
) -> Statements:
    """Statements of what the calls need of the configuration; the inputs that they need are copied."""
    reached = numbering.reachable(results)
    used = {a for i in reached if numbering[i].stage == Stage.CALL for a in numbering.operands(i)}.union(results)
    needed = numbering.reachable(i for i in used if numbering[i].stage < Stage.CALL)
    statements = Statements(numbering, "c", {})
    for section, i in evaluation_order(numbering, [sines_section(numbering, needed), *sections]):
        if i in needed and numbering[i].stage == Stage.CONFIGURATION:
            if not numbering[i].is_leaf:
                statements.assign(i, section)
            elif i in used:
                statements.copy_input(i, section)
    return statements


def sines_section(numbering: ValueNumbering, needed: set[int]) -> NodeSection:
    """The sines and cosines of all angles, one after the other: they are computed at once."""
    sines = sorted(i for i in needed if numbering[i].op in ("sin", "cos") and numbering[i].stage == Stage.CONFIGURATION)
    return "sines and cosines", [*(numbering[i].args[0] for i in sines), *sines]


def function_graph(
    numbering: ValueNumbering,
    known: dict[int, str],
    function: Function,
    sections: list[NodeSection],
    results: list[int],
) -> dict:
    """Statements of one call, where values of the configuration are known."""
    call, reached = Statements(numbering, "t", known), numbering.reachable(results)
    for section, i in evaluation_order(numbering, sections):
        is_of_call = numbering[i].stage == Stage.CALL or is_parametric(numbering, i, call)
        if i in reached and is_of_call and not numbering[i].is_leaf:
            call.assign(i, section)
    for_outputs = numbering.reachable(results[: sum(len(output.elements) for output in function.outputs)])
    elements = iter(results)
    outputs, matrices = (
        [output_graph(output, [call.operand(next(elements)) for _ in output.elements]) for output in part]
        for part in (function.outputs, function.matrices)
    )
    return {
        "name": function.name,
        "description": function.description,
        "equation": function.equation,
        "source": function.source,
        "inputs": function.inputs,
        "sections": call.sections,
        "statements": call.lines,
        "outputs": outputs,
        **({"matrices": matrices} if matrices else {}),
        "operations": count(
            numbering, (i for i in for_outputs if numbering[i].stage > Stage.PARAMETERS or i in call.names)
        ),
    }


def output_graph(output: Output, elements: list[str | float]) -> dict:
    return {
        "name": output.name,
        "shape": output.shape,
        "unit": output.unit,
        "description": output.description,
        "elements": elements,
        **({"derivative": vars(output.derivative)} if output.derivative else {}),
    }


def is_parametric(numbering: ValueNumbering, i: int, call: Statements) -> bool:
    """Whether a node depends on parameters alone and has no name yet: only derivatives by parameters have such."""
    return numbering[i].stage == Stage.PARAMETERS and i not in call.names


def results_of(stage: dict) -> list[dict]:
    """What the statements of a call are for."""
    return [*stage.get("outputs", []), *stage.get("matrices", [])]


def operands(statements: Iterable[list], outputs: Iterable[dict] = ()) -> list[str]:
    """Names that statements and outputs use."""
    used = [operand for line in statements for operand in line[2:]]
    used += [element for output in outputs for element in output["elements"]]
    return [name for name in used if isinstance(name, str)]
