"""Functions of a robot: shapes, bits, parameters, states without a result."""

import copy
import json
import pickle
import pydoc
import re

import numpy as np
import planar_capture as pc
import pytest
from conftest import states, targets

LAYOUTS = pc.layouts()


def test_all_axes_before_those_of_a_state_are_the_batch(robot):
    joints, arms = 6, 2
    for batch in [(), (1,), (3,), (70,), (2, 5), (2, 1, 3)]:
        state = states(robot, *batch)
        shapes = {
            "mass_matrix": (3 + joints, 3 + joints),
            "end_effector_poses": (arms, 3),
            "end_effector_jacobian": (3 * arms, 3 + joints),
            "generalized_jacobian": (3 * arms, joints),
            "body_poses": (1 + joints, 3),
        }
        for name, shape in shapes.items():
            assert getattr(robot, name)(state.base_pose, state.joint_angles).shape == batch + shape
        assert robot.bias(*state).shape == (*batch, 3 + joints)
        assert robot.forward_dynamics(*state).joint_accelerations.shape == (*batch, joints)
        assert np.shape(robot.momentum(*state).kinetic_energy) == batch
    assert robot.momentum(*states(robot, 0)).linear_momentum.shape == (0, 2)


@pytest.mark.parametrize("name", LAYOUTS)
def test_one_state_has_the_bits_of_a_batch_whatever_the_threads(name):
    robot = pc.Robot.from_toml(name)
    state, bodies = states(robot, 5000), targets(robot, 5000)
    for threads in (1, 2, 7):
        many = robot.full_impact(*state, *bodies, threads=threads)
        for i in (0, 63, 64, 2047, 2048, 4999):
            one = robot.full_impact(*(part[i] for part in state), *(part[i] for part in bodies))
            for of_many, of_one in zip(many, one, strict=True):
                np.testing.assert_array_equal(of_many[i], of_one)
    some = robot.capture(*(part[:300] for part in state), *(part[:300] for part in bodies), threads=3)
    one = robot.capture(*(part[299] for part in state), *(part[299] for part in bodies))
    for of_many, of_one in zip(some, one, strict=True):
        np.testing.assert_array_equal(of_many[299], of_one)


def test_forces_that_are_left_out_are_zero(robot):
    state = states(robot, 20)
    random = np.random.default_rng(5)
    torques, wrench, wrenches = (random.normal(size=(20, *shape)) for shape in [(6,), (3,), (2, 3)])
    none, no_wrench, no_wrenches = np.zeros(6), np.zeros(3), np.zeros((2, 3))
    for some, all_of_them in [
        ((), (none, no_wrench, no_wrenches)),
        ((torques,), (torques, no_wrench, no_wrenches)),
        ((torques, wrench), (torques, wrench, no_wrenches)),
        ((None, wrench), (none, wrench, no_wrenches)),
        ((None, None, wrenches), (none, no_wrench, wrenches)),
    ]:
        found, expected = robot.forward_dynamics(*state, *some), robot.forward_dynamics(*state, *all_of_them)
        for part, wanted in zip(found, expected, strict=True):
            np.testing.assert_allclose(part, wanted, rtol=1e-9, atol=1e-12)


def test_axes_broadcast(robot):
    state = states(robot, 4, 5)
    wide = robot.bias(np.zeros(3), state.joint_angles, np.zeros((5, 3)), state.joint_rates[:, :1])
    one = robot.bias(np.zeros(3), state.joint_angles[2, 3], np.zeros(3), state.joint_rates[2, 0])
    np.testing.assert_array_equal(wide[2, 3], one)


def test_any_order_in_memory_and_any_real_type(robot):
    state = states(robot, 10)
    expected = robot.bias(*state)
    for change in (np.asfortranarray, lambda part: np.ascontiguousarray(part[::-1])[::-1], lambda part: part.tolist()):
        np.testing.assert_array_equal(robot.bias(*map(change, state)), expected)
    whole = robot.mass_matrix([0, 0, 0], [0, 1, 0, 0, 1, 0])
    np.testing.assert_array_equal(whole, robot.mass_matrix(np.zeros(3), [0.0, 1.0, 0.0, 0.0, 1.0, 0.0]))


def test_the_command_computes_the_same_bits(command, tmp_path):
    for name in LAYOUTS:
        robot = pc.Robot.from_toml(name)
        state, bodies = states(robot, 8), targets(robot, 8)
        random = np.random.default_rng(1)
        arms, joints = len(robot.arms), len(robot.joints)
        forces = [random.normal(size=(8, *shape)) for shape in [(joints,), (3,), (arms, 3)]]
        keys = [*pc.State._fields, "joint_torques", "base_wrench", "end_effector_wrenches"]
        inputs = [{key: part[i].tolist() for key, part in zip(keys, [*state, *forces], strict=True)} for i in range(8)]
        names = ("mass", "inertia", "contact", "twist")
        for i, one in enumerate(inputs):
            parts = [[part[i, arm].tolist() for part in bodies] for arm in range(arms)]
            one["targets"] = [dict(zip(names, part, strict=True)) if part[0] else None for part in parts]
        file = tmp_path / f"{name}.json"
        file.write_text(json.dumps(inputs))
        printed = command("eval", name, file, "--dynamics", "graph")
        assert printed.returncode == 0, printed.stderr
        found = robot.evaluate(*state, *forces, targets=bodies)
        for i, expected in enumerate(json.loads(printed.stdout)):
            expected["capture"] = {
                key: [value or [0.0] * 3 for value in values] if key in ("target_twists_after", "impulses") else values
                for key, values in expected["capture"].items()
            }
            assert expected.keys() == found.keys()
            for key, value in expected.items():
                pairs = [(value, found[key])]
                if isinstance(value, dict):
                    assert value.keys() == found[key].keys()
                    pairs = [(value[inner], found[key][inner]) for inner in value]
                for wanted, part in pairs:
                    np.testing.assert_array_equal(part[i], wanted, err_msg=f"{name}: {key}")


def test_parameters_are_those_of_another_layout(robot):
    text = robot.layout
    state, bodies = states(robot, 100), targets(robot, 100)
    heavier = pc.Robot.from_toml(text.replace("mass = 500.0", "mass = 480.0", 1))
    assert heavier.parameters["base_mass"].value == 480.0
    masses = np.full(100, 500.0)
    masses[40] = 480.0
    for function, arguments in [
        ("forward_dynamics", state),
        ("reduced_dynamics", state),
        ("full_impact", (*state, *bodies)),
        ("capture", (*state, *bodies)),
    ]:
        found = getattr(robot, function)(*arguments, parameters={"base_mass": masses})
        for other, at in ((heavier, 40), (robot, 41)):
            expected = getattr(other, function)(*(part[at] for part in arguments))
            for of_batch, alone in zip(found, expected, strict=True):
                np.testing.assert_array_equal(of_batch[at], alone)
    # the batch may be that of the parameters alone
    assert robot.mass_matrix(np.zeros(3), np.zeros(6), parameters={"base_mass": masses}).shape == (100, 9, 9)


def test_wrong_parameters_are_named(robot):
    with pytest.raises(pc.InputError, match="no parameter 'base_mas'; did you mean 'base_mass'"):
        robot.mass_matrix(np.zeros(3), np.zeros(6), parameters={"base_mas": 1.0})
    positive = [name for name in robot.parameters if "mass" in name or "inertia" in name]
    assert {"base_mass", "base_inertia"} < set(positive)
    for name in positive:
        with pytest.raises(pc.InputError, match=f"'{name}' is 0.0, expected numbers greater than 0"):
            robot.mass_matrix(np.zeros(3), np.zeros(6), parameters={name: [400.0, 0.0]})
    with pytest.raises(pc.NotFiniteError, match="'base_mass' = nan is not a finite number") as raised:
        robot.mass_matrix(np.zeros(3), np.zeros(6), parameters={"base_mass": [400.0, np.nan]})
    assert raised.value.index == (1,)
    with pytest.raises(pc.NotFiniteError, match="'base_mass'"):
        robot.capture(*states(robot), *targets(robot), parameters={"base_mass": np.inf})


def test_a_state_without_a_result_is_raised_with_its_numbers(robot):
    state = states(robot, 3, 4)
    state.joint_angles[1, 2, 3] = np.nan
    state.joint_angles[2, 2, 3] = np.inf
    for call in (
        lambda: robot.mass_matrix(state.base_pose, state.joint_angles),
        lambda: robot.forward_dynamics(*state),
        lambda: robot.body_twists(*state),
        lambda: robot.capture(*state, *targets(robot)),
    ):
        with pytest.raises(
            pc.NotFiniteError, match=r"state \(1, 2\): .*joint_angles\[3\] = NaN.*\(and 1 more without a result\)"
        ) as raised:
            call()
        assert raised.value.index == (1, 2) and raised.value.exit_code == 1
        assert np.isnan(raised.value.inputs["joint_angles"][3])
        again = pickle.loads(pickle.dumps(raised.value))
        assert (type(again), str(again), again.index) == (pc.NotFiniteError, str(raised.value), (1, 2))
        assert again.inputs.keys() == raised.value.inputs.keys() >= {"base_pose", "joint_angles"}
        for name, value in again.inputs.items():
            np.testing.assert_array_equal(value, raised.value.inputs[name])


def test_a_singular_state_is_raised_with_its_pivot(robot):
    # beside a target beyond all measure the robot is lost in rounding
    state, bodies = states(robot), targets(robot)
    masses = bodies.target_masses * np.array([[1.0], [1e30]])
    heavy = bodies._replace(target_masses=masses)
    with pytest.raises(pc.SingularError, match=r"state \(1,\): full_impact: .*smallest relative pivot is") as raised:
        robot.full_impact(*state, *heavy)
    assert raised.value.inputs["target_masses"].tolist() == masses[1].tolist()
    masked = robot.full_impact(*state, *heavy, on_singular="mask")
    assert masked.joint_rates_after.mask.all(axis=1).tolist() == [False, True]


def test_states_without_a_result_are_masked_where_asked(robot):
    state = states(robot, 3, 4)
    expected = robot.forward_dynamics(*state)
    state.joint_rates[1, 2, 0] = np.inf
    found = robot.forward_dynamics(*state, on_singular="mask")
    for part, wanted in zip(found, expected, strict=True):
        assert isinstance(part, np.ma.MaskedArray)
        assert not np.isnan(part.data).any()
        assert part.mask[1, 2].all() and part.mask.sum() == part.shape[-1]
        np.testing.assert_array_equal(part.compressed(), np.delete(wanted.reshape(12, -1), 6, axis=0).reshape(-1))
    energy = robot.momentum(*state, on_singular="mask").kinetic_energy
    assert energy.mask[1, 2] and energy.mask.sum() == 1
    with pytest.raises(pc.InputError, match='expected "raise" or "mask"'):
        robot.bias(*state, on_singular="nan")


def test_wrong_arrays_are_named(robot):
    pose = np.zeros(3)
    with pytest.raises(pc.InputError, match=r"`joint_angles` has shape \(5,\), expected \(…, 6\).*rad"):
        robot.mass_matrix(pose, np.zeros(5))
    with pytest.raises(pc.InputError, match=r"do not fit each other: base_pose \(2,\), joint_angles \(3,\)"):
        robot.mass_matrix(np.zeros((2, 3)), np.zeros((3, 6)))
    for wrong in (["a"] * 6, [1j] * 6, None):
        with pytest.raises(pc.InputError, match="`joint_angles`"):
            robot.mass_matrix(pose, wrong)
    with pytest.raises(pc.InputError, match="no function `mas_matrix`"):
        robot.call("mas_matrix")
    with pytest.raises(pc.InputError, match="has the inputs base_pose, joint_angles"):
        robot.call("mass_matrix", base_pose=pose)


def test_identities_of_mechanics(robot):
    state = states(robot, 200)
    velocity = np.concatenate([state.base_twist, state.joint_rates], axis=-1)
    mass_matrix = robot.mass_matrix(state.base_pose, state.joint_angles)
    energy = 0.5 * np.einsum("ni,nij,nj->n", velocity, mass_matrix, velocity)
    np.testing.assert_allclose(robot.momentum(*state).kinetic_energy, energy, rtol=1e-12)
    torques = np.random.default_rng(3).normal(size=(200, 6))
    found = np.concatenate(robot.forward_dynamics(*state, torques), axis=-1)
    forces = np.concatenate([np.zeros((200, 3)), torques], axis=-1)
    residual = np.einsum("nij,nj->ni", mass_matrix, found) + robot.bias(*state) - forces
    assert np.abs(residual).max() < 1e-9
    # a capture keeps momentum, and impulses are what the targets lose
    bodies = targets(robot, 200)
    after = robot.capture(*state, *bodies)
    lost = bodies.target_masses[..., None] * (bodies.target_twists - after.target_twists_after)[..., 1:]
    lost[:, 1] = 0.0
    np.testing.assert_allclose(after.impulses[..., 1:], lost, atol=1e-9)
    before = robot.momentum(*state).linear_momentum
    moved = robot.momentum(state[0], state[1], after.base_twist_after, after.joint_rates_after).linear_momentum
    np.testing.assert_allclose(moved - before, after.impulses[..., 1:].sum(axis=1), atol=1e-9)


def test_a_robot_tells_what_it_is(robot):
    assert robot.arms == ["arm1", "arm2"]
    assert robot.joints[:4] == ["arm1_joint1", "arm1_joint2", "arm1_joint3", "arm2_joint1"]
    assert robot.parameters["arm1_link2_mass"].unit == "kg"
    function = robot.functions["forward_dynamics"]
    assert [argument.name for argument in function.inputs][-1] == "joint_torques"
    assert function.outputs[1].shape == (6,) and function.outputs[1].unit == "rad/s^2"
    found = robot.call("forward_dynamics", **states(robot, 2)._asdict(), joint_torques=np.zeros(6))
    assert found["smallest_pivot"].shape == (2,) and (found["smallest_pivot"] > 0).all()
    for same in (pickle.loads(pickle.dumps(robot)), copy.deepcopy(robot)):
        np.testing.assert_array_equal(same.bias(*states(robot)), robot.bias(*states(robot)))


def test_messages_are_those_of_the_command(command, tmp_path):
    file = tmp_path / "broken.toml"
    file.write_text('name = "broken"\n[base]\nmass = -1.0\n')
    for argument in (str(file), "dual_arm_4r", "missing.toml"):
        said = command("eval", argument, "-", input="[]")
        assert said.returncode == 2
        with pytest.raises(pc.InputError) as raised:
            pc.Robot.from_toml(argument)
        assert raised.value.exit_code == 2
        assert str(raised.value).removeprefix("error: ") == said.stderr.strip().removeprefix("error: ")
    with pytest.raises(pc.InputError, match=r"missing\.toml"):
        pc.Robot.from_toml(tmp_path / "missing.toml")


def test_a_structure_without_a_graph_is_refused_with_the_remedy(tmp_path, monkeypatch):
    monkeypatch.setenv("PLANAR_CAPTURE_HOME", str(tmp_path))
    text = pc.Robot.from_toml("boom_7r").layout
    with pytest.raises(pc.MissingGraphError, match="derive"):
        pc.Robot.from_toml(text.replace("mount_angle", "#", 1) + LINK)


def test_help_has_shapes_and_units_and_is_short():
    """The README promises them; annotations in full would be twenty lines for each array."""
    functions = [getattr(pc.Robot, name) for name in vars(pc.Robot) if not name.startswith("_")]
    functions += [pc.run, pc.Scenario.run, pc.Scenario.with_values]
    for function in filter(callable, functions):
        text = pydoc.plain(pydoc.render_doc(function))
        signature = text.split("\n")[2]
        assert "SupportsArray" not in text and "Buffer" not in text and len(signature) < 600, text
    for function in (pc.Robot.reduced_impact, pc.Robot.full_impact, pc.Robot.capture, pc.Robot.evaluate):
        text = " ".join(pydoc.plain(pydoc.render_doc(function)).split())
        for name in re.findall(r"(\w+): 'ArrayLike", text):
            assert f"``{name}`` (" in text, f"{function.__name__}: {name}"
        for part in ("(…, arms, 2)", "kg m²", "rad/s, m/s", "inertial axes"):
            assert part in text, f"{function.__name__}: {part}"
    for kind in (pc.State, pc.Targets, pc.Capture, pc.FullImpact, pc.ReducedImpact):
        assert all(f"``{name}``: (" in kind.__doc__ for name in kind._fields)


def test_a_general_graph_has_exact_zeros_as_parameters(tmp_path, monkeypatch):
    # no graph that was derived here before
    monkeypatch.setenv("PLANAR_CAPTURE_HOME", str(tmp_path))
    exact = pc.Robot.from_toml("dual_arm_3r")
    structural = {"arm1_mount_y", "arm2_mount_angle", "arm1_link2_com_y"}
    assert not structural & set(exact.parameters)
    # a target moves the COM of a last link off its axis
    assert exact.parameters["arm2_link3_com_y"].value == 0.0
    with pytest.raises(pc.InputError, match=r"no parameter 'arm1_mount_y'.*where the graph has exact zeros"):
        exact.mass_matrix(np.zeros(3), np.zeros(6), parameters={"arm1_mount_y": 0.1})
    # a number that is zero in the graph of the shipped layout: the general one fits
    text = exact.layout.replace("mount = [0.5, 0.0]", "mount = [0.5, 0.1]", 1)
    general = pc.Robot.from_toml(text)
    assert text != exact.layout and "general_2x3" in repr(general)
    # but for a length of zero before the last link
    with pytest.raises(pc.MissingGraphError, match="an inner link of length zero"):
        pc.Robot.from_toml(text.replace("length = 1.0", "length = 0.0", 1))
    assert structural <= set(general.parameters) and general.parameters["arm1_link2_com_y"].value == 0.0


LINK = """
[[arm.link]]
length = 0.5
mass = 2.0
inertia = 0.1
"""
