"""The locked Python environment: found, or made on first use, under a name that holds its contents' hash.

``python -m codegen.environment [--dev | --reference]`` prints the environment's interpreter.
"""

import argparse
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
OLDEST = (3, 11)
# Other simulators, for the comparisons in tests/.
REFERENCE = HERE.parent / "tests" / "reference" / "requirements-reference.txt"


class EnvironmentProblem(Exception):
    """The environment cannot be made; the message says what to install."""


def home() -> Path:
    """Where environments are kept: $PLANAR_CAPTURE_ENVIRONMENTS, else target/python beside the package."""
    chosen = os.environ.get("PLANAR_CAPTURE_ENVIRONMENTS")
    return Path(chosen) if chosen else HERE.parent / "target" / "python"


def say(text: str) -> None:
    print(f"codegen: {text}", file=sys.stderr, flush=True)


def requirements(dev: bool) -> list[Path]:
    names = ["requirements.txt", "requirements-dev.txt"] if dev else ["requirements.txt"]
    return [HERE / name for name in names]


def fingerprint(files: list[Path]) -> str:
    """Changes with the pins and with the Python that runs them."""
    digest = hashlib.sha256(f"{sys.version}\n{sys.base_prefix}\n".encode())
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def interpreter(environment: Path) -> Path:
    return environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def ensure(dev: bool = False, reference: bool = False) -> Path:
    """The interpreter of the locked environment, made if it is not there."""
    if sys.version_info < OLDEST:
        raise EnvironmentProblem(
            f"Python {OLDEST[0]}.{OLDEST[1]} or newer is needed, this is {sys.version.split()[0]} ({sys.executable})"
        )
    files = [REFERENCE] if reference else requirements(dev)
    for good_enough in [files] if reference else (files, requirements(dev=True)):  # the larger one serves both
        if not all(file.exists() for file in good_enough):  # the package that a binary carries has the smaller one
            continue
        place = home() / fingerprint(good_enough)
        if interpreter(place).exists():
            return interpreter(place)
    place = home() / fingerprint(files)
    for module in ("venv", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            raise EnvironmentProblem(
                f"{sys.executable} has no `{module}`: on Debian and Ubuntu, `apt install python3-venv`"
            )
    size = 1100 if reference else 400
    say(f"making a Python environment with {files[-1].name} in {place} (once; some {size} MB on disk)")
    place.parent.mkdir(parents=True, exist_ok=True)
    building = Path(tempfile.mkdtemp(prefix="making-", dir=place.parent))
    try:
        run([sys.executable, "-m", "venv", str(building)])
        run(
            [
                str(interpreter(building)),
                "-m",
                "pip",
                "install",
                "--quiet",
                "--disable-pip-version-check",
                "--only-binary=:all:",
                "-r",
                str(files[-1]),
            ]
        )
        try:
            building.rename(place)  # moved last: what has the final name is whole
        except OSError:
            if not interpreter(place).exists():  # else somebody else was faster, and theirs is as good
                raise
    finally:
        shutil.rmtree(building, ignore_errors=True)
    say("environment ready")
    return interpreter(place)


def run(command: list[str]) -> None:
    result = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=sys.stderr, check=False)
    if result.returncode != 0:
        raise EnvironmentProblem(
            f"`{' '.join(command)}` failed ({result.returncode}): the packages that it names "
            "must be within reach of pip (network, proxy or a local index)"
        )


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m codegen.environment", description=__doc__)
    contents = parser.add_mutually_exclusive_group()
    contents.add_argument("--dev", action="store_true", help="with what tests and lints need")
    contents.add_argument("--reference", action="store_true", help="with other simulators to compare with, instead")
    options = parser.parse_args()
    try:
        print(ensure(options.dev, options.reference))
    except EnvironmentProblem as problem:
        say(f"error: {problem}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
