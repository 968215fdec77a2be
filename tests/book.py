"""Checks the book: its pages, the names that it gives of the source, and the commands of tutorials and README.md.

    python3 tests/book.py pages target/book
    python3 tests/book.py names
    python3 tests/book.py commands PLANAR-CAPTURE [CHAPTER.md]
    cargo run … | python3 tests/book.py shown CHAPTER.md

- Pages: every link and picture leads to a file and an anchor that are there, nothing is loaded from a network, no TeX
  is left.
- Names: `path/of/file.rs::name` and `path/of/file.rs` in the chapters of the book and the texts that they include
  exist, and so do the files that README.md links to. A block of code after `<!-- copy of PATH -->` is that file of the
  repository, one after `<!-- part of PATH -->` stands in it.
- Commands: a block of code after `<!-- run -->` has lines `$ COMMAND` with what the command prints, where `...` stands
  for any lines; one after `<!-- file NAME -->` is that file, and `<!-- files CHAPTER.md -->` stands for those of
  another chapter. The blocks of a chapter are run in one folder, which is removed, with the scenarios of the repository
  in it. `<!-- run 1 -->` is for commands that exit with 1. `cargo run --release --` is the given program: what cargo
  makes of it is checked by `.ci/run` and `.ci/new`.
- Shown: the output of the one block of a chapter that is not run here is the standard input.
"""

import argparse
import html.parser
import os
import re
import subprocess
import sys
import tempfile
import urllib.parse
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "docs" / "book" / "src"
MARK = re.compile(
    r"^<!-- (?:(run|file|shown)(?: ([^ ]+))? -->\n+```[^\n]*\n(.*?)^```$|(files) ([^ ]+) -->)", re.MULTILINE | re.DOTALL
)
COPY = re.compile(r"^<!-- (copy|part) of ([^ ]+) -->\n```[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
INCLUDED = re.compile(r"\{\{#include ([^}]+\.md)\}\}")
LINKED = re.compile(r"(?:\]\(|src=\")([^)#:\"]+)(?:#[^)]*)?[)\"]")
NAME = re.compile(r"`((?:\.ci|codegen|crates|src|tests|examples|scenarios|python)/[\w./-]*[\w/])(?:::([\w.]+))?`")
LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class Page(html.parser.HTMLParser):
    """Anchors, links and text of one page."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loaded, self.text = set(), [], [], []
        self.code = 0
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors.update(attributes[key] for key in ("id", "name") if attributes.get(key))
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        if attributes.get(LOADED.get(tag)) and attributes.get("rel") != "canonical":
            self.loaded.append(attributes[LOADED[tag]])
        self.code += tag in ("code", "script", "style")

    def handle_endtag(self, tag):
        self.code -= tag in ("code", "script", "style")

    def handle_data(self, data):
        if not self.code:
            self.text.append(data)


def pages(folder):
    """What is wrong with the pages of a folder."""
    found = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    if not found:
        yield f"{folder}: no pages"
    for path, page in found.items():
        name = path.relative_to(folder)
        text = "".join(page.text)
        for rest in re.findall(r"\$\$|\$\\\w+|\{\{#\w+", text):
            yield f"{name}: {rest} is left in the text"
        if path.name in ("404.html", "toc.html"):
            continue  # their links are from the root of a site
        for target in page.loaded + page.links:
            url = urllib.parse.urlsplit(target)
            if url.scheme or url.netloc:
                if target in page.loaded and url.scheme != "data":
                    yield f"{name}: loads {target}"
                continue
            file = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
            if file.is_dir():
                file = file / "index.html"
            if not file.exists():
                yield f"{name}: {target} does not exist"
            elif url.fragment and file in found and urllib.parse.unquote(url.fragment) not in found[file].anchors:
                yield f"{name}: {target} has no such anchor"


def names():
    """Files and names in them that the book or README.md gives and that do not exist, and copies that are none."""
    texts = sorted(SOURCE.rglob("*.md"))
    for chapter in list(texts):
        texts += [(chapter.parent / path).resolve() for path in INCLUDED.findall(chapter.read_text(encoding="utf-8"))]
    for text in texts:
        for kind, path, copied in COPY.findall(text.read_text(encoding="utf-8")):
            source = (ROOT / path).read_text(encoding="utf-8")
            if copied not in source or (kind == "copy" and copied != source):
                yield f"{text.relative_to(ROOT)}: the block after `{kind} of {path}` is not what is there"
        for path, name in NAME.findall(text.read_text(encoding="utf-8")):
            place = f"{text.relative_to(ROOT)}: {path}{'::' + name if name else ''}"
            # NAME stands for any name; an example's own text gives its own files
            if "NAME" in path or (text.parent / path).exists():
                continue
            if not (ROOT / path).exists():
                yield f"{place}: no such file"
            elif name:
                source = (ROOT / path).read_text(encoding="utf-8")
                for part in name.split("."):
                    if not re.search(rf"\b(?:def|class|fn|struct|enum|trait|const|type|static) {part}\b", source):
                        yield f"{place}: no {part} there"
    for path in LINKED.findall((ROOT / "README.md").read_text(encoding="utf-8")):
        if not (ROOT / path).exists():
            yield f"README.md: {path} does not exist"


def blocks(chapter):
    """Kind, argument and text of the marked blocks of a chapter."""
    for kind, argument, text, files, other in MARK.findall(chapter.read_text(encoding="utf-8")):
        if files:
            yield from (block for block in blocks(chapter.parent / other) if block[0] == "file")
        else:
            yield kind, argument, text


def shown(text):
    """The commands of a block with their outputs."""
    return re.findall(r"^\$ ([^\n]*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE)


class Shell:
    """A folder in which the commands of one chapter are run."""

    def __init__(self, folder, program):
        self.place, tools = Path(folder) / "work", Path(folder) / "bin"
        self.place.mkdir()
        tools.mkdir()
        (tools / "planar-capture").symlink_to(program.resolve())
        (self.place / "scenarios").symlink_to(ROOT / "scenarios")
        self.environment = dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}", HOME=folder, LC_ALL="C.UTF-8")

    def write(self, name, text):
        (self.place / name).parent.mkdir(parents=True, exist_ok=True)
        (self.place / name).write_text(text, encoding="utf-8")

    def run(self, command):
        """Exit code and output."""
        if command.startswith("cd "):
            self.place /= command.removeprefix("cd ")
            return 0, ""
        ran = subprocess.run(
            ["bash", "-c", command.replace("cargo run --release -- ", "planar-capture ")],
            cwd=self.place,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        return ran.returncode, ran.stdout


def commands(program, chapters):
    """Commands of the tutorials that fail or print something else."""
    count = 0
    for chapter in chapters:
        with tempfile.TemporaryDirectory() as folder:
            shell = Shell(folder, program)
            for kind, argument, text in blocks(chapter):
                if kind == "file":
                    shell.write(argument, text)
                for command, wanted in shown(text) if kind == "run" else ():
                    count += 1
                    code, output = shell.run(command)
                    place = f"{chapter.relative_to(ROOT)}: {command}"
                    if code != int(argument or 0):
                        yield f"{place}: exit code {code}\n{output}"
                    elif not matches(wanted, output):
                        yield f"{place}: prints\n{output}"
    print(f"book: {count} commands")


def shown_elsewhere(chapter, output):
    """Whether an output is not what a chapter shows."""
    wanted = [text for kind, _, block in blocks(chapter) if kind == "shown" for _, text in shown(block)]
    if len(wanted) != 1 or not matches(wanted[0], output):
        yield f"{chapter.relative_to(ROOT)}: the command prints\n{output}"


def matches(wanted, found):
    """Whether an output is as wanted, with `...` for any lines."""
    parts = re.split(r"^\.\.\.\n", wanted, flags=re.MULTILINE)
    pattern = r"(?:.*\n)*".join(re.escape(part) for part in parts)
    return re.fullmatch(pattern, trimmed(found)) is not None or trimmed(wanted) == trimmed(found)


def trimmed(text):
    """Without spaces at the ends of lines and empty lines at the end."""
    lines = [line.rstrip() for line in text.splitlines()]
    while lines and not lines[-1]:
        lines.pop()
    return "".join(line + "\n" for line in lines)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    actions = arguments.add_subparsers(dest="action", required=True)
    actions.add_parser("pages").add_argument("folder", type=Path)
    actions.add_parser("names")
    actions.add_parser("shown").add_argument("chapter", type=Path)
    run = actions.add_parser("commands")
    run.add_argument("program", type=Path)
    run.add_argument("chapters", type=Path, nargs="*")
    given = arguments.parse_args()
    if given.action == "pages":
        wrong = pages(given.folder.resolve())
    elif given.action == "names":
        wrong = names()
    elif given.action == "shown":
        wrong = shown_elsewhere(given.chapter.resolve(), sys.stdin.read())
    else:
        chapters = [path.resolve() for path in given.chapters] or [ROOT / "README.md", *sorted(SOURCE.rglob("*.md"))]
        wrong = commands(given.program, chapters)
    wrong = list(wrong)
    for line in wrong:
        print(f"book: {line}")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
