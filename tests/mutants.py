"""Tests mutants of the code by cargo-mutants: a sample, drawn by a seed.

``python3 tests/mutants.py [--count N] [--seed SEED] [--check]`` builds the pinned cargo-mutants into ``target/tools``
where it is missing. Which files are mutated is in ``.cargo/mutants.toml``, which mutants may survive and why in
``tests/mutants.toml``. Exits with 1 if another mutant survives, or if one that is listed is no mutant any more;
``--check`` looks for the latter only. Exit code 3: nothing was tested, because the tool cannot be built here.
"""

import argparse
import json
import os
import random
import re
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VERSION = "27.1.0"
TOOLS = ROOT / "target" / "tools"
RESULTS = ROOT / "target" / "mutants"
# s; a mutant that hangs is found by it
LIMIT = 1800


def tool() -> str | None:
    """The command of the pinned version."""
    for command in ("cargo-mutants", str(TOOLS / "bin" / "cargo-mutants")):
        try:
            said = subprocess.run([command, "mutants", "--version"], capture_output=True, text=True)
        except OSError:
            continue
        if said.stdout.strip() == f"cargo-mutants {VERSION}":
            return command
    print(f"building cargo-mutants {VERSION} into target/tools, once; some minutes on two cores", flush=True)
    # it waits for builds: built for a short build itself
    quick = {"OPT_LEVEL": "1", "LTO": "off", "CODEGEN_UNITS": "16"}
    environment = os.environ | {f"CARGO_PROFILE_RELEASE_{key}": value for key, value in quick.items()}
    install = ["cargo", "install", "--quiet", "--locked", "--root", str(TOOLS), f"cargo-mutants@{VERSION}"]
    if subprocess.run(install, env=environment).returncode != 0:
        return None
    return str(TOOLS / "bin" / "cargo-mutants")


@dataclass(frozen=True)
class Mutant:
    """A mutant, where it is, and the tool's name for it."""

    file: str
    number: int
    line: str
    name: str


def mutants(command: str) -> dict[str, Mutant]:
    """All mutants by their names in the list: with the line as it becomes in place of its number."""
    listing = [command, "mutants", "--workspace", "--list", "--json"]
    found = {}
    for mutant in json.loads(subprocess.run(listing, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout):
        file, start, end = mutant["file"], mutant["span"]["start"], mutant["span"]["end"]
        line = (ROOT / file).read_text(encoding="utf-8").split("\n")[start["line"] - 1]
        name = f"{file}: " + re.sub(r"^.*?:\d+:\d+: ", "", mutant["name"])
        if mutant["genre"] == "StructField":
            continue  # cargo-mutants 27.1 cannot be asked for single ones
        if mutant["genre"] != "FnValue":
            rest = line[end["column"] - 1 :] if start["line"] == end["line"] else ""
            name += ": " + f"{line[: start['column'] - 1]}{mutant['replacement']}{rest}".strip()
        found[name] = Mutant(file, start["line"], line, mutant["name"])
    return found


def difference(sample: list[Mutant]) -> str:
    """A difference in which the lines of the sample are new: the tool looks at no others. By names alone it would test
    all fields of structures too."""
    text = ""
    for file in sorted({mutant.file for mutant in sample}):
        lines = sorted({(mutant.number, mutant.line) for mutant in sample if mutant.file == file})
        text += f"--- a/{file}\n+++ b/{file}\n"
        text += "".join(f"@@ -{number - 1 - i},0 +{number},1 @@\n+{line}\n" for i, (number, line) in enumerate(lines))
    return text


def accepted() -> set[str]:
    """The mutants that may survive."""
    groups = tomllib.loads((ROOT / "tests" / "mutants.toml").read_text(encoding="utf-8"))["accepted"]
    return {f"{group['file']}: {mutant}" for group in groups for mutant in group["mutants"]}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=8, metavar="N", help="mutants in the sample (8)")
    parser.add_argument("--seed", default="0", help="of the sample (0)")
    parser.add_argument("--only", metavar="REGEX", help="of the names of the list: draw from these")
    parser.add_argument("--check", action="store_true", help="only whether the listed mutants exist")
    options = parser.parse_args()
    command = tool()
    if command is None:
        print("cargo-mutants cannot be built here: mutants are NOT tested")
        return 3
    there, listed = mutants(command), accepted()
    stale = sorted(listed - there.keys())
    for name in stale:
        print(f"tests/mutants.toml: not a mutant any more: {name}", file=sys.stderr)
    print(f"{len(there)} mutants, {len(listed)} of them may survive", flush=True)
    if options.check or stale:
        return 1 if stale else 0
    candidates = sorted(name for name in there.keys() - listed if re.search(options.only or "", name))
    drawn = random.Random(options.seed).sample(candidates, min(options.count, len(candidates)))
    sample = [there[name] for name in drawn]
    RESULTS.mkdir(parents=True, exist_ok=True)
    (RESULTS / "sample.diff").write_text(difference(sample), encoding="utf-8")
    run = [command, "mutants", "--workspace", "--baseline", "skip", "--timeout", str(LIMIT), "--output", str(RESULTS)]
    names = "|".join(re.escape(mutant.name) for mutant in sample)
    run += ["--re", f"^({names})$", "--in-diff", str(RESULTS / "sample.diff")]
    code = subprocess.run(run, cwd=ROOT).returncode
    missed = (RESULTS / "mutants.out" / "missed.txt").read_text(encoding="utf-8")
    if missed:
        print(f"not detected, and not in tests/mutants.toml (seed {options.seed}):\n{missed}", file=sys.stderr)
    # 3: a mutant ran into the limit, which detects it
    return 1 if missed or code not in (0, 3) else 0


if __name__ == "__main__":
    sys.exit(main())
