"""``python -m codegen [NAME ...] [--check]``: layouts to graphs, in the locked environment."""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from . import environment  # nothing else yet: an old Python must get as far as its refusal

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
INSIDE = "PLANAR_CAPTURE_CODEGEN_INSIDE"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m codegen",
        description="Derives codegen/layouts/NAME.toml and writes codegen/graphs/NAME.json.",
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="layouts (default: all of codegen/layouts)")
    parser.add_argument(
        "--check", action="store_true", help="write nothing; exit 1 if a graph is not what its layout gives"
    )
    parser.add_argument("--test", action="store_true", help="run the derivation's tests instead")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    try:
        if os.environ.get(INSIDE) == "1":
            return derive(options)
        python = environment.ensure(dev=options.test)
    except environment.EnvironmentProblem as problem:
        environment.say(f"error: {problem}")
        return 2
    command = ["pytest", "-q", str(HERE / "tests")] if options.test else ["codegen", *sys.argv[1:]]
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    inside = {**os.environ, INSIDE: "1", "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run([str(python), "-m", *command], cwd=ROOT, env=inside, check=False).returncode


def derive(options: argparse.Namespace) -> int:
    from .derive import derive_text, graph_path, layout_names, layout_path, write_whole
    from .layout import LayoutError

    shipped = layout_names()
    unknown = [name for name in options.names if name not in shipped]
    if unknown:
        print(
            f"error: no layout {', '.join(unknown)} in codegen/layouts; there are: {', '.join(shipped)}",
            file=sys.stderr,
        )
        return 2
    stale = []
    for name in options.names or shipped:
        try:
            text = derive_text(layout_path(name))
        except LayoutError as problem:
            print(f"error: {problem}", file=sys.stderr)
            return 2
        graph = graph_path(name)
        fresh = graph.exists() and graph.read_text(encoding="utf-8") == text
        if options.check:
            print(f"{graph.relative_to(ROOT)}: {'fresh' if fresh else 'STALE'}")
            stale += [] if fresh else [name]
        else:
            if not fresh:
                write_whole(graph, text)
            print(f"{graph.relative_to(ROOT)}: {'unchanged' if fresh else 'written'}")
    if options.check and not options.names:
        orphans = sorted(p.stem for p in (HERE / "graphs").glob("*.json") if p.stem not in shipped)
        for name in orphans:
            print(f"codegen/graphs/{name}.json: has no layout; delete it, or put codegen/layouts/{name}.toml back")
        if orphans:
            return 1
    if stale:
        print(f"to mend: python -m codegen {' '.join(stale)}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
