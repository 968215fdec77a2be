"""Every output of every function in the graph equals the Lagrangian's, to rounding."""

import numpy as np
import pytest

from codegen.impact import is_in_loops

from .interpreter import Interpreter
from .lagrangian import Lagrangian
from .samples import LAYOUTS, derived, parameters, randomized, states

SEED = 20170613
STATES = 5
# Rounding relative to the largest entry. Both sides solve systems of condition 1e2 to 1e4, so 1e-16 becomes 1e-12.
TOLERANCE = 1e-11
FUNCTIONS = [f["name"] for family in derived(LAYOUTS["single_arm_3r"])["families"] for f in family["functions"]]


def samples(name: str) -> list[tuple[Interpreter, Lagrangian, list[dict]]]:
    """The layout's own numbers and others, each with random states; the same for every function."""
    layout, graph = LAYOUTS[name], derived(LAYOUTS[name])
    rng = np.random.default_rng(SEED)
    chosen = [layout, randomized(layout, rng), randomized(layout, rng)]
    return [
        (Interpreter(graph, parameters(graph, numbers)), Lagrangian(numbers), states(graph, rng, STATES))
        for numbers in chosen
    ]


@pytest.fixture(scope="module")
def sampled():
    """Samples of a layout with the Lagrangian's outputs, made once."""
    made = {}

    def get(name: str):
        if name not in made:
            made[name] = [
                (model, state, robot.at(state).outputs) for model, robot, drawn in samples(name) for state in drawn
            ]
        return made[name]

    return get


def relative_error(found: np.ndarray, right: np.ndarray) -> float:
    """Largest difference over the largest entry; the floor is for outputs that are all zero."""
    return float(np.max(np.abs(found - right)) / max(np.max(np.abs(right)), 1e-3))


@pytest.mark.parametrize("name", LAYOUTS)
def test_functions_are_the_same_in_every_layout(name):
    assert [f["name"] for family in derived(LAYOUTS[name])["families"] for f in family["functions"]] == FUNCTIONS


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize("name", LAYOUTS)
def test_equals_the_lagrangian(name, function, sampled):
    for n, (model, state, outputs) in enumerate(sampled(name)):
        assert function in outputs, f"no second derivation of {function}"
        found, right = model.call(function, **state), outputs[function]
        assert found.keys() == right.keys(), f"outputs of {function} without a second derivation, or the reverse"
        for output, value in found.items():
            assert value.shape == np.shape(right[output]), output
            error = relative_error(value, np.asarray(right[output]))
            assert error <= TOLERANCE, f"{name} {function}.{output}: {error:.1e}, sample {n} of seed {SEED}: {state}"
            if output == "smallest_pivot":
                assert 0 < value <= 1


@pytest.mark.parametrize("name", LAYOUTS)
def test_matrices_of_loops_are_the_generalized_ones(name, sampled):
    """Above a size alone, where single assignments would be too many."""
    arms = LAYOUTS[name].arms
    for model, state, outputs in sampled(name):
        matrices = model.call("reduced_impact", "matrices", **state)
        assert bool(matrices) == is_in_loops(len(arms), sum(len(arm.links) for arm in arms)), name
        for matrix, value in matrices.items():
            assert relative_error(value, np.asarray(outputs["reduced_dynamics"][matrix])) <= TOLERANCE, matrix
    assert [is_in_loops(*size) for size in [(2, 10), (4, 8), (3, 9), (2, 12), (1, 12)]] == [
        False,
        False,
        True,
        True,
        True,
    ]


@pytest.mark.parametrize("name", LAYOUTS)
def test_capturing_nothing_changes_nothing(name, sampled):
    for model, state, _ in sampled(name):
        nothing = {**state, "target_masses": 0 * state["target_masses"], "target_inertias": 0 * state["target_masses"]}
        found = model.call("full_impact", **nothing)
        after = np.concatenate([found["base_twist_after"], found["joint_rates_after"]])
        before = np.concatenate([state["base_twist"], state["joint_rates"]])
        assert relative_error(after, before) <= TOLERANCE
        assert relative_error(found["impact_matrix"], model.call("mass_matrix", **state)["mass_matrix"]) <= TOLERANCE
