"""Derives graphs from layouts: ``python -m codegen [NAME ...] [--check]``, in the locked environment."""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from . import environment  # all else is imported later: an old Python has to reach its error message
from .derivatives import MATRICES

ROOT = environment.HERE.parent
INSIDE = "PLANAR_CAPTURE_CODEGEN_INSIDE"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m codegen",
        description="Derives codegen/graphs/NAME.json from codegen/layouts/NAME.toml, those of codegen/structures from "
        "the layouts beside them, and writes the layouts' cargo features into Cargo.toml.",
    )
    parser.add_argument(
        "names", nargs="*", metavar="NAME", help="layouts (default: all of codegen/layouts and codegen/structures)"
    )
    parser.add_argument(
        "--check", action="store_true", help="write nothing; exit 1 if a graph is not the one of its layout"
    )
    parser.add_argument("--layout", type=Path, help="derive from this file alone; with --graph")
    parser.add_argument("--graph", type=Path, help="the file to write the graph of --layout to")
    parser.add_argument(
        "--derivatives",
        nargs="?",
        metavar="NAME,...",
        const=",".join(MATRICES),
        help=f"with --layout: matrices of derivatives, too; of {' and '.join(MATRICES)} by default",
    )
    parser.add_argument(
        "--directional",
        metavar="FUNCTION,...",
        help="with --layout: directional derivatives of these, too; FUNCTION:parameters along parameters, too",
    )
    parser.add_argument("--test", action="store_true", help="run the derivation's tests instead")
    options = parser.parse_args()
    if (options.layout is None) != (options.graph is None):
        parser.error("--layout and --graph go together")
    if options.layout is None and (options.derivatives is not None or options.directional is not None):
        parser.error("derivatives are for --layout: shipped graphs have none")
    return options


def main() -> int:
    options = arguments()
    try:
        if os.environ.get(INSIDE) == "1":
            return derive(options)
        environment.check_python()
        if problem := wrong_arguments(options):
            print(f"error: {problem}", file=sys.stderr)
            return 2
        python = environment.ensure(dev=options.test)
    except environment.EnvironmentProblem as problem:
        environment.report(f"error: {problem}")
        return 2
    command = ["pytest", "-q", str(environment.HERE / "tests")] if options.test else ["codegen", *sys.argv[1:]]
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    inside = {**os.environ, INSIDE: "1", "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run([str(python), "-m", *command], cwd=ROOT, env=inside, check=False).returncode


def wrong_arguments(options: argparse.Namespace) -> str | None:
    """What is wrong with the arguments, before an environment is made for them."""
    from .layout import LayoutError, layout_names, read, structure_names

    shipped = layout_names() + structure_names()
    if unknown := [name for name in options.names if name not in shipped]:
        return (
            f"no layout {', '.join(unknown)} in codegen/layouts or codegen/structures; there are: {', '.join(shipped)}"
        )
    if options.graph is not None and not options.graph.resolve().parent.is_dir():
        return f"cannot write {options.graph}: there is no folder {options.graph.parent}"
    try:
        if options.layout is not None:
            read(options.layout)
    except LayoutError as problem:
        return str(problem)
    return None


def derive(options: argparse.Namespace) -> int:
    """The exit code, with one line on stderr where the input is wrong."""
    from .cargo_features import FeatureError
    from .derivatives import DerivativesError
    from .layout import LayoutError

    try:
        return derive_shipped(options) if options.layout is None else derive_file(options)
    except (LayoutError, FeatureError, DerivativesError) as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 2


def derive_file(options: argparse.Namespace) -> int:
    """Writes the graph of any layout file, for ``planar-capture generate``."""
    from .derivatives import Derivatives
    from .derive import graph_text, write_atomically
    from .layout import read

    layout = read(options.layout)
    asked = [
        tuple(dict.fromkeys(names.split(","))) if names else () for names in (options.derivatives, options.directional)
    ]
    derivatives = Derivatives(*asked)
    words = ["planar-capture generate", f"{layout.name}.toml --out {layout.name}.json", *derivatives.options()]
    text = graph_text(
        layout, " ".join(words), lambda family: environment.report(f"{layout.name}: {family}"), derivatives
    )
    write_atomically(options.graph, text)
    return 0


def derive_shipped(options: argparse.Namespace) -> int:
    """Writes or checks the files derived from the layouts in codegen/layouts."""
    from .derive import graph_path, graph_paths, layout_path
    from .layout import layout_names, structure_names

    shipped = layout_names()
    names = shipped + structure_names()
    files = derived_files(options.names or names, shipped)
    stale = [path for path, text in files if not up_to_date(path, text, options.check)]
    orphans = sorted(set(graph_paths()) - {graph_path(name) for name in names})
    for path in orphans:
        layout = layout_path(path.stem).relative_to(ROOT)
        print(f"{path.relative_to(ROOT)}: has no layout; delete it, or put {layout} back")
    if stale:
        print(f"to mend: python -m codegen {' '.join(options.names)}".rstrip(), file=sys.stderr)
    return 1 if stale or orphans else 0


def derived_files(names: list[str], shipped: list[str]) -> Iterator[tuple[Path, str]]:
    """(file, text) of the named layouts' graphs and of Cargo.toml."""
    from .cargo_features import CARGO_TOML, with_block
    from .derive import derive_text, graph_path, layout_path

    for name in names:
        yield graph_path(name), derive_text(layout_path(name))
    if CARGO_TOML.exists():
        yield CARGO_TOML, with_block(CARGO_TOML.read_text(encoding="utf-8"), shipped)


def up_to_date(path: Path, text: str, check: bool) -> bool:
    """Whether a file has the text; unless this is only a check, it is written first."""
    from .derive import write_atomically

    fresh = path.exists() and path.read_text(encoding="utf-8") == text
    if not fresh and not check:
        write_atomically(path, text)
    words = ("fresh", "STALE") if check else ("unchanged", "written")
    print(f"{path.relative_to(ROOT)}: {words[0] if fresh else words[1]}")
    return fresh or not check


if __name__ == "__main__":
    sys.exit(main())
