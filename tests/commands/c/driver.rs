//! A program in Rust that calls a standalone module and the same module in C, function by function, and compares them.

use super::{LAYOUTS, Modules, without};
use planar_capture::dynamics::Model;
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;
use planar_proof::tolerance;
use serde_json::Value;
use std::fmt::Write;

/// One function: its name, and (name, shape) of inputs and outputs.
struct Function {
    name: String,
    inputs: Vec<(String, Vec<usize>)>,
    outputs: Vec<(String, Vec<usize>)>,
    /// Whether it returns a status in Rust, too.
    fails: bool,
}

fn variables(list: &Value) -> Vec<(String, Vec<usize>)> {
    let shape = |of: &Value| {
        of.as_array().into_iter().flatten().filter_map(Value::as_u64).filter_map(|n| usize::try_from(n).ok()).collect()
    };
    let list = list.as_array().expect("a list").iter();
    list.map(|variable| (variable["name"].as_str().expect("a name").to_owned(), shape(&variable["shape"]))).collect()
}

/// Those of the graph, and those that are composed of them.
fn functions(graph: &Value) -> Vec<Function> {
    let known = variables(&graph["inputs"]);
    let families = graph["families"].as_array().expect("families").iter();
    let listed = families.flat_map(|family| family["functions"].as_array().expect("functions"));
    let mut all: Vec<Function> = listed
        .map(|function| {
            let inputs = function["inputs"].as_array().expect("inputs").iter();
            let input = |name: &Value| known.iter().find(|(known, _)| name == known).expect("declared").clone();
            Function {
                name: function["name"].as_str().expect("a name").to_owned(),
                inputs: inputs.map(input).collect(),
                outputs: variables(&function["outputs"]),
                fails: false,
            }
        })
        .collect();
    let shape = |name: &str| known.iter().find(|(known, _)| known == name).expect("declared").1.clone();
    let (joints, arms) = (shape("joint_angles"), shape("target_masses"));
    let of = |names: &[(&str, &Vec<usize>)]| -> Vec<(String, Vec<usize>)> {
        names.iter().map(|(name, shape)| ((*name).to_owned(), (*shape).clone())).collect()
    };
    let (three, scalar, pairs, triples) = (vec![3], vec![], vec![arms[0], 2], vec![arms[0], 3]);
    let state = [("base_pose", &three), ("joint_angles", &joints), ("base_twist", &three), ("joint_rates", &joints)];
    let after = [
        ("base_pose_after", &three),
        ("joint_angles_after", &joints),
        ("base_twist_after", &three),
        ("joint_rates_after", &joints),
    ];
    let (torques, wrench, step) = (("joint_torques", &joints), ("base_wrench", &three), ("step", &scalar));
    let step_of = |name: &str, forces: &[(&str, &Vec<usize>)]| Function {
        name: name.to_owned(),
        inputs: of(&[&state[..], forces, &[step]].concat()),
        outputs: of(&after),
        fails: true,
    };
    all.push(step_of("rk4_step", &[torques]));
    all.push(step_of("rk4_step_with_base_wrench", &[torques, wrench]));
    all.push(Function {
        name: "pd_torques".to_owned(),
        inputs: of(&[
            ("joint_angles", &joints),
            ("joint_rates", &joints),
            ("desired_joint_angles", &joints),
            ("desired_joint_rates", &joints),
            ("proportional_gain", &joints),
            ("derivative_gain", &joints),
        ]),
        outputs: of(&[("joint_torques", &joints)]),
        fails: true,
    });
    let targets = [("target_masses", &arms), ("target_inertias", &arms), ("contacts", &pairs)];
    let moving = [
        ("base_pose", &three),
        ("joint_angles", &joints),
        ("base_twist_after", &three),
        ("joint_rates_after", &joints),
    ];
    all.push(Function {
        name: "impulses".to_owned(),
        inputs: of(&[&moving[..], &targets, &[("target_twists", &triples)]].concat()),
        outputs: of(&[("target_twists_after", &triples), ("impulses", &triples)]),
        fails: true,
    });
    all
}

fn size(shape: &[usize]) -> usize {
    shape.iter().product()
}

/// The text of the program: compares 1,000 random states, then tries hostile numbers in every input and parameter.
fn program(modules: &Modules, real: &str) -> String {
    let graph = &modules.graph;
    let name = &modules.name;
    let functions = functions(graph);
    let parameters = graph["parameters"].as_array().expect("parameters");
    let is_mass = |place: &usize| {
        let quantity = parameters[*place]["quantity"].as_str().expect("a quantity");
        quantity.ends_with("_mass") || quantity.ends_with("_inertia")
    };
    let masses: Vec<usize> = (0..parameters.len()).filter(is_mass).collect();
    let parameters = parameters.len();
    let constants = graph["constants"]["values"].as_array().expect("constants").len();
    let mut declarations = String::new();
    let mut calls = String::new();
    let mut names = String::new();
    for (index, Function { name: function, inputs, outputs, fails }) in functions.iter().enumerate() {
        let scalar = |shape: &Vec<usize>| shape.is_empty() && *fails;
        let types = inputs.iter().map(|(_, shape)| if scalar(shape) { "Real" } else { "*const Real" });
        let stored: Vec<_> = outputs.iter().filter(|(name, _)| name != "smallest_pivot").collect();
        let types: Vec<_> = types.chain(stored.iter().map(|_| "*mut Real")).map(|of| format!(", _: {of}")).collect();
        let _ = writeln!(declarations, "    fn {name}_{function}(_: *const CModel{}) -> i32;", types.concat());
        let length: usize = inputs.iter().map(|(_, shape)| size(shape)).sum();
        let results: usize = stored.iter().map(|(_, shape)| size(shape)).sum();
        let _ = writeln!(names, "    (\"{function}\", {length}, {results}, &[{}]),", {
            let kinds = inputs.iter().map(|(name, shape)| format!("(\"{name}\", {})", size(shape)));
            kinds.collect::<Vec<_>>().join(", ")
        });
        let mut at = 0;
        let mut in_rust = Vec::new();
        let mut in_c = Vec::new();
        for (_, shape) in inputs {
            let next = at + size(shape);
            in_rust.push(match shape.as_slice() {
                [] => format!("x[{at}]"),
                [_] => format!("x[{at}..{next}].first_chunk().unwrap()"),
                [_, columns] => format!("x[{at}..{next}].as_chunks::<{columns}>().0.first_chunk().unwrap()"),
                other => panic!("{other:?}"),
            });
            in_c.push(if shape.is_empty() { format!("x[{at}]") } else { format!("x[{at}..].as_ptr()") });
            at = next;
        }
        let mut flat = Vec::new();
        for (output, shape) in &stored {
            let field = if outputs.len() == 1 { String::new() } else { format!(".{output}") };
            flat.push(match shape.len() {
                0 => format!("y.push(result{field});"),
                1 => format!("y.extend(result{field});"),
                _ => format!("y.extend(result{field}.as_flattened());"),
            });
        }
        let mut place = 0;
        for (_, shape) in &stored {
            in_c.push(format!("y.as_mut_ptr().add({place})"));
            place += size(shape);
        }
        let handled = if *fails {
            "match result { Ok(result) => result, Err(status) => return (status as i32, y) }"
        } else {
            "result"
        };
        let _ = write!(
            calls,
            "fn rust_{index}(model: &robot::Model<Real>, x: &[Real]) -> (i32, Vec<Real>) {{
    let mut y = Vec::new();
    let result = model.{function}({});
    let result = {handled};
    {}
    (0, y)
}}
fn c_{index}(model: &CModel, x: &[Real]) -> (i32, Vec<Real>) {{
    let mut y = vec![0.0; {place}];
    let status = unsafe {{ {name}_{function}(model, {}) }};
    (status, y)
}}
",
            in_rust.join(", "),
            flat.join("\n    "),
            in_c.join(", "),
        );
    }
    let list = |prefix: &str| (0..functions.len()).map(|i| format!("{prefix}_{i}")).collect::<Vec<_>>().join(", ");
    let count = functions.len();
    let joints: usize = size(&functions[0].inputs[1].1);
    let arms = functions.last().map_or(0, |function| function.outputs[0].1[0]);
    include_str!("driver.txt")
        .replace("@REAL@", real)
        .replace("@NAME@", name)
        .replace("@PARAMETERS@", &parameters.to_string())
        .replace("@CONSTANTS@", &constants.to_string())
        .replace("@MASSES@", &format!("{masses:?}"))
        .replace("@JOINTS@", &joints.to_string())
        .replace("@ARMS@", &arms.to_string())
        .replace("@COUNT@", &count.to_string())
        .replace("@DECLARATIONS@", &declarations)
        .replace("@FUNCTIONS@", &names)
        .replace("@CALLS@", &calls)
        .replace("@IN_RUST@", &list("rust"))
        .replace("@IN_C@", &list("c"))
}

#[test]
fn modules_in_c_and_rust_have_the_same_bits_and_refuse_hostile_numbers() {
    if without("cc") {
        return;
    }
    for layout in LAYOUTS {
        let modules = Modules::new(layout);
        let source = format!("{layout}.c");
        for (real, precision) in [("f64", "-UNOTHING"), ("f32", &modules.single())] {
            modules.write("main.rs", &program(&modules, real));
            modules
                .compile("cc", &["-std=c99", "-O2", "-ffp-contract=off", precision, "-c", "-o", "module.o", &source]);
            let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
            let arguments =
                ["--edition", "2024", "-C", "opt-level=0", "-C", "link-arg=module.o", "-o", "compare", "main.rs"];
            modules.compile(&rustc, &arguments);
            let (code, out, err) = modules.run("./compare", &[]);
            assert!(code == 0 && out.contains("1000 states"), "{layout}, {real}: {code}\n{out}{err}");
            if real == "f64" {
                compare_with_the_library(layout, &out);
            }
        }
    }
}

/// Steps and impulses that a program has printed, against the library's integrator and its exact impact.
fn compare_with_the_library(layout: &str, printed: &str) {
    let model = planar_capture::registry::generated(&planar_proof::layout(layout)).expect("generated code");
    let (joints, arms) = (model.joints(), model.arms());
    let mut compared = 0;
    for line in printed.lines().filter(|line| line.contains('[')) {
        let lists = line.split(['[', ']']).skip(1).step_by(2);
        let mut lists = lists.map(|list| list.split(", ").map(|x| x.parse().expect("a number")).collect::<Vec<f64>>());
        let (x, y) = (lists.next().expect("inputs"), lists.next().expect("results"));
        let expected = if line.starts_with("rk4_step") { step(&*model, &x) } else { impulses(&*model, &x) };
        assert_eq!(y.len(), expected.len());
        for (found, expected) in y.iter().zip(&expected) {
            let size = 1.0 + expected.abs();
            assert!((found - expected).abs() <= tolerance::IN_ANOTHER_MODULE * size, "{layout}: {line}: {expected:?}");
        }
        compared += 1;
    }
    assert_eq!(compared, 16, "{joints} joints, {arms} arms");
}

/// [pose, angles, twist, rates, torques, step] after the step.
pub fn step(model: &dyn Model<f64>, x: &[f64]) -> Vec<f64> {
    let n = model.joints();
    let (mut state, rest) = (x[..6 + 2 * n].to_vec(), &x[6 + 2 * n..]);
    let mut workspace = vec![0.0; 3 * state.len()];
    let derivative = |_, x: &[f64], slope: &mut [f64]| {
        let (position, velocity) = x.split_at(3 + n);
        let state = State {
            base_pose: [position[0], position[1], position[2]],
            joint_angles: &position[3..],
            base_twist: [velocity[0], velocity[1], velocity[2]],
            joint_rates: &velocity[3..],
        };
        let forces = Forces { joint_torques: &rest[..n], base_wrench: None, end_effector_wrenches: None };
        let mut accelerations = vec![0.0; n];
        let base = model.forward_dynamics(&state, &forces, &mut accelerations)?;
        slope[..3 + n].copy_from_slice(velocity);
        slope[3 + n..6 + n].copy_from_slice(&base);
        slope[6 + n..].copy_from_slice(&accelerations);
        Ok(())
    };
    let mut integrator = RungeKutta4::new(&mut workspace).expect("an integrator");
    integrator.step(0.0, rest[n], &mut state, derivative).expect("a step");
    state
}

/// Twists of the targets and impulses, from [pose, angles, twist, rates, masses, inertias, contacts, twists].
fn impulses(model: &dyn Model<f64>, x: &[f64]) -> Vec<f64> {
    let (n, arms) = (model.joints(), model.arms());
    let (velocity, rest) = (&x[3 + n..6 + 2 * n], &x[6 + 2 * n..]);
    let state = State {
        base_pose: [x[0], x[1], x[2]],
        joint_angles: &x[3..3 + n],
        base_twist: [velocity[0], velocity[1], velocity[2]],
        joint_rates: &velocity[3..],
    };
    let mut twists = vec![[0.0; 3]; arms];
    model.end_effector_twists(&state, &mut twists).expect("twists");
    let at = |from: usize, width: usize, arm: usize| &rest[from * arms + width * arm..][..width];
    let mut all = [Vec::new(), Vec::new()];
    for (arm, twist) in twists.iter().enumerate() {
        let target = Target {
            mass: rest[arm],
            inertia: rest[arms + arm],
            contact: [at(2, 2, arm)[0], at(2, 2, arm)[1]],
            twist: [at(4, 3, arm)[0], at(4, 3, arm)[1], at(4, 3, arm)[2]],
        };
        let after = target.twist_from_contact(twist);
        all[0].extend(after);
        all[1].extend(target.impulse(&after));
    }
    all.concat()
}
