"""The command to compare with, and the files of the repository."""

import os
import subprocess
from pathlib import Path

import numpy as np
import planar_capture as pc
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "scenarios"


@pytest.fixture(scope="session")
def command():
    """Runs the command line; `.ci/python` names the program."""
    program = os.environ.get("PLANAR_CAPTURE")
    if program is None:
        pytest.skip("PLANAR_CAPTURE names no program to compare with")

    def run(*arguments, **options):
        return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False, **options)

    return run


@pytest.fixture
def robot():
    return pc.Robot.from_toml("dual_arm_3r")


def states(robot, *batch, seed=2017):
    """Random states of a robot."""
    random = np.random.default_rng(seed)
    joints = len(robot.joints)
    return pc.State(*(random.normal(size=(*batch, size)) for size in (3, joints, 3, joints)))


def targets(robot, *batch, seed=7):
    """Random targets; the last arm of several captures nothing."""
    random = np.random.default_rng(seed)
    arms = len(robot.arms)
    masses, inertias = random.uniform(1.0, 20.0, (*batch, arms)), random.uniform(0.1, 3.0, (*batch, arms))
    if arms > 1:
        masses[..., -1] = inertias[..., -1] = 0.0
    contacts, twists = random.normal(size=(*batch, arms, 2)), random.normal(size=(*batch, arms, 3))
    return pc.Targets(masses, inertias, contacts, twists)
