"""One layout file to the text of its graph."""

import json
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from . import graph
from .functions import Functions
from .json_text import dump
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
    return dump(graph.build(Functions(layout, progress), command)) + "\n"


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
