//! Modules in C: compiled without a warning, their own test, the bits of the module in Rust, and hostile numbers.
//!
//! Without a C compiler `cc` the tests say so and check nothing; `PLANAR_CAPTURE_NO_C=1` skips them too.

pub mod driver;

use planar_capture::build::graph;
use planar_capture::build::{Arithmetic, CModule, CText, Module};
use planar_capture::generate::complete;
use planar_capture::layout::Layout;
use planar_capture::structure::parameters;
use planar_proof::{file, said};
use serde_json::{Value, json};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// The paper's robot, one arm, three arms, and one with structural zeros and mounts beside the axes.
const LAYOUTS: [&str; 4] = ["dual_arm_3r", "single_arm_2r", "triple_arm_3r", "asymmetric_wheel"];

/// The warnings that are errors.
pub const WARNINGS: [&str; 6] = ["-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-pedantic", "-Werror"];

/// Whether a tool is missing, or is not wanted; it is said.
pub fn without(tool: &str) -> bool {
    let unwanted = std::env::var("PLANAR_CAPTURE_NO_C").is_ok_and(|value| value == "1");
    let missing = unwanted || Command::new(tool).arg("--version").output().is_err();
    if missing {
        // straight to the stream: what the macros print is shown for failing tests only
        let _ = writeln!(std::io::stderr(), "not checked, for there is no `{tool}`: modules in C");
    }
    missing
}

/// A layout's modules in C, `NAME.c` and `NAME.h`, and in Rust, `robot.rs`, in a folder of their own; and its graph.
struct Modules {
    name: String,
    folder: TempDir,
    graph: Value,
}

impl Modules {
    fn new(name: &str) -> Self {
        Self::of(name, &Layout::read(&file(&format!("codegen/layouts/{name}.toml"))).expect("a layout"))
    }

    /// Those of a layout that has other numbers than the shipped one of a name, as if the graph was derived for it.
    fn of(name: &str, layout: &Layout) -> Self {
        let text = fs::read_to_string(file(&format!("codegen/graphs/{name}.json"))).expect("a graph");
        let mut graph: Value = serde_json::from_str(&text).expect("JSON");
        let structure = graph::structure(&serde_json::from_str(&text).expect("a graph")).expect("a structure");
        let values = parameters(&structure, layout).expect("of this structure");
        graph["layout"]["sha256"] = json!(layout.sha256());
        for (parameter, value) in graph["parameters"].as_array_mut().expect("a list").iter_mut().zip(values) {
            parameter["default"] = json!(value);
        }
        let proved = complete(&graph.to_string(), layout).unwrap_or_else(|e| panic!("{e}"));
        let header = format!("{name}.h");
        let in_c = CModule { header: &header, source: "a", command: "b" };
        let CText { source, header } = in_c.render(&proved.graph).unwrap_or_else(|e| panic!("{e}"));
        let in_rust =
            Module { standalone: true, item: false, arithmetic: Arithmetic::default(), source: "a", command: "b" };
        let rust = in_rust.render(&proved.graph).unwrap_or_else(|e| panic!("{e}"));
        let modules = Self {
            name: name.to_owned(),
            folder: TempDir::new().expect("a folder"),
            graph: serde_json::from_str(&proved.text).expect("JSON"),
        };
        modules.write(&format!("{name}.c"), &source);
        modules.write(&format!("{name}.h"), &header);
        modules.write("robot.rs", &rust);
        modules
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path().join(name), text).expect("written");
    }

    fn source(&self) -> String {
        fs::read_to_string(self.path().join(format!("{}.c", self.name))).expect("a source")
    }

    /// The macro for single precision.
    fn single(&self) -> String {
        format!("-D{}_FLOAT", self.name.to_uppercase())
    }

    /// Exit code and error output of a command in the folder.
    fn run(&self, command: &str, arguments: &[&str]) -> (i32, String, String) {
        said(Command::new(command).args(arguments).current_dir(self.path()).output().expect("it runs"))
    }

    /// Compiles and links a program; it has to be free of warnings.
    fn compile(&self, compiler: &str, arguments: &[&str]) {
        let (code, out, err) = self.run(compiler, arguments);
        assert_eq!(code, 0, "{}: {compiler} {arguments:?}\n{out}{err}", self.name);
    }
}

#[test]
fn modules_have_no_warning_in_c_and_cpp() {
    let compilers = [("cc", "-std=c99"), ("c++", "-xc++"), ("clang", "-std=c99"), ("clang++", "-xc++")];
    let compilers: Vec<_> = compilers.into_iter().filter(|(compiler, _)| !without(compiler)).collect();
    for layout in LAYOUTS {
        let modules = Modules::new(layout);
        let (source, single) = (format!("{layout}.c"), modules.single());
        for (compiler, language) in &compilers {
            // some warnings need the optimizer; those of the first compiler are enough of them
            let stage: &[&str] = if *compiler == "cc" { &["-O1", "-c", "-o", "object.o"] } else { &["-fsyntax-only"] };
            for precision in ["-UNOTHING", &single] {
                modules.compile(compiler, &[&[language, precision][..], stage, &WARNINGS, &[&source]].concat());
            }
        }
        // no library, no heap, no state
        let text = modules.source();
        for forbidden in ["math.h", "malloc", "stdlib.h", "goto"] {
            assert!(!text.contains(forbidden), "{layout}: {forbidden}");
        }
        if without("nm") || compilers.is_empty() {
            continue;
        }
        modules.compile("cc", &["-std=c99", "-O1", "-c", "-o", "object.o", &source]);
        let (_, symbols, _) = modules.run("nm", &["object.o"]);
        for line in symbols.lines() {
            let kind = line.split_whitespace().rev().nth(1).unwrap_or_default();
            let is_code_or_constant = ["T", "t", "r"].contains(&kind);
            let is_of_the_compiler = kind == "U"
                && ["memcpy", "memset", "__stack_chk_fail", "_GLOBAL_OFFSET_TABLE_"]
                    .iter()
                    .any(|known| line.ends_with(known));
            assert!(is_code_or_constant || is_of_the_compiler, "{layout}: {line}");
        }
    }
}

/// A program that exits with 1 where the module's own test fails.
const SELF_TEST: &str = "int main(void) { return (NAME_self_test() == 0) ? 0 : 1; }\n";

impl Modules {
    /// Whether the module's own test holds for a source, in one precision.
    fn holds(&self, source: &str, precision: &str) -> bool {
        self.write("module.c", source);
        let include = format!("#include \"{}.h\"\n", self.name);
        self.write("main.c", &(include + &SELF_TEST.replace("NAME", &self.name)));
        self.compile("cc", &["-std=c99", precision, "-o", "self_test", "main.c", "module.c"]);
        self.run("./self_test", &[]).0 == 0
    }

    /// The module's own test fails in both precisions wherever a text of its source, which is there so often, is another.
    fn sees<const N: usize>(&self, count: usize, edits: [(&str, &str); N]) {
        let text = self.source();
        for (right, wrong) in edits {
            let places: Vec<usize> = text.match_indices(right).map(|(place, _)| place).collect();
            assert_eq!(places.len(), count, "{right}");
            for place in places {
                let changed = format!("{}{wrong}{}", &text[..place], &text[place + right.len()..]);
                for precision in ["-UNOTHING", &self.single()] {
                    assert!(!self.holds(&changed, precision), "{wrong}, {precision}");
                }
            }
        }
    }
}

#[test]
fn a_module_passes_its_own_test_in_both_precisions() {
    if without("cc") {
        return;
    }
    for layout in LAYOUTS {
        let modules = Modules::new(layout);
        for precision in ["-UNOTHING", &modules.single()] {
            assert!(modules.holds(&modules.source(), precision), "{layout}, {precision}");
        }
    }
}

/// From robots that are seen under a microscope to those of hundreds of metres: states of the proof and of the own test have
/// their size, and steps are as short as their motion wants it.
#[test]
fn a_module_of_a_robot_of_any_size_passes_its_own_test() {
    if without("cc") {
        return;
    }
    for name in ["dual_arm_3r", "asymmetric_wheel"] {
        let shipped = Layout::read(&file(&format!("codegen/layouts/{name}.toml"))).expect("a layout");
        for (mass, length, radius) in [(1e-15, 1e-6, 1.0), (1e-8, 1e-3, 0.1), (1e-3, 3.5e-3, 0.03), (1e6, 100.0, 1.0)] {
            let mut layout = shipped.clone();
            (layout.base.mass, layout.base.inertia) =
                (mass * layout.base.mass, mass * length * length * layout.base.inertia);
            for arm in &mut layout.arms {
                arm.mount = arm.mount.map(|x| length * x);
                for link in &mut arm.links {
                    (link.length, link.com) = (length * link.length, link.com.map(|x| length * x));
                    (link.mass, link.inertia) = (mass * link.mass, mass * (length * radius).powi(2) * link.inertia);
                }
            }
            let modules = Modules::of(name, &layout);
            for precision in ["-UNOTHING", &modules.single()] {
                assert!(modules.holds(&modules.source(), precision), "{name}, {mass}, {length}, {precision}");
            }
        }
    }
}

/// A constant that is changed by half a per cent fails the module's own test in both precisions, wherever it stands:
/// parameters, coefficients of the sine, weights of the Runge–Kutta method, literals of the equations. Every third is
/// tried.
#[test]
fn a_changed_constant_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    let modules = Modules::new("single_arm_2r");
    let (text, single) = (modules.source(), modules.single());
    let (mut tried, mut of_precision, mut from) = ([0, 0], None, 0);
    for line in text.split_inclusive('\n') {
        let start = from;
        from += line.len();
        if line.contains(" magnitude(") {
            break; // its own test begins
        }
        of_precision = match line.split_whitespace().next() {
            Some("#ifdef") => Some(1),
            Some("#else") if of_precision == Some(1) => Some(0),
            Some("#endif") => None,
            _ => of_precision,
        };
        if HARMLESS.iter().any(|part| line.contains(part)) {
            continue;
        }
        for (place, cast) in line.match_indices("(real)") {
            let rest = &line[place + cast.len()..];
            let length = rest.find(|c: char| !(c.is_ascii_digit() || "-+.e".contains(c))).unwrap_or(0);
            let Ok(number) = rest[..length].parse::<f64>() else { continue };
            for precision in of_precision.map_or(0..2, |one| one..one + 1) {
                tried[precision] += 1;
                // below rounding there
                let is_last = precision == 1 && LAST_OF_SINGLE.contains(&&rest[..length]);
                if tried[precision] % 3 == 0 && !is_last {
                    let wrong = if number == 0.0 { 1e-3 } else { number * 1.005 };
                    let at = start + place + cast.len();
                    let changed = format!("{}{wrong:?}{}", &text[..at], &text[at + length..]);
                    let precision = ["-UNOTHING", &single][precision];
                    assert!(!modules.holds(&changed, precision), "{precision}: {number} changed to {wrong} in {line}");
                }
            }
        }
    }
    assert!(tried.iter().all(|tried| *tried > 60), "{tried:?} constants");
}

/// A sign that is changed fails the own test of a module whose base is a million times as heavy as its links, all of which have
/// their centres of mass on their axes, in single precision: another robot of the test shows what is lost in this one. Every
/// twelfth is tried.
#[test]
fn a_changed_sign_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    let mut layout = Layout::read(&file("codegen/layouts/single_arm_2r.toml")).expect("a layout");
    (layout.base.mass, layout.base.inertia) = (1e6, 1e6);
    for link in &mut layout.arms[0].links {
        (link.mass, link.inertia, link.com) = (1.0, 0.1, [0.5, 0.0]);
    }
    let modules = Modules::of("single_arm_2r", &layout);
    let (text, single) = (modules.source(), modules.single());
    let (mut tried, mut from) = (0, 0);
    for line in text.split_inclusive('\n') {
        let start = from;
        from += line.len();
        if line.contains(" magnitude(") {
            break; // its own test begins
        }
        let is_sum = line.contains(" = ") && !SUMS_OF_NOTHING.iter().any(|part| line.contains(part));
        for (sign, other) in [(" + ", " - "), (" - ", " + ")] {
            for (place, _) in line.match_indices(sign).filter(|_| is_sum) {
                tried += 1;
                if tried % 12 == 0 {
                    let (before, after) = (&text[..start + place], &text[start + place + sign.len()..]);
                    let changed = format!("{before}{other}{after}");
                    assert!(!modules.holds(&changed, &single), "{sign} changed to {other} in {line}");
                }
            }
        }
    }
    assert!(tried > 400, "{tried} signs");
}

/// PD control that takes one of its arguments for another, or leaves one out.
#[test]
fn a_changed_control_law_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    Modules::new("dual_arm_3r").sees(
        1,
        [
            (
                "proportional_gain[i] * (desired_joint_angles[i] - ",
                "desired_joint_angles[i] * (proportional_gain[i] - ",
            ),
            ("real rate = derivative_gain[i]", "real rate = derivative_gain[0]"),
            ("(desired_joint_rates[i] - joint_rates[i])", "(zero - joint_rates[i])"),
            ("joint_torques[i] = angle + rate", "joint_torques[i] = angle - rate"),
        ],
    );
}

/// The stages of a Runge–Kutta step, of which a short step says little: what they begin from, and their weights.
#[test]
fn a_changed_stage_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    Modules::new("dual_arm_3r").sees(
        2,
        [
            ("position[i] = from[0][i] + (advances", "position[i] = from[0][i] - (advances"),
            ("velocity[i] = from[1][i] + (advances", "velocity[i] = from[1][i] - (advances"),
            ("advances[4] = {half, half,", "advances[4] = {half, step,"),
            ("weights[4] = {(real)1.0, (real)2.0,", "weights[4] = {(real)2.0, (real)1.0,"),
        ],
    );
}

/// Lines with sums of products with 0, of which only that they are finite matters; and with series, of which one is for
/// double precision.
const SUMS_OF_NOTHING: [&str; 5] = ["* zero)", "terms_of_sin", "real sine = ", "real cosine = ", "reduction result = "];

/// A reciprocal of an impact that is off by half a per cent is less than what rounding may be at worst in single precision.
#[test]
fn a_changed_reciprocal_fails_the_modules_own_test_in_single_precision() {
    if without("cc") {
        return;
    }
    let modules = Modules::new("dual_arm_3r");
    let text = modules.source();
    let start = text.find("\nint dual_arm_3r_full_impact(").expect("the exact impact");
    let end = start + text[start..].find("\n}\n").expect("its end");
    let reciprocals: Vec<usize> =
        text[start..end].match_indices("(real)1.0 / ").map(|(place, _)| start + place).collect();
    assert!(reciprocals.len() > 2);
    for place in reciprocals {
        let changed = format!("{}(real)1.005 / {}", &text[..place], &text[place + "(real)1.0 / ".len()..]);
        assert!(!modules.holds(&changed, &modules.single()), "{}", text[place..].lines().next().unwrap_or_default());
    }
}

/// Lines with constants of which nothing depends on the third digit: bounds between two ways to the same result, starts
/// of an iteration, a difference that takes back its own rounding, a sign.
const HARMLESS: [&str; 10] = [
    "furthest = ",
    "nearest = ",
    "head = ",
    "least = ",
    "integer >= ",
    "half = (along < zero)",
    "angle = ",
    "is_small = ",
    "smallest = ",
    "no_sum = ",
];

/// The last coefficients of sine and cosine in single precision.
const LAST_OF_SINGLE: [&str; 2] = ["-0.00019515295571181923", "2.44331567955669e-5"];

/// A pivot that is off by half a per cent, and with it the border between regular and singular, fails the module's own test in
/// both precisions.
#[test]
fn a_changed_pivot_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    let modules = Modules::new("dual_arm_3r");
    modules.sees(7, [(" > model->pivot_limit", " * (real)1.005 > model->pivot_limit")]);
    modules.sees(1, [("model->pivot_limit = (real)8.0", "model->pivot_limit = (real)8.04")]);
}

/// An arm that takes another's target for its own, or takes it only where it has both mass and moment of inertia.
#[test]
fn a_changed_merging_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    Modules::new("dual_arm_3r").sees(
        1,
        [
            ("if ((target_masses[0] != zero) ||", "if ((target_masses[1] != zero) ||"),
            ("(target_masses[1] != zero) ||", "(target_masses[1] != zero) &&"),
            ("|| (target_inertias[1] != zero)", "|| (target_inertias[0] != zero)"),
        ],
    );
}

/// What bounds, limits and sums of angles beyond the largest number are made of.
#[test]
fn a_changed_number_of_the_arithmetic_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    let modules = Modules::new("single_arm_2r");
    modules.sees(1, [("result = -REAL_MAX", "result = REAL_MAX")]);
    let (text, single) = (modules.source(), modules.single());
    for (right, wrong, precision) in [
        ("REAL_EPSILON DBL_EPSILON", "REAL_EPSILON FLT_EPSILON", "-UNOTHING"),
        ("REAL_EPSILON FLT_EPSILON", "REAL_EPSILON (2.0F * FLT_EPSILON)", &single),
        ("REAL_MAX DBL_MAX", "REAL_MAX (0.5 * DBL_MAX)", "-UNOTHING"),
    ] {
        assert_eq!(text.matches(right).count(), 1);
        assert!(!modules.holds(&text.replace(right, wrong), precision), "{wrong}");
    }
}

/// Where another status is returned than the header says, or one for another, the module's own test fails.
#[test]
fn a_changed_status_fails_the_modules_own_test() {
    if without("cc") {
        return;
    }
    let modules = Modules::new("single_arm_2r");
    let text = modules.source();
    for (status, others) in
        [("SINGULAR 1", ["SINGULAR 0", "SINGULAR 2"]), ("NOT_FINITE 2", ["NOT_FINITE 0", "NOT_FINITE 1"])]
    {
        assert_eq!(text.matches(&format!("#define {status}\n")).count(), 1);
        for other in others {
            let changed = text.replace(&format!("#define {status}\n"), &format!("#define {other}\n"));
            assert!(!modules.holds(&changed, "-UNOTHING"), "{other}");
        }
    }
    // an infinite angle that is no sum
    assert!(!modules.holds(&text.replace("no_sum = (real)-1.0", "no_sum = (real)1.0"), "-UNOTHING"), "no_sum");
    // and those of its functions, one by one; the pivot of the Jacobian shows all that its results do, but a length
    for returned in ["? DONE : NOT_FINITE", "status = SINGULAR", "status = NOT_FINITE"] {
        for (place, _) in text.match_indices(returned) {
            let before = &text[..place];
            let function = before.rsplit("\nint ").next().and_then(|function| function.split('(').next());
            if function == Some("single_arm_2r_generalized_jacobian") && returned.starts_with('?') {
                continue;
            }
            let changed = returned.replace("NOT_FINITE", "DONE").replace("SINGULAR", "DONE");
            let changed = format!("{before}{changed}{}", &text[place + returned.len()..]);
            assert!(!modules.holds(&changed, "-UNOTHING"), "{function:?}: {returned}");
        }
    }
}

/// Texts of a graph stay comments: their ends, trigraphs and continued lines.
#[test]
fn texts_of_a_graph_stay_in_comments() {
    let layout = Layout::read(&file("codegen/layouts/single_arm_2r.toml")).expect("a layout");
    let text = fs::read_to_string(file("codegen/graphs/single_arm_2r.json")).expect("a graph");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let render = |graph: &Value| {
        let graph = graph::read(&graph.to_string(), &layout).unwrap_or_else(|e| panic!("{e}"));
        CModule { header: "robot.h", source: HOSTILE, command: HOSTILE }.render(&graph)
    };
    let places = [
        "/inputs/0/description",
        "/inputs/0/unit",
        "/parameters/0/description",
        "/constants/values/0/description",
        "/constants/values/0/unit",
        "/families/0/description",
        "/families/0/configuration/sections/0/0",
        "/families/0/functions/0/description",
        "/families/0/functions/0/equation",
        "/families/0/functions/0/source",
        "/families/0/functions/0/sections/0/0",
        "/families/0/functions/0/outputs/0/description",
    ];
    let mut hostile = whole.clone();
    for place in places {
        let text = if place.ends_with("unit") { "*/ int stolen; /*" } else { HOSTILE };
        *hostile.pointer_mut(place).unwrap_or_else(|| panic!("no {place}")) = text.into();
    }
    let CText { source, header } = render(&hostile).unwrap_or_else(|e| panic!("{e}"));
    assert!(source.contains("stolen") && header.contains("stolen"));
    if !without("cc") {
        let folder = TempDir::new().expect("a folder");
        fs::write(folder.path().join("robot.h"), header).expect("written");
        fs::write(folder.path().join("robot.c"), source).expect("written");
        let mut compile = Command::new("cc");
        compile.args(["-std=c99", "-E", "robot.c"]).args(WARNINGS).current_dir(folder.path());
        let (code, out, err) = said(compile.output().expect("it runs"));
        assert!(code == 0 && !out.contains("stolen"), "{err}");
    }
    // names of C, and two things with one name
    for (name, message) in [("double", "C, C++"), ("base_acceleration", "two things")] {
        let statements = whole.pointer("/families/0/configuration/statements").and_then(|all| all.as_array());
        let before =
            statements.expect("statements").iter().find_map(|statement| statement[0].as_str()).expect("a name");
        let renamed = text.replace(&format!("\"{before}\""), &format!("\"{name}\""));
        let problem = render(&serde_json::from_str(&renamed).expect("JSON")).expect_err("no name");
        assert!(problem.contains(name) && problem.contains(message), "{problem}");
    }
    let graph = graph::read(&text, &layout).unwrap_or_else(|e| panic!("{e}"));
    let problem = CModule { header: "a\".h", source: "a", command: "b" }.render(&graph).expect_err("no file");
    assert!(problem.contains("cannot be included"), "{problem}");
}

const HOSTILE: &str = "a */ int stolen; /* b // c ??/ d **/ int stolen; /*\\";

/// MISRA C:2012 by cppcheck: only the rules that docs/c.md names, with the reasons.
#[test]
fn deviations_from_misra_are_those_of_the_document() {
    if without("cppcheck") {
        return;
    }
    let document = fs::read_to_string(file("docs/c.md")).expect("a document");
    let (modules, name) = (Modules::new("single_arm_2r"), "single_arm_2r.c");
    modules.write("in_loops.c", &in_loops("single_arm_2r"));
    for source in [name, "in_loops.c"] {
        let arguments = ["--addon=misra", "--std=c99", "--quiet", "--template={id} {file}:{line}", source];
        let (code, out, err) = modules.run("cppcheck", &arguments);
        assert_eq!(code, 0, "{out}{err}");
        for line in err.lines().filter(|line| line.contains("misra-c2012-")) {
            let rule = line.split_whitespace().next().unwrap_or_default().trim_start_matches("misra-c2012-");
            assert!(document.contains(&format!("| {rule} |")), "{line}");
        }
    }
}

/// A module of a small robot with its impact in loops, from matrices of any of its values: cppcheck takes a minute for one
/// whose impact is large.
fn in_loops(name: &str) -> String {
    let layout = Layout::read(&file(&format!("codegen/layouts/{name}.toml"))).expect("a layout");
    let text = fs::read_to_string(file(&format!("codegen/graphs/{name}.json"))).expect("a graph");
    let mut graph: Value = serde_json::from_str(&text).expect("JSON");
    let families = graph["families"].as_array_mut().expect("families");
    let mut functions = families.iter_mut().flat_map(|family| family["functions"].as_array_mut().expect("functions"));
    let impact = functions.find(|function| function["name"] == "reduced_impact").expect("an impact");
    let value = impact["outputs"][1]["elements"][0].clone();
    let matrices = [("generalized_inertia", [2, 2]), ("generalized_jacobian", [3, 2])].map(|(name, shape)| {
        let elements = vec![value.clone(); shape[0] * shape[1]];
        json!({"name": name, "shape": shape, "unit": "1", "description": "a matrix", "elements": elements})
    });
    impact["matrices"] = json!(matrices);
    let graph = graph::read(&graph.to_string(), &layout).unwrap_or_else(|e| panic!("{e}"));
    let header = format!("{name}.h");
    let module = CModule { header: &header, source: "a", command: "b" };
    let text = module.render(&graph).unwrap_or_else(|e| panic!("{e}")).source;
    assert!(text.contains("static real impact_equations("));
    text
}

/// The listings of docs/c.md: the program runs, the others compile against declarations of what they use of their vendors'.
#[test]
fn listings_of_the_document_compile() {
    if without("cc") {
        return;
    }
    let document = fs::read_to_string(file("docs/c.md")).expect("a document");
    let listings: Vec<&str> = document.split("```c\n").skip(1).filter_map(|part| part.split("```").next()).collect();
    let modules = Modules::new("dual_arm_3r");
    let stubs = format!("-I{}", file("tests/commands/c/stubs").display());
    assert_eq!(listings.len(), 3);
    for (i, listing) in listings.into_iter().enumerate() {
        modules.write("listing.c", listing);
        for precision in ["-UNOTHING", &modules.single()] {
            // Simulink's signals are in double precision
            if i == 0 || (i == 1 && precision != "-UNOTHING") {
                continue;
            }
            let arguments = ["-std=c99", precision, &stubs, "-c", "-o", "listing.o", "listing.c"];
            modules.compile("cc", &[&arguments[..], &WARNINGS].concat());
        }
        if i == 0 {
            modules
                .compile("cc", &["-std=c99", "-O1", "-Wall", "-Werror", "-o", "listing", "listing.c", "dual_arm_3r.c"]);
            let (code, out, err) = modules.run("./listing", &[]);
            assert!(code == 0 && out.starts_with("status 0, base yaw "), "{out}{err}");
        }
    }
}
