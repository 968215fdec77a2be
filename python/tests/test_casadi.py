"""Functions of graphs as CasADi's."""

import sys

import numpy as np
import planar_capture as pc
import pytest
from conftest import states, targets

ca = pytest.importorskip("casadi")


@pytest.mark.parametrize("name", ["dual_arm_3r", "asymmetric_wheel", "single_arm_2r"])
def test_they_have_the_values_of_the_robot(name):
    robot = pc.Robot.from_toml(name)
    values = states(robot)._asdict() | targets(robot)._asdict()
    random = np.random.default_rng(4)
    shapes = {argument.name: argument.shape for function in robot.functions.values() for argument in function.inputs}
    numbers = np.array([parameter.value for parameter in robot.parameters.values()]) * 1.01
    own = dict(zip(robot.parameters, numbers, strict=True))
    for function in robot.functions.values():
        inputs = {
            argument.name: values.get(argument.name, random.normal(size=shapes[argument.name]))
            for argument in function.inputs
        }
        for symbolic in (False, True):
            made = robot.casadi_function(function.name, symbolic_parameters=symbolic)
            found = made(**inputs, **({"parameters": numbers} if symbolic else {}))
            expected = robot.call(function.name, **inputs, parameters=own if symbolic else None)
            for output in function.outputs:
                wanted = np.asarray(expected[output.name])
                scale = max(1.0, np.abs(wanted).max())
                part = np.array(found[output.name]).reshape(wanted.shape)
                np.testing.assert_allclose(part, wanted, rtol=1e-11, atol=1e-11 * scale, err_msg=function.name)


def test_without_casadi_the_remedy_is_what_an_index_has(robot, monkeypatch):
    monkeypatch.setitem(sys.modules, "casadi", None)
    with pytest.raises(pc.InputError, match=r"^CasADi is not installed: pip install casadi==[\d.]+$"):
        robot.casadi_function("momentum")


def test_they_have_derivatives(robot):
    function = robot.casadi_function("momentum")
    state = states(robot)
    rates = ca.SX.sym("rates", 6)
    energy = function(*state[:3], rates)[2]
    gradient = ca.Function("gradient", [rates], [ca.gradient(energy, rates)])
    velocity = np.concatenate([state.base_twist, state.joint_rates])
    expected = (robot.mass_matrix(state.base_pose, state.joint_angles) @ velocity)[3:]
    np.testing.assert_allclose(np.array(gradient(state.joint_rates)).reshape(-1), expected, rtol=1e-11)
