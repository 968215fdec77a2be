"""Sweeps: one case of a scenario many times, with values drawn from distributions."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from . import _native

if TYPE_CHECKING:
    import pandas
    import pyarrow

__all__ = ["SweepResult", "sweep"]


class SweepResult:
    """What a sweep computed; ``docs/sweep.md`` describes the columns of its cases."""

    def __init__(
        self,
        path: str | os.PathLike[str],
        name: str,
        folder: str | os.PathLike[str],
        cases: int,
        computed: list[tuple[str, int]],
        present: int,
    ) -> None:
        self._path = path
        self.name = name
        #: With ``manifest.json``, ``cases/``, ``digests/`` and ``timing/``.
        self.folder = Path(folder)
        #: Of the whole sweep.
        self.cases = cases
        #: Numbers of cases that were computed by this call, by status.
        self.computed = {status: count for status, count in computed if count}
        #: The number of cases that were there before.
        self.present = present

    def __repr__(self) -> str:
        counts = [f"{count} {status}" for status, count in self.computed.items()]
        if self.present:
            counts.append(f"{self.present} were there before")
        return f"<SweepResult {self.name}: {self.cases} cases, {', '.join(counts)}; {self.folder}>"

    def to_arrow(self) -> "pyarrow.Table":
        """All cases in the folder, in order. Needs pyarrow (``pip install pyarrow``)."""
        import pyarrow
        import pyarrow.parquet

        files = sorted((self.folder / "cases").glob("*.parquet"))
        return pyarrow.concat_tables([pyarrow.parquet.read_table(file) for file in files])

    def to_pandas(self) -> "pandas.DataFrame":
        """All cases in the folder. Needs pandas and pyarrow."""
        return self.to_arrow().to_pandas()

    def report(self) -> Path:
        """Writes ``report.html`` into the folder: percentiles, failures, sensitivities, extremes."""
        return Path(_native.sweep_report(self._path, self.folder))


def sweep(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    *,
    threads: int | None = None,
    shard: tuple[int, int] | None = None,
    dynamics: str = "auto",
    report: bool = False,
    progress: Callable[[int, int], object] | None = None,
) -> SweepResult:
    """Computes a sweep, as ``planar-capture sweep`` does: the same files with the same bytes.

    ``out`` is the folder, ``results/NAME`` by default: files of cases that are there already are not computed again,
    those of another sweep are refused, and a damaged one is computed again, with a warning. ``shard=(I, N)`` computes
    every Nth file from the Ith on. ``progress`` is called now and then with the numbers of computed cases and of those
    to compute. Ctrl-C ends it within a case of each thread; the same call goes on from there. A case without a result
    is a row with its message.
    """
    return SweepResult(path, *_native.sweep(path, out, threads, shard, dynamics, report, progress))
