use super::constants;
use super::execute::{execute, registers};
use super::instruction::Kind;
use super::lanes::{self, Lanes};
use super::program::Program;
use super::values::{Value, Values};
use crate::format::{Operand, Operation, Statement, Targets};
use crate::graph;
use planar_dynamics::scalar::Scalar;
use rand::rngs::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use serde_json::{Value as Json, json};
use std::cell::Cell;
use std::collections::HashMap;

/// The text of a shipped graph.
fn shipped() -> String {
    text_of("single_arm_2r")
}

fn text_of(name: &str) -> String {
    let path = format!("{}/../../codegen/graphs/{name}.json", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a graph")
}

fn statements(all: Json) -> Vec<Statement> {
    serde_json::from_value(all).expect("statements")
}

/// The program of statements with the inputs `x[0]`, `x[1]`, …, of which some outputs are wanted.
fn program(statements: &[Statement], inputs: usize, outputs: &[&str]) -> Program {
    let mut values = Values::default();
    for input in 0..inputs {
        values.name(format!("x[{input}]"), Value::Input(input));
    }
    values.extend(statements).expect("known names");
    let mut value = |name: &str| values.operand(&Operand::Name(name.to_owned())).expect("a name");
    let outputs: Vec<usize> = outputs.iter().map(|name| value(name)).collect();
    Program::new(&values, inputs, &outputs).expect("few registers")
}

/// Those of all instructions.
fn kinds(program: &Program) -> Vec<Kind> {
    program.runs().flat_map(|(kind, instructions)| vec![kind; instructions.len()]).collect()
}

fn run(program: &Program, inputs: &[f64]) -> Vec<f64> {
    let mut file = registers();
    let numbers = constants::first(program, &[]).into_iter().chain(inputs.iter().copied());
    file.iter_mut().zip(numbers).for_each(|(place, number)| *place = number);
    execute(program, &mut file);
    program.outputs.iter().map(|register| file[usize::from(*register)]).collect()
}

/// The same for a block of instances that all have these inputs, of which the last is returned.
fn run_block(program: &Program, inputs: &[f64]) -> Vec<f64> {
    let mut file = vec![[(); 2].map(|()| Cell::new(Lanes([f64::NAN; 8]))); program.registers];
    let numbers = constants::first(program, &[]).into_iter().chain(inputs.iter().copied());
    for (register, number) in file.iter_mut().zip(numbers) {
        *register = [(); 2].map(|()| Cell::new(Lanes([number; 8])));
    }
    lanes::execute(program, &file);
    program.outputs.iter().map(|register| file[usize::from(*register)][1].get().0[7]).collect()
}

#[test]
fn products_that_one_sum_uses_are_part_of_it() {
    let all = statements(json!([
        ["p", "mul", "x[0]", "x[1]"],
        ["q", "mul", "x[1]", "x[2]"],
        ["dead", "mul", "x[2]", "x[2]"],
        ["d", "sub", "p", "q"],
        ["r", "mul", "x[0]", "x[0]"],
        ["e", "sub", "d", "r"],
        ["f", "add", "r", "e"],
    ]));
    let program = program(&all, 3, &["f"]);
    assert_eq!(kinds(&program), [Kind::MulSubMul, Kind::Mul, Kind::Sub, Kind::Add], "`r` has two uses");
    assert_eq!(run(&program, &[2.0, 3.0, 5.0]), [6.0 - 15.0 - 4.0 + 4.0]);
}

#[test]
fn a_product_with_itself_and_a_wanted_product_stay() {
    let all = statements(json!([["p", "mul", "x[0]", "x[1]"], ["d", "add", "p", "p"], ["e", "add", "d", 1.0]]));
    assert_eq!(run(&program(&all, 2, &["e", "p"]), &[2.0, 3.0]), [13.0, 6.0]);
    let all = statements(json!([["p", "mul", "x[0]", "x[1]"], ["s", "add", "p", "x[0]"]]));
    let program = program(&all, 2, &["s", "p"]);
    assert_eq!(kinds(&program), [Kind::Mul, Kind::Add]);
}

#[test]
fn one_of_sine_and_cosine_may_be_wanted() {
    let all = statements(json!([[["s", "c"], "sin_cos", "x[0]"], ["y", "mul", "c", 2.0], ["z", "neg", "x[0]"]]));
    assert_eq!(run(&program(&all, 1, &["y", "z"]), &[0.0]), [2.0, -0.0]);
    assert_eq!(run(&program(&all, 1, &["s"]), &[0.0]), [0.0]);
    assert_eq!(kinds(&program(&all, 1, &["z"])), [Kind::Neg], "no sine for nothing");
}

/// Random statements of all operations, computed one after the other under their names, have the same bits.
#[test]
fn programs_compute_what_their_statements_say() {
    const OPERATIONS: [(&str, Operation); 9] = [
        ("neg", Operation::Neg),
        ("sqrt", Operation::Sqrt),
        ("add", Operation::Add),
        ("sub", Operation::Sub),
        ("mul", Operation::Mul),
        ("div", Operation::Div),
        ("min", Operation::Min),
        ("atan2", Operation::Atan2),
        ("copy", Operation::Copy),
    ];
    let mut random = ChaCha8Rng::seed_from_u64(14);
    for _ in 0..200 {
        let mut known: HashMap<String, f64> =
            (0..4).map(|i| (format!("x[{i}]"), random.random_range(-2.0..2.0))).collect();
        let inputs: Vec<f64> = (0..4).map(|i| known[&format!("x[{i}]")]).collect();
        let mut names: Vec<String> = (0..4).map(|i| format!("x[{i}]")).collect();
        let mut all = Vec::new();
        for index in 0..60 {
            let mut operand = || match names.choose(&mut random).filter(|_| index % 7 != 0) {
                Some(name) => (Operand::Name(name.clone()), known[name]),
                None => (Operand::Number(0.5), 0.5),
            };
            let ((a, x), (b, y)) = (operand(), operand());
            // sums and products are what most of a graph is
            let (_, operation) = OPERATIONS[if index % 3 == 0 { random.random_range(0..9) } else { 2 + index % 3 }];
            let name = format!("v{index}");
            if index % 20 == 19 {
                let targets = Targets::SinCos(name.clone(), format!("w{index}"));
                all.push(Statement { targets, operation: Operation::SinCos, a, b: Operand::Number(f64::NAN) });
                let (sine, cosine) = Scalar::sin_cos(x);
                known.extend([(name.clone(), sine), (format!("w{index}"), cosine)]);
                names.extend([name, format!("w{index}")]);
                continue;
            }
            let value = match operation {
                Operation::Neg => -x,
                Operation::Sqrt => x.sqrt(),
                Operation::Add => x + y,
                Operation::Sub => x - y,
                Operation::Mul => x * y,
                Operation::Div => x / y,
                Operation::Min => Scalar::minimum(x, y),
                Operation::Atan2 => Scalar::atan2(x, y),
                Operation::Copy | Operation::SinCos => x,
            };
            all.push(Statement { targets: Targets::Value(name.clone()), operation, a, b });
            known.insert(name.clone(), value);
            names.push(name);
        }
        let wanted: Vec<&str> = names.iter().map(String::as_str).filter(|_| random.random_range(0..4) == 0).collect();
        let program = program(&all, 4, &wanted);
        let expected: Vec<f64> = wanted.iter().map(|name| known[*name]).collect();
        for found in [run(&program, &inputs), run_block(&program, &inputs)] {
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    found.to_bits() == expected.to_bits() || (found.is_nan() && expected.is_nan()),
                    "{found} {expected}"
                );
            }
        }
    }
}

/// Those of forward dynamics are few: results share them, and have those of inputs.
#[test]
fn results_share_registers() {
    let graph = graph::read_any(&shipped()).expect("sound");
    let evaluator = super::Evaluator::new(&graph).expect("all functions");
    let program = &evaluator.function("forward_dynamics").expect("there").program;
    let inputs = 3 + 2 + 3 + 2 + 2;
    let others = program.registers - program.constants.len() - inputs;
    let count = kinds(program).len();
    assert!(others < count / 4, "{others} besides {inputs} for inputs, for {count} instructions");
}

/// Instructions that do not need each other follow each other, those of one kind above all.
#[test]
fn instructions_of_one_kind_follow_each_other() {
    let graph = graph::read_any(&text_of("dual_arm_3r")).expect("sound");
    let evaluator = super::Evaluator::new(&graph).expect("all functions");
    let program = &evaluator.function("forward_dynamics").expect("there").program;
    let (runs, count) = (program.runs().count(), kinds(program).len());
    assert!(runs * 2 < count, "{runs} runs of {count} instructions");
    let first = program.runs().next().expect("instructions");
    assert_eq!((first.0, first.1.len()), (Kind::SinCos, 7), "what others wait for longest is first");
}

#[test]
fn what_is_no_graph_of_a_robot_is_refused() {
    let problem = |change: &dyn Fn(&mut Json)| {
        let mut graph: Json = serde_json::from_str(&shipped()).expect("JSON");
        change(&mut graph);
        let graph = graph::read_any(&graph.to_string()).expect("sound");
        super::Evaluator::new(&graph).expect_err("not what it says").to_string()
    };
    let function = |graph: &mut Json, name: &str, change: &dyn Fn(&mut Json)| {
        let families = graph["families"].as_array_mut().expect("families").iter_mut();
        let mut functions = families.flat_map(|family| family["functions"].as_array_mut().expect("functions"));
        change(functions.find(|function| function["name"] == name).expect("there"));
    };
    let text = problem(&|graph| function(graph, "momentum", &|f| f["name"] = "momenta".into()));
    assert_eq!(text, "`momentum`: it is missing");
    let text = problem(&|graph| function(graph, "bias", &|f| f["outputs"][0]["name"] = "biases".into()));
    assert!(text.contains("`bias`: it has the outputs [(\"biases\", 5)], expected [(\"bias\", 5)]"), "{text}");
    let text =
        problem(&|graph| function(graph, "mass_matrix", &|f| f["inputs"] = json!(["joint_angles", "base_pose"])));
    assert!(text.contains("`mass_matrix`: it has the inputs joint_angles, base_pose, expected"), "{text}");
    let text = problem(&|graph| graph["parameters"][2]["quantity"] = "base_mass".into());
    assert!(text.contains("is no parameter of the layout, or is one twice"), "{text}");
    let text = problem(&|graph| graph["parameters"][2]["link"] = 7.into());
    assert!(text.contains("is no parameter of the layout, or is one twice"), "{text}");
}
