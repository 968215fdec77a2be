"""The derivation of layouts of any arms, links and exact zeros."""

import importlib.metadata
import os
import sys
from collections.abc import Callable

from . import _native
from .casadi_functions import CASADI
from .robot import Robot, layout_source

__all__ = ["derive"]


def derive(layout: str | os.PathLike[str], *, progress: Callable[[str], object] | None = None) -> Robot:
    """Derives a layout (a path, a shipped name, or TOML text) with CasADi, and proves the result against the generic
    implementation; the graph is kept in the user's cache folder, where :meth:`Robot.from_toml`, :func:`run`,
    :func:`sweep` and the command find it for every layout of the same arms, links and exact zeros.

    The robot has the graph (:attr:`Robot.graph`) and its CasADi functions (:meth:`Robot.casadi_function`). CasADi is
    that of this environment where it has the right version, as with the extra ``derive``; else an
    environment is made, once, in the cache folder. ``progress`` is called with messages.
    """
    text, file = layout_source(layout)
    source = _native.Robot.layout_of(file) if text is None else text
    interpreter = sys.executable if has_casadi() else None
    return Robot(_native.derive(source, file, interpreter, progress))


def has_casadi() -> bool:
    """Whether this environment has the CasADi that the derivation is locked to."""
    try:
        return importlib.metadata.version("casadi") == CASADI
    except importlib.metadata.PackageNotFoundError:
        return False
