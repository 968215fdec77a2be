"""Formats a graph as JSON text, with one statement, parameter or output per line."""

import json


def dump(value, indent: int = 0) -> str:
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
    """Whether a value is one line: it holds no object and no list of statements, and is none."""
    items = value.values() if isinstance(value, dict) else value
    return (
        not any(isinstance(item, dict) for item in items)
        and not any(isinstance(item, list) and any(isinstance(inner, list) for inner in item) for item in items)
        and not (isinstance(value, list) and len(value) > 0 and all(isinstance(item, list) for item in value))
    )
