//! An FMU as an importer drives it: its sources, compiled with a driver in C, against the library's steps and the laws of
//! momentum.
//!
//! Without a C compiler `cc` the test says so and checks nothing; `tests/fmu.py` has another importer.

use crate::c::driver::step;
use crate::c::without;
use planar_capture::build::{CModule, CoSimulation, CoSimulationVariable, Role, graph};
use planar_capture::dynamics::Model;
use planar_capture::fmu::{Fmu, Origin};
use planar_capture::registry::generated;
use planar_capture::state::State;
use planar_proof::{assert_close, file, layout, said, tolerance};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Sets the variables of `START`, makes a step of `STEP`, then one with the wrench `WRENCH` on the base, goes back to the state
/// between both, and says what may not be set and done; every line is a list of all variables or a status.
const DRIVER: &str = r#"
#include "fmi3Functions.h"
#include <stdio.h>

static void say(fmi3InstanceEnvironment of, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)of;
    (void)status;
    (void)category;
    (void)fprintf(stderr, "%s\n", message);
}

static void show(fmi3Instance robot)
{
    for (fmi3ValueReference i = 0U; i < VARIABLES; ++i) {
        double value = 0.0;
        const fmi3Status status = fmi3GetFloat64(robot, &i, 1U, &value, 1U);
        (void)printf("%.17g ", (status == fmi3OK) ? value : 0.0 / 0.0);
    }
    (void)printf("\n");
}

static fmi3Status set(fmi3Instance robot, fmi3ValueReference reference, double value)
{
    return fmi3SetFloat64(robot, &reference, 1U, &value, 1U);
}

static fmi3Status advance(fmi3Instance robot, double from, double step)
{
    bool event = true, end = true, early = true;
    double last = 0.0;
    const fmi3Status status = fmi3DoStep(robot, from, step, true, &event, &end, &early, &last);
    return (status == fmi3OK && (event || end || early)) ? fmi3Warning : status;
}

int main(void)
{
    static const fmi3ValueReference references[] = {REFERENCES};
    static const double start[] = {START};
    static const double wrench[3] = {WRENCH};
    fmi3FMUState saved = NULL;
    int all = 0;
    fmi3Instance robot = fmi3InstantiateCoSimulation(
        "robot", TOKEN, "", false, false, false, false, NULL, 0U, NULL, say, NULL);
    if (robot == NULL || fmi3InstantiateCoSimulation("other", "token", "", false, false, false, false, NULL, 0U, NULL, say, NULL) != NULL) {
        return 1;
    }
    show(robot);
    all |= (int)fmi3SetFloat64(robot, references, sizeof(start) / sizeof(start[0]), start, sizeof(start) / sizeof(start[0]));
    show(robot);
    all |= (int)fmi3EnterInitializationMode(robot, false, 0.0, 0.0, false, 0.0);
    all |= (int)fmi3ExitInitializationMode(robot);
    show(robot);
    all |= (int)advance(robot, 0.0, STEP);
    show(robot);
    all |= (int)fmi3GetFMUState(robot, &saved);
    for (fmi3ValueReference i = 0U; i < 3U; ++i) {
        all |= (int)set(robot, FIRST_OF_WRENCH + i, wrench[i]);
    }
    all |= (int)advance(robot, STEP, STEP);
    show(robot);
    all |= (int)fmi3SetFMUState(robot, saved);
    show(robot);
    all |= (int)fmi3FreeFMUState(robot, &saved);
    (void)printf("%d\n", all);
    (void)printf("%d %d %d %d\n", (int)set(robot, FIRST_PARAMETER, 1.0), (int)set(robot, VARIABLES, 1.0),
        (int)advance(robot, 0.0, STEP), (int)advance(robot, STEP, -STEP));
    show(robot);
    fmi3FreeInstance(robot);
    return 0;
}
"#;

/// The lines of numbers that the driver prints.
fn driven(folder: &Path, fmu: &Fmu, driver: &str) -> Vec<Vec<f64>> {
    for entry in &fmu.entries {
        if let Some(name) = entry.path.strip_prefix("sources/") {
            fs::write(folder.join(name), &entry.content).expect("written");
        }
    }
    fs::write(folder.join("driver.c"), driver).expect("written");
    // the sources are those that an importer is told to compile
    let description = fs::read_to_string(folder.join("buildDescription.xml")).expect("a description");
    let sources: Vec<_> =
        description.split("<SourceFile name=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c99", "-O1", "-ffp-contract=off", "-o", "drive", "driver.c"]).args(&sources);
    let (code, _, err) = said(compiler.current_dir(folder).output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    let (code, out, err) = said(Command::new(folder.join("drive")).output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    let numbers = |line: &str| line.split_whitespace().map(|word| word.parse().expect("a number")).collect();
    out.lines().map(numbers).collect()
}

/// Pose and twist of the end effector, and momentum and energy, of [pose, angles, twist, rates].
fn outputs(model: &dyn Model<f64>, states: &[f64]) -> Vec<f64> {
    let state = State {
        base_pose: [states[0], states[1], states[2]],
        joint_angles: &states[3..6],
        base_twist: [states[6], states[7], states[8]],
        joint_rates: &states[9..],
    };
    let (mut poses, mut twists) = ([[0.0; 3]; 1], [[0.0; 3]; 1]);
    model.end_effector_poses(&state.base_pose, state.joint_angles, &mut poses).expect("poses");
    model.end_effector_twists(&state, &mut twists).expect("twists");
    let momentum = model.momentum(&state).expect("momentum");
    let [px, py] = momentum.linear_momentum;
    [&poses[0][..], &twists[0], &[px, py, momentum.angular_momentum, momentum.kinetic_energy]].concat()
}

/// From the same state under the same torques an FMU moves as by the library's steps: 24 of them, as 23 would be longer than the
/// internal step.
#[test]
fn an_fmu_moves_as_the_library_and_by_the_laws_of_momentum() {
    if without("cc") {
        return;
    }
    let shipped = layout("single_arm_3r");
    let text = fs::read_to_string(file("codegen/graphs/single_arm_3r.json")).expect("a graph");
    let graph = graph::read(&text, &shipped).expect("its graph");
    let sha256 = shipped.sha256();
    let fmu = Fmu::new(
        &graph,
        &Origin { name: "single_arm_3r", layout_sha256: &sha256, source: "robot.toml", command: "build" },
    );
    let fmu = fmu.expect("an FMU");
    let module = CModule { header: "single_arm_3r.h", source: "robot.toml", command: "build" };
    let variables = CoSimulation::render(&graph, &module, "").expect("variables").variables;
    let place =
        |name: &str| variables.iter().position(|variable| variable.name == name).unwrap_or_else(|| panic!("{name}"));
    let of = |role: Role| variables.iter().enumerate().filter(move |(_, variable)| variable.role == role);
    let first = |role: Role| of(role).next().expect("one of it").0;

    // other numbers than those of the layout
    let mut robot = shipped.clone();
    robot.base.mass = 400.0;
    robot.arms[0].links[1].inertia = 2.0;
    let (length, internal) = (0.5, 0.021);
    let names = |role| of(role).map(|(_, variable)| variable.name.clone()).collect::<Vec<_>>();
    let states = [0.1, 0.2, -0.3, 0.5, -0.9, 0.7, 0.02, 0.05, -0.04, 2.0, -3.0, 1.0];
    let torques = [3.0, -2.0, 1.0];
    let mut start = vec![("base_mass".to_owned(), 400.0), ("internal_step".to_owned(), internal)];
    start.push(("arm1_link2_inertia".to_owned(), 2.0));
    start.extend(names(Role::State).into_iter().zip(states));
    start.extend((1..=3).map(|k| format!("arm1_joint{k}_torque")).zip(torques));
    assert_eq!(names(Role::State).len(), states.len());
    let wrench = [4.0, 30.0, -20.0];
    let list = |numbers: &[f64]| numbers.iter().map(|number| format!("{number:?}")).collect::<Vec<_>>().join(", ");
    let references: Vec<_> = start.iter().map(|(name, _)| place(name).to_string()).collect();
    let values: Vec<f64> = start.iter().map(|(_, value)| *value).collect();
    let mut driver = String::new();
    let description = String::from_utf8_lossy(&fmu.entries[0].content).into_owned();
    let (_, token) = description.split_once("instantiationToken=\"").expect("a token");
    for (name, value) in [
        ("REFERENCES", references.join(", ")),
        ("START", list(&values)),
        ("WRENCH", list(&wrench)),
        ("TOKEN", format!("\"{}\"", token.split('"').next().unwrap_or_default())),
        ("VARIABLES", format!("{}U", variables.len())),
        ("STEP", format!("{length:?}")),
        ("FIRST_OF_WRENCH", format!("{}U", place("base_wrench_n"))),
        ("FIRST_PARAMETER", format!("{}U", place("base_mass"))),
    ] {
        let _ = writeln!(driver, "#define {name} {value}");
    }
    let folder = TempDir::new().expect("a folder");
    let lines = driven(folder.path(), &fmu, &(driver + DRIVER));
    let [starts, set, initial, after, pushed, restored, done, refused, kept] = &lines[..] else { panic!("{lines:?}") };
    assert_eq!(done, &[0.0], "all is in order");
    assert_eq!(set, initial, "outputs are those of the parameters that are set, at once");
    assert!(refused.iter().all(|status| *status > 2.0), "errors: {refused:?}");
    assert_eq!((restored, kept), (after, after), "the saved state, and that after what is refused");

    for (variable, value) in variables.iter().zip(starts).filter(|(variable, _)| variable.role != Role::Observed) {
        assert_eq!(value.to_bits(), variable.start.to_bits(), "start of {}", variable.name);
    }

    let model = generated(&robot).expect("generated code");
    let at = |values: &[f64]| values[first(Role::State)..first(Role::Observed)].to_vec();
    assert_eq!(at(initial), states);
    let steps = 24;
    let mut expected = states.to_vec();
    for _ in 0..steps {
        expected = step(&*model, &[&expected[..], &torques, &[length / f64::from(steps)]].concat());
    }
    assert_close("states", &at(after), &expected, tolerance::IN_ANOTHER_MODULE);
    assert_close("time", &[after[place("time")], pushed[place("time")]], &[length, 2.0 * length], 1e-15);
    for values in [initial, after, pushed] {
        let names = [
            "arm1_tip_yaw",
            "arm1_tip_x",
            "arm1_tip_y",
            "arm1_tip_omega",
            "arm1_tip_vx",
            "arm1_tip_vy",
            "linear_momentum_x",
            "linear_momentum_y",
            "angular_momentum",
            "kinetic_energy",
        ];
        let found = names.map(|name| values[place(name)]);
        assert_close("outputs", &found, &outputs(&*model, &at(values)), 100.0 * tolerance::IN_ANOTHER_MODULE);
    }
    // joints act within the robot: its momentum changes by the impulse of the wrench on the base alone
    let momentum =
        |values: &[f64]| ["linear_momentum_x", "linear_momentum_y", "angular_momentum"].map(|name| values[place(name)]);
    let gained = |from: &[f64], to: &[f64]| {
        let [from, to] = [momentum(from), momentum(to)];
        [0, 1, 2].map(|i| to[i] - from[i])
    };
    let [x, y, of_turn] = gained(initial, after);
    // steps of a fiftieth of a second keep it to six digits of what the wrench gives
    assert_close("momentum", &[x, y, of_turn], &[0.0; 3], 1e-3);
    let [n, fx, fy] = wrench;
    let [x, y, of_turn] = gained(after, pushed);
    assert_close("impulse", &[x, y], &[fx * length, fy * length], 1e-3);
    // the force acts at the base, which moves almost evenly
    let middle = [place("base_x"), place("base_y")].map(|place| 0.5 * (after[place] + pushed[place]));
    let impulse = (n + middle[0] * fy - middle[1] * fx) * length;
    assert_close("impulse of the moment", &[of_turn], &[impulse], 0.05);
    assert!(impulse.abs() > 1.0, "{impulse} N m s");
}

/// In the description and in C a variable has the same place and the same start.
#[test]
fn variables_have_their_place_and_start_in_the_description() {
    let shipped = layout("single_arm_3r");
    let text = fs::read_to_string(file("codegen/graphs/single_arm_3r.json")).expect("a graph");
    let graph = graph::read(&text, &shipped).expect("its graph");
    let origin = Origin { name: "single_arm_3r", layout_sha256: "", source: "robot.toml", command: "build" };
    let fmu = Fmu::new(&graph, &origin).expect("an FMU");
    let text = |path: &str| {
        let entry = fmu.entries.iter().find(|entry| entry.path == path).unwrap_or_else(|| panic!("{path}"));
        String::from_utf8_lossy(&entry.content).into_owned()
    };
    let description = text("modelDescription.xml");
    let attribute = |element: &str, name: &str| {
        let (_, rest) = element.split_once(&format!(" {name}=\""))?;
        rest.split_once('"').map(|(value, _)| value.to_owned())
    };
    let elements = |tag: &str| -> Vec<String> {
        let open = format!("<{tag}");
        let all = description.split(&*open).skip(1);
        all.filter_map(|rest| rest.split_once('>').map(|(element, _)| element.to_owned())).collect()
    };
    let module = CModule { header: "single_arm_3r.h", source: "robot.toml", command: "build" };
    let variables = CoSimulation::render(&graph, &module, "").expect("variables").variables;
    let page = text("documentation/index.html");
    let described = elements("Float64");
    assert_eq!(described.len(), variables.len());
    for (i, (element, variable)) in described.iter().zip(&variables).enumerate() {
        let CoSimulationVariable { name, unit, role, start, description } = variable;
        assert_eq!(attribute(element, "name").as_ref(), Some(name));
        assert_eq!(attribute(element, "valueReference"), Some(i.to_string()), "{name}");
        // what a simulation does not change is fixed, all else continuous
        let variability = if *role == Role::Parameter { "fixed" } else { "continuous" };
        assert_eq!(attribute(element, "variability").as_deref(), Some(variability), "{name}");
        if let Some(text) = attribute(element, "start") {
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(start.to_bits()), "{name}");
        }
        let row = page.lines().find(|row| row.starts_with(&format!("<tr><td>{name}</td>"))).expect("a row");
        assert!(
            row.contains(&format!("<td>{unit}</td>")) && row.contains(&description.replace('\'', "&apos;")),
            "{row}"
        );
    }
    let parameters = planar_proof::json("codegen/graphs/single_arm_3r.json")["parameters"].clone();
    for (parameter, variable) in parameters.as_array().expect("a list").iter().zip(variables.iter().skip(2)) {
        assert_eq!(parameter["name"], *variable.name);
        assert_eq!(
            parameter["default"].as_f64().map(f64::to_bits),
            Some(variable.start.to_bits()),
            "{}",
            variable.name
        );
    }
    // the outputs, and of these what is calculated at the start, each once
    let calculated = |element: &&String| attribute(element, "initial").as_deref() == Some("calculated");
    let reference = |element: &String| attribute(element, "valueReference").expect("a reference");
    let unknowns: Vec<_> = elements("InitialUnknown").iter().map(reference).collect();
    assert_eq!(unknowns, described.iter().filter(calculated).map(reference).collect::<Vec<_>>());
    // N = kg m/s²: the exponents of a unit follow from its name
    let units = description.split("<Unit name=\"").skip(1);
    for unit in units {
        let (name, rest) = unit.split_once('"').expect("a name");
        let base = rest.split_once("<BaseUnit").and_then(|(_, rest)| rest.split_once("/>")).expect("a base unit").0;
        let mut expected = [0_i32; 4];
        let (over, under) = name.split_once('/').unwrap_or((name, ""));
        for (part, sign) in over.split(' ').map(|part| (part, 1)).chain([(under, -1)]) {
            let (symbol, power) = part.split_once('^').unwrap_or((part, "1"));
            let exponents = match symbol {
                "kg" => [1, 0, 0, 0],
                "m" => [0, 1, 0, 0],
                "s" => [0, 0, 1, 0],
                "rad" => [0, 0, 0, 1],
                "N" => [1, 1, -2, 0],
                "" => [0; 4],
                other => panic!("{other}"),
            };
            let power: i32 = power.parse().expect("a power");
            expected = [0, 1, 2, 3].map(|i: usize| expected[i] + sign * power * exponents[i]);
        }
        let found = ["kg", "m", "s", "rad"]
            .map(|symbol| attribute(base, symbol).map_or(0, |text| text.parse().expect("an exponent")));
        assert_eq!(found, expected, "{name}");
    }
}
