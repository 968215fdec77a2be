"""Creates the symbols of a layout: its run-time parameters, and auxiliary variables that stand for expressions.

CasADi simplifies while it builds: it turns ``a * (1 / b)`` into ``a / b``, which multiplies the divisions, and it
substitutes a value that depends on parameters alone wherever it is used. An auxiliary variable prevents both: other
expressions contain its symbol alone, and `casadi_import.py` replaces the symbol by the expression again.
"""

from dataclasses import dataclass, replace

import casadi as ca

from .layout import Layout
from .plane_vectors import ZERO, Vector


@dataclass(frozen=True)
class Parameter:
    """One run-time number of the model, with the layout's value as its default."""

    name: str
    quantity: str
    arm: int | None
    link: int | None
    unit: str
    default: float
    description: str
    symbol: ca.SX


@dataclass(frozen=True)
class AuxiliaryVariable:
    """A symbol and the expression that it stands for; with a name it is a constant of the model."""

    symbol: ca.SX
    expression: ca.SX
    name: str | None = None
    unit: str = ""
    description: str = ""
    reciprocal_of: ca.SX | None = None  # where the expression is 1 / this
    group: int | None = None  # of variables whose expressions are imported at once


@dataclass(frozen=True)
class LinkSymbols:
    """Parameters of one link; a structural zero is the number 0. ``label`` starts the names of its constants."""

    label: str
    length: ca.SX
    mass: ca.SX
    inertia: ca.SX
    com: Vector


@dataclass(frozen=True)
class ArmSymbols:
    """Parameters of one arm; ``first_joint`` is the index of its first joint among all joints.

    ``label`` starts the names of its constants and ``title`` those of its sections.
    """

    label: str
    title: str
    first_joint: int
    mount: Vector
    mount_angle: ca.SX
    links: list[LinkSymbols]


class Symbols:
    """Parameters and auxiliary variables of one layout.

    Structural zeros (no parameter, no operations): ``mount[1]``, ``mount_angle``, ``com[1]`` of every link but the
    last of an arm (a captured target moves the COM of the last link off its axis), and the length of a link that is
    not the last of its arm (a reaction wheel inside a chain).
    """

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.parameters: list[Parameter] = []
        self.auxiliary_variables: list[AuxiliaryVariable] = []
        base = layout.base
        self.base_mass = self._parameter("base_mass", "base_mass", (None, None), "kg", base.mass, "mass of the base")
        self.base_inertia = self._parameter(
            "base_inertia", "base_inertia", (None, None), "kg m^2", base.inertia, "inertia of the base about its COM"
        )
        self.joints = 0
        self.arms = [self._arm(i) for i in range(len(layout.arms))]

    def _parameter(
        self,
        name: str,
        quantity: str,
        place: tuple[int | None, int | None],
        unit: str,
        value: float,
        description: str,
        structural: bool = False,
    ) -> ca.SX:
        """The symbol of a new parameter of (arm, link); 0 where a zero is structural."""
        if structural and value == 0.0:
            return ZERO
        symbol = ca.SX.sym(name)
        self.parameters.append(Parameter(name, quantity, *place, unit, value, description, symbol))
        return symbol

    def _arm(self, i: int) -> ArmSymbols:
        arm = self.layout.arms[i]
        label, first_joint = f"arm{i + 1}", self.joints

        def parameter(quantity: str, value: float, unit: str, description: str, structural: bool = True) -> ca.SX:
            description = f"{description} of arm {i + 1} ({arm.name})"
            return self._parameter(f"{label}_{quantity}", quantity, (i, None), unit, value, description, structural)

        mount_x = parameter("mount_x", arm.mount[0], "m", "first joint, base frame, x,", structural=False)
        mount_y = parameter("mount_y", arm.mount[1], "m", "first joint, base frame, y,")
        mount_angle = parameter(
            "mount_angle", arm.mount_angle, "rad", "direction of link 1 at joint angle 0, base frame,"
        )
        links = [self._link(i, k) for k in range(len(arm.links))]
        self.joints += len(links)
        return ArmSymbols(label, f"arm {i + 1}", first_joint, (mount_x, mount_y), mount_angle, links)

    def _link(self, i: int, k: int) -> LinkSymbols:
        link = self.layout.arms[i].links[k]
        label, last = f"arm{i + 1}_link{k + 1}", k == len(self.layout.arms[i].links) - 1

        def parameter(quantity: str, value: float, unit: str, description: str, structural: bool = False) -> ca.SX:
            name, description = f"{label}_{quantity}", f"{description} of link {k + 1} of arm {i + 1}"
            return self._parameter(name, f"link_{quantity}", (i, k), unit, value, description, structural)

        length = parameter("length", link.length, "m", "length (joint to next joint or end effector)", not last)
        mass = parameter("mass", link.mass, "kg", "mass")
        inertia = parameter("inertia", link.inertia, "kg m^2", "inertia about the COM")
        com_x = parameter("com_x", link.com[0], "m", "COM, link frame, x,")
        com_y = parameter("com_y", link.com[1], "m", "COM, link frame, y,", not last)
        return LinkSymbols(label, length, mass, inertia, (com_x, com_y))

    def constant(self, name: str, expression: ca.SX, unit: str, description: str) -> ca.SX:
        """A named value that depends on parameters alone: computed once, when the model is built."""
        expression = ca.SX(expression)
        if expression.is_constant() or expression.is_symbolic():
            return expression
        return self._auxiliary_variable(expression, name, unit, description)

    def constant_vector(self, name: str, expression: Vector, unit: str, description: str) -> Vector:
        """Constants ``name_x`` and ``name_y``."""
        x, y = expression
        return (
            self.constant(f"{name}_x", x, unit, f"{description}, x"),
            self.constant(f"{name}_y", y, unit, f"{description}, y"),
        )

    def reciprocal(self, expression: ca.SX) -> ca.SX:
        """``1 / expression``: one division, and a product wherever it is used."""
        return self._auxiliary_variable(1 / expression, reciprocal_of=expression)

    def reciprocal_constant(self, name: str, expression: ca.SX, unit: str, description: str) -> ca.SX:
        """``1 / expression`` of parameters alone, as a named constant."""
        expression = ca.SX(expression)
        return self._auxiliary_variable(1 / expression, name, unit, description, expression)

    def variables(self, expressions: list[ca.SX]) -> list[ca.SX]:
        """A symbol for each of some expressions, which do not depend on each other's; derivatives hold it constant."""
        first = len(self.auxiliary_variables)
        symbols = [self._auxiliary_variable(expression) for expression in expressions]
        for k in range(first, len(self.auxiliary_variables)):
            self.auxiliary_variables[k] = replace(self.auxiliary_variables[k], group=first)
        return symbols

    def _auxiliary_variable(
        self,
        expression: ca.SX,
        name: str | None = None,
        unit: str = "",
        description: str = "",
        reciprocal_of: ca.SX | None = None,
    ) -> ca.SX:
        """The symbol of a new auxiliary variable, or of the one that has this name already."""
        if name is not None:
            for variable in self.auxiliary_variables:
                if variable.name == name:
                    return variable.symbol
        symbol = ca.SX.sym(name or f"auxiliary_{len(self.auxiliary_variables)}")
        self.auxiliary_variables.append(AuxiliaryVariable(symbol, expression, name, unit, description, reciprocal_of))
        return symbol
