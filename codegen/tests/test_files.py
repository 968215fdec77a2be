"""What the command writes, checks and refuses, without a derivation."""

import argparse

import pytest

from codegen import __main__, cargo_features, derive
from codegen.json_text import dump


def test_a_file_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    path = tmp_path / "new" / "graph.json"
    derive.write_atomically(path, "first\n")
    assert path.read_text() == "first\n" and path.stat().st_mode & 0o777 == 0o644

    def full(*_):
        raise OSError("no space left")

    monkeypatch.setattr(derive.os, "replace", full)
    with pytest.raises(OSError, match="no space left"):
        derive.write_atomically(path, "second\n")
    assert [file.name for file in path.parent.iterdir()] == ["graph.json"] and path.read_text() == "first\n"


def test_no_graph_has_numbers_that_are_none():
    for number in (float("nan"), float("inf")):
        with pytest.raises(ValueError, match="JSON"):
            dump({"default": number})


def test_the_block_of_features_is_replaced_alone():
    begin, end = cargo_features.BEGIN, cargo_features.END
    before = f"[features]\na = []\n{begin}\nold = []\n{end}\n[lib]\n"
    block = f'{begin}\nall_layouts = ["one", "two"]\none = []\ntwo = []\n{end}'
    found = cargo_features.with_block(before, ["one", "two"])
    assert found == f"[features]\na = []\n{block}\n[lib]\n"
    assert cargo_features.with_block(found, ["one", "two"]) == found
    for text in ("", begin, end, f"{end}\n{begin}"):
        with pytest.raises(cargo_features.FeatureError, match="put both lines back"):
            cargo_features.with_block(text, ["one"])


@pytest.mark.parametrize("check", [True, False])
@pytest.mark.parametrize("content", ["text", "old", None])
@pytest.mark.parametrize("orphan", [True, False])
def test_stale_graphs_and_orphans_fail_a_check(content, check, orphan, tmp_path, monkeypatch, capsys):
    path = tmp_path / "one.json"
    if content is not None:
        path.write_text(content)
    left = [tmp_path / "two.json"] if orphan else []
    monkeypatch.setattr(__main__, "ROOT", tmp_path)
    monkeypatch.setattr(__main__, "derived_files", lambda *_: [(path, "text")])
    monkeypatch.setattr(derive, "graph_paths", lambda: [path, *left])
    monkeypatch.setattr(derive, "graph_path", lambda _: path)
    monkeypatch.setattr(derive, "layout_path", lambda name: tmp_path / f"{name}.toml")
    code = __main__.derive_shipped(argparse.Namespace(names=["one"], check=check))
    stale = check and content != "text"
    assert code == int(stale or orphan)
    said = capsys.readouterr()
    word = ("fresh" if content == "text" else "STALE") if check else ("unchanged" if content == "text" else "written")
    assert f"one.json: {word}\n" in said.out
    assert ("two.json: has no layout; delete it, or put two.toml back" in said.out) == orphan
    assert ("to mend: python -m codegen one\n" in said.err) == stale
    assert (path.read_text() if path.exists() else None) == (content if check else "text")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--layout", "one.toml"], "go together"),
        (["--graph", "one.json"], "go together"),
        (["--derivatives"], "derivatives are for --layout"),
        (["--directional", "momentum"], "derivatives are for --layout"),
    ],
)
def test_options_that_do_not_fit_are_refused(words, said, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["codegen", *words])
    with pytest.raises(SystemExit) as ended:
        __main__.arguments()
    assert ended.value.code == 2 and said in capsys.readouterr().err
