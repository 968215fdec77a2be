"""Arm layouts: the bodies and joints of a robot, read from TOML.

The same checks as src/layout.rs makes, which also shows the line; here the first problem ends the
reading. Both compute the same content hash.
"""

import difflib
import hashlib
import math
import re
import struct
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

# Rust's keywords, strict and reserved, up to edition 2024.
KEYWORDS = re.compile(
    "abstract|as|async|await|become|box|break|const|continue|crate|do|dyn|else|enum|extern|false|"
    "final|fn|for|gen|if|impl|in|let|loop|macro|match|mod|move|mut|override|priv|pub|ref|return|"
    "self|static|struct|super|trait|true|try|type|typeof|unsafe|unsized|use|virtual|where|while|"
    "yield"
)


class LayoutError(Exception):
    """A layout that cannot be read: the file, the key, its value and what would be right."""


@dataclass(frozen=True)
class Base:
    """The base body; its frame has its origin at the centre of mass."""

    mass: float  # kg, > 0
    inertia: float  # kg m^2 about the centre of mass, > 0


@dataclass(frozen=True)
class Link:
    """A rigid link; its frame has its origin at its joint and x towards the next one or the tip."""

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
    """The layout in a TOML file; raises LayoutError where the file or its content is wrong."""
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
        content = tomllib.loads(text)
    except OSError as error:
        reason = error.strerror or error
        raise LayoutError(f"{path}: cannot read it: {reason}, expected a TOML file") from None
    except UnicodeDecodeError as error:
        wrong = f"byte 0x{error.object[error.start]:02x} at offset {error.start}"
        raise LayoutError(f"{path}: {wrong} is not UTF-8, save the file as UTF-8") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise LayoutError(f"{path}: not valid TOML: {error}") from None
    return _Table(str(path), "", content, ("name", "base", "arm")).layout()


def content_hash(layout: Layout) -> str:
    """SHA-256 in hexadecimal of the canonical text; the same as Layout::sha256 in src/layout.rs.

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
    """A table of the file at a path such as ``arm[1].link[0]``, which may hold only these keys."""

    def __init__(self, file: str, path: str, value: Any, keys: tuple[str, ...]) -> None:
        self.file = file
        self.path = path
        if not isinstance(value, dict):
            raise LayoutError(f"{file}: `{path}` is {value!r}, expected a table with {keys}")
        self.entries = value
        for key in value:
            if key not in keys:
                close = difflib.get_close_matches(key, keys, 1)
                hint = f"did you mean `{close[0]}`?" if close else f"expected {', '.join(keys)}"
                found = f"{file}: unknown key `{self._full(key)}` ({value[key]!r})"
                raise LayoutError(f"{found}, {hint}")

    def layout(self) -> Layout:
        name = self._text("name")
        if not re.fullmatch("[a-z][a-z0-9_]{0,63}", name) or KEYWORDS.fullmatch(name):
            self._fail("name", "lower-case letters, digits and _, a letter first, no Rust keyword")
        base = _Table(self.file, "base", self._get("base", "a table"), ("mass", "inertia"))
        body = Base(base._positive("mass", "kg"), base._positive("inertia", "kg m^2"))
        keys = ("name", "mount", "mount_angle", "link")
        arms = tuple(table._arm() for table in self._tables("arm", keys))
        names = [arm.name for arm in arms]
        for i, arm_name in enumerate(names):
            if arm_name in names[:i]:
                first = names.index(arm_name)
                self._fail(f"arm[{i}].name", f"another than that of `arm[{first}]`", arm_name)
        return Layout(name, body, arms)

    def _arm(self) -> Arm:
        name = self._text("name")
        mount = self._position("mount")
        mount_angle = self._number("mount_angle", "rad", default=0.0)
        if abs(mount_angle) > 2 * math.pi:
            self._fail("mount_angle", f"radians (is it degrees? {math.radians(mount_angle)} rad)")
        links = self._tables("link", ("length", "mass", "inertia", "com"))
        return Arm(name, mount, mount_angle, tuple(table._link() for table in links))

    def _link(self) -> Link:
        length = self._number("length", "m")
        if length < 0:
            self._fail("length", "a number in m of 0 or more")
        if length > 1e4:
            self._fail("length", f"metres (is it millimetres? {length * 1e-3} m)")
        mass = self._positive("mass", "kg")
        inertia = self._positive("inertia", "kg m^2")
        com = self._position("com") if "com" in self.entries else (length / 2, 0.0)
        return Link(length, mass, inertia, com)

    def _tables(self, key: str, keys: tuple[str, ...]) -> list["_Table"]:
        value = self._get(key, f"at least one [[{key}]]")
        if not isinstance(value, list) or not value:
            self._fail(key, f"a list of at least one table, [[{key}]]")
        path = self._full(key)
        return [_Table(self.file, f"{path}[{i}]", item, keys) for i, item in enumerate(value)]

    def _text(self, key: str) -> str:
        value = self._get(key, "text in quotes")
        is_text = isinstance(value, str) and value.strip() != ""
        if not is_text or re.search("[\x00-\x1f\x7f-\x9f]", value):
            self._fail(key, "text in quotes, on one line, not blank")
        return value

    def _number(self, key: str, unit: str, default: float | None = None) -> float:
        if default is not None and key not in self.entries:
            return default
        number = _finite(self._get(key, f"a number in {unit}"))
        return self._fail(key, f"a finite number in {unit}") if number is None else number

    def _positive(self, key: str, unit: str) -> float:
        number = self._number(key, unit)
        return number if number > 0 else self._fail(key, f"a number in {unit} greater than 0")

    def _position(self, key: str) -> tuple[float, float]:
        value = self._get(key, "[x, y] in m")
        numbers = [_finite(item) for item in value] if isinstance(value, list) else []
        if len(numbers) != 2 or None in numbers:
            self._fail(key, "[x, y] in m")
        if max(map(abs, numbers)) > 1e4:
            self._fail(key, "metres (is it millimetres?)")
        return numbers[0], numbers[1]

    def _get(self, key: str, wanted: str) -> Any:
        if key not in self.entries:
            raise LayoutError(f"{self.file}: missing key `{self._full(key)}`, expected {wanted}")
        return self.entries[key]

    def _full(self, key: str) -> str:
        return f"{self.path}.{key}" if self.path else key

    def _fail(self, key: str, wanted: str, value: Any = None) -> NoReturn:
        shown = self.entries.get(key, value)
        raise LayoutError(f"{self.file}: `{self._full(key)}` is {shown!r}, expected {wanted}")


def _finite(value: Any) -> float | None:
    """A TOML number as a float; None for anything else, infinities and NaN."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None
