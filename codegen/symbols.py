"""Symbols of one layout: run-time parameters, and the values that are cut out of an expression.

CasADi simplifies while it builds: it turns ``a * (1 / b)`` into ``a / b`` and so multiplies divisions,
and it would fold a value that depends on parameters alone into every use. A *cut* stops both: the value
gets a symbol of its own, and `graph.py` joins symbol and expression again.
"""

from dataclasses import dataclass

import casadi as ca

from .layout import Layout


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
class Cut:
    """A symbol that stands for an expression."""

    symbol: ca.SX
    expression: ca.SX
    name: str | None = None
    unit: str = ""
    description: str = ""


@dataclass(frozen=True)
class LinkSymbols:
    """Parameters of one link; a structural zero is the number 0."""

    length: ca.SX
    mass: ca.SX
    inertia: ca.SX
    com_x: ca.SX
    com_y: ca.SX


@dataclass(frozen=True)
class ArmSymbols:
    """Parameters of one arm."""

    mount_x: ca.SX
    mount_y: ca.SX
    mount_angle: ca.SX
    links: list[LinkSymbols]


class Symbols:
    """Parameters, named constants and reciprocals of one layout.

    Structural zeros (no parameter, no operations): ``mount[1]``, ``mount_angle``, ``com[1]`` of every
    link but the last of an arm (capturing a target moves that one off its axis), and the length of a
    link that is not the last of its arm (a reaction wheel inside a chain).
    """

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.parameters: list[Parameter] = []
        self.cuts: list[Cut] = []
        self.base_mass = self._parameter(
            "base_mass", "base_mass", None, None, "kg", layout.base.mass, "mass of the base"
        )
        self.base_inertia = self._parameter(
            "base_inertia",
            "base_inertia",
            None,
            None,
            "kg m^2",
            layout.base.inertia,
            "inertia of the base about its COM",
        )
        self.arms = [self._arm(i) for i in range(len(layout.arms))]
        self.joints = sum(len(arm.links) for arm in self.arms)

    def _parameter(self, name, quantity, arm, link, unit, default, description) -> ca.SX:
        symbol = ca.SX.sym(name)
        self.parameters.append(Parameter(name, quantity, arm, link, unit, default, description, symbol))
        return symbol

    def _arm(self, i: int) -> ArmSymbols:
        arm = self.layout.arms[i]
        label = f"arm{i + 1}"

        def number(quantity, value, unit, description, structural):
            if structural and value == 0.0:
                return ca.SX(0)
            return self._parameter(
                f"{label}_{quantity}",
                quantity,
                i,
                None,
                unit,
                value,
                f"{description} of arm {i + 1} ({arm.name})",
            )

        mount_x = number("mount_x", arm.mount[0], "m", "first joint, base frame, x,", structural=False)
        mount_y = number("mount_y", arm.mount[1], "m", "first joint, base frame, y,", structural=True)
        mount_angle = number(
            "mount_angle",
            arm.mount_angle,
            "rad",
            "direction of joint 1 = 0 in the base frame",
            structural=True,
        )
        return ArmSymbols(mount_x, mount_y, mount_angle, [self._link(i, k) for k in range(len(arm.links))])

    def _link(self, i: int, k: int) -> LinkSymbols:
        link = self.layout.arms[i].links[k]
        last = k == len(self.layout.arms[i].links) - 1

        def number(quantity, value, unit, description, structural=False):
            if structural and value == 0.0:
                return ca.SX(0)
            name = f"arm{i + 1}_link{k + 1}_{quantity}"
            return self._parameter(
                name, f"link_{quantity}", i, k, unit, value, f"{description} of link {k + 1} of arm {i + 1}"
            )

        return LinkSymbols(
            length=number(
                "length",
                link.length,
                "m",
                "joint to next joint (or to the end effector)",
                structural=not last,
            ),
            mass=number("mass", link.mass, "kg", "mass"),
            inertia=number("inertia", link.inertia, "kg m^2", "inertia about the COM"),
            com_x=number("com_x", link.com[0], "m", "COM, link frame, x,"),
            com_y=number("com_y", link.com[1], "m", "COM, link frame, y,", structural=not last),
        )

    def constant(self, name: str, expression: ca.SX, unit: str, description: str) -> ca.SX:
        """A named value that depends on parameters alone: computed once, when the model is built."""
        expression = ca.SX(expression)
        if expression.is_constant() or expression.is_symbolic():
            return expression
        return self._cut(expression, name, unit, description)

    def reciprocal(self, expression: ca.SX) -> ca.SX:
        """``1 / expression``, divided once and multiplied wherever it is used."""
        return self._cut(1 / expression, None, "", "")

    def inverse_constant(self, name: str, expression: ca.SX, unit: str, description: str) -> ca.SX:
        """``1 / expression`` of parameters alone, kept as a named constant."""
        return self._cut(1 / ca.SX(expression), name, unit, description)

    def _cut(self, expression: ca.SX, name: str | None, unit: str, description: str) -> ca.SX:
        if name is not None:
            for cut in self.cuts:
                if cut.name == name:
                    return cut.symbol
        symbol = ca.SX.sym(name or f"cut_{len(self.cuts)}")
        self.cuts.append(Cut(symbol, expression, name, unit, description))
        return symbol
