"""Computes the outputs of a graph, as its JSON has it, from inputs in double precision."""

import math

import numpy as np

OPERATIONS = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "copy": lambda a: a,
    "neg": lambda a: -a,
    "min": min,
    "sqrt": math.sqrt,
    "atan2": math.atan2,
}


class Interpreter:
    """The functions of a graph, with parameters set."""

    def __init__(self, graph: dict, parameters: dict[str, float] | None = None) -> None:
        self.graph = graph
        self.values = {p["name"]: p["default"] for p in graph["parameters"]}
        self.values.update(parameters or {})
        self._run(graph["constants"]["statements"], self.values)
        self.functions = {f["name"]: (family, f) for family in graph["families"] for f in family["functions"]}

    def call(self, name: str, results: str = "outputs", **inputs) -> dict[str, np.ndarray]:
        """The outputs of a function by name, or its matrices."""
        family, function = self.functions[name]
        values = dict(self.values)
        for key in function["inputs"]:
            array = np.asarray(inputs[key], dtype=float)
            for index in np.ndindex(array.shape):
                values[key + "".join(f"[{i}]" for i in index)] = float(array[index])
        self._run(family["configuration"]["statements"], values)
        self._run(function["statements"], values)
        return {
            o["name"]: np.array([self._value(e, values) for e in o["elements"]]).reshape(o["shape"])
            for o in function.get(results, [])
        }

    @staticmethod
    def _value(operand, values: dict) -> float:
        return values[operand] if isinstance(operand, str) else operand

    def _run(self, statements: list, values: dict) -> None:
        for target, op, *args in statements:
            operands = [self._value(a, values) for a in args]
            if op == "sin_cos":
                values[target[0]], values[target[1]] = math.sin(operands[0]), math.cos(operands[0])
            else:
                values[target] = OPERATIONS[op](*operands)
