"""Graphs are reproducible, in single assignments, staged and described; their operations stay below ceilings."""

import math
import os
import re
import subprocess
import sys
from collections import Counter
from itertools import pairwise

import pytest

from codegen import graph
from codegen.derive import HERE, derive_text, graph_path, layout_path
from codegen.functions import Functions
from codegen.json_text import dump
from codegen.layout import content_hash, layout_names, read

from .samples import LAYOUTS, derived, parameters

SHIPPED = layout_names()
CONFIGURATION = {"base_pose", "joint_angles"}
# Arithmetic operations of each function alone for two arms of three links: a rise must be a decision.
CEILINGS = {
    "forward_dynamics": 341,  # of these 10 so that a model is built without a root and an arctangent
    "forward_dynamics_with_base_wrench": 352,
    "forward_dynamics_with_wrenches": 410,
    "reduced_dynamics": 560,
}


def functions(graph: dict) -> list[tuple[dict, dict]]:
    """(family, function) pairs."""
    return [(family, function) for family in graph["families"] for function in family["functions"]]


def targets(statement: list) -> list[str]:
    """Names that a statement assigns; `_` of a sine and cosine pair is none."""
    return [name for name in statement[0] if name != "_"] if statement[1] == "sin_cos" else [statement[0]]


def names_used(statements: list, outputs: list = ()) -> set[str]:
    operands = [a for line in statements for a in line[2:]] + [e for o in outputs for e in o["elements"]]
    return {a for a in operands if isinstance(a, str)}


def results(function: dict) -> list[dict]:
    """Outputs, and the matrices from which rendered code has them in loops."""
    return [*function["outputs"], *function.get("matrices", [])]


def elements(graph: dict, inputs: set[str]) -> set[str]:
    """Names of the elements of inputs, `name[i]` or `name[i][j]`."""
    names = set()
    for item in graph["inputs"]:
        if item["name"] in inputs:
            indices = [""]
            for length in item["shape"]:
                indices = [f"{prefix}[{i}]" for prefix in indices for i in range(length)]
            names.update(item["name"] + index for index in indices)
    return names


def check_statements(statements: list, known: set[str]) -> set[str]:
    """Checks that each operand is known and each name new; returns the new names."""
    assigned = set()
    for line in statements:
        for operand in line[2:]:
            if isinstance(operand, str):
                assert operand in known | assigned, f"{operand} is not known in {line}"
            else:
                assert math.isfinite(operand)
        for name in targets(line):
            assert name not in known | assigned, f"{name} is assigned again in {line}"
            assigned.add(name)
    return assigned


@pytest.mark.parametrize("name", SHIPPED)
def test_the_committed_graph_is_what_its_layout_gives(name):
    assert graph_path(name).read_text(encoding="utf-8") == derive_text(layout_path(name)), (
        f"stale: python -m codegen {name}"
    )


def test_every_graph_has_a_layout():
    assert sorted(path.stem for path in (HERE / "graphs").glob("*.json")) == SHIPPED


@pytest.mark.parametrize("name", LAYOUTS)
def test_deriving_twice_gives_the_same_text(name):
    assert dump(derived(LAYOUTS[name])) == dump(graph.build(Functions(LAYOUTS[name])))


@pytest.mark.parametrize("seed", ["1", "20170613"])
def test_the_order_of_hashing_does_not_show(seed):
    code = f"from codegen.derive import *\nfor name in {SHIPPED!r}: print(derive_text(layout_path(name)), end='')"
    environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONIOENCODING": "utf-8"}
    result = subprocess.run([sys.executable, "-c", code], cwd=HERE.parent, env=environment, capture_output=True)
    assert result.returncode == 0, result.stderr.decode()
    assert result.stdout == "".join(derive_text(layout_path(name)) for name in SHIPPED).encode()


@pytest.mark.parametrize("name", SHIPPED)
def test_the_header_names_the_layout_and_the_command(name):
    layout, found = read(layout_path(name)), derived(LAYOUTS[name])
    assert found["layout"]["sha256"] == content_hash(layout)
    assert found["layout"]["arms"] == [{"name": arm.name, "links": len(arm.links)} for arm in layout.arms]
    assert found["command"] == f"python -m codegen {name}"


@pytest.mark.parametrize("name", LAYOUTS)
def test_every_statement_is_in_a_section(name):
    """Sections divide the statements of a stage in order, none is empty and none comes twice."""
    for family in derived(LAYOUTS[name])["families"]:
        for stage in [family["configuration"], *family["functions"]]:
            names, starts = [[section[k] for section in stage["sections"]] for k in (0, 1)]
            assert all(names) and len(set(names)) == len(names), names
            assert starts[:1] == [0][: len(stage["statements"])]
            assert all(start < end for start, end in pairwise([*starts, len(stage["statements"])])), starts


@pytest.mark.parametrize("name", LAYOUTS)
def test_sections_are_named_after_the_passes(name):
    """Each arm has the passes of each algorithm, in the order in which they use each other."""
    layout, found = LAYOUTS[name], derived(LAYOUTS[name])
    arms = [f"arm {i + 1}" for i in range(len(layout.arms))]
    forward, equations = found["families"][0], found["families"][1]
    expected = ["sines and cosines", *(f"{arm}, articulated inertia" for arm in arms), "base, articulated inertia"]
    assert [section for section, _ in forward["configuration"]["sections"]] == expected
    passes = [f"{arm}, inward pass" for arm in arms] + ["base, acceleration"]
    passes += [f"{arm}, outward pass" for arm in arms]
    assert [section for section, _ in forward["functions"][0]["sections"]] == passes
    bias = next(function for function in equations["functions"] if function["name"] == "bias")
    recursion = [f"{arm}, {direction} pass" for arm in arms for direction in ("outward", "inward")]
    assert [section for section, _ in bias["sections"]][: len(recursion)] == recursion


@pytest.mark.parametrize("name", LAYOUTS)
def test_each_name_is_assigned_once_and_known_before_its_use(name):
    """Each stage reads parameters, named constants, its own inputs, and the values of the stage before it."""
    found = derived(LAYOUTS[name])
    parameters = {p["name"] for p in found["parameters"]}
    assert len(parameters) == len(found["parameters"])
    named = {value["name"] for value in found["constants"]["values"]}
    assert named <= check_statements(found["constants"]["statements"], parameters)
    fixed = parameters | named
    configuration = elements(found, CONFIGURATION)
    for family in found["families"]:
        stage = family["configuration"]
        assigned = check_statements(stage["statements"], fixed | configuration)
        assert len(set(stage["values"])) == len(stage["values"])
        assert set(stage["values"]) <= assigned
        for function in family["functions"]:
            known = fixed | set(stage["values"]) | elements(found, set(function["inputs"]) - CONFIGURATION)
            known |= check_statements(function["statements"], known)
            assert names_used([], results(function)) <= known


@pytest.mark.parametrize("name", LAYOUTS)
def test_every_value_is_used(name):
    found = derived(LAYOUTS[name])
    everywhere = set()
    for family in found["families"]:
        statements = family["configuration"]["statements"]
        called = set()
        for function in family["functions"]:
            used = names_used(function["statements"], results(function))
            called |= used
            assert all(used.intersection(targets(line)) for line in function["statements"]), function["name"]
            read_by_call = {re.sub(r"\[.*", "", operand) for operand in used}
            assert set(function["inputs"]) - CONFIGURATION <= read_by_call, function["name"]
        within = names_used(statements)
        assert all((within | called).intersection(targets(line)) for line in statements), family["name"]
        assert set(family["configuration"]["values"]) <= called
        everywhere |= within | called
    constants = found["constants"]["statements"]
    within = names_used(constants)
    assert all((within | everywhere).intersection(targets(line)) for line in constants)
    assert {p["name"] for p in found["parameters"]} <= within | everywhere


@pytest.mark.parametrize("name", LAYOUTS)
def test_everything_public_is_described(name):
    found = derived(LAYOUTS[name])
    inputs = {item["name"]: item for item in found["inputs"]}
    values = [*found["parameters"], *found["constants"]["values"]]
    outputs = [o for _, function in functions(found) for o in results(function)]
    for item in [*inputs.values(), *values, *outputs]:
        assert item["unit"] and item["description"], item["name"]
        assert re.fullmatch("[a-z][a-z0-9_]*", item["name"])
    for item in [*inputs.values(), *outputs]:
        assert all(isinstance(n, int) and n > 0 for n in item["shape"]), item["name"]
    for output in outputs:
        assert len(output["elements"]) == math.prod(output["shape"]), output["name"]
    for family, function in functions(found):
        assert family["description"] and function["description"] and function["equation"] and function["source"]
        assert set(function["inputs"]) <= inputs.keys()
        assert function["outputs"]
        assert len({o["name"] for o in function["outputs"]}) == len(function["outputs"])


@pytest.mark.parametrize("name", LAYOUTS)
def test_only_documented_zeros_are_structural(name):
    """No parameter for a zero mount[1], mount_angle, com[1] or length of an inner link; for all else a default."""
    layout = LAYOUTS[name]
    found = derived(layout)
    assert {p["name"]: p["default"] for p in found["parameters"]} == parameters(found, layout)
    expected = [("base_mass", None, None), ("base_inertia", None, None)]
    for i, arm in enumerate(layout.arms):
        structural = [("mount_y", arm.mount[1]), ("mount_angle", arm.mount_angle)]
        expected += [("mount_x", i, None)] + [(quantity, i, None) for quantity, value in structural if value != 0]
        for k, link in enumerate(arm.links):
            last = k == len(arm.links) - 1
            structural = [("link_length", link.length), ("link_com_y", link.com[1])]
            expected += [(quantity, i, k) for quantity in ("link_mass", "link_inertia", "link_com_x")]
            expected += [(quantity, i, k) for quantity, value in structural if last or value != 0]
    assert Counter((p["quantity"], p["arm"], p["link"]) for p in found["parameters"]) == Counter(expected)


def recount(family: dict, function: dict) -> Counter:
    """Operations that the outputs depend on, in both stages; parameters and constants cost none."""
    lines = [*family["configuration"]["statements"], *function["statements"]]
    made_by = {name: i for i, line in enumerate(lines) for name in targets(line)}
    pending = [e for o in function["outputs"] for e in o["elements"]]
    needed = set()
    while pending:
        i = made_by.get(pending.pop())
        if i is not None and i not in needed:
            needed.add(i)
            pending += lines[i][2:]
    return tally(lines[i] for i in needed)


def tally(lines) -> Counter:
    counts = Counter(line[1] for line in lines if line[1] != "copy")
    counts["flops"] = sum(counts[op] for op in ("add", "sub", "mul", "div"))
    return counts


@pytest.mark.parametrize("name", LAYOUTS)
def test_operation_counts_are_true(name):
    found = derived(LAYOUTS[name])
    assert found["constants"]["operations"] == tally(found["constants"]["statements"])
    for family in found["families"]:
        assert family["configuration"]["operations"] == tally(family["configuration"]["statements"])
    for family, function in functions(found):
        assert function["operations"] == recount(family, function), function["name"]


@pytest.mark.parametrize("name", CEILINGS)
def test_operations_stay_below_their_ceiling(name):
    counts = {
        function["name"]: recount(*pair) for pair in functions(derived(LAYOUTS["dual_arm_3r"])) for function in pair[1:]
    }
    assert counts[name]["flops"] <= CEILINGS[name]
    assert counts[name]["sin_cos"] == 7, "one per body"
