"""Controllers of one's own, called once per sample."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .errors import InputError
from .results import State

__all__ = ["Control", "Desired"]


class Desired(NamedTuple):
    """The desired motion of the joints at a time, (joints,) each.

    In an approach it is that of the scenario's trajectory; after a capture the joint angles at the capture, at rest.

    - ``joint_angles``: rad.
    - ``joint_rates``: rad/s.
    - ``joint_accelerations``: rad/s².
    """

    joint_angles: np.ndarray
    joint_rates: np.ndarray
    joint_accelerations: np.ndarray


#: ``control(time, state, desired)`` returns the joint torques, (joints,) N m, which are held until the next sample.
#:
#: ``time`` is in s since the start of the phase, of an approach or of the motion after an impact; ``desired`` is
#: ``None`` where the scenario has end effector paths instead of a joint trajectory. A controller with a memory has a
#: method ``reset()``, which is called before each phase.
Control = Callable[[float, State, Desired | None], ArrayLike]


class Law:
    """A controller as the native part calls it."""

    def __init__(self, control: Control, joints: int) -> None:
        if not callable(control):
            raise InputError(f"a controller is {control!r}, expected a callable of time, state and desired motion")
        self.control, self.joints = control, joints

    def begin(self, since_impact: float) -> None:
        """Before each phase."""
        reset = getattr(self.control, "reset", None)
        if reset is not None:
            reset()

    def torques(self, time: float, *arrays: Any) -> np.ndarray:
        """Its torques, which are checked."""
        state, desired = State(*arrays[:4]), Desired(*arrays[4:])
        torques = self.control(time, state, None if desired.joint_angles is None else desired)
        try:
            found = np.asarray(torques, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(self.refusal(time, f"{torques!r}")) from error
        if found.shape != (self.joints,):
            what = f"an array of shape {found.shape}" if found.ndim else repr(torques)
            raise InputError(self.refusal(time, what))
        if not np.isfinite(found).all():
            raise InputError(self.refusal(time, f"{found}"))
        return np.ascontiguousarray(found)

    def refusal(self, time: float, found: str) -> str:
        """About what a controller has returned."""
        return f"at t = {time} s the controller returned {found}, expected {self.joints} finite joint torques in N m"
