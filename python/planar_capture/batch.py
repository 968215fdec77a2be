"""Arrays of any batch shape to flat ones and back; states without a result as exceptions or masks."""

import difflib
import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .errors import InputError, NotFiniteError, SingularError

#: What becomes of states without a result: an exception about the first one, or masked arrays.
OnSingular = Literal["raise", "mask"]

Array = NDArray[np.float64]
SINGULAR = 1


class Argument(NamedTuple):
    """An input or an output of a function."""

    name: str
    #: Of one state.
    shape: tuple[int, ...]
    #: SI; of its elements one after the other where they differ.
    unit: str
    description: str


class Parameter(NamedTuple):
    """A number of the robot."""

    name: str
    unit: str
    description: str
    #: The layout's.
    value: float


class Function(NamedTuple):
    """A function of a robot's graph."""

    name: str
    inputs: tuple[Argument, ...]
    outputs: tuple[Argument, ...]


class Batches:
    """The functions of a robot for batches."""

    def __init__(self, native: _native.Robot) -> None:
        def arguments(described: Sequence[Any]) -> tuple[Argument, ...]:
            return tuple(Argument(name, tuple(shape), unit, text) for name, shape, unit, text in described)

        self.native = native
        self.functions = {
            name: Function(name, arguments(inputs), arguments(outputs)) for name, inputs, outputs in native.functions
        }
        self.parameters = {described[0]: Parameter(*described) for described in native.parameters}
        self.values = np.array([parameter.value for parameter in self.parameters.values()])

    def call(
        self,
        function: Function,
        inputs: Sequence[ArrayLike],
        wanted: Sequence[bool],
        parameters: Mapping[str, ArrayLike] | None,
        on_singular: OnSingular,
        threads: int | None,
    ) -> list[Any]:
        """The outputs that are wanted."""

        def compute(arrays: list[Array], count: int, numbers: Array | None) -> tuple[list[Any], NDArray[np.uint8]]:
            outputs, statuses = self.native.call(function.name, arrays, wanted, count, numbers, threads)
            return [output for output in outputs if output is not None], statuses

        shapes = [output.shape for output, is_wanted in zip(function.outputs, wanted, strict=True) if is_wanted]
        return self.run(function, inputs, shapes, parameters, on_singular, compute)

    def run(
        self,
        function: Function,
        inputs: Sequence[ArrayLike],
        shapes: Sequence[tuple[int, ...]],
        parameters: Mapping[str, ArrayLike] | None,
        on_singular: OnSingular,
        compute: Any,
    ) -> list[Any]:
        """The results of a computation, of these shapes of one state, with the axes of the batch before them."""
        if on_singular not in ("raise", "mask"):
            raise InputError(f'on_singular is {on_singular!r}, expected "raise" or "mask"')
        arrays = [real(value, argument) for value, argument in zip(inputs, function.inputs, strict=True)]
        own = self.own(parameters) if parameters else {}
        batch = batch_shape(function, arrays, own)
        count = math.prod(batch)
        if count == 0:
            return [np.zeros(batch + shape) for shape in shapes]
        inputs_of = zip(arrays, function.inputs, strict=True)
        flat = [spread(array, batch + argument.shape) for array, argument in inputs_of]
        numbers = self.numbers(own, batch) if own else None
        outputs, statuses = compute(flat, count, numbers)
        if on_singular == "raise" and np.count_nonzero(statuses):
            self.raise_first(function, batch, flat, numbers, statuses)
        results = [output.reshape(batch + shape) for output, shape in zip(outputs, shapes, strict=True)]
        if on_singular == "mask":
            mask = statuses.reshape(batch).astype(bool)
            return [masked(result, mask) for result in results]
        return [result if result.shape else result[()] for result in results]

    def own(self, parameters: Mapping[str, ArrayLike]) -> dict[str, Array]:
        """The parameters that are given, as arrays."""
        own = {}
        for name, value in parameters.items():
            if name not in self.parameters:
                close = difflib.get_close_matches(name, self.parameters, 1)
                hint = f"did you mean {close[0]!r}?" if close else f"it has {', '.join(self.parameters)}"
                raise InputError(
                    f"robot `{self.native.name}` has no parameter {name!r}; {hint} A mount's y and angle, and the "
                    "com_y and length of a link before the last, are no parameters where the graph has exact zeros"
                )
            array = real(value, Argument(name, (), *self.parameters[name][1:3]))
            if name.endswith(("_mass", "_inertia")) and not (np.isnan(array) | (array > 0.0)).all():
                raise InputError(f"parameter {name!r} is {array.min()}, expected numbers greater than 0")
            own[name] = array
        return own

    def numbers(self, own: Mapping[str, Array], batch: tuple[int, ...]) -> Array:
        """All parameters of each state."""
        numbers = np.empty((*batch, len(self.values)))
        numbers[...] = self.values
        for place, name in enumerate(self.parameters):
            if name in own:
                numbers[..., place] = own[name]
        return numbers.reshape(-1)

    def raise_first(
        self,
        function: Function,
        batch: tuple[int, ...],
        flat: Sequence[Array],
        numbers: Array | None,
        statuses: NDArray[np.uint8],
    ) -> None:
        """The exception about the first state without a result."""
        first = int(np.flatnonzero(statuses)[0])

        def of_state(array: Array, size: int) -> Array:
            return np.ascontiguousarray(array[first * size : (first + 1) * size])

        own = None if numbers is None else of_state(numbers, len(self.values))
        sizes = [math.prod(argument.shape) for argument in function.inputs]
        parts = [of_state(array, size) for array, size in zip(flat, sizes, strict=True)]
        index = tuple(int(i) for i in np.unravel_index(first, batch)) if batch else ()
        inputs = {
            argument.name: part.reshape(argument.shape) for argument, part in zip(function.inputs, parts, strict=True)
        }
        if own is not None:
            inputs |= {name: own[place] for place, name in enumerate(self.parameters)}
        infinite = [name for name, value in inputs.items() if not np.isfinite(value).all()]
        if infinite and infinite[0] in self.parameters:
            why: str | None = f"parameter {infinite[0]!r} = {inputs[infinite[0]]} is not a finite number"
        else:
            why = self.native.why(function.name, parts, own)
        singular = statuses[first] == SINGULAR
        words = "the equations are singular" if singular else "a number is not finite"
        place = f"state {index}: " if batch else ""
        more = np.count_nonzero(statuses) - 1
        rest = f" (and {more} more without a result)" if more else ""
        error = SingularError if singular else NotFiniteError
        raise error(f"{place}{function.name}: {why or words}{rest}", index, inputs)


def real(value: ArrayLike, argument: Argument) -> Array:
    """An array of real numbers whose last axes are those of an argument."""
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise InputError(
            f"`{argument.name}` has elements of type {array.dtype}, expected real numbers ({argument.unit})"
        )
    axes = len(argument.shape)
    if array.shape[array.ndim - axes :] != argument.shape:
        wanted = ", ".join(["…", *map(str, argument.shape)])
        raise InputError(
            f"`{argument.name}` has shape {array.shape}, expected ({wanted}): {argument.description}; {argument.unit}"
        )
    return array.astype(np.float64, copy=False)


def batch_shape(function: Function, arrays: Sequence[Array], own: Mapping[str, Array]) -> tuple[int, ...]:
    """The axes that states and parameters have together."""
    pairs = list(zip(function.inputs, arrays, strict=True))
    if not own and all(array.ndim == len(argument.shape) for argument, array in pairs):
        return ()
    shapes = {argument.name: array.shape[: array.ndim - len(argument.shape)] for argument, array in pairs}
    shapes |= {name: array.shape for name, array in own.items()}
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items() if shape)
        raise InputError(f"the axes of the batch do not fit each other: {listed}") from None


def spread(array: Array, shape: tuple[int, ...]) -> Array:
    """The numbers of all states, flat."""
    if array.shape != shape:
        array = np.broadcast_to(array, shape)
    return np.ascontiguousarray(array).reshape(-1)


def masked(result: Array, mask: NDArray[np.bool_]) -> np.ma.MaskedArray:
    """The states that the mask has are hidden."""
    axes = (1,) * (result.ndim - mask.ndim)
    return np.ma.MaskedArray(result, np.broadcast_to(mask.reshape(mask.shape + axes), result.shape).copy())
