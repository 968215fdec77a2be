"""Makes pages of chapters, for mdBook: links between files of the repository, pictures and formulas.

A chapter that only includes a file of the repository begins with a line that links to it, for readers of the chapter's
file: the page is without. It has the links of that file, and links to that file, not to the chapter's, lead to the
page. Links to files that are no chapter become the path in the repository, and SVG pictures are put into the page. In
the other chapters $...$ and $$...$$ are TeX, which becomes MathML. Code is left alone.

    python3 preprocessor.py supports html
    python3 preprocessor.py <BOOK.json
"""

import base64
import json
import os
import re
import sys
from pathlib import Path

from formulas import with_formulas

FOLDER = Path(__file__).resolve().parent
SOURCE, ROOT = FOLDER / "src", FOLDER.parent.parent
CODE = re.compile(r"^(```|~~~)[^\n]*\n.*?^\1[^\n]*$|`[^`\n]+`", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(!?)\[((?:`[^`\n]*`|[^\[\]`]|\[[^\[\]]*\])*)\]\(([^()\s]+)\)")
INCLUDING = re.compile(r"(This page is \[([^\]\n]+)\]\(([^()\s]+)\)\.\n\n)\{\{#include ([^}\n]+)\}\}\n")
EXTERNAL = re.compile(r"[a-z][a-z+.-]*:", re.IGNORECASE)


def origin(chapter):
    """The file that a chapter's text is in, its own or the one that it includes, and the line that says so."""
    path = SOURCE / chapter
    text = path.read_text(encoding="utf-8")
    including = INCLUDING.fullmatch(text)
    if not including:
        if "{{#include" in text:
            sys.exit(f"{chapter}: a chapter includes nothing beside its own text; one that is a file is two lines")
        return path, ""
    line, name, link, included = including.groups()
    file = (path.parent / included).resolve()
    if link != included or file != ROOT / name:
        sys.exit(f"{chapter}: the first line names another file than the one that is included")
    return file, line


def outside_code(text, change):
    """The text, changed everywhere but in code."""
    parts, end = [], 0
    for code in CODE.finditer(text):
        parts += [change(text[end : code.start()]), code[0]]
        end = code.end()
    return "".join([*parts, change(text[end:])])


def chapters(items):
    """All chapters with a text, nested ones too."""
    for item in items:
        chapter = item.get("Chapter") if isinstance(item, dict) else None
        if chapter:
            if chapter["path"]:
                yield chapter
            yield from chapters(chapter["sub_items"])


class Links:
    """The links of one chapter."""

    def __init__(self, chapter, pages):
        self.chapter, self.pages, (self.origin, _) = chapter, pages, origin(chapter)

    def replace_all(self, text):
        return LINK.sub(self.replace, text)

    def replace(self, link):
        picture, text, target = link.groups()
        if EXTERNAL.match(target) or target.startswith("#"):
            return link[0]
        path, _, anchor = target.partition("#")
        file = (self.origin.parent / path).resolve()
        if not file.exists() or not file.is_relative_to(ROOT):
            sys.exit(f"{self.origin.relative_to(ROOT)}: {target} does not exist")
        if file.is_relative_to(SOURCE) and file.suffix == ".md" and origin(file)[1]:
            sys.exit(f"{self.origin.relative_to(ROOT)}: {target} only includes a file: link to that one")
        if picture:
            if file.suffix != ".svg":
                sys.exit(f"{self.origin.relative_to(ROOT)}: {target} is no SVG")
            return f"![{text}](data:image/svg+xml;base64,{base64.b64encode(file.read_bytes()).decode()})"
        page = self.pages.get(file)
        if page is None:
            name = str(file.relative_to(ROOT))
            return f"`{name}`" if text.strip("`") in (path, name) else f"{text} (`{name}`)"
        relative = os.path.relpath(page, os.path.dirname(self.chapter) or ".")
        return f"[{text}]({relative}{'#' + anchor if anchor else ''})"


def main():
    if sys.argv[1:2] == ["supports"]:
        sys.exit(sys.argv[2] != "html")
    _, book = json.load(sys.stdin)
    found = list(chapters(book.get("sections", book.get("items"))))
    pages = {}
    for chapter in found:
        pages[origin(chapter["path"])[0]] = chapter["path"]
    for chapter in found:
        chapter["content"] = chapter["content"].removeprefix(origin(chapter["path"])[1])
        links = Links(chapter["path"], pages)
        if links.origin.is_relative_to(SOURCE):
            chapter["content"] = with_formulas(chapter["content"], chapter["path"], outside_code)
        # a link may contain code
        chapter["content"] = outside_fences(chapter["content"], links.replace_all)
    json.dump(book, sys.stdout)


def outside_fences(text, change):
    """The text, changed everywhere but in blocks of code."""
    parts = re.split(r"(^(?:```|~~~)[^\n]*\n.*?^(?:```|~~~)[^\n]*$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if i % 2 else change(part) for i, part in enumerate(parts))


if __name__ == "__main__":
    main()
