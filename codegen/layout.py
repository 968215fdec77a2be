"""Computes the bodies and joints of a robot, and the hash of their content, from a layout's TOML file.

`planar-capture check` alone validates layouts (crates/planar-layout). Here a missing or unknown key, or a value of the
wrong type, ends the reading with one line that names that command.
"""

import hashlib
import struct
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .environment import HERE


class LayoutError(Exception):
    """A layout that cannot be read; one line that names the file."""


def layout_names() -> list[str]:
    """The layouts in codegen/layouts."""
    return sorted(path.stem for path in (HERE / "layouts").glob("*.toml"))


def structure_names() -> list[str]:
    """The layouts in codegen/structures, whose graphs are evaluated, not rendered."""
    return sorted(path.stem for path in (HERE / "structures").glob("*.toml"))


@dataclass(frozen=True)
class Base:
    """The base body; its frame has its origin at the centre of mass."""

    mass: float  # kg, > 0
    inertia: float  # kg m^2 about the centre of mass, > 0


@dataclass(frozen=True)
class Link:
    """A rigid link; its frame has its origin at its joint and x towards the next joint or the end effector."""

    length: float  # m, >= 0
    mass: float  # kg, > 0
    inertia: float  # kg m^2 about the centre of mass, > 0
    com: tuple[float, float]  # m, link frame


@dataclass(frozen=True)
class Arm:
    """A chain of links on the base; joint k moves link k."""

    name: str
    mount: tuple[float, float]  # first joint, base frame, m
    mount_angle: float  # direction of link 1 at joint angle 0, from the base x axis, rad
    links: tuple[Link, ...]


@dataclass(frozen=True)
class Layout:
    """A free-floating robot: a base and the arms mounted on it, in the order of the joints."""

    name: str
    base: Base
    arms: tuple[Arm, ...]

    @property
    def joints(self) -> int:
        return sum(len(arm.links) for arm in self.arms)


def read(path: str | Path) -> Layout:
    """The layout in a TOML file; raises LayoutError where a number cannot be found."""
    try:
        content = tomllib.loads(Path(path).read_bytes().decode("utf-8-sig"))
        return _layout(content)
    except OSError as error:
        problem = f"cannot be read: {error.strerror}"
    except (ValueError, RecursionError) as error:  # not UTF-8, not TOML, or without the keys of a layout
        problem = " ".join(str(error).split())
    raise LayoutError(f"{path}: {problem}; planar-capture check {path} says what is wrong")


def content_hash(layout: Layout) -> str:
    """SHA-256 in hexadecimal of the canonical text; the same as `Layout::sha256` of planar-layout.

    Lines ``key=value`` in a fixed order with defaults filled in; numbers are the 16 hexadecimal
    digits of their binary64 bits, most significant first, with -0 written as 0.
    """
    return hashlib.sha256("".join(_canonical_lines(layout)).encode()).hexdigest()


def _canonical_lines(layout: Layout) -> Iterator[str]:
    def number(key: str, value: float) -> str:
        # Adding +0 turns -0 into +0 and leaves every other number as it is.
        return f"{key}={struct.pack('>d', value + 0.0).hex()}\n"

    yield f"name={layout.name}\n"
    yield number("base.mass", layout.base.mass)
    yield number("base.inertia", layout.base.inertia)
    for i, arm in enumerate(layout.arms):
        yield f"arm[{i}].name={arm.name}\n"
        yield number(f"arm[{i}].mount[0]", arm.mount[0])
        yield number(f"arm[{i}].mount[1]", arm.mount[1])
        yield number(f"arm[{i}].mount_angle", arm.mount_angle)
        for j, link in enumerate(arm.links):
            yield number(f"arm[{i}].link[{j}].length", link.length)
            yield number(f"arm[{i}].link[{j}].mass", link.mass)
            yield number(f"arm[{i}].link[{j}].inertia", link.inertia)
            yield number(f"arm[{i}].link[{j}].com[0]", link.com[0])
            yield number(f"arm[{i}].link[{j}].com[1]", link.com[1])


class _Table:
    """A TOML table at a path such as ``arm[1].link[0]``, with no keys but the given ones."""

    def __init__(self, path: str, value: Any, keys: tuple[str, ...]) -> None:
        self.path = path
        if not isinstance(value, dict):
            raise ValueError(f"{path} is not a table")
        self.entries = value
        for key in value:
            if key not in keys:
                raise ValueError(f"{self.path_of(key)} is unknown")

    def path_of(self, key: str) -> str:
        return f"{self.path}.{key}" if self.path else key

    def value(self, key: str) -> Any:
        if key not in self.entries:
            raise ValueError(f"{self.path_of(key)} is missing")
        return self.entries[key]

    def text(self, key: str) -> str:
        value = self.value(key)
        if not isinstance(value, str):
            raise ValueError(f"{self.path_of(key)} is not a string")
        return value

    def number(self, key: str) -> float:
        return _number(self.path_of(key), self.value(key))

    def position(self, key: str) -> tuple[float, float]:
        value = self.value(key)
        if not isinstance(value, list) or len(value) != 2:
            raise ValueError(f"{self.path_of(key)} is not a pair [x, y]")
        return _number(f"{self.path_of(key)}[0]", value[0]), _number(f"{self.path_of(key)}[1]", value[1])

    def table(self, key: str, keys: tuple[str, ...]) -> "_Table":
        return _Table(self.path_of(key), self.value(key), keys)

    def tables(self, key: str, keys: tuple[str, ...]) -> list["_Table"]:
        value = self.value(key)
        if not isinstance(value, list) or not value:
            raise ValueError(f"{self.path_of(key)} is not a list of tables")
        return [_Table(f"{self.path_of(key)}[{i}]", item, keys) for i, item in enumerate(value)]


def _number(path: str, value: Any) -> float:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (is_number and abs(value) <= sys.float_info.max):
        raise ValueError(f"{path} is not a finite number")
    return float(value)


def _layout(content: dict[str, Any]) -> Layout:
    root = _Table("", content, ("name", "base", "arm"))
    base = root.table("base", ("mass", "inertia", "outline"))
    arms = root.tables("arm", ("name", "mount", "mount_angle", "link"))
    return Layout(root.text("name"), Base(base.number("mass"), base.number("inertia")), tuple(map(_arm, arms)))


def _arm(table: _Table) -> Arm:
    mount_angle = table.number("mount_angle") if "mount_angle" in table.entries else 0.0
    links = table.tables("link", ("length", "mass", "inertia", "com", "outline"))
    return Arm(table.text("name"), table.position("mount"), mount_angle, tuple(map(_link, links)))


def _link(table: _Table) -> Link:
    length = table.number("length")
    com = table.position("com") if "com" in table.entries else (length / 2, 0.0)
    return Link(length, table.number("mass"), table.number("inertia"), com)
