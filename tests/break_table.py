"""Makes deliberate faults, one at a time, and prints the tests that detect each: the break table of tests/README.md.

``python3 tests/break_table.py [--jobs N] [--only NAME ...] [--check]`` works on copies of the tracked files in a
temporary folder and does not change the repository. After a fault in the derivation the graphs are derived again, so
that only their numbers are wrong. Exits with 1 if a fault is not detected, or if its text is not found exactly once;
``--check`` looks for the texts only.
"""

import argparse
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# from formulas to what a user sees
BINARIES = ["models", "contacts", "studies", "commands"]


@dataclass(frozen=True)
class Fault:
    """A replacement of one text in one file."""

    name: str
    file: str
    old: str
    new: str

    @property
    def in_derivation(self) -> bool:
        return self.file.endswith(".py")


FAULTS = [
    # derivation
    Fault(
        "sign of a centripetal term",
        "codegen/composite_inertia.py",
        "moment = self.joints[k + 1] + moment - cross(arm.link[k], total)",
        "moment = self.joints[k + 1] + moment + cross(arm.link[k], total)",
    ),
    Fault(
        "coupling of base and joints with its rows exchanged",
        "codegen/equations_of_motion.py",
        "m[first + k, 1], m[first + k, 2] = perpendicular(arm.first_moment[k])",
        "m[first + k, 2], m[first + k, 1] = perpendicular(arm.first_moment[k])",
    ),
    Fault(
        "generalized bias without the base's moment",
        "codegen/reduced_dynamics.py",
        "reduced.append(bias - cross(self.com_lever[k], force) - self.rotation_response[k] * moment)",
        "reduced.append(bias - cross(self.com_lever[k], force))",
    ),
    Fault(
        "R for −R in the derived contact Jacobian",
        "codegen/impact.py",
        "[angular, x + contact[1] * angular, y - contact[0] * angular]",
        "[angular, x - contact[1] * angular, y + contact[0] * angular]",
    ),
    Fault(
        "targets of the arms exchanged",
        "codegen/impact.py",
        "target_jacobian(jacobian, arm, (",
        "target_jacobian(jacobian, inputs.contacts.shape[1] - 1 - arm, (",
    ),
    Fault(
        "fill-in of the elimination dropped",
        "codegen/linear_algebra.py",
        "for j in [j for j in column if j <= i]:",
        "for j in [j for j in column if j <= i and (i, j) in work]:",
    ),
    Fault(
        "matrices stored by columns",
        "codegen/signatures.py",
        "[dense[i, j] for i in range(rows) for j in range(columns)]",
        "[dense[i, j] for j in range(columns) for i in range(rows)]",
    ),
    Fault(
        "inertia about the child's joint from the distance of the own joint",
        "codegen/articulated_body.py",
        "own.mass * (to_child * to_child)) * square",
        "own.mass * (com * com)) * square",
    ),
    Fault(
        "share of a short link by a difference",
        "codegen/articulated_body.py",
        "self.own_share = across * self.inverse  # f",
        "self.own_share = 1 - ratios.coupling * self.inverse",
    ),
    Fault(
        "sign of a link's rate in the derivative by its angle",
        "codegen/acceleration_derivatives.py",
        "angle[row] = angle[row] + part.squares[k]",
        "angle[row] = angle[row] - part.squares[k]",
    ),
    Fault(
        "mount angle forgotten in the kinematics",
        "codegen/kinematics.py",
        "angle = inputs.base_pose[0] + self.symbols.mount_angle",
        "angle = inputs.base_pose[0]",
    ),
    # renderer and template
    Fault(
        "operands of a difference exchanged",
        "crates/planar-build/src/renderer/statements.rs",
        "infix(syntax, &a, '-', &b, Precedence::Sum)",
        "infix(syntax, &b, '-', &a, Precedence::Sum)",
    ),
    Fault(
        "sine and cosine exchanged",
        "crates/planar-build/src/renderer/syntax.rs",
        'format!("({s}, {c})")',
        'format!("({c}, {s})")',
    ),
    Fault(
        "order of a Runge–Kutta step's weights in C",
        "crates/planar-build/templates/steps.c.tera",
        "{(real)1.0, (real)2.0, (real)2.0, (real)1.0}",
        "{(real)2.0, (real)1.0, (real)2.0, (real)1.0}",
    ),
    Fault(
        "singular systems with status 0 in C",
        "crates/planar-build/templates/module.c.tera",
        "        status = SINGULAR;",
        "        status = DONE;",
    ),
    Fault(
        "contacts of the arms exchanged in a standalone module's merging",
        "crates/planar-build/templates/steps.rs.tera",
        "contact: contacts[{{ arm.index }}],",
        "contact: contacts[ARMS - 1 - {{ arm.index }}],",
    ),
    Fault(
        "a nonzero dropped: [5][0] of 6 × 6 results",
        "crates/planar-build/src/renderer/statements.rs",
        "let elements: Vec<String> = output.elements.iter().map(|element| self.operand(element)).collect();",
        "let mut elements: Vec<String> = output.elements.iter().map(|element| self.operand(element)).collect();\n"
        '        if elements.len() == 36 {\n            elements[30] = "T::ZERO".to_owned();\n        }',
    ),
    Fault(
        "constants from the defaults, not the values",
        "crates/planar-build/templates/model.rs.tera",
        """\
{{ constants.statements }}
        Self {
            parameters,
""",
        """\
        let given = parameters;
        let parameters = Parameters::<T>::default();
{{ constants.statements }}
        Self {
            parameters: given,
""",
    ),
    # runtime
    Fault(
        "structural zero ignored",
        "crates/planar-layout/src/structure.rs",
        'None => differ(key(), value, "an exact zero, which costs no operations"),',
        "None => {}",
    ),
    Fault(
        "layout hash without the COM's y",
        "crates/planar-layout/src/layout.rs",
        """\
                    (Kind::LinkComY, i, k, link.com[1]),
""",
        "",
    ),
    Fault(
        "link of one arm merged at the angle of another",
        "crates/planar-dynamics/src/implement.rs",
        "targets.iter().zip(&end_effectors).zip(MANIFEST.links)",
        "targets.iter().zip(end_effectors.iter().rev()).zip(MANIFEST.links)",
    ),
    Fault(
        "merged inertia without the parallel axis term",
        "crates/planar-dynamics/src/target.rs",
        "link.inertia + self.inertia + reduced * (offset[0] * offset[0] + offset[1] * offset[1])",
        "link.inertia + self.inertia",
    ),
    Fault(
        "R for −R in the contact Jacobian",
        "crates/planar-dynamics/src/target.rs",
        "[[one, zero, zero], [-ry, one, zero], [rx, zero, one]]",
        "[[one, zero, zero], [ry, one, zero], [-rx, zero, one]]",
    ),
    Fault(
        "sign of the impulse's moment",
        "crates/planar-dynamics/src/target.rs",
        "[spin + ry * fx - rx * fy, fx, fy]",
        "[spin - ry * fx + rx * fy, fx, fy]",
    ),
    Fault(
        "momentum of eq. (17) about the origin, not the base",
        "crates/planar-dynamics/src/momentum_equation.rs",
        "[l - (x * py - y * px), px, py]",
        "[l - T::ZERO * (x * py - y * px), px, py]",
    ),
    Fault(
        "eq. (7) without the factor T",
        "crates/planar-dynamics/src/trajectory/quartic.rs",
        "[T::ZERO, *self.final_rates.get(joint)?]",
        "[T::ZERO, *self.final_rates.get(joint)? / self.motion.duration]",
    ),
    Fault(
        "gains of the controller exchanged",
        "crates/planar-dynamics/src/control/proportional_derivative.rs",
        "*torque = *kp * (desired.angle - *angle) + *kv * (desired.rate - *rate);",
        "*torque = *kv * (desired.angle - *angle) + *kp * (desired.rate - *rate);",
    ),
    Fault(
        "weights of the Runge–Kutta stages",
        "crates/planar-dynamics/src/integrate/runge_kutta4.rs",
        "(half, two, half), (half, two, step), (step, T::ONE, T::ZERO)",
        "(half, two, half), (half, T::ONE, step), (step, two, T::ZERO)",
    ),
    Fault(
        "sign of the work in the audit",
        "src/simulate/conservation.rs",
        "now.kinetic_energy - self.start.kinetic_energy - input.work",
        "now.kinetic_energy - self.start.kinetic_energy + input.work",
    ),
    Fault(
        "scale of the audit twice too large",
        "src/simulate/conservation.rs",
        "if self.scale == 0.0 { 0.0 } else { self.deviation / self.scale }",
        "if self.scale == 0.0 { 0.0 } else { self.deviation / (2.0 * self.scale) }",
    ),
    Fault(
        "angular momentum left out of the drift",
        "src/simulate/conservation.rs",
        "Real::maximum(self.linear.value(), self.angular.value())",
        "self.linear.value()",
    ),
    Fault(
        "sign in the angular scale of the audit",
        "src/simulate/bodies.rs",
        "mass * (x * vy - y * vx).abs()",
        "mass * (x * vy + y * vx).abs()",
    ),
    Fault(
        "compare without an exit code",
        "src/cli/compare.rs",
        "ExitCode::from(1)",
        "ExitCode::SUCCESS",
    ),
    Fault(
        "columns of the time series exchanged",
        "src/output/time_series/columns.rs",
        "&row.sample.state.joint_angles",
        "&row.sample.state.joint_rates",
    ),
    Fault(
        "audit without an exit code",
        "src/cli/run.rs",
        "ExitCode::from(1)",
        "ExitCode::from(0)",
    ),
    Fault(
        "centripetal term of the base in the generic implementation",
        "crates/planar-build/src/prove/generic/configuration.rs",
        "let mut linear = velocity[0] * quarter_turn(&self.arm_rate(0, body, velocity));",
        "let mut linear = -velocity[0] * quarter_turn(&self.arm_rate(0, body, velocity));",
    ),
    # contacts
    Fault(
        "sign of the moment arm of a contact",
        "crates/planar-dynamics/src/contact/constraint_row.rs",
        "n + (rx * fy - ry * fx)",
        "n - (rx * fy - ry * fx)",
    ),
    Fault(
        "constraint forces without the centripetal acceleration of the arms",
        "crates/planar-dynamics/src/contact/constraint_solver.rs",
        "(*ax + x, *ay + y)",
        "(*ax + T::ZERO * x, *ay + T::ZERO * y)",
    ),
    Fault(
        "constraint forces without the centripetal acceleration of the partner",
        "crates/planar-dynamics/src/contact/constraint_solver.rs",
        "? + omega * omega * row.partner_distance)",
        "? + T::ZERO * omega * row.partner_distance)",
    ),
    Fault(
        "offset of a constraint rotated the wrong way",
        "crates/planar-dynamics/src/contact/loop_constraint.rs",
        "offset: [cos * dx + sin * dy, cos * dy - sin * dx]",
        "offset: [cos * dx - sin * dy, cos * dy + sin * dx]",
    ),
    Fault(
        "restitution ignored",
        "crates/planar-dynamics/src/contact/impact.rs",
        "|e| e * *impulse",
        "|e| T::ZERO * e * *impulse",
    ),
    Fault(
        "angular momentum left about the base's position at the start",
        "src/simulate/translation.rs",
        "self.momentum.angular_momentum += moment(by, self.momentum.linear_momentum);",
        "",
    ),
    Fault(
        "stored samples left about the base's position at the start",
        "src/simulate/stored_samples.rs",
        "self.origin = Some(origin);",
        "let _ = origin;",
    ),
    # modules for other crates
    Fault(
        "last part of π/2 forgotten",
        "crates/planar-dynamics/src/scalar/sine.rs",
        "6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21]",
        "6.077_100_506_303_966e-11, 0.0]",
    ),
    Fault(
        "a far angle's quarter turns with the wrong sign",
        "crates/planar-dynamics/src/scalar/far_angle.rs",
        "(-x, quarters.wrapping_neg()) } else { (x, quarters) }\n}\n\n/// As",
        "(-x, quarters) } else { (x, quarters) }\n}\n\n/// As",
    ),
    Fault(
        "a batch with the second four angles first",
        "crates/planar-dynamics/src/scalar/sine_batch.rs",
        "let pairs = if from + 4 < N { eight(first, second) }",
        "let pairs = if from + 4 < N { eight(second, first) }",
    ),
    Fault(
        "a fused product without its sign",
        "crates/planar-build/src/renderer/fused.rs",
        "let sum = MultiplyAdd { a, b, addend, is_product_negative, is_addend_negative };",
        "let sum = MultiplyAdd { a, b, addend, is_product_negative: false, is_addend_negative };",
    ),
    Fault(
        "a regrouped difference as a sum",
        "codegen/regrouping.py",
        '"add" if sign == other else "sub"',
        '"add"',
    ),
    Fault(
        "the end of an approach without the robot's momentum",
        "src/capture/approach/exact_end.rs",
        "let spin = momentum.angular_momentum - (start[0] * py - start[1] * px);",
        "let spin = -(start[0] * py - start[1] * px);",
    ),
    Fault(
        "a minimum that drops what is not a number",
        "crates/planar-dynamics/src/scalar/float.rs",
        "if self < other || self.is_nan() { self } else { other }",
        "if other < self { other } else { self }",
    ),
    Fault(
        "a graph proved by nothing",
        "crates/planar-build/src/prove/mod.rs",
        "if error > 1.0 {",
        "if error > f64::MAX {",
    ),
    Fault(
        "a module's own test that always passes",
        "crates/planar-build/templates/self_test.rs.tera",
        "let within = difference <= bound;",
        "let within = difference <= bound || bound > 0.0;",
    ),
    Fault(
        "a stale graph rendered",
        "crates/planar-build/src/graph.rs",
        "if *found != wanted {",
        "if found.len() != wanted.len() {",
    ),
    Fault(
        "an edited module verified",
        "crates/planar-build/src/layouts.rs",
        "if hash == sha256(body) =>",
        "if hash.len() == sha256(body).len() =>",
    ),
    Fault(
        "sign of a URDF's axis",
        "src/urdf/chain.rs",
        "sign: if against { -1.0 } else { 1.0 },",
        "sign: if against { 1.0 } else { 1.0 },",
    ),
    Fault(
        "link inertia bound of a rod",
        "src/check/link.rs",
        "let largest = mass * (x * (length - x) + y * y);",
        "let largest = mass * (x * (length - x) / 3.0 + y * y);",
    ),
    # what is reported, audited and refused
    Fault(
        "error of a path a thousandth of what it is",
        "src/simulate/stepper/companion.rs",
        "Some(1.0 / (growth - 1.0))",
        "Some(1e-3 / (growth - 1.0))",
    ),
    Fault(
        "error of a path without an objection",
        "src/capture/mod.rs",
        '        ("path error", phase.path_error, PATH_BOUND),\n',
        "",
    ),
    Fault(
        "rate of opening never reported",
        "src/capture/mod.rs",
        '        ("rate of opening of what is held", phase.constraint_errors[1], CONSTRAINT_BOUND),\n',
        "",
    ),
    Fault(
        "further impacts not audited",
        "src/capture/mod.rs",
        "std::iter::once(&captured.impact).chain(captured.later_impacts.iter().map(|later| &later.impact));",
        "std::iter::once(&captured.impact);",
    ),
    Fault(
        "a centimetre of penetration passes",
        "src/capture/mod.rs",
        "pub const PENETRATION_BOUND: f64 = 1e-6;",
        "pub const PENETRATION_BOUND: f64 = 1e-2;",
    ),
    Fault(
        "report without mount angle",
        "src/output/html_report/data.rs",
        '"pose": frame.pose, "joint"',
        '"pose": [0.0, frame.pose[1], frame.pose[2]], "joint"',
    ),
    Fault(
        "mean force times duration in the summary",
        "src/output/summary.rs",
        "part / duration",
        "part * duration",
    ),
    Fault(
        "mean force times duration in the table",
        "src/output/console.rs",
        "exact / duration",
        "exact * duration",
    ),
    Fault(
        "sign of the base's work",
        "src/output/summary.rs",
        "json!(end.work.base_work)",
        "json!(-end.work.base_work)",
    ),
    Fault(
        "line of a repeated key",
        "src/eval/places.rs",
        "passed.iter().rposition(|passed| *passed == Some(path.len()))?;",
        "passed.iter().position(|passed| *passed == Some(path.len()))?;",
    ),
    Fault(
        "small offsets of a URDF taken for zero",
        "src/urdf/plane.rs",
        "component.abs() <= 1e-12 * scale",
        "component.abs() <= 1e-4 * scale",
    ),
    Fault(
        "missing results pass the proof",
        "crates/planar-build/src/prove/mod.rs",
        "if found.len() != state.expected.len() {",
        "if found.len() > state.expected.len() {",
    ),
    Fault(
        "another layout name than the file's",
        "crates/planar-build/src/layouts.rs",
        "if layout.name != name {",
        "if layout.name.is_empty() {",
    ),
    Fault(
        "saturation seen at samples only",
        "src/simulate/recorder.rs",
        "if sampled || !control.saturated().is_empty() || control.base_torque().is_some() {",
        "if sampled {",
    ),
    Fault(
        "largest joint rate counts wheels",
        "src/capture/residual_motion.rs",
        ".filter(|(_, wheel)| !**wheel)",
        ".filter(|_| true)",
    ),
    Fault(
        "impulse index of a bounce with a tangential impulse",
        "src/capture/contact_response.rs",
        "Some(_) => along.map(|part| part * of_both.effective_mass(along)),",
        "Some(_) => of_both.stopping_impulse(along),",
    ),
    Fault(
        "a miss of a thousandth passes the design",
        "src/capture/approach/terminal_rates.rs",
        "const RESIDUAL_TOLERANCE: f64 = 1e-9;",
        "const RESIDUAL_TOLERANCE: f64 = 1e-3;",
    ),
    Fault(
        "adaptive steps ignore the constraints",
        "src/integrate/adaptive.rs",
        "if restore(&mut x)? {",
        "if restore(&mut x)? && self.end < 0.0 {",
    ),
    Fault(
        "Gauss–Legendre stages settled at 2e-8",
        "crates/planar-dynamics/src/integrate/gauss_legendre.rs",
        "T::constant(1e3) * T::EPSILON * scale",
        "T::constant(1e8) * T::EPSILON * scale",
    ),
    Fault(
        "short events sought to 1e-4 of a step",
        "src/simulate/event_location.rs",
        "let tolerance = (end - start) * f64::EPSILON.sqrt();",
        "let tolerance = (end - start) * 1e-4;",
    ),
    Fault(
        "operations of the manifest without divisions",
        "crates/planar-build/src/renderer/doc_text.rs",
        'count(&["div"])',
        "count(&[])",
    ),
    Fault(
        "a module's own test without its parameters",
        "crates/planar-build/templates/self_test.rs.tera",
        "if expected.to_bits() != found.to_bits() {",
        "if expected.to_bits() != found.to_bits() && element > 1000 {",
    ),
    # hostile input
    Fault(
        "nesting of a URDF without a bound",
        "src/urdf/xml.rs",
        "if deepest > MAX_DEPTH {",
        "if deepest > usize::MAX - 1 {",
    ),
    Fault(
        "keys compared as they are written",
        "src/eval/places.rs",
        "if !inside.contains(&b'\\\\') {",
        "if !inside.is_empty() {",
    ),
    Fault(
        "marks of direction taken for text",
        "crates/planar-layout/src/diagnostic/hidden_character.rs",
        "'\\u{2028}'..='\\u{202e}'",
        "'\\u{2028}'..='\\u{2029}'",
    ),
    Fault(
        "graph rendered without its proof",
        "crates/planar-build/src/pipeline.rs",
        "crate::prove::prove(&layout, &graph).map_err(|e| mend(&e))?;",
        "let _ = crate::prove::prove(&layout, &graph);",
    ),
    Fault(
        "comment with a list broken into lines",
        "crates/planar-build/src/renderer/wrap.rs",
        '!line.contains("//")',
        '!line.trim_start().starts_with("//")',
    ),
]


@dataclass(frozen=True)
class Outcome:
    """Detection of a fault: failing tests as `binary::name`, or the error that stopped the build."""

    rust: list[str]
    derivation: list[str]
    stopped: str = ""

    @property
    def caught(self) -> bool:
        return bool(self.rust or self.derivation or self.stopped)


class Broken(Exception):
    """A fault that cannot be made."""


@dataclass(frozen=True)
class Place:
    """A copy of the repository, with a build folder that is kept between faults and runs."""

    tree: Path
    target: Path


def copy_tracked(to: Path) -> None:
    """The tracked files as they are in the working tree."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, names.split("\0")):
        if (ROOT / name).exists():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, to / name)


def run(command: list[str], place: Place) -> tuple[int, str]:
    """(exit code, both streams) of a command in the copy."""
    kept = {
        "CARGO_TARGET_DIR": str(place.target),
        "PLANAR_CAPTURE_ENVIRONMENTS": str(ROOT / "target" / "python"),
        "CARGO_PROFILE_DEV_DEBUG": "0",
        "CARGO_TERM_COLOR": "never",
    }
    result = subprocess.run(
        command,
        cwd=place.tree,
        env={**os.environ, **kept},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    return result.returncode, result.stdout.decode(errors="replace")


def test(place: Place, with_derivation: bool) -> Outcome:
    """Runs the tests in the copy, up to the first binary with a failure; the derivation's own for its faults only."""
    derivation = []
    if with_derivation:
        code, text = run([sys.executable, "-m", "codegen"], place)
        if code != 0:
            return Outcome([], [], "the derivation: " + text.strip().splitlines()[-1])
        _, text = run([sys.executable, "-m", "codegen", "--test"], place)
        derivation = list(dict.fromkeys(re.findall(r"(?m)^FAILED codegen/tests/(\S+)", text)))
    for binary in BINARIES:
        # the tests of `derivation` run the derivation's own
        code, text = run(["cargo", "test", "--locked", "--test", binary, "--", "--skip", "derivation::"], place)
        names = re.findall(r"(?m)^test (\S+) \.\.\. FAILED", text)
        if names:
            # the fastest is reported first: the name decides
            return Outcome(sorted(f"{binary}::{name}" for name in names), derivation)
        if "failed to run custom build command" in text:
            stopped = re.search(r"--- stderr\n\s*(.+?)(?:: |\n)", text)
            return Outcome([], derivation, "the build: " + (stopped[1].strip() if stopped else "see build.rs"))
        if code != 0:
            raise Broken("the faulty code does not compile:\n" + text[-4000:])
    return Outcome([], derivation)


def right(fault: Fault, tree: Path) -> str:
    """The file of a fault, which has its text exactly once."""
    path = tree / fault.file
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    if text.count(fault.old) != 1:
        raise Broken(f"{fault.file} has the text {text.count(fault.old)} times, not once:\n{fault.old}")
    return text


def check(faults: list[Fault]) -> int:
    """Exit code 1 where a fault cannot be made."""
    bad = 0
    for fault in faults:
        try:
            right(fault, ROOT)
        except Broken as problem:
            bad += 1
            print(f"{fault.name}: {problem}", file=sys.stderr)
    print(f"{len(faults)} faults, {bad} of them cannot be made")
    return 1 if bad else 0


def attempt(fault: Fault, place: Place) -> Outcome:
    """Makes a fault in the copy, runs the tests, and restores the file."""
    path = place.tree / fault.file
    text = right(fault, place.tree)
    graphs = {graph: graph.read_bytes() for graph in (place.tree / "codegen" / "graphs").iterdir()}
    try:
        path.write_text(text.replace(fault.old, fault.new), encoding="utf-8")
        return test(place, fault.in_derivation)
    finally:
        path.write_text(text, encoding="utf-8")
        for graph, content in graphs.items():
            if graph.read_bytes() != content:
                graph.write_bytes(content)


def row(fault: Fault, outcome: Outcome) -> str:
    """One line of the table."""
    first = f"`{outcome.rust[0]}`" if outcome.rust else "none"
    derivation = "–"
    if outcome.stopped:
        first = f"stops {outcome.stopped}"
    if fault.in_derivation and not outcome.stopped:
        derivation = f"`{outcome.derivation[0].partition('[')[0]}`" if outcome.derivation else "none"
    count = str(len(outcome.rust)) + (f" + {len(outcome.derivation)}" if fault.in_derivation else "")
    cells = [fault.name, f"`{fault.file}`", first, derivation, "–" if outcome.stopped else count]
    return f"| {' | '.join(cell.replace('|', '¦') for cell in cells)} |"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", metavar="NAME", help="this fault alone; may be given again")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="faults at a time, a copy each (1)")
    parser.add_argument("--check", action="store_true", help="only whether each fault's text is there exactly once")
    options = parser.parse_args()
    only = options.only or []
    unknown = sorted(set(only) - {fault.name for fault in FAULTS})
    if unknown:
        print(f"no fault {', '.join(unknown)}; there are: {', '.join(f.name for f in FAULTS)}", file=sys.stderr)
        return 2
    chosen = [fault for fault in FAULTS if not only or fault.name in only]
    if options.check:
        return check(chosen)
    start, bad = time.monotonic(), []
    with tempfile.TemporaryDirectory(prefix="break-table-") as folder, ThreadPoolExecutor(options.jobs) as pool:
        places: queue.SimpleQueue[Place] = queue.SimpleQueue()
        for k in range(options.jobs):
            place = Place(Path(folder) / str(k), ROOT / "target" / "break_table" / str(k))
            copy_tracked(place.tree)
            places.put(place)

        def outcome_of(fault: Fault) -> Outcome | Broken:
            place = places.get()
            try:
                return attempt(fault, place)
            except Broken as problem:
                return problem
            finally:
                places.put(place)

        print("| fault | where | first test in Rust that fails | first of the derivation's | how many |")
        print("|---|---|---|---|---|", flush=True)
        for fault, outcome in zip(chosen, pool.map(outcome_of, chosen), strict=True):
            if isinstance(outcome, Broken):
                print(f"{fault.name}: {outcome}", file=sys.stderr)
            else:
                print(row(fault, outcome), flush=True)
            if isinstance(outcome, Broken) or not outcome.caught:
                bad.append(fault.name)
    print(f"{len(chosen)} faults in {time.monotonic() - start:.0f} s", file=sys.stderr)
    if bad:
        print(f"not caught: {', '.join(bad)}", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
