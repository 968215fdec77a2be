"""The locked environment: errors where it cannot be made, and a new one when its contents change."""

import errno
import os
import re
import signal
import subprocess
import sys
import threading
import time
import types

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
    assert environment.fingerprint([environment.DEV, pins]) != first
    pins.write_text("casadi==3.8.3\n")
    second = environment.fingerprint([pins])
    monkeypatch.setattr(sys, "version", "3.14.0 (main)")
    third = environment.fingerprint([pins])
    monkeypatch.setattr(sys, "base_prefix", "/opt/python")
    assert len({first, second, third, environment.fingerprint([pins])}) == 4


LOCKS = [environment.REQUIREMENTS, environment.DEV, environment.REFERENCE]


@pytest.mark.parametrize("lock", LOCKS, ids=lambda lock: lock.name)
def test_every_package_is_exact_and_has_its_hashes(lock):
    text = lock.read_text().replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    assert lines
    for line in lines:
        assert re.fullmatch(r"[\w.-]+==[\w.]+( ; [^-]+)?( +--hash=sha256:[0-9a-f]{64})+ *", line), line


class Pip:
    """Stands for the programs that make an environment."""

    def __init__(self, monkeypatch):
        self.commands, self.options = [], []
        monkeypatch.setattr(environment.subprocess, "run", self.run)

    def run(self, command, **options):
        self.commands.append(command)
        self.options.append(options)
        if "venv" in command:
            place = environment.Path(command[-1])
            environment.site_packages(place).mkdir(parents=True)
            environment.interpreter(place).parent.mkdir()
            environment.interpreter(place).touch()
        return subprocess.CompletedProcess([], 0)

    def installed(self):
        return [environment.Path(command[-1]).name for command in self.commands if "install" in command]


def test_there_is_one_environment_for_each_lock(elsewhere, monkeypatch):
    pip = Pip(monkeypatch)
    first = environment.ensure()
    dev = environment.ensure(dev=True)
    assert environment.ensure() == first != dev == environment.ensure(dev=True)
    environment.ensure(reference=True)
    assert pip.installed() == [lock.name for lock in LOCKS]
    assert len(list(elsewhere.iterdir())) == 3
    # the tests see the packages of the derivation, and have no second copy of them
    below = environment.site_packages(dev.parent.parent) / "below.pth"
    assert environment.Path(below.read_text().strip()) == environment.site_packages(first.parent.parent)


def test_pip_asks_for_hashes_and_for_no_configuration(elsewhere, monkeypatch):
    pip = Pip(monkeypatch)
    environment.ensure(dev=True)
    installs = [command for command in pip.commands if "install" in command]
    assert len(installs) == 2
    for command in installs:
        assert {"--isolated", "--require-hashes", "--no-deps", "--only-binary=:all:"} <= set(command)


def test_what_was_left_unfinished_goes_at_once_where_there_are_locks(elsewhere, monkeypatch):
    left = elsewhere / "making-left"
    left.mkdir()
    pip = Pip(monkeypatch)
    environment.ensure()
    assert left.exists() == (environment.fcntl is None)
    # the programs that write there hold the lock too
    assert all(bool(options.get("pass_fds")) == (environment.fcntl is not None) for options in pip.options)


def without_locks(_descriptor, _operation):
    raise OSError(errno.ENOLCK, "no locks")


@pytest.mark.parametrize("system", [None, types.SimpleNamespace(flock=without_locks, LOCK_EX=2, LOCK_NB=4)])
def test_without_locks_it_goes_after_a_day(elsewhere, monkeypatch, system):
    old, new = elsewhere / "making-old", elsewhere / "making-new"
    for left in (old, new):
        left.mkdir()
    for left, hours in ((old, 25), (new, 23)):
        os.utime(left, (time.time() - 3600 * hours,) * 2)
    monkeypatch.setattr(environment, "fcntl", system)
    Pip(monkeypatch)
    environment.ensure()
    assert not old.exists() and new.exists()


# makes environments by a program that has no end
ENDLESS = """
import sys
from codegen import environment
run = environment.subprocess.run
wait = "import sys, time; print('waiting', flush=True); time.sleep(600)"
environment.subprocess.run = lambda command, **options: run([sys.executable, "-c", wait], **options | {"stdout": None})
environment.ensure()
"""


@pytest.mark.skipif(environment.fcntl is None, reason="a system without locks")
def test_what_a_killed_process_left_goes_once_its_programs_have_ended(elsewhere, monkeypatch):
    killed = subprocess.Popen(
        [sys.executable, "-c", ENDLESS], cwd=environment.HERE.parent, stdout=subprocess.PIPE, start_new_session=True
    )
    assert killed.stdout.readline() == b"waiting\n"
    Pip(monkeypatch)
    making = threading.Thread(target=environment.ensure, daemon=True)
    killed.kill()
    killed.wait()
    making.start()
    making.join(0.5)
    assert making.is_alive() and len(list(elsewhere.glob("making-*"))) == 1, "its program is still there"
    os.killpg(killed.pid, signal.SIGKILL)
    making.join(60)
    assert not making.is_alive()
    assert [place.name.startswith("making-") for place in elsewhere.iterdir()] == [False]


def test_everybody_makes_them_in_one_place(monkeypatch, tmp_path):
    for name in ("PLANAR_CAPTURE_ENVIRONMENTS", "PLANAR_CAPTURE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LOCALAPPDATA" if os.name == "nt" else "XDG_CACHE_HOME", str(tmp_path))
    assert environment.home() == tmp_path / "planar-capture" / "python"
    monkeypatch.setenv("PLANAR_CAPTURE_HOME", str(tmp_path / "home"))
    assert environment.home() == tmp_path / "home" / "python"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["no_such_layout"], "no layout no_such_layout in codegen/layouts"),
        (["--layout", "no_such.toml", "--graph", "a.json"], "no_such.toml"),
        (["--layout", "codegen/layouts/boom_7r.toml", "--graph", "no_such/a.json"], "no folder no_such"),
    ],
)
def test_wrong_arguments_make_no_environment(elsewhere, arguments, said):
    outside = {k: v for k, v in os.environ.items() if k != "PLANAR_CAPTURE_CODEGEN_INSIDE"}
    command = [sys.executable, "-m", "codegen", *arguments]
    result = subprocess.run(command, cwd=environment.HERE.parent, env=outside, capture_output=True, text=True)
    assert result.returncode == 2
    assert said in result.stderr
    assert list(elsewhere.iterdir()) == []
