"""Makes deliberate faults, one at a time, and runs the tests that have to fail with each: ``tests/break_table.toml``.

``python3 tests/break_table.py [--jobs N] [--only NAME ...] [--check]`` works on copies of the tracked files in a
temporary folder and does not change the repository. After a fault in the derivation the graphs are derived again, so
that only their numbers are wrong. Exits with 1 if one of its tests does not fail with a fault, or if a fault cannot be
made; ``--check`` looks only whether the texts that faults replace, and the tests, are there.
"""

import argparse
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

CARGO_TEST = ["cargo", "test", "--locked"]


@dataclass(frozen=True)
class Fault:
    """A replacement of one text in one file, and the tests that have to fail."""

    name: str
    file: str
    old: str
    new: str
    tests: list[str]


class Broken(Exception):
    """A fault that cannot be made, or a test that cannot be run."""


@dataclass(frozen=True)
class Place:
    """A copy of the repository, with a build folder that is kept between faults and runs."""

    tree: Path
    target: Path


def faults() -> list[Fault]:
    text = (ROOT / "tests" / "break_table.toml").read_text(encoding="utf-8")
    return [Fault(**fault) for fault in tomllib.loads(text)["fault"]]


def copy_tracked(to: Path) -> None:
    """The tracked files as they are in the working tree."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, names.split("\0")):
        if (ROOT / name).exists():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, to / name)


def run(command: list[str], place: Place, **variables: str) -> tuple[int, str]:
    """(exit code, both streams) of a command in the copy."""
    kept = {
        "CARGO_TARGET_DIR": str(place.target),
        "CARGO_PROFILE_DEV_DEBUG": "0",
        "CARGO_TERM_COLOR": "never",
    }
    result = subprocess.run(
        command,
        cwd=place.tree,
        env={**os.environ, **kept, **variables},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    return result.returncode, result.stdout.decode(errors="replace")


def fails(test: str, place: Place) -> bool:
    """Whether a test, or the build, fails in the copy."""
    kind, _, name = test.partition(":")
    name = name.lstrip(": ")
    if kind == "codegen":
        function = name.rpartition("::")[2]
        _, text = run([sys.executable, "-m", "codegen", "--test"], place, PYTEST_ADDOPTS=f"-x -k {function}")
        return f"FAILED codegen/tests/{name}" in text
    if kind == "build":
        code, text = run([*CARGO_TEST, "--test", "models", "--no-run"], place)
        return code != 0 and "failed to run custom build command" in text and name in text
    # a crate's own tests; with planar-proof it is built as for the binaries
    chosen = ["--lib", "-p", kind, "-p", "planar-proof"] if "-" in kind else ["--test", kind]
    # for the tests of pictures
    if kind == "planar-capture":
        chosen += ["--features", "figures"]
    code, text = run([*CARGO_TEST, *chosen, "--", "--exact", name], place)
    found = re.search(rf"(?m)^test {re.escape(name)} \.\.\. (ok|FAILED)", text)
    if found is None:
        raise Broken(f"{test} cannot be run:\n{text[-4000:]}")
    return found[1] == "FAILED"


def right(fault: Fault, tree: Path) -> str:
    """The file of a fault, which has its text exactly once."""
    path = tree / fault.file
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    if text.count(fault.old) != 1:
        raise Broken(f"{fault.file} has the text {text.count(fault.old)} times, not once:\n{fault.old}")
    return text


def check(chosen: list[Fault]) -> int:
    """Exit code 1 where a fault cannot be made, or a test is not there."""
    files = [path for folder in ("codegen", "crates", "src", "tests") for path in (ROOT / folder).rglob("*.[pr][sy]")]
    defined = re.findall(r"(?m)^\s*(?:def|fn) (\w+)\(", "".join(path.read_text(encoding="utf-8") for path in files))
    # tests of each layout
    defined += [path.stem for path in (ROOT / "codegen" / "layouts").iterdir()]
    # what `fails` can run: packages, and folders of test binaries
    binaries = [path for folder in ("tests", "tests/proof/tests") for path in (ROOT / folder).glob("*/main.rs")]
    kinds = {"build", "codegen", "planar-capture"} | {path.parent.name for path in binaries}
    kinds |= {path.name for path in (ROOT / "crates").iterdir()}
    bad = 0
    for fault in chosen:
        try:
            right(fault, ROOT)
            for test in fault.tests:
                kind = test.partition(":")[0]
                if kind not in kinds or (kind != "build" and test.rpartition("::")[2] not in defined):
                    raise Broken(f"there is no test {test}")
        except Broken as problem:
            bad += 1
            print(f"{fault.name}: {problem}", file=sys.stderr)
    print(f"{len(chosen)} faults, {bad} of them cannot be made or have a test that is not there")
    return 1 if bad else 0


def attempt(fault: Fault, place: Place) -> list[str]:
    """Makes a fault in the copy, runs its tests, and restores the file; returns the tests that do not fail."""
    path = place.tree / fault.file
    text = right(fault, place.tree)
    graphs = {graph: graph.read_bytes() for graph in (place.tree / "codegen").rglob("*.json")}
    try:
        path.write_text(text.replace(fault.old, fault.new), encoding="utf-8")
        if path.suffix == ".py":
            code, said = run([sys.executable, "-m", "codegen"], place)
            if code != 0:
                raise Broken("the faulty derivation derives nothing:\n" + said[-4000:])
        return [test for test in fault.tests if not fails(test, place)]
    finally:
        path.write_text(text, encoding="utf-8")
        for graph, content in graphs.items():
            if graph.read_bytes() != content:
                graph.write_bytes(content)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", metavar="NAME", help="this fault alone; may be given again")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="faults at a time, a copy each (1)")
    parser.add_argument("--check", action="store_true", help="only whether the texts and the tests are there")
    options = parser.parse_args()
    only, there = options.only or [], faults()
    unknown = sorted(set(only) - {fault.name for fault in there})
    if unknown:
        print(f"no fault {', '.join(unknown)}; there are: {', '.join(f.name for f in there)}", file=sys.stderr)
        return 2
    chosen = [fault for fault in there if not only or fault.name in only]
    if options.check:
        return check(chosen)
    start, bad = time.monotonic(), []
    with tempfile.TemporaryDirectory(prefix="break-table-") as folder, ThreadPoolExecutor(options.jobs) as pool:
        places: queue.SimpleQueue[Place] = queue.SimpleQueue()
        for k in range(options.jobs):
            place = Place(Path(folder) / str(k), ROOT / "target" / "break_table" / str(k))
            copy_tracked(place.tree)
            places.put(place)

        def outcome_of(fault: Fault) -> str:
            place = places.get()
            try:
                passed = attempt(fault, place)
            except Broken as problem:
                return str(problem)
            finally:
                places.put(place)
            return f"not seen by {', '.join(passed)}" if passed else ""

        for fault, problem in zip(chosen, pool.map(outcome_of, chosen), strict=True):
            print(f"{fault.name}: {problem or 'seen'}", flush=True)
            if problem:
                bad.append(fault.name)
    print(f"{len(chosen)} faults in {time.monotonic() - start:.0f} s", file=sys.stderr)
    if bad:
        print(f"not as expected: {', '.join(bad)}", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
