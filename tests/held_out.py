"""Layouts that nobody has seen, through the installed command, in a crate that is not this one, against Pinocchio.

For each seed a random layout is drawn: one to four arms of one to five links, mounts and centres of mass anywhere,
reaction wheels. `planar-capture generate` makes two modules of it, one that stands on planar-capture's core and one
that stands on nothing, in a folder outside the repository; a crate there computes every function at random states. The
numbers have to be Pinocchio's and, for the reduced equations and the impacts, what linear systems solved as they stand
make of them.

    PYTHONPATH=. python tests/held_out.py [--binary planar-capture] [SEED ...]

needs tests/reference/requirements-reference.txt. Without --binary the command is installed first.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from codegen.layout import read
from tests.reference.pinocchio_states import MEDIUM, Pinocchio, impacts, random_state, reduced

ROOT = Path(__file__).resolve().parent.parent
BOUND = 1e-10  # of the largest entry of each result
STATES = 5  # of each layout
REGIMES = ((0.0, "tbe"), (0.5, "t"), (0.5, "tbe"), (3.0, "tb"), (0.5, "be"))  # speed, forces


def random_layout(random, name):
    """TOML text; numbers with a few digits, as people write them."""

    def some(low, high):
        return float(f"{random.uniform(low, high):.3g}")

    lines = [f'name = "{name}"', "[base]", f"mass = {some(50, 900)}", f"inertia = {some(5, 120)}"]
    for arm in range(random.integers(1, 5)):
        mount = [some(-0.8, 0.8), some(-0.8, 0.8) if random.random() < 0.7 else 0.0]
        lines += ["[[arm]]", f'name = "arm {arm} of {name}"', f"mount = {mount}"]
        if random.random() < 0.5:
            lines.append(f"mount_angle = {some(-3.1, 3.1)}")
        for _ in range(random.integers(1, 6)):
            length = 0.0 if random.random() < 0.15 else some(0.2, 1.5)
            mass = some(0.5, 30)
            lines += ["[[arm.link]]", f"length = {length}", f"mass = {mass}"]
            lines.append(f"inertia = {some(0.02, 0.3) * mass * max(length, 0.3) ** 2:.3g}")
            if length == 0.0 or random.random() < 0.5:
                bent = random.random() < 0.5 and length > 0.0
                lines.append(f"com = [{some(0.2, 0.8) * length:.3g}, {some(-0.1, 0.1) if bent else 0.0}]")
    return "\n".join(lines) + "\n"


def bodies(pinocchio, pose, angles, twist, rates):
    """[yaw, x, y] and [omega, vx, vy] of every body's COM, after Pinocchio's quantities at the same state."""
    layout, model, data = pinocchio.layout, pinocchio.model, pinocchio.data
    yaws, omegas, joint = [pose[0]], [twist[0]], 0
    for arm in layout.arms:
        yaw, omega = pose[0] + arm.mount_angle, twist[0]
        for _ in arm.links:
            yaw, omega, joint = yaw + angles[joint], omega + rates[joint], joint + 1
            yaws.append(yaw)
            omegas.append(omega)
    poses, twists = [], []
    for index, (yaw, omega) in enumerate(zip(yaws, omegas, strict=True), start=1):
        place, motion, lever = data.oMi[index], data.v[index], model.inertias[index].lever
        position = place.act(lever)
        velocity = place.rotation @ (motion.linear + np.cross(motion.angular, lever))
        poses.append([yaw, *position[:2]])
        twists.append([omega, *velocity[:2]])
    return {"body_poses": np.array(poses), "body_twists": np.array(twists)}


def expected(pinocchio, state):
    """Every result of every function, by "function.result"."""
    layout = pinocchio.layout
    motion = tuple(np.array(state[key]) for key in ("base_pose", "joint_angles", "base_twist", "joint_rates"))
    none = np.zeros(3), np.zeros((len(layout.arms), 3))
    forces = [
        ("forward_dynamics", (state["joint_torques"], *none)),
        ("forward_dynamics_with_base_wrench", (state["joint_torques"], state["base_wrench"], none[1])),
        (
            "forward_dynamics_with_wrenches",
            (state["joint_torques"], state["base_wrench"], state["end_effector_wrenches"]),
        ),
    ]
    results = {}
    for function, acting in forces:
        known = pinocchio.quantities(*motion, *acting)
        for key in ("base_acceleration", "joint_accelerations"):
            results[f"{function}.{key}"] = known[key]
    velocity = np.concatenate(motion[2:])
    results |= {key: known[key] for key in ("mass_matrix", "bias", "end_effector_poses", "end_effector_jacobian")}
    results["end_effector_twists"] = (known["end_effector_jacobian"] @ velocity).reshape(-1, 3)
    results |= bodies(pinocchio, *motion)
    for key in ("linear_momentum", "angular_momentum", "kinetic_energy"):
        results[f"momentum.{key}"] = known[key]
    known |= reduced(known["mass_matrix"], known["bias"], known["end_effector_jacobian"])
    for key in ("generalized_inertia", "generalized_bias", "generalized_jacobian"):
        results[f"reduced_dynamics.{key}"] = known[key]
    results["generalized_jacobian.generalized_jacobian"] = known["generalized_jacobian"]
    after = impacts(known, *motion[2:], state["targets"])
    results["reduced_impact.impact_matrix"] = after["impact"]["G"]
    results["reduced_impact.impact_momentum"] = after["impact"]["H"]
    results["reduced_impact.joint_rates_after"] = after["impact"]["joint_rates_after"]
    results["full_impact.base_twist_after"] = after["capture"]["base_twist_after"]
    results["full_impact.joint_rates_after"] = after["capture"]["joint_rates_after"]
    return results


def inputs(state):
    """The generated functions' arguments."""
    targets = state["targets"]
    return {key: state[key] for key in state if key != "targets"} | {
        "target_masses": [target["mass"] if target else 0.0 for target in targets],
        "target_inertias": [target["inertia"] if target else 0.0 for target in targets],
        "contacts": [target["contact"] if target else [0.0, 0.0] for target in targets],
        "target_twists": [target["twist"] if target else [0.0, 0.0, 0.0] for target in targets],
    }


CONFIGURATION = ("base_pose", "joint_angles")
MOTION = (*CONFIGURATION, "base_twist", "joint_rates")
TARGETS = ("target_masses", "target_inertias", "contacts", "target_twists")
ARGUMENTS = {
    "forward_dynamics": (*MOTION, "joint_torques"),
    "forward_dynamics_with_base_wrench": (*MOTION, "joint_torques", "base_wrench"),
    "forward_dynamics_with_wrenches": (*MOTION, "joint_torques", "base_wrench", "end_effector_wrenches"),
    "mass_matrix": CONFIGURATION,
    "bias": MOTION,
    "end_effector_poses": CONFIGURATION,
    "end_effector_jacobian": CONFIGURATION,
    "end_effector_twists": MOTION,
    "body_poses": CONFIGURATION,
    "body_twists": MOTION,
    "momentum": MOTION,
    "reduced_dynamics": MOTION,
    "generalized_jacobian": CONFIGURATION,
    "reduced_impact": (*CONFIGURATION, "joint_rates", *TARGETS),
    "full_impact": (*MOTION, *TARGETS),
}


def literal(value):
    """A number or nested list as Rust, which JSON is where every number has a point or an exponent."""
    return json.dumps(np.asarray(value, dtype=float).tolist())


def program(modules, states, results):
    """An example: each result of each module at each state on a line, `module state result numbers`."""
    lines = ["//! Every result of every function."]
    lines += [f"use held_out::{module};" for module in modules]
    lines += ["", "fn main() {"]
    for module in modules:
        lines.append(f"    let robot = {module}::Model::<f64>::default();")
        for index, state in enumerate(states):
            for function, arguments in ARGUMENTS.items():
                values = ", ".join(f"&{literal(inputs(state)[argument])}" for argument in arguments)
                lines.append(f"    let result = robot.{function}({values});")
                for result in results:
                    name, _, field = result.partition(".")
                    if name == function:
                        found = f"result.{field}" if field else "result"
                        lines.append(f'    println!("{module} {index} {result} {{:?}}", {found});')
    return "\n".join([*lines, "}", ""])


MANIFEST = """[package]
name = "held-out"
version = "0.0.0"
edition = "2024"

[workspace]

[dependencies]
planar-capture = {{ path = {root}, default-features = false }}

[lints.clippy]
pedantic = "deny"

[lints.rust]
warnings = "deny"
missing_docs = "deny"
unsafe_code = "forbid"
"""


def run(command, folder, **options):
    """Runs it; a failure ends the test with what it said."""
    shown = " ".join(map(str, command))
    print(f"held_out: {shown}", file=sys.stderr, flush=True)
    outcome = subprocess.run([*map(str, command)], cwd=folder, capture_output=True, text=True, check=False, **options)
    if outcome.returncode != 0:
        sys.exit(f"held_out: `{shown}` failed ({outcome.returncode}):\n{outcome.stdout}{outcome.stderr}")
    return outcome.stdout


def install(folder):
    """The command, installed as a user does."""
    run(
        ["cargo", "install", "--debug", "--locked", "--path", ROOT, "--root", folder, "--target-dir", ROOT / "target"],
        ROOT,
    )
    return folder / "bin" / ("planar-capture.exe" if os.name == "nt" else "planar-capture")


def check(seed, binary, folder):
    """The worst error of one layout's results, relative to the largest entry, with the result's name."""
    random = np.random.default_rng([2017, seed])
    name = f"held_out_{seed}"
    layout_file = folder / f"{name}.toml"
    layout_file.write_text(random_layout(random, name), encoding="utf-8")
    layout = read(layout_file)
    crate = folder / f"crate_{seed}"
    for part in ("src", "examples"):
        (crate / part).mkdir(parents=True)
    (crate / "Cargo.toml").write_text(MANIFEST.format(root=json.dumps(str(ROOT))), encoding="utf-8")
    modules = [name, f"{name}_standalone"]
    environment = {"PLANAR_CAPTURE_ENVIRONMENTS": str(ROOT / "target" / "python"), **os.environ}
    environment["PLANAR_CAPTURE_HOME"] = str(folder / "home")
    for module, option in zip(modules, ([], ["--standalone"]), strict=True):
        command = [binary, "generate", layout_file.name, "--out", crate / "src" / f"{module}.rs", *option]
        run(command, folder, env=environment)
    states = [
        random_state(random, layout, "random", speed, 2.0, "tbe", MEDIUM, False)
        | {key: np.zeros_like(value) for key, value in absent(layout, forces).items()}
        for speed, forces in REGIMES[:STATES]
    ]
    pinocchio = Pinocchio(layout)
    right = [expected(pinocchio, state) for state in states]
    library = ["//! Generated.", "#![cfg_attr(not(test), no_std)]", *(f"pub mod {module};" for module in modules), ""]
    (crate / "src" / "lib.rs").write_text("\n".join(library), encoding="utf-8")
    (crate / "examples" / "print.rs").write_text(program(modules, states, right[0]), encoding="utf-8")
    target = ["--target-dir", ROOT / "target" / "held_out"]
    run(["cargo", "clippy", "--quiet", "--lib", "--tests", *target], crate)
    run(["cargo", "test", "--quiet", "--lib", *target], crate)
    lines = run(["cargo", "run", "--quiet", "--example", "print", *target], crate).splitlines()
    worst, seen = (0.0, ""), 0
    for line in lines:
        module, index, result, numbers = line.split(" ", 3)
        found, wanted = np.array(json.loads(numbers)), np.array(right[int(index)][result])
        error = np.max(np.abs(found.reshape(wanted.shape) - wanted)) / max(np.max(np.abs(wanted)), 1e-300)
        seen += 1
        if not error <= worst[0]:
            worst = (error, f"{result} of {module}, state {index}")
    assert seen == len(modules) * len(states) * len(right[0]), seen
    links = "+".join(str(len(arm.links)) for arm in layout.arms)
    print(f"{name}: arms of {links} links, {seen} results, worst {worst[0]:.1e} ({worst[1]})", flush=True)
    return worst


def absent(layout, forces):
    """The forces that do not act, as zeros."""
    shapes = {"t": ("joint_torques", layout.joints), "b": ("base_wrench", 3)}
    shapes["e"] = ("end_effector_wrenches", (len(layout.arms), 3))
    return {name: np.zeros(shape) for key, (name, shape) in shapes.items() if key not in forces}


def main():
    """Exit code 1 where a result is off by more than the bound."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, help="the command; without it, it is installed from this repository")
    parser.add_argument("seeds", nargs="*", type=int, default=[1, 2, 3], metavar="SEED")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        binary = options.binary.resolve() if options.binary else install(Path(folder))
        worst = max(check(seed, binary, Path(folder)) for seed in options.seeds)
    if not worst[0] <= BOUND:
        sys.exit(f"held_out: {worst[1]} is off by {worst[0]:.1e}, more than {BOUND:.0e}")


if __name__ == "__main__":
    main()
