"""Sweeps by Dask: the bytes of one machine, with workers that are killed."""

import contextlib
import os
import signal
import subprocess
import sys
import tomllib

import planar_capture as pc
import pytest
from conftest import ROOT, SCENARIOS
from test_sweep import SWEEP, blocks

dask = pytest.importorskip("distributed")
from planar_capture import distributed  # noqa: E402  (it needs Dask)


@pytest.fixture(scope="module")
def client(tmp_path_factory):
    with (
        dask.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            local_directory=str(tmp_path_factory.mktemp("workers")),
        ) as cluster,
        dask.Client(cluster) as client,
    ):
        yield client


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(SWEEP.replace("SCENARIO", str(SCENARIOS / "sweeps" / "capture.toml")))
    return path


def test_killed_workers_change_nothing(client, file, tmp_path):
    file.write_text(file.read_text().replace("cases = 60", "cases = 605"))
    expected = pc.sweep(file, tmp_path / "here")
    killed = set()

    def progress(computed, cases):
        assert cases == 605
        # one of those that are there now, again and again
        if computed >= 80 * (len(killed) + 1) and len(killed) < 4:
            workers = client.run(os.getpid, on_error="ignore")
            new = [process for process in workers.values() if process not in killed]
            if new:
                killed.add(new[0])
                os.kill(new[0], signal.SIGKILL)

    result = distributed.sweep(file, client, tmp_path / "there", progress=progress)
    assert len(killed) == 4
    assert sum(result.computed.values()) == 605 and result.present == 0
    assert blocks(result.folder) == blocks(expected.folder)
    assert not list(result.folder.glob(".probe*"))
    frame = result.to_dask()
    assert frame.npartitions == 61 and frame["case"].compute().tolist() == list(range(605))
    again = distributed.sweep(file, client, tmp_path / "there", report=True)
    assert again.present == 605 and not again.computed and (result.folder / "report.html").exists()


def test_a_file_that_a_lost_worker_has_left_is_counted(file, tmp_path):
    pc.sweep(file, tmp_path / "there")
    arguments = {"path": str(file), "folder": str(tmp_path / "there"), "total": 6, "dynamics": "auto"}
    (tmp_path / "there/cases/000002.parquet").unlink()
    first, again = (dict(distributed.compute(2, **arguments)) for _ in range(2))
    assert {status: count for status, count in first.items() if count} == again == {"done": 10}


def test_refusals(client, file, tmp_path):
    with pytest.raises(pc.InputError, match=r"no file `.*missing\.toml`"):
        distributed.sweep(tmp_path / "missing.toml", client, tmp_path / "out")
    distributed.sweep(file, client, tmp_path / "out")
    file.write_text(file.read_text().replace("2017", "2018"))
    with pytest.raises(pc.InputError, match="seed: was 2017, is 2018"):
        distributed.sweep(file, client, tmp_path / "out")
    # a folder that workers see as another one
    hidden = client.run(hide, str(tmp_path / "elsewhere"))
    assert len(hidden) == 2
    try:
        with pytest.raises(pc.OutputError, match="workers cannot compute this sweep"):
            distributed.sweep(file, client, tmp_path / "new")
    finally:
        client.run(show)


def hide(place):
    """On a worker: all files are elsewhere."""
    distributed.answer.__globals__["Path"] = lambda path: __import__("pathlib").Path(place + path)


def show():
    """Undoes it."""
    import pathlib

    distributed.answer.__globals__["Path"] = pathlib.Path


def test_the_command(client, file, tmp_path):
    words = [sys.executable, "-P", "-m", "planar_capture.distributed"]
    address = client.scheduler_info()["address"]
    done = subprocess.run(
        [*words, file, "--scheduler", address, "--out", tmp_path / "out"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "<SweepResult" not in done.stderr and "60 cases" in done.stdout
    assert "60 of 60 cases" in done.stderr
    wrong = subprocess.run(
        [*words, ROOT / "missing.toml", "--scheduler", address], capture_output=True, text=True, check=False
    )
    assert wrong.returncode == 2 and "missing.toml" in wrong.stderr


def test_without_dask_the_command_says_so_in_one_line():
    script = (
        "import runpy, sys; sys.modules['distributed'] = None; "
        "runpy.run_module('planar_capture.distributed', run_name='__main__', alter_sys=True)"
    )
    done = subprocess.run([sys.executable, "-P", "-c", script], capture_output=True, text=True, check=False)
    project = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())["project"]
    (needed,) = project["optional-dependencies"]["distributed"]
    assert done.returncode == 2
    assert done.stderr == f"error: Dask is not installed: pip install '{needed}'\n"


def test_an_interruption_has_its_exit_code(monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(distributed, "Client", contextlib.nullcontext)
    monkeypatch.setattr(distributed, "sweep", interrupted)
    monkeypatch.setattr(sys, "argv", ["distributed", "it.toml"])
    assert distributed.main() == 130
    assert capsys.readouterr().err == "interrupted: the same command goes on from here\n"
