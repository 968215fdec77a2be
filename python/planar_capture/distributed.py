"""Sweeps on several machines, by Dask: ``python -m planar_capture.distributed SWEEP.toml --scheduler ADDRESS``.

A task computes one file of cases, and writes it, whole or not at all, into a folder that all workers see. The files
have the bytes of :func:`planar_capture.sweep`, whatever workers there are, and however many of them are lost.
"""

import argparse
import os
import secrets
import socket
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from .errors import Error, InputError, OutputError
from .sweeps import SweepResult

try:
    from distributed import Client, as_completed
except ImportError as error:
    missing = "Dask is not installed: pip install 'distributed>=2026.1'"
    if __name__ == "__main__":
        print(f"error: {missing}", file=sys.stderr)
        sys.exit(2)
    raise ImportError(missing) from error

if TYPE_CHECKING:
    import dask.dataframe

__all__ = ["DistributedResult", "sweep"]

#: A file may be under way on so many workers that are lost: on a cluster that is a matter of luck, not of the file.
ALLOWED_FAILURES = 20
#: Of a task that fails by itself, as where a disk is out of reach for a moment.
RETRIES = 3
#: As shells report a command that SIGINT has ended.
INTERRUPTED = 130


class DistributedResult(SweepResult):
    """What a sweep computed."""

    def to_dask(self) -> "dask.dataframe.DataFrame":
        """All cases in the folder as a Dask data frame with a partition for each file. Needs pandas and pyarrow."""
        import dask.dataframe

        files = [str(file) for file in sorted((self.folder / "cases").glob("*.parquet"))]
        frame: dask.dataframe.DataFrame = dask.dataframe.read_parquet(files)
        return frame


def sweep(
    path: str | os.PathLike[str],
    client: Client,
    out: str | os.PathLike[str] | None = None,
    *,
    dynamics: str = "auto",
    report: bool = False,
    progress: Callable[[int, int], object] | None = None,
) -> DistributedResult:
    """Computes the files of a sweep that are missing, on the workers of a Dask client.

    ``path`` and ``out`` (by default ``results/NAME``) are seen by all workers under the same absolute names, which is
    tried first. Workers have this version of the package: others are refused. ``progress`` is called with the numbers
    of cases that this call has computed and is to compute. A worker that is lost costs the files that it had under way;
    after an interruption the same call goes on.
    """
    file = Path(path).resolve()
    name, folder, cases, total, missing, to_compute = _native.sweep_plan(file, out and Path(out).resolve(), dynamics)
    place = Path(folder).resolve()
    probe(client, file, place)
    client.run_on_scheduler(allow_failures)
    computed: dict[str, int] = {}
    futures = client.map(
        compute, missing, path=str(file), folder=str(place), total=total, dynamics=dynamics, pure=False, retries=RETRIES
    )
    try:
        for future in as_completed(futures):
            for status, count in future.result():
                computed[status] = computed.get(status, 0) + count
            if progress is not None:
                progress(sum(computed.values()), to_compute)
    finally:
        client.cancel(futures)
    result = DistributedResult(file, name, place, cases, list(computed.items()), cases - to_compute)
    if report:
        result.report()
    return result


def compute(block: int, path: str, folder: str, total: int, dynamics: str) -> list[tuple[str, int]]:
    """Computes one file, on a worker; the numbers of its cases by status."""
    *_, computed, present = _native.sweep(path, folder, 1, (block + 1, total), dynamics, False, None)
    # a worker that was lost may have written the file, and not said so
    return _native.sweep_statuses(folder, block) if present else computed


def allow_failures(dask_scheduler: Any) -> None:
    """On the scheduler: a task is not given up with a few workers."""
    dask_scheduler.allowed_failures = max(dask_scheduler.allowed_failures, ALLOWED_FAILURES)


def probe(client: Client, file: Path, folder: Path) -> None:
    """That all workers see file and folder, and write where this process sees it; and that there are workers."""
    if not client.scheduler_info(n_workers=-1)["workers"]:
        raise InputError("the scheduler has no workers")
    token = secrets.token_hex(8)
    mark = folder / f".probe-{token}"
    try:
        mark.write_text(token, encoding="utf-8")
        answers = client.run(answer, str(file), str(mark), on_error="return")
        problems = []
        for worker, found in answers.items():
            if isinstance(found, BaseException):
                problems.append(f"{worker}: {found}")
            elif found["problem"] is not None:
                problems.append(f"{worker} ({found['host']}): {found['problem']}")
            elif not Path(found["mark"]).exists():
                problems.append(f"{worker} ({found['host']}): {folder} is another folder there")
        if problems:
            listed = "\n".join(f"  {problem}" for problem in problems)
            raise OutputError(f"workers cannot compute this sweep:\n{listed}")
    finally:
        for left in folder.glob(f".probe-{token}*"):
            left.unlink(missing_ok=True)


def answer(file: str, mark: str) -> dict[str, str | None]:
    """What a worker sees; writes a mark of its own."""
    host, own = socket.gethostname(), f"{mark}-{secrets.token_hex(8)}"
    problem = None
    if not Path(file).is_file():
        problem = f"there is no file {file}"
    else:
        try:
            Path(mark).read_text(encoding="utf-8")
            Path(own).write_text(host, encoding="utf-8")
        except OSError as error:
            problem = f"the folder is not shared: {error}"
    return {"host": host, "problem": problem, "mark": own}


def main() -> int:
    """The command; its exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m planar_capture.distributed", description="Computes a sweep on the workers of a Dask scheduler."
    )
    parser.add_argument("sweep", type=Path, metavar="SWEEP.toml")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="by default a cluster of this machine's processors")
    parser.add_argument("--out", type=Path, metavar="DIR", help="a folder that all workers see (default: results/NAME)")
    parser.add_argument("--dynamics", default="auto", choices=["auto", "generated", "graph", "generic"])
    parser.add_argument("--report", action="store_true", help="write DIR/report.html too")
    options = parser.parse_args()

    def show(computed: int, cases: int) -> None:
        print(f"{computed} of {cases} cases", file=sys.stderr)

    try:
        with Client(**({"address": options.scheduler} if options.scheduler else {})) as client:
            result = sweep(
                options.sweep, client, options.out, dynamics=options.dynamics, report=options.report, progress=show
            )
    except KeyboardInterrupt:
        print("interrupted: the same command goes on from here", file=sys.stderr)
        return INTERRUPTED
    except (Error, OSError) as error:
        message = str(error)
        print(message if message.startswith("error") else f"error: {message}", file=sys.stderr)
        return error.exit_code if isinstance(error, Error) else 2
    print(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
