//! One function of a graph as a program.

use super::execute::{Registers, execute, registers};
use super::instruction::Register;
use super::program::Program;
use super::values::{Source, Value, Values};
use crate::format::{Family, Graph};
use std::cell::RefCell;
use std::ops::Range;

/// The program of a function.
#[derive(Clone, Debug)]
pub(super) struct Function {
    /// Position of the function among those of the evaluator, and of its constants in a model.
    pub index: usize,
    pub program: Program,
    /// The elements of each output.
    outputs: Vec<Range<usize>>,
}

thread_local! {
    static REGISTERS: RefCell<Box<Registers<f64>>> = RefCell::new(registers());
}

/// Executes a program in the registers of the thread.
pub(super) fn run<R>(
    program: &Program,
    constants: &[f64],
    inputs: &[&[f64]],
    read: impl FnOnce(&Registers<f64>) -> R,
) -> R {
    REGISTERS.with_borrow_mut(|registers| {
        let mut rest = &mut registers[..];
        for part in std::iter::once(&constants).chain(inputs) {
            let (place, after) = rest.split_at_mut(part.len());
            place.copy_from_slice(part);
            rest = after;
        }
        execute(&program.instructions, registers);
        read(registers)
    })
}

/// The results of a call, in the registers.
pub(super) struct Results<'a> {
    function: &'a Function,
    registers: &'a Registers<f64>,
}

impl Results<'_> {
    /// The elements of an output, by its position.
    pub fn elements(&self, output: usize) -> impl Iterator<Item = f64> {
        let registers: &[Register] = &self.function.program.outputs[self.function.outputs[output].clone()];
        registers.iter().map(|register| self.registers[usize::from(*register)])
    }

    /// An output of one element.
    pub fn scalar(&self, output: usize) -> f64 {
        self.elements(output).next().unwrap_or(f64::NAN)
    }
}

impl Function {
    /// Calls it; `read` takes what it wants of the results.
    pub fn call<R>(&self, constants: &[f64], inputs: &[&[f64]], read: impl FnOnce(&Results<'_>) -> R) -> R {
        run(&self.program, constants, inputs, |registers| read(&Results { function: self, registers }))
    }

    /// The program of the function of a name, with these inputs, and outputs with these numbers of elements.
    ///
    /// # Errors
    /// How it differs from that.
    pub fn new(
        graph: &Graph,
        (name, index): (&str, usize),
        inputs: &[&str],
        outputs: &[(&str, usize)],
    ) -> Result<Self, String> {
        let functions = |family: &Family| family.functions.iter().position(|function| function.name == name);
        let found = graph.families.iter().find_map(|family| Some((family, &family.functions[functions(family)?])));
        let (family, function) = found.ok_or("it is missing")?;
        if function.inputs != inputs {
            return Err(format!("it has the inputs {}, expected {}", function.inputs.join(", "), inputs.join(", ")));
        }
        let found: Vec<_> =
            function.outputs.iter().map(|output| (output.name.as_str(), output.elements.len())).collect();
        if found != outputs {
            return Err(format!("it has the outputs {found:?}, expected {outputs:?}"));
        }
        let mut values = Values::default();
        let of_model = graph.parameters.iter().map(|parameter| &parameter.name);
        for (index, name) in of_model.chain(graph.constants.values.iter().map(|value| &value.name)).enumerate() {
            values.name(name.clone(), Value::Constant(Source::Model(index)));
        }
        let mut elements = 0;
        for input in inputs {
            let declared = graph.inputs.iter().find(|declared| declared.name == *input);
            let declared = declared.ok_or_else(|| format!("its input `{input}` is not declared"))?;
            for index in 0..declared.shape.iter().product() {
                values.name(declared.element(index), Value::Input(elements));
                elements += 1;
            }
        }
        values.extend(&family.configuration.statements)?;
        values.extend(&function.statements)?;
        let mut wanted = Vec::new();
        let mut ranges = Vec::with_capacity(function.outputs.len());
        for output in &function.outputs {
            let start = wanted.len();
            for element in &output.elements {
                wanted.push(values.operand(element)?);
            }
            ranges.push(start..wanted.len());
        }
        Ok(Self { index, program: Program::new(&values, elements, &wanted)?, outputs: ranges })
    }
}
