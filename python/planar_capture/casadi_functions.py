"""Functions of a graph as CasADi's: its single assignments, made with symbols."""

from typing import Any

import numpy as np

from .batch import Argument, Array, Function
from .errors import InputError

#: What the derivation is locked to; the extra `derive` installs it.
CASADI = "3.8.2"


def casadi_function(graph: dict[str, Any], function: Function, values: Array, symbolic_parameters: bool) -> Any:
    """The function, with the parameters' values in it or as another input."""
    try:
        import casadi as ca
    except ImportError as error:
        raise InputError(f"CasADi is not installed: pip install casadi=={CASADI}") from error
    names = [parameter["name"] for parameter in graph["parameters"]]
    parameters = ca.SX.sym("parameters", len(names)) if symbolic_parameters else ca.SX(values)
    known = {name: parameters[place] for place, name in enumerate(names)}
    symbols = []
    for argument in function.inputs:
        # CasADi's matrices of one column are vectors
        rows, columns = (*argument.shape, 1)[:2]
        symbol = ca.SX.sym(argument.name, rows, columns)
        symbols.append(symbol)
        for place, name in zip(np.ndindex(*argument.shape), element_names(argument), strict=True):
            known[name] = symbol[place if len(place) == 2 else (place[0], 0)]
    family, of_graph = next(
        (family, found)
        for family in graph["families"]
        for found in family["functions"]
        if found["name"] == function.name
    )
    for statements in (graph["constants"], family["configuration"], of_graph):
        assign(ca, known, statements["statements"])
    outputs = []
    for argument, output in zip(function.outputs, of_graph["outputs"], strict=True):
        elements = [operand(known, element) for element in output["elements"]]
        rows, columns = (*argument.shape, 1, 1)[:2]
        # reshaping goes by columns
        outputs.append(ca.reshape(ca.vertcat(*elements), columns, rows).T)
    inputs = [argument.name for argument in function.inputs]
    if symbolic_parameters:
        symbols.append(parameters)
        inputs.append("parameters")
    return ca.Function(function.name, symbols, outputs, inputs, [argument.name for argument in function.outputs])


def element_names(argument: Argument) -> list[str]:
    """``name[i][j]`` of each element, row by row."""
    return [argument.name + "".join(f"[{i}]" for i in place) for place in np.ndindex(*argument.shape)]


def operand(known: dict[str, Any], value: str | float) -> Any:
    """A number, or what has that name."""
    return known[value] if isinstance(value, str) else value


def assign(ca: Any, known: dict[str, Any], statements: list[list[Any]]) -> None:
    """Adds what statements assign."""
    binary = {
        "add": lambda a, b: a + b,
        "sub": lambda a, b: a - b,
        "mul": lambda a, b: a * b,
        "div": lambda a, b: a / b,
        "min": ca.fmin,
        "atan2": ca.atan2,
    }
    unary = {"neg": lambda a: -a, "sqrt": ca.sqrt, "copy": lambda a: a}
    for target, operation, *operands in statements:
        values = [operand(known, value) for value in operands]
        if operation == "sin_cos":
            known[target[0]], known[target[1]] = ca.sin(values[0]), ca.cos(values[0])
        else:
            known[target] = (unary if operation in unary else binary)[operation](*values)
