"""Versions that stand in several files."""

import re
import tomllib

from conftest import ROOT
from planar_capture.casadi_functions import CASADI


def test_casadi_is_that_of_the_derivation():
    project = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())["project"]
    assert f"casadi=={CASADI}" in project["optional-dependencies"]["derive"]
    locked = re.search(r"^casadi==(\S+)", (ROOT / "codegen" / "requirements.txt").read_text(), re.MULTILINE)
    assert locked and locked[1] == CASADI
