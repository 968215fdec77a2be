"""Derivation of a structure that no graph has."""

import numpy as np
import planar_capture as pc
import pytest
from conftest import states

pytest.importorskip("casadi")

LAYOUT = """
name = "hinged"

[base]
mass = 300.0
inertia = 50.0

[[arm]]
name = "boom"
mount = [0.5, 0.0]

[[arm.link]]
length = 0.0
mass = 4.0
inertia = 0.5
com = [0.0, 0.0]

[[arm.link]]
length = 1.0
mass = 8.0
inertia = 0.7

[[arm.link]]
length = 0.6
mass = 4.0
inertia = 0.2
com = [0.3, 0.0]
"""


def test_a_layout_is_derived_proved_and_found_later(tmp_path, monkeypatch):
    monkeypatch.setenv("PLANAR_CAPTURE_HOME", str(tmp_path / "home"))
    with pytest.raises(
        pc.MissingGraphError, match=r"no graph has the structure of layout `hinged`.*planar_capture\.derive"
    ):
        pc.Robot.from_toml(LAYOUT)
    said = []
    robot = pc.derive(LAYOUT, progress=said.append)
    assert any("forward dynamics" in line for line in said)
    assert not list((tmp_path / "home").glob("python")), "CasADi is there already"
    state = states(robot, 50)
    mass_matrix = robot.mass_matrix(state.base_pose, state.joint_angles)
    found = np.concatenate(robot.forward_dynamics(*state), axis=-1)
    assert np.abs(np.einsum("nij,nj->ni", mass_matrix, found) + robot.bias(*state)).max() < 1e-9
    other = pc.Robot.from_toml(LAYOUT.replace("300.0", "310.0"))
    assert other.parameters["base_mass"].value == 310.0
    function = robot.casadi_function("end_effector_poses")
    poses = np.array(function(state.base_pose[0], state.joint_angles[0]))
    np.testing.assert_allclose(poses, robot.end_effector_poses(state.base_pose[0], state.joint_angles[0]), atol=1e-12)


def test_what_cannot_be_derived_is_named(tmp_path):
    with pytest.raises(pc.InputError, match=r"missing\.toml"):
        pc.derive(tmp_path / "missing.toml")
