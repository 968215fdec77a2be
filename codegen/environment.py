"""Finds or makes the locked Python environment, whose folder has the hash of the pinned requirements as its name.

``python -m codegen.environment [--dev | --reference]`` prints its interpreter.
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
# other simulators, which tests/ compares with
REFERENCE = HERE.parent / "tests" / "reference" / "requirements-reference.txt"


class EnvironmentProblem(Exception):
    """There is no environment; the message says what to install."""


def home() -> Path:
    """The folder of all environments: $PLANAR_CAPTURE_ENVIRONMENTS, else target/python beside the package."""
    chosen = os.environ.get("PLANAR_CAPTURE_ENVIRONMENTS")
    return Path(chosen) if chosen else HERE.parent / "target" / "python"


def report(text: str) -> None:
    print(f"codegen: {text}", file=sys.stderr, flush=True)


def requirements(dev: bool) -> list[Path]:
    names = ["requirements.txt", "requirements-dev.txt"] if dev else ["requirements.txt"]
    return [HERE / name for name in names]


def fingerprint(files: list[Path]) -> str:
    """Hash of the pinned requirements and of the Python that runs this."""
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
    candidates = [files] if reference else [files, requirements(dev=True)]  # the one for tests has all of the other
    for candidate in candidates:
        if not all(file.exists() for file in candidate):  # the package in the binary has no requirements of tests
            continue
        place = home() / fingerprint(candidate)
        if interpreter(place).exists():
            return interpreter(place)
    place = home() / fingerprint(files)
    for module in ("venv", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            raise EnvironmentProblem(
                f"{sys.executable} has no `{module}`: on Debian and Ubuntu, `apt install python3-venv`"
            )
    size = 1100 if reference else 400
    report(f"making a Python environment with {files[-1].name} in {place} (once; some {size} MB on disk)")
    place.parent.mkdir(parents=True, exist_ok=True)
    building = Path(tempfile.mkdtemp(prefix="making-", dir=place.parent))
    try:
        run([sys.executable, "-m", "venv", str(building)])
        pip = [str(interpreter(building)), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        run([*pip, "--only-binary=:all:", "-r", str(files[-1])])
        try:
            building.rename(place)  # last, so that only a complete environment has the final name
        except OSError:
            if not interpreter(place).exists():  # else another process has made the same environment meanwhile
                raise
    finally:
        shutil.rmtree(building, ignore_errors=True)
    report("environment ready")
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
        report(f"error: {problem}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
