"""Computes the text of a graph from a layout file, and writes it."""

import json
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from . import graph
from .derivatives import NO_DERIVATIVES, Derivatives
from .environment import HERE
from .functions import Functions
from .json_text import dump
from .layout import Layout, LayoutError, read


def graph_paths() -> list[Path]:
    return sorted(path for folder in ("graphs", "structures") for path in (HERE / folder).glob("*.json"))


def layout_path(name: str) -> Path:
    structure = HERE / "structures" / f"{name}.toml"
    return structure if structure.exists() else HERE / "layouts" / f"{name}.toml"


def graph_path(name: str) -> Path:
    folder = "structures" if (HERE / "structures" / f"{name}.toml").exists() else "graphs"
    return HERE / folder / f"{name}.json"


def derive_text(path: Path) -> str:
    """The graph of a shipped layout file, as it is committed."""
    layout = read(path)
    if layout.name != path.stem:
        found = json.dumps(layout.name, ensure_ascii=False)
        raise LayoutError(f'{path}: name = {found} must be the file\'s own name, "{path.stem}"')
    return graph_text(layout)


def graph_text(
    layout: Layout,
    command: str | None = None,
    progress: Callable[[str], None] = lambda family: None,
    derivatives: Derivatives = NO_DERIVATIVES,
) -> str:
    """The graph of a layout; `command` derives it again, `progress` gets the name of each family before its turn."""
    return dump(graph.build(Functions(layout, progress, derivatives), command)) + "\n"


def write_atomically(path: Path, text: str) -> None:
    """Writes a whole file or none: a temporary file in the same folder, which is then renamed."""
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
