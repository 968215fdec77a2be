//! One function of a graph as a program.

use super::argument::Argument;
use super::execute::{Registers, execute, registers};
use super::instruction::Register;
use super::program::Program;
use super::recorded::in_loops;
use super::values::{Source, Value, Values};
use crate::format::{Family, Function as GraphFunction, Graph, Operand, Operation, PIVOT};
use std::cell::RefCell;
use std::ops::Range;

/// A function of a graph.
#[derive(Clone, Debug)]
pub struct Function {
    /// Position of the function among those of the evaluator, and of its constants in a model.
    pub(super) index: usize,
    pub(super) program: Program,
    /// The elements of each output among those of the program.
    pub(super) elements: Vec<Range<usize>>,
    /// The position of the output `smallest_pivot`, where it has one.
    pub(super) pivot: Option<usize>,
    name: String,
    inputs: Vec<Argument>,
    outputs: Vec<Argument>,
}

thread_local! {
    static REGISTERS: RefCell<Box<Registers>> = RefCell::new(registers());
}

/// Executes a program in the registers of the thread.
pub(super) fn run<R>(program: &Program, constants: &[f64], inputs: &[&[f64]], read: impl FnOnce(&Registers) -> R) -> R {
    REGISTERS.with_borrow_mut(|registers| {
        let mut rest = &mut registers[..];
        for part in std::iter::once(&constants).chain(inputs) {
            let (place, after) = rest.split_at_mut(part.len());
            place.copy_from_slice(part);
            rest = after;
        }
        execute(program, registers);
        read(registers)
    })
}

/// The results of a call, in the registers.
pub(super) struct Results<'a> {
    function: &'a Function,
    registers: &'a Registers,
}

impl Results<'_> {
    /// The elements of an output, by its position.
    pub fn elements(&self, output: usize) -> impl Iterator<Item = f64> {
        let registers: &[Register] = &self.function.program.outputs[self.function.elements[output].clone()];
        registers.iter().map(|register| self.registers[usize::from(*register)])
    }

    /// An output of one element.
    pub fn scalar(&self, output: usize) -> f64 {
        self.elements(output).next().unwrap_or(f64::NAN)
    }
}

impl Function {
    /// As in the graph.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is computed from, in order.
    #[must_use]
    pub fn inputs(&self) -> &[Argument] {
        &self.inputs
    }

    /// What it computes, in order. `smallest_pivot`, where there is one, is relative to its scale: at or below 8
    /// roundings the others are those of a singular system.
    #[must_use]
    pub fn outputs(&self) -> &[Argument] {
        &self.outputs
    }

    /// Calls it; `read` takes what it wants of the results.
    pub(super) fn call<R>(&self, constants: &[f64], inputs: &[&[f64]], read: impl FnOnce(&Results<'_>) -> R) -> R {
        run(&self.program, constants, inputs, |registers| read(&Results { function: self, registers }))
    }

    /// That it has these inputs, and outputs with these numbers of elements.
    ///
    /// # Errors
    /// How it differs from that.
    pub(super) fn check(&self, inputs: &[&str], outputs: &[(&str, usize)]) -> Result<(), String> {
        let found: Vec<&str> = self.inputs.iter().map(|input| input.name.as_str()).collect();
        if found != inputs {
            return Err(format!("it has the inputs {}, expected {}", found.join(", "), inputs.join(", ")));
        }
        let found: Vec<_> = self.outputs.iter().map(|output| (output.name.as_str(), output.rows())).collect();
        if found == outputs { Ok(()) } else { Err(format!("it has the outputs {found:?}, expected {outputs:?}")) }
    }

    /// The same function of the graph with some of its outputs alone.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(super) fn with_outputs(&self, graph: &Graph, outputs: &[&str], index: usize) -> Result<Self, String> {
        let found = graph.functions_of_families().nth(self.index);
        let (family, function) = found.ok_or("its function is not in the graph")?;
        let mut function = function.clone();
        function.outputs.retain(|output| outputs.contains(&output.name.as_str()));
        Self::new(graph, family, &function, index)
    }

    /// The program of a function of a family.
    ///
    /// # Errors
    /// A name that is not known, or too many registers.
    pub(super) fn new(graph: &Graph, family: &Family, function: &GraphFunction, index: usize) -> Result<Self, String> {
        let mut values = Values::default();
        let of_model = graph.parameters.iter().map(|parameter| &parameter.name);
        for (index, name) in of_model.chain(graph.constants.values.iter().map(|value| &value.name)).enumerate() {
            values.name(name.clone(), Value::Constant(Source::Model(index)));
        }
        let mut inputs = Vec::with_capacity(function.inputs.len());
        let mut elements = 0;
        for input in &function.inputs {
            let declared = graph.inputs.iter().find(|declared| declared.name == *input);
            let declared = declared.ok_or_else(|| format!("its input `{input}` is not declared"))?;
            let argument = Argument::new(declared);
            for index in 0..argument.rows() {
                values.name(declared.element(index), Value::Input(elements));
                elements += 1;
            }
            inputs.push(argument);
        }
        values.extend(&family.configuration.statements)?;
        values.extend(&function.statements)?;
        let roots = function.roots().iter().flat_map(|root| &root.elements);
        let mut wanted = roots.map(|element| values.operand(element)).collect::<Result<Vec<_>, _>>()?;
        if function.is_in_loops() {
            for input in graph.inputs_of_call(function) {
                for element in 0..input.shape.iter().product() {
                    wanted.push(values.operand(&Operand::Name(input.element(element)))?);
                }
            }
            wanted = in_loops(&mut values, function, &wanted);
        }
        let mut ranges = Vec::with_capacity(function.outputs.len());
        let mut end = 0;
        for output in &function.outputs {
            ranges.push(end..end + output.elements.len());
            end += output.elements.len();
        }
        let pivot = function.outputs.iter().position(|output| output.name == PIVOT);
        if let Some(pivot) = pivot {
            // after the graph's
            let regularity = values.constant(Source::Model(graph.parameters.len() + graph.constants.values.len()));
            if let Some(element) = wanted.get_mut(ranges[pivot].start) {
                *element = values.result(Operation::Add, *element, Some(regularity));
            }
        }
        let angles = function.outputs.iter().flat_map(|o| (0..o.elements.len()).map(|element| o.is_angle(element)));
        for (element, _) in wanted.iter_mut().zip(angles).filter(|(_, is_angle)| *is_angle) {
            *element = values.saturated(*element);
        }
        Ok(Self {
            index,
            program: Program::new(&values, elements, &wanted)?,
            elements: ranges,
            pivot,
            name: function.name.clone(),
            inputs,
            outputs: function.outputs.iter().map(Argument::new).collect(),
        })
    }
}
