//! The numbers that programs begin with.

use super::function::run;
use super::program::Program;
use super::values::Source;

/// The parameters of a robot, and what a program computes from them.
pub(super) fn of_model(program: &Program, parameters: &[f64]) -> Vec<f64> {
    let literals = first(program, &[]);
    let mut all = parameters.to_vec();
    run(program, &literals, &[parameters], |registers| {
        all.extend(program.outputs.iter().map(|register| registers[usize::from(*register)]));
    });
    all
}

/// What is in the first registers of a program, with those numbers of a model.
pub(super) fn first(program: &Program, model: &[f64]) -> Vec<f64> {
    let number = |source: &Source| match source {
        Source::Number(number) => *number,
        Source::Model(index) => model.get(*index).copied().unwrap_or(f64::NAN),
    };
    program.constants.iter().map(number).collect()
}
