"""Operations are polynomials in the numbers of links and arms, counted in the graphs; docs/scaling.md has examples."""

from itertools import pairwise

import pytest

from .samples import derived, regular

# Degree of the polynomial in the links of each arm that the operations of a function are, and why.
DEGREES = {
    "forward_dynamics": 1,  # articulated bodies: one inward and one outward step per link
    "forward_dynamics_with_base_wrench": 1,
    "forward_dynamics_with_wrenches": 1,
    "bias": 1,  # one outward and one inward recursion
    "momentum": 1,  # sums over bodies
    "end_effector_poses": 1,
    "end_effector_jacobian": 1,  # a column per joint of the arm
    "end_effector_twists": 1,
    "body_poses": 1,
    "body_twists": 1,
    "mass_matrix": 2,  # as many entries
    "reduced_dynamics": 2,  # as many entries of the generalized inertia
    "generalized_jacobian": 2,  # every arm's composite bodies contribute to every column
    "full_impact": 2,  # as many entries of the matrix; velocities by one inward and one outward step per link
    "reduced_impact": 3,  # LDL^T of G, which is dense across the arms too
}
FORWARD = [name for name in DEGREES if name.startswith("forward_dynamics")]


def operations(*links: int) -> dict[str, dict]:
    """Operations of each function of a regular layout."""
    families = derived(regular(*links))["families"]
    return {function["name"]: function["operations"] for family in families for function in family["functions"]}


def differences(values: list[int]) -> list[int]:
    return [after - before for before, after in pairwise(values)]


@pytest.mark.parametrize("arms", [1, 2])
def test_operations_are_polynomials_in_the_links(arms):
    # the poses of two links have a sum in common that those of three do not have
    counts = [operations(*[links] * arms) for links in range(3, 9)]
    assert counts[0].keys() == DEGREES.keys()
    for name, degree in DEGREES.items():
        values = [count[name]["flops"] for count in counts]
        for _ in range(degree):
            values = differences(values)
        assert set(values) != {0}, f"{name} grows more slowly than degree {degree}: lower it"
        assert set(differences(values)) == {0}, f"{name} grows faster than degree {degree}: {values}"


@pytest.mark.parametrize("name", FORWARD)
def test_a_link_costs_the_same_on_whichever_arm(name):
    before = operations(3, 3, 3)[name]
    steps = {
        tuple(operations(*links)[name].get(op, 0) - before.get(op, 0) for op in ("flops", "div", "sin_cos"))
        for links in [(4, 3, 3), (3, 4, 3), (3, 3, 4)]
    }
    chain = differences([operations(links)[name]["flops"] for links in (3, 4)])
    assert steps == {(*chain, 1, 1)}, "as much as on a single arm, with one division and one sine and cosine"


@pytest.mark.parametrize("name", FORWARD)
def test_an_arm_costs_the_same_whichever_it_is(name):
    flops = [operations(*[2] * arms)[name]["flops"] for arms in range(2, 6)]
    assert len(set(differences(flops))) == 1, flops


def flops_of(outputs: tuple[str, ...], name: str, *links: int) -> int:
    """Operations that these outputs of a function of a regular layout need."""
    families = derived(regular(*links))["families"]
    family, function = next((f, g) for f in families for g in f["functions"] if g["name"] == name)
    wanted = {element for output in function["outputs"] if output["name"] in outputs for element in output["elements"]}
    count = 0
    for targets, operation, *operands in reversed([*family["configuration"]["statements"], *function["statements"]]):
        if wanted.intersection([targets] if isinstance(targets, str) else targets):
            wanted.update(operand for operand in operands if isinstance(operand, str))
            count += operation in ("add", "sub", "mul", "div")
    return count


@pytest.mark.parametrize("arms", [1, 2])
def test_velocities_after_the_exact_impact_are_linear_in_the_links(arms):
    """The matrix of the merged robot has more entries, and is not needed for them."""
    velocities = ("base_twist_after", "joint_rates_after", "smallest_pivot")
    counts = [flops_of(velocities, "full_impact", *[links] * arms) for links in range(3, 8)]
    steps = set(differences(counts))
    # 56 would do where products did not take a division last
    assert len(steps) == 1 and steps.pop() <= 67 * arms, counts


def test_four_arms_of_seven_links_stay_within_bounds():
    """31 degrees of freedom, 29 bodies: linear and quadratic counts, but for the cubic one of the impact."""
    counts = operations(7, 7, 7, 7)
    assert counts["forward_dynamics"]["flops"] <= 29 * 58
    assert counts["forward_dynamics"]["sin_cos"] == 29
    assert counts["reduced_dynamics"]["flops"] <= 28**2 * 6
    assert counts["reduced_impact"]["flops"] <= 28**3 / 3 + 25 * 28**2
