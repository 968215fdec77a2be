"""Closed-form planar dynamics of free-floating multi-arm space robots: from approach through impact to post-impact.

- :class:`Robot`: dynamics on numpy arrays of any batch shape.
- :class:`Scenario`, :func:`run`: a capture end to end, under a controller of one's own if wanted.
- :func:`sweep`: many captures with drawn values.
- :func:`derive`: robots of other arms, links and exact zeros.

SI units and radians; poses are [yaw, x, y], twists [ω, vx, vy], wrenches and impulses [n, fx, fy], in inertial axes.
"""

from ._native import VERSION as __version__
from ._native import layouts
from .batch import Argument, Function, Parameter
from .control import Control, Desired
from .derivation import derive
from .errors import (
    ComputationError,
    DerivationError,
    Error,
    InputError,
    MissingGraphError,
    NotFiniteError,
    OutputError,
    SingularError,
    StateError,
)
from .results import (
    Accelerations,
    Capture,
    FullImpact,
    Momentum,
    ReducedDynamics,
    ReducedImpact,
    State,
    Targets,
)
from .robot import Robot
from .scenario import Scenario, run
from .study import Case, Result, Series
from .sweeps import SweepResult, sweep

__all__ = [
    "Accelerations",
    "Argument",
    "Capture",
    "Case",
    "ComputationError",
    "Control",
    "DerivationError",
    "Desired",
    "Error",
    "FullImpact",
    "Function",
    "InputError",
    "MissingGraphError",
    "Momentum",
    "NotFiniteError",
    "OutputError",
    "Parameter",
    "ReducedDynamics",
    "ReducedImpact",
    "Result",
    "Robot",
    "Scenario",
    "Series",
    "SingularError",
    "State",
    "StateError",
    "SweepResult",
    "Targets",
    "__version__",
    "derive",
    "layouts",
    "run",
    "sweep",
]
