"""The locked environment: errors where it cannot be made, and a new one when its contents change."""

import os
import subprocess
import sys

import pytest

from codegen import environment

OLD = (3, 10, 14, "final", 0)


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """Keeps environments in an empty folder."""
    monkeypatch.setenv("PLANAR_CAPTURE_ENVIRONMENTS", str(tmp_path))
    return tmp_path


def test_an_old_python_is_refused(elsewhere, monkeypatch):
    monkeypatch.setattr(sys, "version_info", OLD)
    monkeypatch.setattr(sys, "version", "3.10.14 (main)")
    with pytest.raises(environment.EnvironmentProblem) as caught:
        environment.ensure()
    assert "Python 3.11 or newer is needed, this is 3.10.14" in str(caught.value)
    assert sys.executable in str(caught.value)
    assert list(elsewhere.iterdir()) == []


def test_the_command_says_so_too(elsewhere):
    """An old Python has no tomllib: the error message must come before it is imported."""
    code = f"import runpy, sys; sys.version_info = {OLD}; sys.modules['tomllib'] = None; sys.argv = ['codegen']\n"
    code += "runpy.run_module('codegen', run_name='__main__')"
    outside = {k: v for k, v in os.environ.items() if k != "PLANAR_CAPTURE_CODEGEN_INSIDE"}
    root = environment.HERE.parent
    result = subprocess.run([sys.executable, "-c", code], cwd=root, env=outside, capture_output=True, text=True)
    assert result.returncode == 2, result.stderr
    assert result.stderr.startswith("codegen: error: Python 3.11 or newer is needed")
    assert "Traceback" not in result.stderr


def test_a_missing_module_is_named_with_its_remedy(elsewhere, monkeypatch):
    monkeypatch.setattr(environment.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(environment.EnvironmentProblem, match=r"no `venv`.*apt install python3-venv"):
        environment.ensure()


def test_a_failed_installation_leaves_nothing(elsewhere, monkeypatch):
    monkeypatch.setattr(environment, "requirements", lambda dev: [environment.HERE / "requirements.txt"])
    failing = subprocess.CompletedProcess([], 1)
    monkeypatch.setattr(environment.subprocess, "run", lambda *args, **options: failing)
    with pytest.raises(environment.EnvironmentProblem, match="must be within reach of pip"):
        environment.ensure()
    assert list(elsewhere.iterdir()) == []


def test_the_fingerprint_follows_pins_and_python(tmp_path, monkeypatch):
    pins = tmp_path / "requirements.txt"
    pins.write_text("casadi==3.8.2\n")
    first = environment.fingerprint([pins])
    assert environment.fingerprint([pins]) == first
    assert environment.fingerprint(environment.requirements(True)) != environment.fingerprint(
        environment.requirements(False)
    )
    pins.write_text("casadi==3.8.3\n")
    second = environment.fingerprint([pins])
    monkeypatch.setattr(sys, "version", "3.14.0 (main)")
    assert len({first, second, environment.fingerprint([pins])}) == 3


def test_every_pin_is_exact():
    for path in [*environment.requirements(dev=True), environment.REFERENCE]:
        lines = [line.split("#")[0].strip() for line in path.read_text().splitlines()]
        assert all("==" in line for line in lines if line and not line.startswith("-r "))
