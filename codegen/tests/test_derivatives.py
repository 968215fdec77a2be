"""Derivatives equal CasADi's of the Lagrangian, and each other; their operations stay below ceilings."""

from dataclasses import replace
from functools import cache

import casadi as ca
import numpy as np
import pytest

from codegen import graph
from codegen.derivatives import MATRICES, Derivatives, DerivativesError
from codegen.functions import Functions
from codegen.impact_derivatives import RESULTS
from codegen.layout import Layout

from .interpreter import Interpreter
from .lagrangian import Lagrangian
from .samples import LAYOUTS, parameters, randomized, states
from .test_graph import check_statements, elements, functions, names_used, recount

SEED = 20170614
# Rounding relative to the largest entry: derivatives are solved for twice, with systems of condition 1e2 to 1e4.
TOLERANCE = 1e-10
DIRECTIONAL = ("forward_dynamics", "momentum", "full_impact:parameters")
FORCES = {"": 0, "_with_base_wrench": 1, "_with_wrenches": 2}
# Arithmetic operations for two arms of three links, where forward dynamics has 331: a rise must be a decision.
CEILINGS = {
    "inverse_mass_matrix": 521,
    "forward_dynamics_derivatives": 1592,
    "forward_dynamics_with_base_wrench_derivatives": 1623,
    "forward_dynamics_with_wrenches_derivatives": 1798,
    "forward_dynamics_derivative": 946,
    "momentum_derivative": 581,
    "exact_impact_derivatives": 5104,
    "paper_impact_derivatives": 9791,
}


@cache
def derived(layout: Layout) -> dict:
    return graph.build(Functions(layout, derivatives=Derivatives(("forward_dynamics",), DIRECTIONAL)))


@cache
def with_impacts(layout: Layout) -> dict:
    return graph.build(Functions(layout, derivatives=Derivatives(MATRICES, DIRECTIONAL)))


def reference(layout: Layout) -> ca.Function:
    """(q, v, f, end-effector wrenches) to accelerations and their Jacobians, from the Lagrangian."""
    robot = Lagrangian(layout)
    q, v, f = (ca.SX.sym(name, robot.size) for name in "qvf")
    wrenches = ca.SX.sym("wrenches", 3 * robot.arms)
    values = dict(zip(robot.results, robot.function(q, v), strict=True))
    right = f + values["end_effector_jacobian"].T @ wrenches - values["bias"]
    a = ca.solve(values["mass"], right)
    return ca.Function("reference", [q, v, f, wrenches], [a, *(ca.jacobian(a, x) for x in (q, v, f))])


def poses(layout: Layout, found: dict, rng: np.random.Generator) -> list[dict]:
    """Random states, and symmetric and stretched poses and some close to them."""
    drawn = states(found, rng, 5)
    drawn[1]["joint_angles"] *= 0.0
    drawn[2]["joint_angles"] = np.pi * rng.integers(-1, 2, size=layout.joints)
    drawn[3]["joint_angles"] = 1e-9 * rng.uniform(-1, 1, size=layout.joints)
    return drawn


@pytest.mark.parametrize("name", LAYOUTS)
def test_matrices_equal_those_of_the_lagrangian(name):
    layout, found = LAYOUTS[name], derived(LAYOUTS[name])
    rng = np.random.default_rng(SEED)
    for numbers in (layout, randomized(layout, rng)):
        model, expected = Interpreter(found, parameters(found, numbers)), reference(numbers)
        for state in poses(layout, found, rng):
            q = np.concatenate([state["base_pose"], state["joint_angles"]])
            v = np.concatenate([state["base_twist"], state["joint_rates"]])
            for suffix, present in FORCES.items():
                f = np.concatenate([state["base_wrench"] * (present > 0), state["joint_torques"]])
                wrenches = state["end_effector_wrenches"].ravel() * (present > 1)
                a, *jacobians = (value.full() for value in expected(q, v, f, wrenches))
                result = model.call(f"forward_dynamics{suffix}_derivatives", **state)
                pairs = [(np.concatenate([result["base_acceleration"], result["joint_accelerations"]]), a.ravel())]
                outputs = ("by_position", "by_velocity", "inverse_mass_matrix")
                pairs += [(result[output], right) for output, right in zip(outputs, jacobians, strict=True)]
                for value, right in pairs:
                    assert np.max(np.abs(value - right)) <= TOLERANCE * np.max(np.abs(right)), (suffix, state)
            alone = model.call("inverse_mass_matrix", **state)["inverse_mass_matrix"]
            assert np.array_equal(alone, result["inverse_mass_matrix"])
            assert np.array_equal(alone, alone.T)


@pytest.mark.parametrize("name", ["single_arm_2r", "dual_arm_3r", "three_arms", "wheel_inside", "one_mount"])
def test_impacts_and_their_derivatives(name):
    """Values are those of the impact family, matrices are difference quotients."""
    found = with_impacts(LAYOUTS[name])
    model, step = Interpreter(found), 1e-6
    blocks = {
        "by_position": ("base_pose", "joint_angles"),
        "by_velocity": ("base_twist", "joint_rates"),
        "by_contacts": ("contacts",),
        "by_target_twists": ("target_twists",),
    }
    for state in states(found, np.random.default_rng(SEED), 2):
        for function, origin in (("exact_impact", "full_impact"), ("paper_impact", "reduced_impact")):
            values, right = model.call(function, **state), model.call(origin, **state)["joint_rates_after"]
            assert np.max(np.abs(values["joint_rates_after"] - right)) <= TOLERANCE * np.max(np.abs(right))
            result = model.call(f"{function}_derivatives", **state)
            for output, inputs in blocks.items():
                columns = []
                for key in inputs:
                    for place in np.ndindex(state[key].shape):
                        sides = []
                        for side in (step, -step):
                            moved = {**state, key: state[key].copy()}
                            moved[key][place] += side
                            there = model.call(function, **moved)
                            sides.append(np.concatenate([there[part].ravel() for part in RESULTS]))
                        columns.append((sides[0] - sides[1]) / (2 * step))
                quotient = np.array(columns).T
                assert np.max(np.abs(result[output] - quotient)) <= 1e-7 * np.max(np.abs(quotient)), output


@pytest.mark.parametrize("name", LAYOUTS)
def test_directional_derivatives_are_products_with_the_matrices(name):
    found = derived(LAYOUTS[name])
    model = Interpreter(found)
    for state in states(found, np.random.default_rng(SEED), 3):
        matrices = model.call("forward_dynamics_derivatives", **state)
        along = model.call("forward_dynamics_derivative", **state)
        part = {key: state[f"{key}_direction"] for key in ("base_pose", "joint_angles", "base_twist", "joint_rates")}
        expected = matrices["by_position"] @ np.concatenate([part["base_pose"], part["joint_angles"]])
        expected += matrices["by_velocity"] @ np.concatenate([part["base_twist"], part["joint_rates"]])
        expected += matrices["inverse_mass_matrix"][:, 3:] @ state["joint_torques_direction"]
        value = np.concatenate(
            [along[f"{output}_derivative"] for output in ("base_acceleration", "joint_accelerations")]
        )
        assert np.max(np.abs(value - expected)) <= TOLERANCE * np.max(np.abs(expected))
        right = model.call("forward_dynamics", **state)["joint_accelerations"]
        assert np.max(np.abs(along["joint_accelerations"] - right)) <= TOLERANCE * np.max(np.abs(right))


@pytest.mark.parametrize("name", LAYOUTS)
def test_derivatives_by_parameters_are_difference_quotients(name):
    found = derived(LAYOUTS[name])
    own = {p["name"]: p["default"] for p in found["parameters"]}
    state = states(found, np.random.default_rng(SEED), 1)[0]
    along = Interpreter(found).call("full_impact_derivative_by_parameters", **state)
    step, sides = 1e-6, []
    for side in (step, -step):
        numbers = {
            key: value + side * d for (key, value), d in zip(own.items(), state["parameters_direction"], strict=True)
        }
        moved = {key: value + side * state.get(f"{key}_direction", 0.0) for key, value in state.items()}
        sides.append(Interpreter(found, numbers).call("full_impact", **moved))
    for output in ("impact_matrix", "impact_momentum", "base_twist_after", "joint_rates_after"):
        quotient = (sides[0][output] - sides[1][output]) / (2 * step)
        value = along[f"{output}_derivative"]
        assert np.max(np.abs(value - quotient)) <= 1e-7 * np.max(np.abs(quotient)), output


@pytest.mark.parametrize("name", LAYOUTS)
def test_statements_of_derivatives_are_single_assignments(name):
    """As those of every function; what depends on parameters alone may be assigned in the call, for it has no name."""
    found = derived(LAYOUTS[name])
    fixed = {p["name"] for p in found["parameters"]} | {value["name"] for value in found["constants"]["values"]}
    configuration = elements(found, {"base_pose", "joint_angles"})
    for family in found["families"]:
        assigned = check_statements(family["configuration"]["statements"], fixed | configuration)
        assert set(family["configuration"]["values"]) <= assigned
        for function in family["functions"]:
            known = fixed | set(family["configuration"]["values"]) | elements(found, set(function["inputs"]))
            known |= check_statements(function["statements"], known)
            assert names_used([], function["outputs"]) <= known
            assert function["operations"] == recount(family, function), function["name"]


def test_a_graph_says_what_each_output_is_the_derivative_of():
    found = with_impacts(LAYOUTS["single_arm_3r"])
    assert found["options"] == ["--derivatives", "--directional", ",".join(DIRECTIONAL)]
    sizes = {item["name"]: int(np.prod(item["shape"])) for item in found["inputs"]}
    outputs = {f["name"]: {o["name"]: o for o in f["outputs"]} for _, f in functions(found)}
    derivatives = [o for f in outputs.values() for o in f.values() if "derivative" in o]
    assert len(derivatives) == 1 + 3 * 5 + 2 * 8 + (2 * 2 + 1) + 3 * 2 + (4 * 2 + 1)
    for output in derivatives:
        origin = output["derivative"]
        rows = sum(len(outputs[origin["function"]][name]["elements"]) for name in origin["outputs"])
        if origin["by"]:
            assert output["shape"] == [rows, sum(sizes[name] for name in origin["by"])]
        else:
            assert output["shape"] == outputs[origin["function"]][origin["outputs"][0]]["shape"]


@pytest.mark.parametrize("name", CEILINGS)
def test_operations_stay_below_their_ceiling(name):
    counts = {
        function["name"]: function["operations"] for _, function in functions(with_impacts(LAYOUTS["dual_arm_3r"]))
    }
    assert counts[name]["flops"] <= CEILINGS[name]
    assert counts[name]["sin_cos"] == 7, "one per body"


def test_what_cannot_be_derived_is_an_error():
    def derive(layout: str | Layout, *directional: str) -> None:
        robot = LAYOUTS[layout] if isinstance(layout, str) else layout
        Functions(robot, derivatives=Derivatives(directional=directional))

    with pytest.raises(DerivativesError, match=r"no function `momenta`.* momentum"):
        derive("single_arm_2r", "momenta")
    with pytest.raises(DerivativesError, match=r"COM of the last link of arm `at_0.5_0.0_0.0` is at its joint"):
        derive("wheel_at_the_end", "forward_dynamics:parameters")
    # beside an arm that has the derivative, too
    wheels = LAYOUTS["wheel_at_the_end"]
    second = replace(wheels, arms=(LAYOUTS["chain_2"].arms[0], wheels.arms[1]))
    with pytest.raises(DerivativesError, match=r"COM of the last link of arm `at_-0.4_0.0_0.0` is at its joint"):
        derive(second, "forward_dynamics:parameters")
    derive("wheel_at_the_end", "forward_dynamics", "reduced_dynamics:parameters")
    with pytest.raises(DerivativesError, match=r"no derivatives of `momentum`; there are: forward_dynamics, impact"):
        Derivatives(("momentum",))
    assert Derivatives(("impact",)).options() == ["--derivatives=impact"]
    assert Derivatives(("impact", "forward_dynamics")).options() == ["--derivatives"]
