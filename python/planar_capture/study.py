"""Results of a study: summary, time series, report."""

import html
import json
import os
import warnings
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from .errors import InputError

if TYPE_CHECKING:
    import pandas
    import pyarrow

__all__ = ["Case", "Result", "Series"]

#: Of the frame in a notebook.
HEIGHT = 900


class Series(Mapping[str, np.ndarray]):
    """The time series of a case, by the names of columns: ``t`` in s since the start of the approach, ``phase``
    (``approach`` or ``post_impact``), and those of the command's CSV file, as ``base_yaw`` or ``arm1_joint2_rate``.

    An impact has two rows of the same time, before and after it.
    """

    def __init__(self, phases: list[str], columns: list[tuple[str, str, np.ndarray]]) -> None:
        time, *others = columns
        self._columns = {time[0]: time[2], "phase": np.array(phases)}
        self._columns |= {name: values for name, _, values in others}
        #: SI units by names.
        self.units = {name: unit for name, unit, _ in columns}

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"<Series of {len(self._columns['t'])} rows: {', '.join(self)}>"

    def to_pandas(self) -> "pandas.DataFrame":
        """As a data frame, with the units in ``attrs["units"]``. Needs pandas (``pip install pandas``)."""
        import pandas

        frame = pandas.DataFrame(dict(self))
        frame["phase"] = frame["phase"].astype("category")
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_arrow(self) -> "pyarrow.Table":
        """As a table, with the unit in the metadata of each column. Needs pyarrow (``pip install pyarrow``)."""
        import pyarrow

        arrays = [pyarrow.array(values) for values in self.values()]
        units = [{"unit": self.units[name]} if name in self.units else None for name in self]
        fields = [
            pyarrow.field(name, array.type, nullable=False, metadata=unit)
            for name, array, unit in zip(self, arrays, units, strict=True)
        ]
        return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields))


class Case:
    """The results of one case."""

    def __init__(self, native: _native.Study, name: str, summary: dict[str, Any]) -> None:
        self._native = native
        #: As in the scenario.
        self.name = name
        #: Its entry in ``summary["cases"]``.
        self.summary = summary

    @cached_property
    def series(self) -> Series:
        """Its time series."""
        return Series(*self._native.series(self.name))

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes its time series as the command does."""
        self._native.write_csv(self.name, path)

    def __repr__(self) -> str:
        return f"<Case {self.name}>"


class Result:
    """The results of a study. In a notebook it is shown as its report: animation and plots."""

    def __init__(self, native: _native.Study) -> None:
        self._native = native
        if native.warning is not None:
            warnings.warn(native.warning, stacklevel=3)
        #: As in ``summary.json`` (the book's chapter of results describes it), but for the command in ``run``, and
        #: without ``files``.
        self.summary: dict[str, Any] = json.loads(native.summary())
        cases = zip(native.cases, self.summary["cases"], strict=True)
        #: By name.
        self.cases = {name: Case(native, name, summary) for name, summary in cases}

    @property
    def name(self) -> str:
        """The scenario's."""
        return str(self.summary["scenario"])

    @property
    def dynamics(self) -> str:
        """What computed it: ``generated``, ``graph`` or ``generic``."""
        return str(self.summary["dynamics"])

    @property
    def audit_failures(self) -> list[str]:
        """What the audit objects to: drifts and errors over their bounds, overlaps, limits. Empty where all is well;
        else the command ends with exit code 1."""
        return self._native.audit_failures

    @property
    def series(self) -> Series:
        """The time series of a study of one case; of several, ``result.cases[NAME].series``."""
        return self._only().series

    def to_pandas(self) -> "pandas.DataFrame":
        """The time series of a study of one case as a data frame. Needs pandas."""
        return self._only().series.to_pandas()

    def to_arrow(self) -> "pyarrow.Table":
        """The time series of a study of one case as a table. Needs pyarrow."""
        return self._only().series.to_arrow()

    def report(self, path: str | os.PathLike[str], *, case: str | None = None) -> None:
        """Writes the report, one HTML file that opens without a network.

        It is on all cases, or on ``case`` and those that share its approach: a case with values of its own, ``set``,
        shares its with none.
        """
        self._native.write_html(path, case)

    def __repr__(self) -> str:
        return f"<Result of {self.name} ({', '.join(self.cases)})>"

    def __str__(self) -> str:
        return self._native.table()

    def _repr_html_(self) -> str:
        page = html.escape(self._native.html(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: {HEIGHT}px; border: 0"></iframe>'

    def _only(self) -> Case:
        if len(self.cases) != 1:
            raise InputError(f"the study has the cases {', '.join(self.cases)}: choose one, result.cases[NAME]")
        return next(iter(self.cases.values()))
