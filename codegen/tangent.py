"""Computes derivatives of expressions along a direction, through auxiliary variables.

These stand for expressions, which CasADi does not see: the derivative of each along the direction is another
expression, that of a reciprocal r = 1 / e being -r^2 de.
"""

import casadi as ca

from .symbols import AuxiliaryVariable, Symbols


class Tangent:
    """The direction ``seeds`` in ``variables``; auxiliary variables that are made later are constants."""

    def __init__(self, symbols: Symbols, variables: list[ca.SX], seeds: list[ca.SX]) -> None:
        self._auxiliary = {variable.symbol.name(): variable for variable in symbols.auxiliary_variables}
        self._seeds: dict[str, ca.SX] = {}
        for variable, seed in zip(variables, seeds, strict=True):
            pairs = zip(ca.vertsplit(ca.vec(variable)), ca.vertsplit(ca.densify(ca.vec(seed))), strict=True)
            self._seeds.update((element.name(), part) for element, part in pairs)

    def of(self, expressions: list[ca.SX]) -> list[ca.SX]:
        column = ca.vertcat(*expressions)
        symbols = [symbol for symbol in ca.symvar(column) if not self._seed(symbol).is_zero()]
        if not symbols:
            return [ca.SX(0) for _ in expressions]
        seeds = [self._seed(symbol) for symbol in symbols]
        derivatives = ca.jtimes(ca.densify(column), ca.vertcat(*symbols), ca.vertcat(*seeds))
        return ca.vertsplit(ca.densify(derivatives))

    def _seed(self, symbol: ca.SX) -> ca.SX:
        name = symbol.name()
        if name not in self._seeds:
            variable = self._auxiliary.get(name)
            self._seeds[name] = ca.SX(0) if variable is None else self._of_auxiliary(variable)
        return self._seeds[name]

    def _of_auxiliary(self, variable: AuxiliaryVariable) -> ca.SX:
        if variable.reciprocal_of is None:
            return self.of([variable.expression])[0]
        (derivative,) = self.of([variable.reciprocal_of])
        return -(variable.symbol * variable.symbol) * derivative
