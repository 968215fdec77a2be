"""Scenarios: approach, impact and the motion after it."""

# annotations stay text, as in `robot`
from __future__ import annotations

import os
from collections.abc import Mapping

from . import _native
from .control import Control, Law
from .robot import Robot
from .study import Result

__all__ = ["Scenario", "run"]


class Scenario:
    """A scenario; ``docs/scenarios.md`` and ``planar-capture template`` describe its file."""

    def __init__(self, native: _native.Scenario) -> None:
        self._native = native

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str]) -> Scenario:
        """A scenario from a path, or from TOML text, in which paths are relative to the working folder.

        Raises :class:`InputError` with file, line, key and value of whatever is wrong.
        """
        if isinstance(source, str) and "\n" in source:
            return cls(_native.Scenario.parse(source, "<scenario>"))
        return cls(_native.Scenario.read(source))

    def __repr__(self) -> str:
        return f"<Scenario {self.name} ({', '.join(self.cases)})>"

    @property
    def name(self) -> str:
        """As in its file."""
        return self._native.name

    @property
    def text(self) -> str:
        """The TOML text."""
        return self._native.text

    @property
    def cases(self) -> list[str]:
        """The names of its cases."""
        return self._native.cases

    @property
    def targets(self) -> list[str]:
        """The names of its targets."""
        return self._native.targets

    @property
    def robot(self) -> Robot:
        """The robot without targets."""
        return Robot.from_toml(self._native.layout)

    def with_values(self, values: Mapping[str, float | str | bool], *, case: str | None = None) -> Scenario:
        """The scenario of one case, by default the only one, with other values: ``{"target.target1.mass": 12.0,
        "layout.base.mass": 480.0, "approach.tracking": "computed_torque"}``.

        Keys are those of sweeps (``docs/sweep.md``): TOML paths into the scenario, or after ``layout.`` into its
        layout, also those that are left at their default. Raises :class:`InputError` where there is no such key, or a
        value is not valid there. :attr:`text` has the values; what shows only when it runs is said of that text.
        """
        return Scenario(self._native.with_values(list(values.items()), case))

    def run(
        self,
        control: Control | None = None,
        *,
        post_capture_control: Control | None = None,
        sample: float = 0.05,
        sample_time: float | None = None,
        dynamics: str = "auto",
    ) -> Result:
        """Computes the study, as ``planar-capture run`` does, without writing files.

        ``control`` takes the place of the approach's tracking, ``post_capture_control`` that of the law after a
        capture: a callable of the time since the start of its phase, s, of :class:`State`, and of :class:`Desired`
        (rad, rad/s, rad/s², (joints,) each; ``None`` where the scenario has end effector paths), which returns the
        joint torques, (joints,) in N m; positions are in the inertial frame. Both are called every ``sample_time`` s (a
        multiple of the phase's step), by default that of the scenario; the scenario's torque limits hold for them. Rows
        of the time series are ``sample`` s apart.
        ``dynamics`` is ``"auto"``, ``"generated"``, ``"graph"`` or ``"generic"``.

        Raises :class:`InputError` where the scenario has no result, :class:`ComputationError` where the simulation
        breaks down, and whatever a controller raises.
        """
        joints = self._native.joints
        tracking = None if control is None else Law(control, joints)
        after = None if post_capture_control is None else Law(post_capture_control, joints)
        command = f"planar_capture.run({self.name!r})"
        return Result(self._native.run(tracking, after, sample, sample_time, dynamics, command))


def run(
    scenario: Scenario | str | os.PathLike[str],
    control: Control | None = None,
    *,
    post_capture_control: Control | None = None,
    sample: float = 0.05,
    sample_time: float | None = None,
    dynamics: str = "auto",
) -> Result:
    """Computes a scenario, or that of a path or a TOML text, as :meth:`Scenario.run` does.

    ``control`` and ``post_capture_control`` are callables of time (s), :class:`State` and :class:`Desired` that return
    the joint torques, (joints,) in N m; both are called every ``sample_time`` s. Rows of the time series are ``sample``
    s apart. Series have their units in ``units``: SI and radians, poses [yaw, x, y] and twists [ω, vx, vy] in the
    inertial frame.
    """
    read = scenario if isinstance(scenario, Scenario) else Scenario.from_toml(scenario)
    return read.run(
        control,
        post_capture_control=post_capture_control,
        sample=sample,
        sample_time=sample_time,
        dynamics=dynamics,
    )
