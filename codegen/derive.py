"""One layout file to the text of its graph."""

import json
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from . import graph
from .functions import Model
from .layout import Layout, LayoutError, read

HERE = Path(__file__).resolve().parent


def layout_names() -> list[str]:
    return sorted(path.stem for path in (HERE / "layouts").glob("*.toml"))


def graph_names() -> list[str]:
    return sorted(path.stem for path in (HERE / "graphs").glob("*.json"))


def layout_path(name: str) -> Path:
    return HERE / "layouts" / f"{name}.toml"


def graph_path(name: str) -> Path:
    return HERE / "graphs" / f"{name}.json"


def derive_text(path: Path) -> str:
    """The graph of a layout file, as it is committed."""
    layout = read(path)
    if layout.name != path.stem:
        found = json.dumps(layout.name, ensure_ascii=False)
        raise LayoutError(f'{path}: name = {found} must be the file\'s own name, "{path.stem}"')
    return graph_text(layout)


def graph_text(
    layout: Layout, command: str | None = None, progress: Callable[[str], None] = lambda family: None
) -> str:
    """The graph of a layout, with the command that makes it; `progress` hears of each family before it is worked on."""
    return dump(graph.build(Model(layout, progress), command)) + "\n"


def dump(value, indent: int = 0) -> str:
    """JSON with one statement, parameter or output per line: made to be read and compared."""
    if not isinstance(value, dict | list) or is_line(value):
        return json.dumps(value, allow_nan=False, ensure_ascii=False)
    pad = " " * (indent + 1)
    if isinstance(value, dict):
        items = [f"{json.dumps(key)}: {dump(item, indent + 1)}" for key, item in value.items()]
        opening, closing = "{", "}"
    else:
        items = [dump(item, indent + 1) for item in value]
        opening, closing = "[", "]"
    return opening + "\n" + ",\n".join(pad + item for item in items) + "\n" + " " * indent + closing


def is_line(value: dict | list) -> bool:
    """Whether a value stands on one line: no object inside, and no list of statements."""
    items = value.values() if isinstance(value, dict) else value
    return (
        not any(isinstance(item, dict) for item in items)
        and not any(isinstance(item, list) and any(isinstance(inner, list) for inner in item) for item in items)
        and not (isinstance(value, list) and len(value) > 0 and all(isinstance(item, list) for item in value))
    )


def write_whole(path: Path, text: str) -> None:
    """Writes a file whole or not at all: a temporary name beside it, then renamed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
