"""Writes CasADi's C code of a shipped layout's functions, with the layout's numbers in it, for comparison:

    python3 -m codegen.environment    # prints the Python that has CasADi
    PYTHONPATH=. THAT_PYTHON benches/evaluation/casadi_c.py dual_arm_3r benches/evaluation/casadi/dual_arm_3r.c

The formulation is the one that the project derives. CasADi's simplification on the fly is off: it turns a * (1 / b)
into a / b, which triples the divisions. The compiler folds the numbers.
"""

import sys
from pathlib import Path

import casadi as ca

from codegen.derive import layout_path
from codegen.functions import Functions
from codegen.layout import read

FUNCTIONS = ("forward_dynamics", "reduced_dynamics", "reduced_impact", "full_impact")


def main(name: str, path: str) -> None:
    functions = Functions(read(layout_path(name)))
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
    generator.generate(f"{file.parent}/")


main(*sys.argv[1:])
