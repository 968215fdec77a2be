"""Layouts and states that the derivation is tested on: every structural special case, and random numbers."""

import math
from dataclasses import replace
from functools import cache

import numpy as np

from codegen import graph
from codegen.derive import layout_path
from codegen.functions import Functions
from codegen.layout import Arm, Base, Layout, Link, layout_names, read

BASE = Base(60.0, 9.0)


def link(length: float = 0.8, com: tuple[float, float] = (0.35, 0.0), mass: float = 7.0, inertia: float = 0.6) -> Link:
    return Link(length, mass, inertia, com)


def arm(*links: Link, mount: tuple[float, float] = (0.5, 0.0), mount_angle: float = 0.0) -> Arm:
    return Arm(f"at_{mount[0]}_{mount[1]}_{mount_angle}", mount, mount_angle, links)


def chain(links: int) -> Layout:
    """One arm of equal links."""
    return Layout(f"chain_{links}", BASE, (arm(*[link()] * links),))


def regular(*links: int) -> Layout:
    """Arms of these numbers of equal links, at equal angles around the base, with no mount on an axis."""
    angles = [0.5 + 2 * math.pi * i / len(links) for i in range(len(links))]
    mounts = [(0.5 * math.cos(angle), 0.5 * math.sin(angle)) for angle in angles]
    arms = tuple(
        arm(*[link()] * number, mount=mount, mount_angle=angle)
        for number, mount, angle in zip(links, mounts, angles, strict=True)
    )
    return Layout(f"regular_{'_'.join(map(str, links))}", BASE, arms)


WHEEL = link(0.0, (0.0, 0.0), 4.0, 0.3)
OTHER_SIDE = (-0.4, 0.0)

LAYOUTS = {name: read(layout_path(name)) for name in layout_names()} | {
    layout.name: layout
    for layout in [
        chain(1),
        chain(2),
        chain(5),
        Layout(
            "three_arms", BASE, (arm(link()), arm(*[link()] * 2, mount=OTHER_SIDE), arm(*[link()] * 3, mount=(0, 1)))
        ),
        Layout("mounts_off_axis", BASE, (arm(*[link()] * 2, mount=(0.4, 0.3)), arm(link(), mount=(-0.4, -0.2)))),
        Layout(
            "mount_angles",
            BASE,
            (arm(*[link()] * 2, mount_angle=-0.7), arm(*[link()] * 2, mount=OTHER_SIDE, mount_angle=2.9)),
        ),
        Layout(
            "inner_com_off_axis",
            BASE,
            (arm(link(com=(0.3, 0.2)), link(), link(com=(0.4, -0.3))), arm(link(), link(), mount=OTHER_SIDE)),
        ),
        Layout("wheel_inside", BASE, (arm(link(), WHEEL, link()), arm(WHEEL, link(), mount=OTHER_SIDE))),
        Layout("wheel_at_the_end", BASE, (arm(link(), link(), WHEEL), arm(WHEEL, mount=OTHER_SIDE))),
        Layout("wheels_alone", BASE, (arm(WHEEL, WHEEL, WHEEL), arm(link(0.0, (0.1, 0.2)), link(), mount=OTHER_SIDE))),
        Layout("one_mount", BASE, (arm(*[link()] * 2), arm(*[link()] * 3, mount_angle=1.2))),
        Layout("mount_at_the_com", BASE, (arm(link(), link(), mount=(0.0, 0.0)),)),
    ]
}


@cache
def derived(layout: Layout) -> dict:
    return graph.build(Functions(layout))


def randomized(layout: Layout, rng: np.random.Generator) -> Layout:
    """Other numbers for the same structure: structural zeros stay, all else changes."""

    def vary(value: float, low: float, high: float) -> float:
        return value if value == 0.0 else rng.uniform(low, high) * np.sign(value)

    def vary_link(link: Link, last: bool) -> Link:
        length = rng.uniform(0.3, 1.3) if last else vary(link.length, 0.3, 1.3)
        across = rng.uniform(-0.4, 0.4) if last else vary(link.com[1], 0.05, 0.4)
        return Link(length, rng.uniform(2, 12), rng.uniform(0.2, 1.5), (rng.uniform(-0.2, 0.9), across))

    def vary_arm(arm: Arm) -> Arm:
        return replace(
            arm,
            mount=(arm.mount[0] + rng.uniform(-0.2, 0.2), vary(arm.mount[1], 0.1, 0.6)),
            mount_angle=vary(arm.mount_angle, 0.1, 3.0),
            links=tuple(vary_link(link, link is arm.links[-1]) for link in arm.links),
        )

    # a link shared by several arms is still the last one of its own arm only
    arms = tuple(vary_arm(replace(arm, links=tuple(replace(link) for link in arm.links))) for arm in layout.arms)
    return Layout(layout.name, Base(rng.uniform(20, 200), rng.uniform(5, 30)), arms)


def parameters(graph: dict, layout: Layout) -> dict[str, float]:
    """A layout's numbers under the names that the graph gives them."""

    def number(quantity: str, i: int | None, k: int | None) -> float:
        if i is None:
            return {"base_mass": layout.base.mass, "base_inertia": layout.base.inertia}[quantity]
        arm = layout.arms[i]
        if k is None:
            return {"mount_x": arm.mount[0], "mount_y": arm.mount[1], "mount_angle": arm.mount_angle}[quantity]
        link = arm.links[k]
        return {
            "link_length": link.length,
            "link_mass": link.mass,
            "link_inertia": link.inertia,
            "link_com_x": link.com[0],
            "link_com_y": link.com[1],
        }[quantity]

    return {p["name"]: number(p["quantity"], p["arm"], p["link"]) for p in graph["parameters"]}


SIZES = {  # of the numbers in a random state, lowest and highest
    "base_pose": (-3.0, 3.0),
    "joint_angles": (-3.2, 3.2),
    "base_twist": (-0.7, 0.7),
    "joint_rates": (-1.5, 1.5),
    "joint_torques": (-6.0, 6.0),
    "base_wrench": (-8.0, 8.0),
    "end_effector_wrenches": (-8.0, 8.0),
    "target_masses": (1.0, 30.0),
    "target_inertias": (0.1, 4.0),
    "contacts": (-0.6, 0.6),
    "target_twists": (-0.7, 0.7),
}
DIRECTION = (-1.0, 1.0)


def states(graph: dict, rng: np.random.Generator, number: int) -> list[dict[str, np.ndarray]]:
    """Random inputs for every function; the n-th null target, in turn, from the second state on."""
    shapes = {item["name"]: item["shape"] for item in graph["inputs"]}
    drawn = []
    for n in range(number):
        state = {name: rng.uniform(*SIZES.get(name, DIRECTION), size=shape) for name, shape in shapes.items()}
        if n > 0:
            null = (n - 1) % shapes["target_masses"][0]
            state["target_masses"][null] = state["target_inertias"][null] = 0.0
        drawn.append(state)
    return drawn
