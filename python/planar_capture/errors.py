"""The exceptions. Messages are those of the command line; `exit_code` is what it would end with."""

import numpy as np


class Error(Exception):
    """Any of them."""

    #: Of the command: 1 where a valid computation broke down, 2 where an input is not suitable.
    exit_code: int = 2


class InputError(Error, ValueError):
    """A file, an argument or an array is not valid: the message says which, where, and what would be right."""


class MissingGraphError(InputError):
    """No graph has the structure of a layout: :func:`planar_capture.derive` derives one."""


class DerivationError(Error, RuntimeError):
    """A layout could not be derived; the message says what to install where something is missing."""


class OutputError(Error, OSError):
    """A result cannot be written."""


class ComputationError(Error, ArithmeticError):
    """A valid computation broke down."""

    exit_code = 1


class StateError(ComputationError):
    """A state of a batch has no result."""

    #: Of the first such state in the batch; ``()`` without a batch.
    index: tuple[int, ...]
    #: What it was computed from, by name.
    inputs: dict[str, np.ndarray]

    def __init__(self, message: str, index: tuple[int, ...], inputs: dict[str, np.ndarray]) -> None:
        super().__init__(message)
        self.index, self.inputs = index, inputs

    def __reduce__(self) -> tuple[type["StateError"], tuple[str, tuple[int, ...], dict[str, np.ndarray]]]:
        return type(self), (str(self), self.index, self.inputs)


class SingularError(StateError):
    """Its equations are singular: masses that are absurdly different, or an arm that reaches a pole of its graph."""


class NotFiniteError(StateError):
    """An input or a parameter is NaN or infinite, or a result is too large for a 64-bit number."""
