"""Builds the firmware example for two emulated boards, runs it, measures it, and proves that it cannot panic.

    python3 tests/firmware.py [--write [--accept]] [--all]

`.ci/firmware` calls this with a Rust compiler that has the source of `core`. The programs compare their results with
those of this machine, to the last bit, and fail where one differs. Then they print what each function costs: executed
instructions by QEMU, stack by painting; sizes are those of sections. examples/firmware/bounds.json holds

- `budgets`: what a function may cost; written by hand;
- `accepted`: what it may cost for now where it is over its budget, a hundredth above what it cost when it was written;
- `measured`: the numbers of docs/embedded.md, with the compilers that they are of.

Without options: numbers have to be within budgets or what is accepted, within a fiftieth of those of the document where
the compilers are the same, and the document has to be that of the numbers. `--write` writes both; a bound that grows
needs `--accept`, too. `--all` adds other layouts and profiles, some twenty minutes; the document keeps their last
numbers.

Exit code: 0 when all of it holds, 1 otherwise.
"""

import argparse
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "examples/firmware"
BOUNDS = EXAMPLE / "bounds.json"
DOCUMENT = ROOT / "docs/embedded.md"
TARGET = "thumbv7em-none-eabihf"
BUILT = ROOT / "target/firmware"
COPIES = ROOT / "target/firmware-layouts"
CARGO = os.environ.get("CARGO", "cargo")
RUSTC = os.environ.get("RUSTC", "rustc")
ROBOT = "dual_arm_3r"
ROUTES = ["library", "standalone", "c"]
BOARDS = {
    "m4f": ("Cortex-M4F, f32", "mps2-an386", "", []),
    "m7": ("Cortex-M7, f64", "mps2-an500", "-C target-cpu=cortex-m7", ["--features", "double"]),
}
FUNCTIONS = {
    "model_new": "`Model::new`",
    "forward_dynamics": "forward dynamics",
    "reduced_dynamics": "generalized inertia, bias and Jacobian",
    "exact_impact": "exact impact",
    "exact_impact_with_impulses": "exact impact, twists and impulses",
    "pd_and_rk4_step": "PD control and a Runge–Kutta step",
    "merge": "merging of the targets",
}
PARTS = {
    "forward_dynamics": "forward dynamics",
    "four_functions": "with inertia, bias and Jacobian, exact impact, `Model::new`",
    "control_loop": "the whole program of the mission",
}
METRICS = ["instructions", "far_instructions", "jitter", "stack"]
SAME = 0.02
OTHER_COMPILER = 0.05
LIMIT = 300  # s, of a run


def fail(message):
    """Ends with a message."""
    sys.exit(f"error: {message}")


def build(folder, program, board="m4f", opt="3", options=(), rustc=(), flags=""):
    """The program of a crate for a board, as a path."""
    _, _, cpu, features = BOARDS[board]
    environment = {
        **os.environ,
        "RUSTC_BOOTSTRAP": "1",
        "RUSTC": RUSTC,
        "RUSTFLAGS": f"{cpu} {flags}".strip(),
        "CARGO_PROFILE_RELEASE_OPT_LEVEL": opt,
        "CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER": "arm-none-eabi-ld",
    }
    # to cargo, copies with one target folder are one package: each is newer than the one before, the original is not
    built = COPIES / "built" if folder.is_relative_to(COPIES) else BUILT
    action = ["rustc", "--bin", program] if rustc else ["build", "--bin", program]
    command = [CARGO, *action, "--quiet", "--locked", "--release", "-Zbuild-std=core", "--target", TARGET]
    command += ["--target-dir", built, *features, *options, *(["--", *rustc] if rustc else [])]
    done = subprocess.run(
        command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    if done.returncode:
        fail(f"{program} does not build for {board} at opt-level {opt}:\n{done.stdout}")
    return built / TARGET / "release" / program


def run(program, board):
    """What a program prints; ends where it fails."""
    machine = BOARDS[board][1]
    command = ["qemu-system-arm", "-M", machine, "-nographic", "-semihosting-config", "enable=on,target=native"]
    command += ["-icount", "shift=0", "-kernel", program]
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=LIMIT,
        )
    except subprocess.TimeoutExpired:
        fail(f"{program.name} on {machine} takes longer than {LIMIT} s")
    if done.returncode:
        fail(f"{program.name} on {machine} ends with {done.returncode}:\n{done.stdout}")
    return done.stdout


def sections(program):
    """(code and constants, memory) of a program, bytes; the table of interrupts is no part of either."""
    shown = subprocess.run(["arm-none-eabi-size", "-A", program], check=True, stdout=subprocess.PIPE, text=True).stdout
    size = {name: int(number) for name, number in re.findall(r"^\.(\w+)\s+(\d+)", shown, re.MULTILINE)}
    data = size.get("data", 0)
    return size["text"] + size["rodata"] + data, data + size["bss"]


def measured(folder, board, opt, options=()):
    """What every route's functions cost on a board."""
    found = {}
    for route in ROUTES:
        lines = run(build(folder, route, board, opt, options), board)
        found[route] = {}
        for name, *numbers in re.findall(r"^measured (\w+) (\d+) (\d+) (\d+) (\d+) (\d+)$", lines, re.MULTILINE):
            least, most, far, stack, far_stack = map(int, numbers)
            found[route][name] = {
                "instructions": most,
                "jitter": most - least,
                "far_instructions": far,
                "stack": max(stack, far_stack),
            }
        found[route]["mission"] = {"stack": int(re.search(r"^mission (\d+)$", lines, re.MULTILINE)[1])}
        if set(found[route]) != {*FUNCTIONS, "mission"}:
            fail(f"{route} on {board} does not print what was measured:\n{lines}")
    return found


def sizes(folder, opt):
    """Code of the parts of every route, on the smaller board; memory of the whole."""
    nothing, _ = sections(build(folder, "size", opt=opt))
    found = {}
    for route in ROUTES:
        found[route] = {}
        for part in PARTS:
            chosen = ["--cfg", f'route="{route}"', "--cfg", f'part="{part}"']
            code, memory = sections(build(folder, "size", opt=opt, rustc=chosen))
            found[route][part] = {"code": code if part == "control_loop" else code - nothing}
            if part == "control_loop":
                found[route][part]["memory"] = memory
    return found


def panic_free(opt):
    """Proves by the linker that the routes of the example and all of the core cannot panic."""
    build(EXAMPLE, "no_panic", opt=opt, options=["--features", "self_test"])
    if opt == "3":  # optimised for size, the iterators of the standard library are functions that count
        build(EXAMPLE, "no_panic", flags="-C overflow-checks=on")
    build(
        ROOT / "tests/no_std", "no_std_firmware", opt=opt, flags="-C link-arg=--entry=start -C link-arg=--gc-sections"
    )


def with_self_test(found):
    """A linked self test changes no count by more than a fiftieth."""
    other = measured(EXAMPLE, "m4f", "3", ["--features", "self_test"])
    for route in ROUTES:
        for function in FUNCTIONS:
            number, before = (m[route][function]["instructions"] for m in (other, found))
            if abs(number - before) > SAME * before:
                yield f"{route}: {function} takes {number} instructions with a linked self test, {before} without"


def copy_for(layout, command):
    """The example for another layout, as a user would copy it."""
    folder = COPIES / layout
    shutil.rmtree(folder, ignore_errors=True)
    listed = subprocess.run(["git", "ls-files", "-z", "."], cwd=EXAMPLE, check=True, stdout=subprocess.PIPE, text=True)
    for name in filter(None, listed.stdout.split("\0")):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        text = (EXAMPLE / name).read_text(encoding="utf-8")
        text = text.replace(ROBOT, layout).replace(ROBOT.upper(), layout.upper())
        (folder / name).write_text(text.replace('path = "../../.."', f'path = "{ROOT}"'), encoding="utf-8")
    (folder / "generate").chmod(0o755)
    subprocess.run([folder / "generate"], check=True, env={**os.environ, "PLANAR_CAPTURE": command})
    return folder


def over(bounds, found, same_compiler):
    """A line for each number that may not be."""
    budgets, accepted, before = bounds["budgets"], bounds["accepted"], bounds["measured"]["numbers"]
    slack = 1 if same_compiler else 1 + OTHER_COMPILER
    for path, number in flat(found):
        budget, known = bound(budgets, path), dict(flat(before)).get(path)
        if budget is not None and number > max(budget, accepted.get(path, 0)) * slack:
            yield f"{path} is {number}: the budget is {budget}, {accepted.get(path, 'nothing')} is accepted"
        elif same_compiler and known is None:
            yield f"{path} is {number}, and not in {BOUNDS.relative_to(ROOT)}: --write"
        elif same_compiler and abs(number - known) > max(SAME * known, 1):
            yield f"{path} is {number}, and {known} in the document: --write"


def flat(tree, path=""):
    """(path, number) of every number of a tree."""
    for key, value in tree.items():
        inner = f"{path}/{key}" if path else key
        if isinstance(value, dict):
            yield from flat(value, inner)
        else:
            yield inner, value


def bound(budgets, path):
    """The budget of a number; None where it has none: C, other layouts, other profiles."""
    layout, profile, board, route, function, metric = path.split("/")
    if (layout, profile) != (ROBOT, "3") or route == "c":
        return None
    return budgets.get(board, {}).get(function, {}).get(metric)


def accept(bounds, found, may_grow):
    """What is accepted of numbers over their budgets; a bound that would grow is a failure."""
    accepted = {}
    for path, number in flat(found):
        budget = bound(bounds["budgets"], path)
        if budget is not None and number > budget:
            accepted[path] = math.ceil(number * 1.01)
            before = bounds["accepted"].get(path, 0)
            if number > max(before, budget) and bounds["measured"]["numbers"] and not may_grow:
                fail(f"{path} is {number}, and {before or budget} is its bound: --accept lets it grow")
    return accepted


def compilers():
    """Names and versions."""
    rustc = subprocess.run([RUSTC, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout
    gcc = subprocess.run(
        ["arm-none-eabi-gcc", "-dumpfullversion"], check=True, stdout=subprocess.PIPE, text=True
    ).stdout
    return f"rustc {rustc.split()[1]}, GCC {gcc.strip()}"


def table(head, rows):
    """A table of Markdown."""
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    return "\n".join([*lines, *(f"| {' | '.join(row)} |" for row in rows)])


def pair(budgets, numbers, path, first, second):
    """Two numbers of a function, those over their budgets in bold."""
    shown = []
    for metric in (first, second):
        whole = f"{path}/{metric}"
        budget, number = bound(budgets, whole), numbers[whole]
        shown.append(f"**{number:,}**" if budget is not None and number > budget else f"{number:,}")
    return " / ".join(shown)


def document(bounds):
    """The text of the document."""
    tree, budgets = bounds["measured"]["numbers"], bounds["budgets"]
    numbers = dict(flat(tree))
    text = [HEAD.format(compilers=bounds["measured"]["compilers"]), OVER if bounds["accepted"] else WITHIN]
    for board, (name, machine, *_) in BOARDS.items():
        rows = []
        for function, shown in FUNCTIONS.items():
            limit = budgets.get(board, {}).get(function)
            cells = [
                pair(budgets, numbers, f"{ROBOT}/3/{board}/{route}/{function}", "instructions", "stack")
                for route in ROUTES
            ]
            rows.append([shown, f"{limit['instructions']:,} / {limit['stack']:,}" if limit else "–", *cells])
        stack = [f"– / {numbers[f'{ROBOT}/3/{board}/{route}/mission/stack']:,}" for route in ROUTES]
        rows.append(["the whole mission", "–", *stack])
        text += [
            f"## {name} ({machine})",
            "Instructions / bytes of stack per call.",
            table(["", "budget", "library", "module", "C"], rows),
        ]
        rows = []
        for function, shown in FUNCTIONS.items():
            cells = [
                pair(budgets, numbers, f"{ROBOT}/3/{board}/{route}/{function}", "far_instructions", "jitter")
                for route in ROUTES
            ]
            rows.append([shown, *cells])
        text += ["The most instructions with far angles / jitter without:", table(["", "library", "module", "C"], rows)]
    rows = []
    for part, shown in PARTS.items():
        limit = budgets["m4f"].get(f"code_{part}", {}).get("code")
        cells = []
        for route in ROUTES:
            number = tree[ROBOT]["3"]["m4f"][route][f"code_{part}"]["code"]
            is_over = bound(budgets, f"{ROBOT}/3/m4f/{route}/code_{part}/code")
            cells.append(f"**{number:,}**" if is_over is not None and number > is_over else f"{number:,}")
        rows.append([shown, f"{limit:,}" if limit else "–", *cells])
    memory = [tree[ROBOT]["3"]["m4f"][route]["code_control_loop"]["memory"] for route in ROUTES]
    stack = [tree[ROBOT]["3"]["m4f"][route]["mission"]["stack"] for route in ROUTES]
    rows.append(
        ["memory of that program: static + stack", "–", *(f"{m:,} + {s:,}" for m, s in zip(memory, stack, strict=True))]
    )
    text += [
        "## Code",
        "Bytes of code and constants on the Cortex-M4F, f32.",
        table(["", "budget", "library", "module", "C"], rows),
    ]
    text.append(single_precision())
    others = [(layout, opt) for layout in tree for opt in tree[layout] if (layout, opt) != (ROBOT, "3")]
    if others:
        rows = []
        for layout, opt in [(ROBOT, "3"), *others]:
            for board, (name, *_) in BOARDS.items():
                for route in ROUTES if layout == ROBOT else ["standalone"]:
                    at = f"{layout}/{opt}/{board}/{route}"
                    chosen = ["forward_dynamics", "reduced_dynamics", "exact_impact", "pd_and_rk4_step", "merge"]
                    cells = [pair({}, numbers, f"{at}/{f}", "instructions", "stack") for f in chosen]
                    rows.append([f"`{layout}`", opt, name, "module" if route == "standalone" else route, *cells])
        head = [
            "layout",
            "profile",
            "",
            "route",
            "forward dynamics",
            "inertia, bias, Jacobian",
            "impact",
            "PD and step",
            "merging",
        ]
        text += [
            "## Other layouts and profiles",
            "Written by `.ci/firmware --all --write`; instructions / bytes of stack.",
            table(head, rows),
        ]
    return "\n\n".join(text) + "\n"


def single_precision():
    """The section of the document that a test of planar-proof writes and compares."""
    found = re.search(r"^## Single precision\n.*?(?=\n+## |\n*\Z)", DOCUMENT.read_text(encoding="utf-8"), re.M | re.S)
    return found[0] if found else "## Single precision"


HEAD = """# On a microcontroller

Written by `.ci/firmware --write`; the gate compares. What is measured are the programs of
[examples/firmware](../examples/firmware/README.md): the paper's robot, a capture at 1 kHz, by the library, by a
standalone module (`generate --standalone`), and by the module in C. {compilers}, QEMU; Rust with opt-level 3 and fat
LTO, C with `-O2 -ffp-contract=off`.

- **Bits.** Each program compares its numbers with those that the same code computes on the host: the state at the
  contact, after the impact and at the end of a mission of 3,000 steps, and every function at 1,000 states. All bits
  agree, and those of the three routes agree with each other.
- **Instructions** are executed ones, counted by QEMU (`-icount shift=0`), without the call itself: not cycles. They are
  the most of 900 states with angles up to 1,000 rad; *jitter* is the difference to the least of these. Every finite
  angle is valid; with *far* angles, up to the largest finite number, sines are reduced in integers, which takes longer:
  the most of 100 such states. Where the sum of yaw and joint angles of a link is beyond the largest number, it counts
  as that number. PD control, whose torques would be infinite at most of these, then ends before the step: its count
  may then be less than with other angles.
- **What is built.** Programs for the M4F are built for the target's default processor, those for the M7 with
  `-C target-cpu=cortex-m7`. With `-C target-cpu=cortex-m4` the compiler replaces each `VMLA`, of three cycles there,
  by a product and a sum of one cycle each: up to a quarter more instructions, and stack for the products, but
  fewer cycles by the processor's manual. Of the exact impact in Rust the velocities are used, and the compiler
  leaves out that its matrix and momentum are stored; who keeps them, has them in a frame of their own: 360 bytes in
  `f32`. C always stores them.
- **Stack** is painted, below the caller's own: the most of all these states. The library's integrator works in memory
  of the caller, three vectors of the state, which the example keeps with the state: 252 bytes in `f32`, 504 in `f64`.
- **Inputs that have no result.** The `smallest_pivot` of a module's functions is not a number where an input or a
  parameter that a result depends on is infinite or none, or a mass or moment of inertia is 0. The traits of the
  library, steps, merging and impulses have an error or a status, and so has C: `NAME_model_new` refuses such a robot,
  and one with a mass or moment of inertia below 0, which the library looks for in layouts alone.
- **No panic** is proved by the linker: a program with all functions, library and module, links although its panic
  handler calls a function that does not exist. The same for every part of the core (`tests/no_std`). At opt-level 3 and
  s, and z by `--all`; at 3 also with overflow checks, for all but the self test.
- **Self test.** A program with a linked self test has the same counts within 2 %. A shipped layout of the library has
  none in its code."""

OVER = "**Bold** numbers are over their budgets. They may not grow: `examples/firmware/bounds.json`."
WITHIN = """Budgets are those of library and module for the paper's robot at opt-level 3, with angles that are not far
ones, and their numbers are within them: one that is over fails the gate. C, other layouts and other profiles have
none; C exceeds some of these: `examples/firmware/bounds.json`."""


def main():
    """Builds, runs, compares or writes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write bounds and document")
    parser.add_argument("--accept", action="store_true", help="let bounds over a budget grow")
    parser.add_argument("--all", action="store_true", help="other layouts and profiles, too")
    arguments = parser.parse_args()
    bounds = json.loads(BOUNDS.read_text(encoding="utf-8"))
    compiler = compilers()

    def say(message):
        print(f"firmware: {message}", flush=True)

    say("no panic: library, module, core")
    for opt in ["3", "s", "z"] if arguments.all else ["3", "s"]:
        panic_free(opt)
    found = {ROBOT: {"3": {}}}
    for board in BOARDS:
        say(f"{ROBOT} on {BOARDS[board][1]}, {BOARDS[board][0]}")
        found[ROBOT]["3"][board] = measured(EXAMPLE, board, "3")
    say("code")
    for route, parts in sizes(EXAMPLE, "3").items():
        for part, numbers in parts.items():
            found[ROBOT]["3"]["m4f"][route][f"code_{part}"] = numbers
    say("with a linked self test")
    problems = list(with_self_test(found[ROBOT]["3"]["m4f"]))
    if arguments.all:
        for opt in ["s", "z"]:
            say(f"{ROBOT}, profile {opt}")
            found[ROBOT][opt] = {board: measured(EXAMPLE, board, opt) for board in BOARDS}
        command = os.environ.get("PLANAR_CAPTURE", str(ROOT / "target/release/planar-capture"))
        for path in sorted((ROOT / "codegen/layouts").glob("*.toml")):
            if path.stem != ROBOT:
                say(path.stem)
                folder = copy_for(path.stem, command)
                found[path.stem] = {"3": {board: measured(folder, board, "3") for board in BOARDS}}
    same = compiler == bounds["measured"]["compilers"]
    if arguments.write:
        kept = bounds["measured"]["numbers"] if same else {}
        merged = {**kept, **found, ROBOT: {**kept.get(ROBOT, {}), **found[ROBOT]}}
        bounds["accepted"] = accept(bounds, found, arguments.accept)
        bounds["measured"] = {"compilers": compiler, "numbers": merged}
        BOUNDS.write_text(json.dumps(bounds, indent=1) + "\n", encoding="utf-8")
        DOCUMENT.write_text(document(bounds), encoding="utf-8")
        say(f"{BOUNDS.relative_to(ROOT)} and {DOCUMENT.relative_to(ROOT)} are written")
    else:
        if not same:
            say(f"the document is of {bounds['measured']['compilers']}: with {compiler} only bounds are compared")
        problems += over(bounds, found, same)
        if DOCUMENT.read_text(encoding="utf-8") != document(bounds):
            problems.append(
                f"{DOCUMENT.relative_to(ROOT)} is not that of {BOUNDS.relative_to(ROOT)}: .ci/firmware --write"
            )
    for problem in problems:
        print(f"error: {problem}")
    missed = len(bounds["accepted"])
    within = f"all but {missed} numbers are" if missed else "all numbers are"
    say("failed" if problems else f"{within} within their budgets")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
