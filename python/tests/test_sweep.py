"""Sweeps: the command's bytes, interruption, refusals."""

import html
import json
import re
import shlex

import planar_capture as pc
import pytest
from conftest import SCENARIOS

SWEEP = """
name = "small"
scenario = "SCENARIO"
cases = 60
seed = 2017
sampling = "random"
block = 10

[[vary]]
key = "target.target1.mass"
distribution = { normal = { mean = 10.0, std = 1.0 }, min = 5.0 }

[[vary]]
key = "layout.base.mass"
distribution = { uniform = { min = 400.0, max = 600.0 } }
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(SWEEP.replace("SCENARIO", str(SCENARIOS / "sweeps" / "capture.toml")))
    return path


def blocks(folder):
    return {path.name: path.read_bytes() for path in sorted((folder / "cases").iterdir())}


def test_files_have_the_bytes_of_the_command(command, file, tmp_path):
    done = command("sweep", file, "--out", tmp_path / "command", "-q")
    assert done.returncode == 0, done.stderr
    result = pc.sweep(file, tmp_path / "it's python", threads=2)
    assert result.cases == 60 and sum(result.computed.values()) == 60 and result.present == 0
    assert blocks(result.folder) == blocks(tmp_path / "command")
    assert (result.folder / "manifest.json").read_bytes() == (tmp_path / "command" / "manifest.json").read_bytes()
    frame = result.to_pandas()
    assert frame["case"].tolist() == list(range(60))
    assert frame["target.target1.mass"].between(5.0, 20.0).all()
    page = result.report().read_text()
    assert "arm1_impulse_magnitude" in page.replace("<wbr>", "")
    (replay,) = [code for code in re.findall("<code>(.*?)</code>", page) if "--replay" in code]
    words = shlex.split(html.unescape(replay))
    assert words == ["planar-capture", "sweep", str(file), "--out", str(result.folder), "--replay", "INDEX", "--report"]
    again = pc.sweep(file, tmp_path / "command")
    assert again.present == 60 and not again.computed
    assert repr(again) == f"<SweepResult small: 60 cases, 60 were there before; {tmp_path / 'command'}>"
    assert repr(result) == f"<SweepResult small: 60 cases, 60 done; {result.folder}>"


def test_a_sweep_is_computed_by_what_is_asked_for(file, tmp_path):
    file.write_text(file.read_text().replace("cases = 60", "cases = 2"))
    for dynamics in ("generic", "graph"):
        folder = pc.sweep(file, tmp_path / dynamics, dynamics=dynamics).folder
        assert json.loads((folder / "manifest.json").read_text())["engine"] == dynamics


def test_shards_and_an_interruption(file, tmp_path):
    whole = pc.sweep(file, tmp_path / "whole")
    for number in (1, 2, 3):
        pc.sweep(file, tmp_path / "shards", shard=(number, 3))
    assert blocks(tmp_path / "shards") == blocks(whole.folder)
    seen = []

    def progress(computed, cases):
        seen.append((computed, cases))
        if computed >= 12:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pc.sweep(file, tmp_path / "resumed", progress=progress, threads=1)
    assert seen[-1][1] == 60
    resumed = pc.sweep(file, tmp_path / "resumed")
    assert resumed.present == 60 - sum(resumed.computed.values())
    assert blocks(resumed.folder) == blocks(whole.folder)


def test_a_damaged_file_is_computed_again(file, tmp_path):
    result = pc.sweep(file, tmp_path / "out")
    whole = blocks(result.folder)
    damaged = result.folder / "cases" / "000002.parquet"
    damaged.write_bytes(whole["000003.parquet"])
    with pytest.raises(pc.InputError, match=r"000002.parquet is damaged"):
        result.report()
    with pytest.warns(UserWarning, match=r"000002.parquet is damaged.*computed again"):
        again = pc.sweep(file, tmp_path / "out")
    assert sum(again.computed.values()) == 10 and blocks(again.folder) == whole


def test_refusals(file, tmp_path):
    with pytest.raises(pc.InputError, match="shard is"):
        pc.sweep(file, tmp_path / "out", shard=(4, 3))
    pc.sweep(file, tmp_path / "out", shard=(1, 6))
    file.write_text(file.read_text().replace("2017", "2018"))
    with pytest.raises(pc.InputError, match="seed: was 2017, is 2018"):
        pc.sweep(file, tmp_path / "out")
    file.write_text(file.read_text().replace("sampling", "smpling"))
    with pytest.raises(pc.InputError, match="did you mean `sampling`"):
        pc.sweep(file, tmp_path / "out")
