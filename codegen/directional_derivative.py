"""Computes directional derivatives of functions, by forward differentiation of their expressions."""

from dataclasses import dataclass, replace

import casadi as ca

from .derivatives import PARAMETERS, DerivativesError
from .inputs import INPUTS, Inputs, input_shapes
from .signatures import Derivative, Family, Function, Output, Section
from .symbols import Symbols
from .tangent import Tangent

BY_PARAMETERS = "parameters_direction"


@dataclass(frozen=True)
class Direction:
    """An input that holds the part of a direction in another input, or in the parameters."""

    symbol: ca.SX
    shape: list[int]
    unit: str
    description: str


class DirectionalDerivatives:
    """Families of directional derivatives; ``directions`` has the inputs that they need."""

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.symbols, self.inputs = symbols, inputs
        self.shapes = input_shapes(len(symbols.arms), symbols.joints)
        self.directions: dict[str, Direction] = {}

    def family(self, asked: str, functions: dict[str, Function]) -> Family:
        name, by_parameters = asked.removesuffix(PARAMETERS), asked.endswith(PARAMETERS)
        if name not in functions:
            raise DerivativesError(f"--directional: no function `{name}`; there are: {', '.join(functions)}")
        function = functions[name]
        if by_parameters and name.startswith("forward_dynamics"):
            self._check_last_links(name)
        variables = [getattr(self.inputs, name) for name in function.inputs]
        seeds = [self._direction(name).symbol for name in function.inputs]
        along = [*function.inputs]
        if by_parameters:
            variables.append(ca.vertcat(*[parameter.symbol for parameter in self.symbols.parameters]))
            seeds.append(self._parameters().symbol)
            along.append("parameters")
        tangent = Tangent(self.symbols, variables, seeds)
        outputs = []
        for output in function.outputs:
            outputs.append(replace(output, derivative=Derivative(name, [output.name])))
            if output.name != "smallest_pivot":
                outputs.append(self._derivative(name, output, tangent, along))
        title = f"{name}_derivative_by_parameters" if by_parameters else f"{name}_derivative"
        text = " The direction has parameters, too." if by_parameters else ""
        derivative = Function(
            title,
            f"Directional derivative of `{name}`.{text}",
            "d/ds f(x + s direction) at s = 0",
            function.source,
            [*function.inputs, *(f"{name}_direction" for name in along)],
            outputs,
            [Section("values", *(output.elements for output in function.outputs))],
        )
        return Family(title, f"Directional derivative of `{name}`.", [derivative], [])

    def _check_last_links(self, name: str) -> None:
        """Forward dynamics has distance and direction of the last links' COMs, which have no derivative at zero."""
        for arm in self.symbols.layout.arms:
            if arm.links[-1].com == (0.0, 0.0):
                text = f"the COM of the last link of arm `{arm.name}` is at its joint"
                raise DerivativesError(f"--directional: `{name}` has no derivative by parameters: {text}")

    def _derivative(self, function: str, output: Output, tangent: "Tangent", along: list[str]) -> Output:
        return Output(
            f"{output.name}_derivative",
            output.shape,
            f"{output.unit}, per unit of the direction",
            f"derivative of {output.name} along the direction",
            tangent.of(output.elements),
            Derivative(function, [output.name], along=along),
        )

    def _direction(self, name: str) -> Direction:
        shape, (_, unit, description) = self.shapes[name], INPUTS[name]
        symbol = ca.SX.sym(f"{name}_direction", *reversed(shape))
        new = Direction(symbol, shape, f"{unit}, per unit", f"part of the direction: {description}")
        return self.directions.setdefault(f"{name}_direction", new)

    def _parameters(self) -> Direction:
        size = len(self.symbols.parameters)
        text = "part of the direction: parameters, in the order of the manifest"
        new = Direction(ca.SX.sym(BY_PARAMETERS, size), [size], "of each parameter, per unit", text)
        return self.directions.setdefault(BY_PARAMETERS, new)
