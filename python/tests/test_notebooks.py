"""The notebooks' cells run, one after the other."""

import json
from pathlib import Path

import pytest
from conftest import ROOT

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"


@pytest.mark.parametrize("name", sorted(path.name for path in NOTEBOOKS.glob("*.ipynb")))
def test_all_cells_run(name, tmp_path, monkeypatch):
    cells = json.loads((NOTEBOOKS / name).read_text(encoding="utf-8"))["cells"]
    code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    assert len(code) >= 5
    assert not any(cell.get("outputs") for cell in cells), "outputs are not kept"
    # where it is in the repository
    (tmp_path / "scenarios").symlink_to(ROOT / "scenarios")
    (tmp_path / "python" / "notebooks").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "python" / "notebooks")
    names = {}
    for cell in code:
        exec(compile(cell, name, "exec"), names)
