"""Counts the instructions of single functions and of one study, and compares them with their bounds.

    python3 tests/instruction_counts.py [--study planar-capture] [--write]

Valgrind, which is installed where it can be, counts, so the numbers are the same on a loaded machine and depend on
the compiler alone. Its processor has AVX2 and no AVX-512, whatever the machine has. What has an instruction that it
does not know is not counted: 3.19 lacks one of AVX's moves. A function is counted in a default build and in one for
x86-64-v3: the difference of runs of many and of few calls, over the number of calls. The study is one run of the
given program.

The bounds are those of a compiler, in benches/instructions/bounds.json: a count may be 2 % above, for the C library's
part. For a compiler without bounds the counts are printed. `--write` sets the bounds of this compiler.

Exit code: 0 within the bounds or nothing to compare with, 1 above a bound, 3 without Valgrind or on another processor.
"""

import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CRATE = ROOT / "benches/instructions"
BOUNDS = CRATE / "bounds.json"
BUILDS = {"default": "", "x86-64-v3": "-C target-cpu=x86-64-v3"}
FUNCTIONS = [
    "forward_dynamics",
    "reduced_dynamics",
    "reduced_impact",
    "full_impact",
    "runge_kutta_step",
    "batch_of_64",
    "batch_of_64_reduced_dynamics",
    "batch_of_64_reduced_impact",
    "batch_of_64_full_impact",
    "graph_forward_dynamics",
    "graph_full_impact",
    "graph_batch_of_64",
]
STUDY = ROOT / "scenarios/raina_shah_2017.toml"
TOLERANCE = 0.02


def valgrind():
    """Valgrind's path, after an attempt to install it; None where it cannot be had."""
    if shutil.which("valgrind") is None and shutil.which("apt-get"):
        print("installing the package valgrind")
        root = [] if os.geteuid() == 0 else ["sudo", "-n"]
        for action in (["update", "-qq"], ["install", "-y", "-qq", "valgrind"]):
            try:
                subprocess.run([*root, "apt-get", *action], check=True, stdout=subprocess.DEVNULL)
            except (OSError, subprocess.CalledProcessError):
                return None
    return shutil.which("valgrind")


def count(tool, *command):
    """Instructions of a run; None where Valgrind does not know one of them."""
    options = ["--tool=callgrind", "--callgrind-out-file=/dev/null"]
    done = subprocess.run([tool, *options, *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if "Unrecognised instruction" in done.stderr:
        return None
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or not found:
        sys.exit(f"error: {' '.join(map(str, command))} under valgrind:\n{done.stderr}")
    return int(found.group(1))


def built(flags):
    """The program of a build; with flags for a named target, so that build scripts and macros are shared."""
    command = ["cargo", "build", "--quiet", "--release", "--locked", "--manifest-path", CRATE / "Cargo.toml"]
    environment = {**os.environ, "RUSTFLAGS": flags}
    folder = ROOT / "target"
    command += ["--target-dir", folder]
    if flags:
        said = subprocess.run(["rustc", "-vV"], check=True, stdout=subprocess.PIPE, text=True).stdout
        host = re.search(r"(?m)^host: (\S+)", said)[1]
        command += ["--target", host]
        folder /= host
    subprocess.run(command, check=True, env=environment)
    return folder / "release/instructions"


def counts(tool, study):
    """Name and number of instructions of all that is counted."""
    found = {}
    for build, flags in BUILDS.items():
        program = built(flags)
        for function in FUNCTIONS:
            # reading a graph takes some ten thousand instructions more or less, by the seeds of hash tables
            calls = 5000 if function.startswith("graph_") else 1000
            few, many = (count(tool, program, function, str(100 + more)) for more in (0, calls))
            found[f"{function}, {build}"] = None if None in (few, many) else round((many - few) / calls)
    if study:
        with tempfile.TemporaryDirectory() as folder:
            found["study, default"] = count(tool, study, "run", STUDY, "--out", Path(folder) / "out")
    return found


def main():
    """Counts, compares, prints."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", type=Path, help="a release build of planar-capture with its default features")
    parser.add_argument("--write", action="store_true", help="set the bounds of this compiler")
    arguments = parser.parse_args()
    if platform.machine() not in ("x86_64", "AMD64") or platform.system() != "Linux":
        print("instructions: not counted, the bounds are those of x86-64 with Linux")
        return 3
    tool = valgrind()
    if tool is None:
        print("instructions: not counted, Valgrind is needed: install the package valgrind")
        return 3
    version = subprocess.run(["rustc", "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.split()[1]
    found = counts(tool, arguments.study)
    bounds = json.loads(BOUNDS.read_text(encoding="utf-8")) if BOUNDS.exists() else {}
    if arguments.write:
        counted = {name: number for name, number in found.items() if number is not None}
        bounds[version] = {**bounds.get(version, {}), **counted}
        BOUNDS.write_text(json.dumps(bounds, indent=2) + "\n", encoding="utf-8")
    known = bounds.get(version, {})
    if not known:
        print(f"instructions: there are no bounds for rustc {version} in {BOUNDS.relative_to(ROOT)}; --write sets them")
    above = 0
    for name, number in found.items():
        bound = known.get(name)
        verdict = ""
        if number is None:
            number, verdict = "-", "  not counted: this Valgrind does not know one of the instructions"
        elif bound and number > bound * (1 + TOLERANCE):
            verdict, above = "  above its bound", above + 1
        elif bound and number < bound * (1 - TOLERANCE):
            verdict = "  below: --write lowers the bound"
        print(f"{name:40} {number:>12} {bound or '-':>12}{verdict}")
    if above:
        print(f"error: {above} counts are above their bounds in {BOUNDS.relative_to(ROOT)}; to set them again: --write")
    return 1 if above else 0


if __name__ == "__main__":
    sys.exit(main())
