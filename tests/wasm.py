"""Builds examples/wasm for WebAssembly, runs it in Node.js, and compares its bits with those of this machine.

    python3 tests/wasm.py [--write]

`.ci/wasm` calls this with a compiler, a linker and Node.js. Every build has to have the bits of this machine at 1,000
states, with hostile angles, in every function and lane, and to need nothing of its host. `--write` writes times and
sizes to examples/wasm/measured.json and docs/webassembly.md; without it the document has to be that of the numbers.
Times and sizes are not compared.

Exit code: 0 when all of it holds, 1 otherwise.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "examples/wasm"
MEASURED = EXAMPLE / "measured.json"
DOCUMENT = ROOT / "docs/webassembly.md"
BUILT = ROOT / "target/firmware"  # shared with tests/firmware.py, whose builds have the same dependencies
TARGET = "wasm32-unknown-unknown"
CARGO = os.environ.get("CARGO", "cargo")
RUSTC = os.environ.get("RUSTC", "rustc")
NODE = os.environ.get("NODE", "node")
BUILD_STD = os.environ.get("BUILD_STD", "")
LINKER = os.environ.get("LINKER", "")
# the same for all builds: build scripts of dependencies look at these, and would be run again
ENVIRONMENT = {**os.environ, "RUSTC": RUSTC, **({"RUSTC_BOOTSTRAP": "1"} if BUILD_STD else {})}
SCALARS = {"double": "f64", "single": "f32"}
FUNCTIONS = {
    "forward_dynamics": "forward dynamics",
    "control_step": "PD control and a Runge–Kutta step",
    "exact_impact": "exact impact, twists and impulses",
    "forward_dynamics_of_lanes": "forward dynamics in lanes, per robot",
}


def output(command, **options):
    """What a command prints; ends where it fails."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, **options)
    if done.returncode:
        sys.exit(f"error: {' '.join(map(str, command))} ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def cargo(action, features, *options, **options_of_run):
    """A call of cargo for the example."""
    command = [CARGO, action, "--quiet", "--locked", "--release", "--manifest-path", EXAMPLE / "Cargo.toml"]
    command += ["--target-dir", BUILT, "--features", ",".join(features), *options]
    return output(command, **options_of_run)


def module(features, has_simd):
    """The module of these features, as a path."""
    environment = {**ENVIRONMENT, "RUSTFLAGS": "-C target-feature=+simd128" if has_simd else ""}
    options = ["--lib", "--target", TARGET]
    if BUILD_STD:
        options.append(f"-Zbuild-std={BUILD_STD}")
    if LINKER:
        environment["CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER"] = LINKER
    cargo("build", features, *options, env=environment)
    return BUILT / TARGET / "release/wasm.wasm"


def measured(scalar):
    """Times (ns) and size (bytes) of every build of a scalar, and times of this machine; ends where a bit differs."""
    single = ["single"] if scalar == "single" else []
    expected = BUILT / f"expected_{scalar}"
    BUILT.mkdir(parents=True, exist_ok=True)
    # on this machine the library is nothing to be linked whole
    times = cargo(
        "run", single, "--bin", "expected", "--", expected, env={**ENVIRONMENT, "CARGO_PROFILE_RELEASE_LTO": "off"}
    )
    found = {"host": json.loads(times)}
    for name, features, has_simd in [("wasm", [], False), ("simd128", ["lanes"], True)]:
        path = module([*single, *features], has_simd)
        checked = json.loads(output([NODE, EXAMPLE / "check.mjs", path, expected, scalar]))
        print(
            f"wasm: {SCALARS[scalar]}, {name}: {checked['compared']:,} numbers have the bits of this machine",
            flush=True,
        )
        found[name] = {**checked["times"], "bytes": path.stat().st_size}
        if scalar == "double" and not has_simd:
            output([NODE, EXAMPLE / "capture.mjs", path])
    return found


def document(numbers):
    """The text of the document."""
    columns = [(scalar, build) for scalar in SCALARS for build in ("wasm", "simd128", "host")]
    head = ["", *(f"{SCALARS[scalar]}, {'this machine' if build == 'host' else build}" for scalar, build in columns)]
    rows = [head, ["---"] * len(head)]
    for function, shown in {**FUNCTIONS, "bytes": "module, bytes"}.items():
        cells = [numbers[scalar][build].get(function) for scalar, build in columns]
        rows.append([shown, *("–" if cell is None else f"{cell:,}" for cell in cells)])
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    return HEAD.format(versions=numbers["versions"]) + "\n\n" + table + "\n"


HEAD = """# In a browser or Node.js

Written by `.ci/wasm --write`. The programs are those of [examples/wasm](../examples/wasm/README.md): the paper's robot
as a module of plain functions, built for `wasm32-unknown-unknown` without `std`, an allocator or a runtime.

- **Bits.** The gate builds the module in f64 and f32, with and without `simd128`, and compares it in Node.js with this
  machine: forward dynamics, PD control with a Runge–Kutta step, exact impact with impulses and merging, at 1,000 states
  with angles up to the largest finite number. All bits agree, those of every lane too.
- **Lanes.** With `simd128` and the feature `lanes`, a vector has a robot in each lane: two in f64, four in f32. Without
  the feature, `simd128` changes little.
- **Time** is that of a call from JavaScript, in ns, the least of 50 runs through 800 states with angles within ±π;
  beside it the same functions called by Rust on the same machine. {versions}.
  Times and sizes are not compared by the gate.

## Time per call, ns"""


def main():
    """Builds, runs, compares or writes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write numbers and document")
    arguments = parser.parse_args()
    versions = f"rustc {output([RUSTC, '--version']).split()[1]}, Node.js {output([NODE, '--version']).strip()}"
    numbers = {"versions": versions, **{scalar: measured(scalar) for scalar in SCALARS}}
    if arguments.write:
        MEASURED.write_text(json.dumps(numbers, indent=1) + "\n", encoding="utf-8")
        DOCUMENT.write_text(document(numbers), encoding="utf-8")
        print(f"wasm: {MEASURED.relative_to(ROOT)} and {DOCUMENT.relative_to(ROOT)} are written")
    elif DOCUMENT.read_text(encoding="utf-8") != document(json.loads(MEASURED.read_text(encoding="utf-8"))):
        sys.exit(f"error: {DOCUMENT.relative_to(ROOT)} is not that of {MEASURED.relative_to(ROOT)}: .ci/wasm --write")


if __name__ == "__main__":
    main()
