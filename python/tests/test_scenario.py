"""Studies against the command's files."""

import csv
import json
import re

import numpy as np
import planar_capture as pc
import pytest
from conftest import SCENARIOS

STUDIES = ["raina_shah_2017", "elastic_rebound", "redysim_single_arm_3r", "three_arms"]


SET = 'set = { "layout.base.mass" = 480.0, "approach.duration" = 12.0 }'


def with_set(folder, *names):
    """The paper's scenario, cases of which have values of their own."""
    text = (SCENARIOS / "raina_shah_2017.toml").read_text().replace("duration = 50.0", "duration = 1.0")
    for name in names:
        assert f'name = "{name}"\n' in text
        text = text.replace(f'name = "{name}"\n', f'name = "{name}"\n{SET}\n')
    file = folder / "it.toml"
    file.write_text(text)
    return file


@pytest.mark.parametrize("name", STUDIES)
def test_summary_series_and_report_are_those_of_the_command(name, command, tmp_path):
    same_as_the_command(SCENARIOS / f"{name}.toml", name, command, tmp_path)


def test_cases_with_values_of_their_own_are_those_of_the_command(command, tmp_path):
    result = same_as_the_command(with_set(tmp_path, "case2"), "raina_shah_2017", command, tmp_path)
    assert list(result.cases) == ["case1", "case2", "case3"]
    assert result.cases["case2"].summary["set"] == {"layout.base.mass": 480.0, "approach.duration": 12.0}
    assert 12.0 < result.cases["case2"].series["t"][-1] < 14.0 < 20.0 < result.cases["case3"].series["t"][-1]
    # the report is on all cases, or on those of one approach
    result.report(tmp_path / "own.html", case="case2")
    result.report(tmp_path / "shared.html", case="case1")
    own, shared, both = ((tmp_path / path).read_text() for path in ("own.html", "shared.html", "report.html"))
    names = [f'"name":"case{i}"' for i in (1, 2, 3)]
    assert [[name in page for name in names] for page in (own, shared, both)] == [
        [False, True, False],
        [True, False, True],
        [True, True, True],
    ]
    assert result._repr_html_().count("<iframe") == 1
    with pytest.raises(pc.InputError, match="there is no case `light`"):
        result.report(tmp_path / "none.html", case="light")


def test_cases_that_all_have_values_of_their_own(tmp_path):
    result = pc.run(with_set(tmp_path, "case1", "case2", "case3"), sample=1.0)
    assert list(result.cases) == ["case1", "case2", "case3"] and result._repr_html_().count("<iframe") == 1
    result.report(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert all(f'"name":"{name}"' in page for name in result.cases)
    # each has the approach of its own, and those of a controller in Python
    scenario = pc.Scenario.from_toml(with_set(tmp_path, "case3"))
    times = []

    def control(time, state, desired):
        times.append(time)
        return 49.0 * (desired.joint_angles - state.joint_angles) - 14.0 * state.joint_rates

    scenario.run(control, sample_time=0.01, sample=1.0)
    assert sum(time == 0.0 for time in times) == 2 and max(times) > 19.0


def test_other_values_beside_those_of_a_case(tmp_path):
    scenario = pc.Scenario.from_toml(with_set(tmp_path, "case2"))
    assert scenario.cases == ["case1", "case2", "case3"]
    changed = scenario.with_values({"target.target1.mass": 12.0}, case="case2")
    assert changed.cases == ["case2"] and changed.robot.parameters["base_mass"].value == 480.0


def same_as_the_command(file, name, command, tmp_path):
    done = command("run", file, "--out", tmp_path / "out", "--report")
    assert done.returncode in (0, 1), done.stderr
    result = pc.run(file)
    expected = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert "files" in expected and expected["run"].pop("command")
    del expected["files"], expected["run"]["features"]
    found = json.loads(json.dumps(result.summary))
    assert found["run"].pop("command") == f"planar_capture.run('{name}')"
    del found["run"]["features"]
    assert found == expected
    assert bool(result.audit_failures) == (done.returncode == 1)
    assert str(result) in done.stdout
    for case, values in result.cases.items():
        text = (tmp_path / "out" / f"{case}.csv").read_text()
        heading, *rows = csv.reader(text.splitlines())
        assert heading[:2] == ["time [s]", "phase"]
        units = values.series.units
        assert units["t"] == "s" and set(units) == set(values.series) - {"phase"}
        assert heading[2:] == [f"{column} [{units[column]}]" for column in list(values.series)[2:]]
        for place, column in enumerate(values.series):
            written = [row[place] for row in rows]
            if column == "phase":
                assert values.series[column].tolist() == written
            else:
                np.testing.assert_array_equal(values.series[column], np.array(written, dtype=float))
        values.to_csv(tmp_path / "again.csv")
        assert (tmp_path / "again.csv").read_text() == text
    result.report(tmp_path / "report.html")
    said = [(tmp_path / path).read_text() for path in ("report.html", "out/report.html")]
    assert len(said[0]) > 100_000 and said[0][:5000] == said[1][:5000]
    return result


def test_scenarios_from_text():
    text = (SCENARIOS / "redysim_single_arm_3r.toml").read_text()
    scenario = pc.Scenario.from_toml(text)
    assert scenario.name == "redysim_single_arm_3r" and scenario.robot.arms == ["arm1"]
    result = scenario.run()
    assert result.dynamics == "generated" and not result.audit_failures
    assert result.series["t"][0] == 0.0 and (np.diff(result.series["t"]) >= 0).all()
    with pytest.raises(KeyError):
        result.series["nothing"]


def test_messages_are_those_of_the_command(command, tmp_path):
    text = (SCENARIOS / "raina_shah_2017.toml").read_text()
    broken = {
        "negative": text.replace("duration = 20.0", "duration = -20.0", 1),
        "unknown": text.replace("tracking", "traking", 1),
        # valid, but without a result
        "gains": text.replace("= 49.0", "= 49000000.0", 1).replace("= 14.0", "= 14000000.0", 1),
    }
    for name, content in broken.items():
        assert content != text
        file = tmp_path / f"{name}.toml"
        file.write_text(content)
        said = command("run", file, "--out", tmp_path / "out", "-q")
        expected = {1: pc.ComputationError, 2: pc.InputError}[said.returncode]
        with pytest.raises(expected) as raised:
            pc.run(file)
        assert raised.value.exit_code == said.returncode
        assert str(raised.value).strip() == said.stderr.strip()
    with pytest.raises(pc.InputError, match="dynamics is `fast`"):
        pc.run(SCENARIOS / "three_arms.toml", dynamics="fast")
    with pytest.raises(pc.InputError, match=r"sample is -1\.0"):
        pc.run(SCENARIOS / "three_arms.toml", sample=-1.0)


def test_engines_agree():
    file = SCENARIOS / "redysim_dual_arm_3r.toml"
    compiled, graph, generic = (pc.run(file, dynamics=engine) for engine in ("generated", "graph", "generic"))
    assert (compiled.dynamics, graph.dynamics, generic.dynamics) == ("generated", "graph", "generic")
    for column in compiled.series:
        np.testing.assert_array_equal(compiled.series[column], graph.series[column])
    np.testing.assert_allclose(generic.series["base_yaw"], graph.series["base_yaw"], atol=1e-8)


def test_several_cases_have_to_be_chosen():
    result = pc.run(SCENARIOS / "raina_shah_2017.toml", sample=1.0)
    assert list(result.cases) == ["case1", "case2", "case3"]
    with pytest.raises(pc.InputError, match="case1, case2, case3"):
        _ = result.series
    assert result.cases["case2"].summary["impact"]["exact"]["impulse_magnitudes"][0] > 0.1


def test_data_frames_and_tables():
    series = pc.run(SCENARIOS / "redysim_single_arm_3r.toml", sample=1.0).series
    frame = series.to_pandas()
    assert list(frame) == list(series) and frame.attrs["units"]["base_yaw"] == "rad"
    np.testing.assert_array_equal(frame["base_yaw"], series["base_yaw"])
    table = series.to_arrow()
    assert table.column_names == list(series)
    assert table.schema.field("base_yaw").metadata == {b"unit": b"rad"}
    np.testing.assert_array_equal(table["base_yaw"].to_numpy(), series["base_yaw"])


def test_a_notebook_shows_the_report():
    shown = pc.run(SCENARIOS / "redysim_single_arm_3r.toml", sample=1.0)._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!') and shown.endswith("</iframe>")
    # the page is in the attribute to its end
    assert shown.count('"') == 4 and "<" not in shown[7:-9].split('"')[1]


def test_results_that_cannot_be_written(tmp_path):
    result = pc.run(SCENARIOS / "redysim_single_arm_3r.toml", sample=1.0)
    (tmp_path / "file").write_text("")
    with pytest.raises(pc.OutputError) as raised:
        result.report(tmp_path / "file" / "report.html")
    assert isinstance(raised.value, OSError) and "report.html" in str(raised.value)


def test_other_values_are_those_of_another_file():
    file = SCENARIOS / "redysim_single_arm_3r.toml"
    scenario = pc.Scenario.from_toml(file)
    changed = scenario.with_values({"approach.derivative_gain": 2.5, "layout.base.mass": 450.0})
    assert changed.robot.parameters["base_mass"].value == 450.0
    text = changed.text.replace('"./layout.toml"', '"single_arm_3r"')
    assert "derivative_gain = 2.5" in text
    found, same = changed.run(sample=1.0), scenario.run(sample=1.0)
    assert not np.array_equal(found.series["base_yaw"], same.series["base_yaw"])
    back = changed.with_values({"layout.base.mass": scenario.robot.parameters["base_mass"].value})
    only_gain = scenario.with_values({"approach.derivative_gain": 2.5}).run(sample=1.0)
    np.testing.assert_array_equal(back.run(sample=1.0).series["base_yaw"], only_gain.series["base_yaw"])
    assert scenario.with_values({"approach.tracking": "computed_torque"}).run(sample=1.0).series["t"].size
    paper = pc.Scenario.from_toml(SCENARIOS / "raina_shah_2017.toml")
    assert paper.with_values({"target.target1.mass": 12.0}, case="case2").cases == ["case2"]
    for wrong, message in [
        ({"approach.derivative_gains": 1.0}, "derivative_gains"),
        ({"layout.base.mass": -1.0}, "-1.0"),
        ({"layout.base.mass": "heavy"}, "heavy"),
        ({"layout.base": 1.0}, "layout.base"),
        ({"": 1.0}, "key"),
    ]:
        with pytest.raises(pc.InputError, match=message):
            scenario.with_values(wrong)
    # no line of a text that the user has not seen
    for wrong, message in [
        ({"layout.base.mass": "x"}, 'key `layout.base.mass` = "x": `base.mass` is "x", expected a mass in kg'),
        ({"layout.base.mass": "480.0"}, "write the number without quotes"),
        ({"approach.duration": -3}, "key `approach.duration` = -3.0: `approach.duration` is -3.0, expected"),
        ({"approach.duration": -3, "layout.base.mass": -1}, "key `layout.base.mass` = -1.0: `base.mass` is -1.0"),
        ({"approach.final_joint_rates[0]": 1.0}, "key `approach.final_joint_rates[0]` = 1.0: "),
    ]:
        with pytest.raises(pc.InputError) as raised:
            changed.with_values(wrong)
        assert message in str(raised.value) and "-->" not in str(raised.value)
        assert ("quotes" in str(raised.value)) == ("quotes" in message)
    # what shows in a run is shown in the text that has the values
    gains = {"approach.derivative_gain": 1e7, "layout.base.mass": 450.0}
    for stiff in (scenario.with_values(gains), changed.with_values(gains)):
        with pytest.raises(pc.ComputationError) as raised:
            stiff.run(sample=1.0)
        line = re.search(r"--> \S+redysim_single_arm_3r\.toml, with other values:(\d+):", str(raised.value))[1]
        assert stiff.text.splitlines()[int(line) - 1] in str(raised.value)
    with pytest.raises(pc.InputError, match="case is missing, expected one of the scenario's cases, case1, case2"):
        paper.with_values({"target.target1.mass": 12.0})
