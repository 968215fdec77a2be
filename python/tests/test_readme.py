"""The README's examples run."""

import re
from pathlib import Path

from conftest import ROOT


def test_all_examples_run_one_after_the_other(tmp_path, monkeypatch, capsys):
    text = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
    examples = re.findall(r"```python\n(.*?)```", text, flags=re.S)
    assert len(examples) == 6
    (tmp_path / "scenarios").symlink_to(ROOT / "scenarios")
    monkeypatch.chdir(tmp_path)
    names = {}
    for example in examples:
        exec(compile(example, "README.md", "exec"), names)
    printed = capsys.readouterr().out
    assert "state (3, 4): mass_matrix: joint_angles[5] = NaN is not a finite number" in printed
    assert "<SweepResult uncertain_capture: 1000 cases" in printed
    assert (tmp_path / "report.html").stat().st_size > 100_000
