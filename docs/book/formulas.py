"""Makes MathML of the TeX of a text: $...$ within a line, $$...$$ as a line of its own, \\tag{...} at its right."""

import html
import re
import sys

BLOCK = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
INLINE = re.compile(r"\$([^$\n]+)\$")
MATRIX = re.compile(r"<mo[^>]*>(?:\[|&#x0005B;)</mo><mtable([^>]*)>(.*?)</mtable><mo[^>]*>(?:\]|&#x0005D;)</mo>")
TAG = re.compile(r"\\tag\{([^}]+)\}")


def with_formulas(text, name, outside_code):
    """The text with MathML in place of its TeX; `name` is for messages."""
    return outside_code(text, lambda part: INLINE.sub(lambda tex: math(tex[1], "inline", name), blocks(part, name)))


def blocks(text, name):
    def replace(block):
        tag = TAG.search(block[1])
        formula = math(TAG.sub("", block[1]), "block", name)
        number = f'<span class="number">({html.escape(tag[1])})</span>' if tag else ""
        return f'<div class="formula{" numbered" if tag else ""}">{formula}{number}</div>'

    return BLOCK.sub(replace, text)


def math(tex, display, name):
    from latex2mathml.converter import convert

    try:
        formula = convert(" ".join(tex.split()), display=display)
    except Exception as error:
        sys.exit(f"{name}: {tex!r}: {error!r}")
    formula = MATRIX.sub(r'<mtable class="matrix"\1>\2</mtable>', formula)
    # Markdown reads between the tags
    return re.sub(
        r">([^<]*)<", lambda text: ">" + re.sub(r"[\\`*_\[\]$]", lambda c: f"&#{ord(c[0])};", text[1]) + "<", formula
    )
