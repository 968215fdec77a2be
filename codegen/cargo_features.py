"""Computes Cargo.toml's text, with a cargo feature for each layout between two marks, from the layouts' names."""

from .environment import HERE

CARGO_TOML = HERE.parent / "Cargo.toml"
BEGIN = "# layouts: one feature each, written by `python -m codegen`"
END = "# end of layouts"


class FeatureError(Exception):
    """Cargo.toml has no marked block."""


def block(names: list[str]) -> str:
    """The marks and the text between them."""
    listed = ", ".join(f'"{name}"' for name in names)
    lines = [BEGIN, f"all_layouts = [{listed}]", *(f"{name} = []" for name in names), END]
    return "\n".join(lines)


def with_block(text: str, names: list[str]) -> str:
    """Cargo.toml's text with the block of these layouts."""
    start, end = text.find(BEGIN), text.find(END)
    if start < 0 or end < start:
        raise FeatureError(
            f"{CARGO_TOML} has no block between `{BEGIN}` and `{END}` in [features]: put both lines back"
        )
    return text[:start] + block(names) + text[end + len(END) :]
