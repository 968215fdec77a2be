"""Records the signature of each function: its texts, inputs, outputs with shapes and units, and sections."""

from dataclasses import dataclass, field, replace

import casadi as ca

Values = ca.SX | list["Values"] | tuple["Values", ...]


class Section:
    """A named part of a computation: its values, and all that they depend on and no earlier section has."""

    def __init__(self, name: str, *values: Values) -> None:
        self.name, self.values = name, scalars(values)


def scalars(values: Values) -> list[ca.SX]:
    """The scalar expressions in nested lists and tuples, and the elements of matrices."""
    return values.nonzeros() if isinstance(values, ca.SX) else [scalar for part in values for scalar in scalars(part)]


@dataclass(frozen=True)
class Derivative:
    """What an output is the derivative of: ``outputs`` of ``function``, one after the other.

    Its columns are the elements of the inputs ``by``; with ``along`` in their place it is the derivative along the
    direction in each of these inputs; with neither it is a value of the outputs itself.
    """

    function: str
    outputs: list[str]
    by: list[str] = field(default_factory=list)
    along: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Output:
    """One result; its elements are in row-major order."""

    name: str
    shape: list[int]
    unit: str
    description: str
    elements: list[ca.SX]
    derivative: Derivative | None = None

    def deriving(self, function: str, outputs: list[str], by: list[str]) -> "Output":
        """The same output, which is the derivative of these."""
        return replace(self, derivative=Derivative(function, outputs, by))

    @property
    def section(self) -> Section:
        return Section(self.name.replace("_", " ").replace("jacobian", "Jacobian"), self.elements)


@dataclass(frozen=True)
class Function:
    """What a function computes, by which equation, from which inputs."""

    name: str
    description: str
    equation: str
    source: str
    inputs: list[str]
    outputs: list[Output]
    own_sections: list[Section] = field(default_factory=list)  # after those of the family
    matrices: list[Output] = field(default_factory=list)  # from which a routine in loops has the outputs, too

    @property
    def results(self) -> list[Output]:
        """The outputs, then the matrices."""
        return [*self.outputs, *self.matrices]

    @property
    def sections(self) -> list[Section]:
        """The sections of this function alone; those of its results are the last."""
        return [*self.own_sections, *(result.section for result in self.results)]


@dataclass(frozen=True)
class Family:
    """Functions that share what depends on the configuration (base pose and joint angles) alone."""

    name: str
    description: str
    functions: list[Function]
    sections: list[Section]  # which the functions have in common, in their order


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
    description = "smallest pivot relative to its scale; small or zero: singular, NaN: singular or not finite"
    return scalar("smallest_pivot", "1", description, expression)
