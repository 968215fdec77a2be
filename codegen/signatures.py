"""Signatures of the model's functions: names, texts, inputs, and outputs with their shapes, units and expressions."""

from dataclasses import dataclass, field

import casadi as ca


@dataclass(frozen=True)
class Output:
    """One result; ``flat`` holds its elements in row-major order."""

    name: str
    shape: list[int]
    units: str
    description: str
    flat: list[ca.SX]


@dataclass(frozen=True)
class Function:
    name: str
    description: str
    equation: str
    source: str
    inputs: list[str]
    outputs: list[Output]


@dataclass(frozen=True)
class Family:
    name: str
    description: str
    functions: list[Function] = field(default_factory=list)


def matrix(name: str, units: str, description: str, expression: ca.SX) -> Output:
    rows, columns = expression.shape
    dense = ca.densify(expression)
    return Output(name, [rows, columns], units, description, [dense[i, j] for i in range(rows) for j in range(columns)])


def vector(name: str, units: str, description: str, expression: ca.SX) -> Output:
    return Output(name, [expression.shape[0]], units, description, ca.vertsplit(ca.densify(expression)))


def per_item(name: str, units: str, description: str, expression: ca.SX) -> Output:
    """A list of twists or poses, held as columns."""
    rows, columns = expression.shape
    dense = ca.densify(expression)
    return Output(name, [columns, rows], units, description, [dense[i, j] for j in range(columns) for i in range(rows)])


def scalar(name: str, units: str, description: str, expression: ca.SX) -> Output:
    return Output(name, [], units, description, [ca.SX(expression)])


def pivot(expression: ca.SX) -> Output:
    return scalar(
        "smallest_pivot",
        "1",
        "smallest pivot relative to its scale; small, zero or NaN: singular",
        expression,
    )
