"""Controllers of one's own: sampled, held, with a memory, with mistakes."""

import re

import numpy as np
import planar_capture as pc
import pytest
from conftest import SCENARIOS

PAPER = SCENARIOS / "raina_shah_2017.toml"


def proportional_derivative(time, state, desired):
    return 49.0 * (desired.joint_angles - state.joint_angles) + 14.0 * (desired.joint_rates - state.joint_rates)


def sampled(text, seconds):
    """The scenario with its own law at a sample time."""
    return text.replace('tracking = "pd"', f'tracking = "pd"\nsample_time = {seconds}', 1)


def test_the_scenarios_law_in_python_gives_its_results_and_keeps_the_audit():
    text = sampled(PAPER.read_text(), 0.05)
    expected = pc.run(text)
    found = pc.run(text, proportional_derivative)
    assert found.audit_failures == [] == expected.audit_failures
    for case in expected.cases:
        for column, values in expected.cases[case].series.items():
            if column != "phase":
                # sums may be rounded elsewhere
                np.testing.assert_allclose(found.cases[case].series[column], values, rtol=1e-9, atol=1e-9)
    torques = found.cases["case1"].series["arm1_joint1_torque"]
    assert np.abs(torques).max() > 0.01


def test_it_is_called_once_per_sample_and_its_torques_are_held():
    times = []

    def control(time, state, desired):
        times.append(time)
        return proportional_derivative(time, state, desired)

    result = pc.run(PAPER, control, sample_time=0.1, sample=0.005)
    assert result.audit_failures == []
    np.testing.assert_allclose(times, np.arange(200) * 0.1, atol=1e-12)
    series = result.cases["case1"].series
    torque = series["arm1_joint2_torque"][series["phase"] == "approach"]
    assert len(torque) == 4001 and 100 < len(np.unique(torque)) <= 200


def test_a_controller_is_reset_before_every_phase():
    # two targets are met one after the other, and the motion after each impact is a phase

    class Still:
        """No torques."""

        resets = 0

        def reset(self):
            self.resets += 1

        def __call__(self, time, state, desired):
            return np.zeros(6)

    control = Still()
    result = pc.run(SCENARIOS / "elastic_rebound.toml", post_capture_control=control, sample_time=0.05)
    impacts = [case.summary.get("post_impact", {}).get("impacts", []) for case in result.cases.values()]
    phases = sum(1 + len(later) for later in impacts)
    assert max(map(len, impacts)) > 0 and control.resets == phases


def test_each_phase_has_its_own_controller():
    called = {"approach": 0, "afterwards": 0}

    def of(phase):
        def control(time, state, desired):
            called[phase] += 1
            return np.zeros(6)

        return control

    text = PAPER.read_text().replace("duration = 20.0", "duration = 1.0").replace("duration = 50.0", "duration = 2.0")
    text = text[: text.index("[[case]]", text.index("[[case]]") + 1)] + text[text.index("[post_impact]") :]
    pc.run(text, of("approach"), post_capture_control=of("afterwards"), sample_time=0.1)
    assert called["approach"] >= 10 and called["afterwards"] >= 20, called


def test_a_controller_with_a_memory_keeps_the_audit_and_is_reset():
    class Filtered:
        """By filtered rates that are one sample late."""

        def __init__(self):
            self.resets = 0

        def reset(self):
            self.resets += 1
            self.rates = np.zeros(6)
            self.late = np.zeros(6)

        def __call__(self, time, state, desired):
            self.rates = self.rates + 0.8 * (self.late - self.rates)
            self.late = state.joint_rates.copy()
            error = desired.joint_angles - state.joint_angles
            return 49.0 * error + 14.0 * (desired.joint_rates - self.rates)

    control = Filtered()
    result = pc.run(PAPER, control, sample_time=0.01)
    assert result.audit_failures == [] and control.resets == 1
    again = pc.run(PAPER, control, sample_time=0.01)
    np.testing.assert_array_equal(
        again.cases["case1"].series["arm1_joint1_angle"], result.cases["case1"].series["arm1_joint1_angle"]
    )


def test_after_a_capture():
    text = PAPER.read_text()
    starts = []

    def hold(time, state, desired):
        if time == 0.0:
            starts.append(desired.joint_angles.copy())
            np.testing.assert_array_equal(desired.joint_angles, state.joint_angles)
        return 20.0 * (desired.joint_angles - state.joint_angles) - 20.0 * state.joint_rates

    free = pc.run(text, sample=1.0)
    held = pc.run(text, post_capture_control=hold, sample_time=0.1, sample=1.0)
    assert len(starts) == 3 and not [failure for failure in held.audit_failures if "overlap" not in failure]

    def rate(result):
        return np.abs(result.cases["case1"].series["arm1_joint1_rate"][-1])

    assert rate(held) < 0.1 * rate(free)
    assert held.cases["case1"].summary["post_impact"]["remainder"]["control"] == "python"


def test_what_it_raises_is_raised():
    class Odd(Exception):
        pass

    def control(time, state, desired):
        if time > 1.0:
            raise Odd(f"at {time}")
        return np.zeros(6)

    with pytest.raises(Odd, match=r"at 1\.05") as raised:
        pc.run(PAPER, control, sample_time=0.05)
    assert any(entry.name == "control" for entry in raised.traceback)


@pytest.mark.parametrize(
    ("returned", "found"),
    [
        (np.zeros(5), r"an array of shape \(5,\)"),
        (np.full(6, np.nan), "nan"),
        (None, "None"),
        ("abc", "'abc'"),
        (1.0, "1.0"),
    ],
)
def test_wrong_torques_are_named(returned, found):
    with pytest.raises(pc.InputError, match=rf"at t = 0.0 s the controller returned .*{found}.*expected 6 finite"):
        pc.run(PAPER, lambda *_: returned, sample_time=0.05)


def test_a_sample_time_is_needed_and_whole_steps():
    with pytest.raises(pc.InputError, match="sample_time"):
        pc.run(PAPER, proportional_derivative)
    with pytest.raises(pc.InputError, match=r"multiple of the step of `approach`, 0\.005 s"):
        pc.run(PAPER, proportional_derivative, sample_time=0.0123)
    # 20 s have no whole number of steps of 0.03 s: they are shorter
    shorter = PAPER.read_text().replace("step = 0.005", "step = 0.03", 1)
    with pytest.raises(pc.InputError, match=r"multiple of the step of `approach`, 0\.02998\d* s"):
        pc.run(shorter, proportional_derivative, sample_time=0.06)
    for wrong in (0.0, -1.0, np.nan):
        with pytest.raises(pc.InputError, match="sample_time is"):
            pc.run(PAPER, proportional_derivative, sample_time=wrong)
    with pytest.raises(pc.InputError, match="expected a callable"):
        pc.run(PAPER, 5, sample_time=0.05)


@pytest.mark.parametrize(("name", "before"), [("redysim_single_arm_3r", True), ("raina_shah_2017", False)])
def test_a_gain_that_is_too_high_is_said_of_the_controller(name, before):
    text = (SCENARIOS / f"{name}.toml").read_text().replace('integrator = "rk4"', "")

    def control(time, state, desired):
        return 49.0 * (desired.joint_angles - state.joint_angles) - 1e6 * state.joint_rates

    laws = {"control": control} if before else {"post_capture_control": control}
    with pytest.raises(pc.ComputationError) as raised:
        pc.run(text, **laws, sample_time=0.01)
    message = str(raised.value)
    assert re.search(r"stopped at t = [\d.e-]+ s", message) and "the law's torques change too fast" in message
    assert "sample time, 0.01 s" in message
    assert "-->" not in message and "_gain" not in message


def test_states_are_of_the_inertial_frame_and_belong_to_the_controller():
    kept = []

    def control(time, state, desired):
        kept.append(state)
        return np.zeros(6)

    text = PAPER.read_text().replace("[initial]", "[initial]\nbase_pose = [0.1, 1000.0, -2000.0]", 1)
    text = text.replace("duration = 20.0", "duration = 1.0", 1)
    pc.run(text, control, sample_time=0.5)
    np.testing.assert_allclose(kept[0].base_pose, [0.1, 1000.0, -2000.0], rtol=1e-12)
    assert kept[0].joint_angles is not kept[1].joint_angles
