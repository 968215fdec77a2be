"""FMUs in FMPy: valid, and with the motion that `planar-capture run` computes by the same Runge-Kutta steps.

The paper's robot with other numbers than its layout has, which are parameters of the FMU, approaches under torques that
are held for a sample; the FMU takes these torques from the time series. First with the binary that `generate` has
compiled, then with one compiled from the sources alone, as buildDescription.xml lists them, by every compiler that is
found.

    PYTHON=$(python3 -m codegen.environment --dev)
    $PYTHON tests/fmu.py [planar-capture, or another command that runs it]

exits with 1 where something differs; without a C compiler `cc` with 3.
"""

import argparse
import csv
import math
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

ROOT = Path(__file__).resolve().parent.parent
LAYOUT = "dual_arm_3r"
SAMPLE, STEP, DURATION = 0.05, 0.005, 4.0
# Relative to 1 or to the largest value of a column: 800 steps of rounding in two orders of summation (1e-12 measured).
BOUND = 1e-9
WRENCH = ["base_wrench_n", "base_wrench_fx", "base_wrench_fy"]
WARNINGS = ["-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-pedantic", "-Werror"]
SCENARIO = f"""
name = "held"
layout = "other.toml"
[initial]
base_pose = [0.3, 0.2, -0.1]
base_twist = [0.002, 0.01, -0.005]
joint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]
[approach]
duration = {DURATION}
step = {STEP}
integrator = "rk4"
sample_time = {SAMPLE}
tracking = "pd"
trajectory = "cycloidal"
final_joint_angles = [0.5, -1.4, 0.8, 2.6, 1.3, -0.9]
"""


def check(holds: bool, message: str) -> None:
    if not holds:
        sys.exit(f"fmu: {message}")


def run(command: list[str], folder: Path) -> subprocess.CompletedProcess:
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"{' '.join(command)}: {result.returncode}\n{result.stdout}{result.stderr}")
    return result


def generate(command: list[str], layout: str, fmu: Path) -> None:
    """An FMU that FMPy finds no problem in."""
    run([*command, "generate", layout, "--fmu", "--out", fmu.name], fmu.parent)
    problems = validate_fmu(str(fmu))
    check(not problems, f"{layout} is not valid: {problems}")


def other_numbers(folder: Path) -> dict[str, float]:
    """Writes the layout with other numbers; the FMU's parameters that say the same."""
    values, lines = {}, []
    arm, link = 0, 0
    factor = 1.0
    for line in (ROOT / "codegen" / "layouts" / f"{LAYOUT}.toml").read_text().splitlines():
        key, _, rest = line.partition("=")
        key, number = key.strip(), rest.split("#")[0].strip()
        arm, link = arm + (line == "[[arm]]"), 0 if line == "[[arm]]" else link + (line == "[[arm.link]]")
        owner = "base" if arm == 0 else f"arm{arm}_link{link}" if link else f"arm{arm}"
        if key in {"length", "mass", "inertia"}:
            factor += 0.01
            values[f"{owner}_{key}"] = float(number) * factor
            line = f"{key} = {values[f'{owner}_{key}']!r}"
            if key == "length":
                values[f"{owner}_com_x"] = 0.45 * values[f"{owner}_length"]
                line += f"\ncom = [{values[f'{owner}_com_x']!r}, {0.02 if link == 3 else 0.0}]"
                if link == 3:
                    values[f"{owner}_com_y"] = 0.02
        elif key == "mount":
            factor += 0.01
            values[f"{owner}_mount_x"] = tomllib.loads(line)["mount"][0] * factor
            line = f"mount = [{values[f'{owner}_mount_x']!r}, 0.0]"
        elif key == "outline":
            continue
        lines.append(line)
    (folder / "other.toml").write_text("\n".join(lines) + "\n")
    return values


def reference(command: list[str], folder: Path) -> dict[str, np.ndarray]:
    """The columns of `run`'s time series, by their names without units."""
    (folder / "held.toml").write_text(SCENARIO)
    run([*command, "run", "held.toml", "--out", "results", "--sample", str(SAMPLE)], folder)
    with (folder / "results" / "held.csv").open() as file:
        rows = list(csv.DictReader(file))
    return {
        name.split(" [")[0]: np.array([float(row[name]) for row in rows]) for name in rows[0] if name not in {"phase"}
    }


def compare(found, expected: dict[str, np.ndarray], what: str) -> float:
    """The largest difference of an FMU's outputs from the time series."""
    worst = 0.0
    for name in found.dtype.names:
        difference = np.abs(found[name] - expected[name]).max() / max(1.0, np.abs(expected[name]).max())
        check(difference < BOUND, f"{what}: {name} differs by {difference}")
        worst = max(worst, difference)
    return worst


def simulate(fmu: Path, start: dict[str, float], expected: dict[str, np.ndarray]):
    """FMPy's own simulation with the torques of the time series."""
    torques = [name for name in expected if name.endswith("_torque")]
    signals = np.zeros(len(expected["time"]), [(name, float) for name in ["time", *torques, *WRENCH]])
    for name in ["time", *torques]:
        signals[name] = expected[name]
    outputs = [v.name for v in fmpy.read_model_description(fmu).modelVariables if v.causality == "output"]
    check(len(outputs) == 18 + 12 + 4 and len(torques) == 6, f"{len(outputs)} outputs")
    result = fmpy.simulate_fmu(
        str(fmu), stop_time=DURATION, output_interval=SAMPLE, start_values=start, input=signals, output=outputs
    )
    check(np.abs(result["time"] - expected["time"]).max() < 1e-12, "other times")
    return result


class Instance:
    """An instance in step mode, with its messages."""

    def __init__(self, folder: Path, start: dict[str, float], name: str = "robot"):
        description = fmpy.read_model_description(folder)
        self.places = {v.name: v.valueReference for v in description.modelVariables}
        self.variables = description.modelVariables
        self.messages: list[str] = []
        token, identifier = description.guid, description.coSimulation.modelIdentifier
        self.fmu = FMU3Slave(guid=token, unzipDirectory=str(folder), modelIdentifier=identifier, instanceName=name)
        self.fmu.instantiate(logMessage=lambda *arguments: self.messages.append(arguments[-1].decode()))
        self.start(start)

    def start(self, start: dict[str, float]) -> None:
        for variable in self.variables:  # values before anything is set
            if variable.start is not None:
                check(self[variable.name] == float(variable.start), f"{variable.name} starts at {self[variable.name]}")
        for name, value in start.items():
            self[name] = value
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.time = 0.0

    def __getitem__(self, name: str) -> float:
        return self.fmu.getFloat64([self.places[name]])[0]

    def __setitem__(self, name: str, value: float) -> None:
        self.fmu.setFloat64([self.places[name]], [value])

    def step(self, length: float) -> None:
        self.fmu.doStep(self.time, length)
        self.time += length

    def outputs(self) -> list[float]:
        return self.fmu.getFloat64([v.valueReference for v in self.variables if v.causality == "output"])

    def refuses(self, function, message: str) -> None:
        """A call that has to fail, with a message, and to change nothing."""
        before, self.messages[:] = self.outputs(), []
        try:
            function()
        except FMICallException as problem:
            said = "".join(self.messages)
            check(problem.status == 3 and message in said, f"`{said}` has no `{message}`")
            check(self.outputs() == before, f"{message}: the state is another one")
        else:
            check(False, f"{message}: no error")


def behave(folder: Path, start: dict[str, float]) -> None:
    """Instances: division of steps, independence, saved states, the law of momentum, errors."""
    one, other = Instance(folder, start, "one"), Instance(folder, start | {"internal_step": 0.05 / 3}, "other")
    heavy = Instance(folder, start | {"base_mass": 5000.0, "internal_step": 0.02}, "heavy")
    fine = Instance(folder, start | {"internal_step": 0.02}, "fine")
    for i in range(20):
        for instance in (one, other, heavy, fine):
            instance["arm1_joint1_torque"] = math.sin(i)
            # one component at a time
            for k, (name, value) in enumerate(zip(WRENCH, (0.5, 8.0, -4.0), strict=True)):
                instance[name] = value if i % 4 == k else 0.0
        # 0.05 is divided into three steps by an internal step of 0.02, as it is by one of a third of it
        fine.step(0.05)
        heavy.step(0.05)
        for _ in range(3):
            other.step(0.05 / 3)
        one.step(0.05)
    difference = max(abs(a - b) for a, b in zip(fine.outputs(), other.outputs(), strict=True))
    check(difference < 1e-12, f"three steps are not three steps: {difference}")
    difference = max(abs(a - b) for a, b in zip(fine.outputs(), one.outputs(), strict=True))
    check(0.0 < difference < 1e-3, f"an internal step of 0.02 s instead of 0.001 s makes a difference of {difference}")
    check(abs(heavy["base_x"] - fine["base_x"]) > 1e-5, "a parameter of one instance is that of another")
    # the momentum is what the wrench has given
    momentum = (fine["linear_momentum_x"], fine["linear_momentum_y"])
    check(np.allclose(momentum, (2.0, -1.0), rtol=0, atol=1e-9), f"momentum {momentum} after [2, -1] N s")
    turned = Instance(folder, start)
    turned["base_wrench_n"] = 2.0
    turned.step(0.05)
    check(abs(turned["angular_momentum"] - 0.1) < 1e-12, f"{turned['angular_momentum']} N m s after 0.1 N m s")

    saved = fine.fmu.getFMUState()
    written = fine.fmu.serializeFMUState(saved)
    time = fine.time
    fine.step(0.05)
    after = fine.outputs()
    for state in (saved, fine.fmu.deserializeFMUState(written)):
        fine.fmu.setFMUState(state)
        fine.time = time
        fine.step(0.05)
        check(fine.outputs() == after, "a saved state is another one")
        fine.fmu.freeFMUState(state)
    fine.refuses(lambda: fine.fmu.deserializeFMUState(b"x" + written[1:]), "not a state of this FMU")

    fine["arm2_joint1_torque"] = math.nan
    fine.refuses(lambda: fine.step(0.05), "not finite")
    fine["arm2_joint1_torque"] = 0.0
    fine.refuses(lambda: fine.step(0.0), "not above 0")
    fine.refuses(lambda: fine.step(math.inf), "not above 0")
    fine.refuses(lambda: fine.step(1e8), "a billion")
    fine.refuses(lambda: fine.fmu.doStep(0.5, 0.05), "not the end of the last step")
    fine.refuses(lambda: fine.fmu.setFloat64([fine.places["base_mass"]], [1.0]), "cannot be set now")
    fine.refuses(lambda: fine.fmu.setFloat64([fine.places["arm1_tip_x"]], [1.0]), "cannot be set now")
    fine.refuses(lambda: fine.fmu.getFloat64([10_000]), "no such value reference")
    fine.refuses(lambda: fine.fmu.enterInitializationMode(), "not in this mode")
    fine.step(0.05)
    fine.fmu.terminate()

    fine.fmu.reset()
    fine.start(start | {"internal_step": 0.02})
    check(abs(fine["base_x"]) == 0.0, "reset does not reset")
    for name, value, message in [
        ("base_mass", math.nan, "parameters"),
        ("arm1_link1_length", 0.0, "parameters"),
        ("internal_step", 0.0, "internal_step is not above 0"),
    ]:
        fine.fmu.reset()
        try:
            fine.start(start | {name: value})
        except FMICallException:
            check(message in fine.messages[-1], fine.messages[-1])
        else:
            check(False, f"{name} of {value}: no error")
    for instance in (one, other, heavy, fine, turned):
        instance.fmu.freeInstance()


def build(folder: Path, compiler: str) -> None:
    """Compiles the binary from the sources that buildDescription.xml lists."""
    description = fmpy.read_model_description(folder)
    (configuration,) = description.buildConfigurations
    (files,) = configuration.sourceFileSets
    check(files.language == "C99" and not files.preprocessorDefinitions, "another language")
    target = folder / "binaries" / fmpy.platform_tuple
    target.mkdir(parents=True)
    library = target / f"{configuration.modelIdentifier}{fmpy.sharedLibraryExtension}"
    arguments = ["-std=c99", "-O1", "-fPIC", "-shared", *WARNINGS, "-o", str(library), *files.sourceFiles]
    run([compiler, *arguments], folder / "sources")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", nargs="*", default=["planar-capture"])
    command = parser.parse_args().command
    command[0] = str(Path(shutil.which(command[0]) or command[0]).resolve())
    compilers = [name for name in ("cc", "clang") if shutil.which(name)]
    if "cc" not in compilers:
        print("fmu: nothing was checked, for there is no `cc`")
        sys.exit(3)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        numbers = other_numbers(folder)
        expected = reference(command, folder)
        fmu = folder / "robot.fmu"
        generate(command, LAYOUT, fmu)
        # names that XML has to escape
        text = (folder / "other.toml").read_text()
        (folder / "named.toml").write_text(text.replace('"arm1"', """'left "hand" <&> é'"""))
        generate(command, "named.toml", folder / "named.fmu")
        state = {
            name: values[0] for name, values in expected.items() if name.startswith("base_") or name[-6:] == "_angle"
        }
        start = numbers | state | {"internal_step": STEP}
        worst = compare(simulate(fmu, start, expected), expected, "binary")
        for compiler in compilers:
            unpacked = folder / compiler
            fmpy.extract(fmu, unpacked)
            shutil.rmtree(unpacked / "binaries")
            build(unpacked, compiler)
            worst = max(worst, compare(simulate(unpacked, start, expected), expected, f"sources with {compiler}"))
        joints = {name: value for name, value in state.items() if name.endswith("_angle")}
        behave(folder / "cc", joints)
        names = ", ".join(compilers)
        print(f"fmu: valid; {DURATION} s with held torques as `run`, largest difference {worst:.1e}; {names}")


if __name__ == "__main__":
    main()
