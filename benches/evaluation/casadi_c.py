"""Writes CasADi's C code of a shipped layout's functions, with the layout's numbers in it, for comparison:

    python3 -m codegen.environment    # prints the Python that has CasADi
    PYTHONPATH=. THAT_PYTHON benches/evaluation/casadi_c.py dual_arm_3r benches/evaluation/casadi/dual_arm_3r.c

The formulation is the one that the project derives. CasADi's simplification on the fly is off: it turns a * (1 / b)
into a / b, which triples the divisions. The compiler folds the numbers. Derivatives of forward dynamics are CasADi's
own, in the best of its ways: columns by forward differentiation, with what they have in common found afterwards.
"""

import sys
from pathlib import Path

import casadi as ca

from codegen.derive import layout_path
from codegen.functions import Functions
from codegen.layout import read
from codegen.signatures import Function
from codegen.tangent import Tangent

FUNCTIONS = ("forward_dynamics", "reduced_dynamics", "reduced_impact", "full_impact")


def derivatives(functions: Functions, function: Function) -> tuple[list[ca.SX], list[ca.SX]]:
    """(inputs, results) of forward dynamics with a base wrench: accelerations, and their derivatives by position, velocity
    and forces as row-major matrices, for a base wrench of zero."""
    inputs, symbols = functions.inputs, functions.symbols
    accelerations = [element for output in function.outputs[:2] for element in output.elements]
    pairs = [("base_pose", "joint_angles"), ("base_twist", "joint_rates"), ("base_wrench", "joint_torques")]
    matrices = []
    for names in pairs:
        variables = [getattr(inputs, name) for name in names]
        size, columns = sum(variable.numel() for variable in variables), []
        for k in range(size):
            unit = ca.vertsplit(ca.SX([float(i == k) for i in range(size)]), [0, 3, size])
            columns.append(ca.vertcat(*Tangent(symbols, variables, unit).of(accelerations)))
        matrices.append(ca.vec(ca.horzcat(*columns).T))
    results = [ca.vertcat(*accelerations[:3]), ca.vertcat(*accelerations[3:]), *matrices]
    given = [getattr(inputs, name) for name in function.inputs if name != "base_wrench"]
    return given, ca.substitute(results, [inputs.base_wrench], [ca.SX.zeros(3, 1)])


def main(name: str, path: str) -> None:
    functions = Functions(read(layout_path(name)))
    with_wrench = next(f for f in functions.families[0].functions if f.name == "forward_dynamics_with_base_wrench")
    given, columns = derivatives(functions, with_wrench)
    ca.GlobalOptions.setSimplificationOnTheFly(False)
    symbols = [parameter.symbol for parameter in functions.symbols.parameters]
    values = [ca.SX(parameter.default) for parameter in functions.symbols.parameters]
    for variable in functions.symbols.auxiliary_variables:
        (value,) = ca.substitute([variable.expression], symbols, values)
        symbols.append(variable.symbol)
        values.append(value)
    file = Path(path)
    generator = ca.CodeGenerator(file.name, {"verbose": False})
    for function in (function for family in functions.families for function in family.functions):
        if function.name in FUNCTIONS:
            outputs = ca.substitute([ca.vertcat(*output.elements) for output in function.outputs], symbols, values)
            inputs = [getattr(functions.inputs, name) for name in function.inputs]
            generator.add(ca.Function(f"casadi_{function.name}", inputs, outputs, {"cse": True}))
    results = [ca.densify(value) for value in ca.substitute(columns, symbols, values)]
    generator.add(ca.Function("casadi_forward_dynamics_derivatives", given, results, {"cse": True}))
    generator.generate(f"{file.parent}/")


main(*sys.argv[1:])
