"""Finds or makes the locked Python environment, whose folder has the hash of the pinned requirements as its name.

``python -m codegen.environment [--dev | --reference]`` prints its interpreter.
"""

import argparse
import contextlib
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

try:
    import fcntl
except ImportError:  # not on Windows
    fcntl = None

HERE = Path(__file__).resolve().parent
OLDEST = (3, 11)
# other simulators, which tests/ compares with
REFERENCE = HERE.parent / "tests" / "reference" / "requirements-reference.txt"
REQUIREMENTS = HERE / "requirements.txt"
DEV = HERE / "requirements-dev.txt"
UNFINISHED = "making-"
# what is in the lock and nothing else, whatever the user's configuration of pip says
INSTALL = ["-m", "pip", "--isolated", "install", "--quiet", "--disable-pip-version-check", "--no-input"]
INSTALL += ["--require-hashes", "--no-deps", "--only-binary=:all:", "-r"]


class EnvironmentProblem(Exception):
    """There is no environment; the message says what to install."""


def home() -> Path:
    """The one folder of all environments, whoever makes them.

    $PLANAR_CAPTURE_ENVIRONMENTS, $PLANAR_CAPTURE_HOME/python, else planar-capture/python in the user's cache folder."""
    if chosen := os.environ.get("PLANAR_CAPTURE_ENVIRONMENTS"):
        return Path(chosen)
    if chosen := os.environ.get("PLANAR_CAPTURE_HOME"):
        return Path(chosen) / "python"
    name, inside = ("LOCALAPPDATA", "AppData/Local") if os.name == "nt" else ("XDG_CACHE_HOME", ".cache")
    chosen = Path(os.environ.get(name, ""))
    try:
        caches = chosen if chosen.is_absolute() else Path.home() / inside
    except RuntimeError as error:
        raise EnvironmentProblem(f"{error}; name a folder: PLANAR_CAPTURE_ENVIRONMENTS=/path/to/folder") from error
    return caches / "planar-capture" / "python"


def report(text: str) -> None:
    print(f"codegen: {text}", file=sys.stderr, flush=True)


def fingerprint(files: list[Path]) -> str:
    """Hash of the pinned requirements and of the Python that runs this."""
    digest = hashlib.sha256(f"{sys.version}\n{sys.base_prefix}\n".encode())
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def interpreter(environment: Path) -> Path:
    return environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def site_packages(environment: Path) -> Path:
    version = f"python{sys.version_info[0]}.{sys.version_info[1]}"
    return environment / ("Lib" if os.name == "nt" else f"lib/{version}") / "site-packages"


def check_python() -> None:
    """An old Python cannot even read what comes next."""
    if sys.version_info < OLDEST:
        raise EnvironmentProblem(
            f"Python {OLDEST[0]}.{OLDEST[1]} or newer is needed, this is {sys.version.split()[0]} ({sys.executable})"
        )


def ensure(dev: bool = False, reference: bool = False) -> Path:
    """The interpreter of the locked environment, made if it is not there.

    There is one for each lock. That of the tests and lints sees the packages of the derivation, which are large."""
    check_python()
    if reference:
        return made([REFERENCE], 1100)
    derivation = made([REQUIREMENTS], 400)
    return made([DEV, REQUIREMENTS], 120) if dev else derivation


def made(locks: list[Path], size: int) -> Path:
    """The interpreter of the environment of a lock, on top of that of another where two are given."""
    place = home() / fingerprint(locks)
    if interpreter(place).exists():
        return interpreter(place)
    for module in ("venv", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            raise EnvironmentProblem(
                f"{sys.executable} has no `{module}`: on Debian and Ubuntu, `apt install python3-venv`"
            )
    place.parent.mkdir(parents=True, exist_ok=True)
    with alone_in(place.parent) as held:
        if not interpreter(place).exists():  # else another process has made it meanwhile
            make(place, locks, size, held)
    return interpreter(place)


def make(place: Path, locks: list[Path], size: int, held: list[int]) -> None:
    """Makes an environment; the programs that do it keep the descriptors that are held."""
    report(f"making a Python environment with {locks[0].name} in {place} (once; some {size} MB on disk)")
    sweep(place.parent, everything=bool(held))
    building = Path(tempfile.mkdtemp(prefix=UNFINISHED, dir=place.parent))
    try:
        run([sys.executable, "-m", "venv", str(building)], held)
        run([str(interpreter(building)), *INSTALL, str(locks[0])], held)
        if locks[1:]:
            below = site_packages(home() / fingerprint(locks[1:]))
            (site_packages(building) / "below.pth").write_text(f"{below}\n", encoding="utf-8")
        try:
            building.rename(place)  # last, so that only a complete environment has the final name
        except OSError:
            if not interpreter(place).exists():  # else another process has made the same environment meanwhile
                raise
    finally:
        shutil.rmtree(building, ignore_errors=True)
    report("environment ready")


@contextlib.contextmanager
def alone_in(folder: Path) -> Iterator[list[int]]:
    """Waits for the lock on a folder, of which there is no file, and holds it by a descriptor, which is given; by none
    where there are no locks.

    Programs that inherit the descriptor hold the lock too: what they still write after the death of this process is not
    taken for left over."""
    with contextlib.ExitStack() as stack:
        held = []
        if fcntl is not None:
            with contextlib.suppress(OSError):  # a file system without locks
                descriptor = os.open(folder, os.O_RDONLY)
                stack.callback(os.close, descriptor)
                try:
                    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    report(f"waiting for another process that makes a Python environment in {folder}")
                    fcntl.flock(descriptor, fcntl.LOCK_EX)
                held.append(descriptor)
        yield held


def sweep(folder: Path, everything: bool) -> None:
    """Removes what processes have left that were ended while they made an environment: everything, or what is so old
    that nobody can be at it."""
    for left in folder.glob(f"{UNFINISHED}*"):
        if everything or time.time() - left.stat().st_mtime > 24 * 3600:
            shutil.rmtree(left, ignore_errors=True)


def run(command: list[str], held: list[int]) -> None:
    inherited = {"pass_fds": held} if held else {}
    result = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=sys.stderr, check=False, **inherited)
    if result.returncode != 0:
        raise EnvironmentProblem(
            f"`{' '.join(command)}` failed ({result.returncode}): the packages that it names "
            "must be within reach of pip, without the user's configuration of it, and have the hashes of the lock"
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
