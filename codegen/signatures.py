"""Records the signature of each function: its texts, its inputs, and its outputs with shapes, units and expressions."""

from dataclasses import dataclass

import casadi as ca


@dataclass(frozen=True)
class Output:
    """One result; its elements are in row-major order."""

    name: str
    shape: list[int]
    unit: str
    description: str
    elements: list[ca.SX]


@dataclass(frozen=True)
class Function:
    """What a function computes, by which equation, from which inputs."""

    name: str
    description: str
    equation: str
    source: str
    inputs: list[str]
    outputs: list[Output]


@dataclass(frozen=True)
class Family:
    """Functions that share what depends on the configuration (base pose and joint angles) alone."""

    name: str
    description: str
    functions: list[Function]


def matrix(name: str, unit: str, description: str, expression: ca.SX) -> Output:
    rows, columns = expression.shape
    dense = ca.densify(expression)
    return Output(name, [rows, columns], unit, description, [dense[i, j] for i in range(rows) for j in range(columns)])


def list_of_vectors(name: str, unit: str, description: str, expression: ca.SX) -> Output:
    """A list of twists or poses, which are the columns of the expression."""
    return matrix(name, unit, description, expression.T)


def vector(name: str, unit: str, description: str, expression: ca.SX) -> Output:
    return Output(name, [expression.shape[0]], unit, description, ca.vertsplit(ca.densify(expression)))


def scalar(name: str, unit: str, description: str, expression: ca.SX) -> Output:
    return Output(name, [], unit, description, [ca.SX(expression)])


def smallest_pivot(expression: ca.SX) -> Output:
    description = "smallest pivot relative to its scale; small, zero or NaN: singular"
    return scalar("smallest_pivot", "1", description, expression)
