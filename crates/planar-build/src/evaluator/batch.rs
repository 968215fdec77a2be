//! Functions of a graph for many instances at once.

use super::function::Function;
use super::lanes::{Call, Constants, InstructionSet, Matrix, MatrixMut, Order};
use super::model::{Evaluator, GraphModel};
use planar_dynamics::status::Status;

/// Functions of a graph for N instances at once, of one robot or of as many robots, in the vectors of the processor.
///
/// Inputs and outputs are those of the [`Function`] that is called, in its order: an array for each, with a number for
/// every element of every instance, which follow each other in the batch's [`Order`]. N is any number, that of the
/// statuses. Results have the bits of the model's functions for one state, with every instruction set.
///
/// A call is computed by the thread that makes it. For several threads, let each have some of the instances: in the
/// order of [`Order::Instances`] these are parts of the arrays.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'e> {
    evaluator: &'e Evaluator,
    robots: Robots<'e>,
    order: Order,
    instructions: InstructionSet,
}

#[derive(Clone, Copy, Debug)]
enum Robots<'e> {
    One(&'e GraphModel),
    /// Of which these are the parameters.
    Each(&'e [f64]),
}

/// A call that has no results at all.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CallError {
    /// There is no function of that name.
    #[error("the graph has no function `{name}`: it has {}", known.join(", "))]
    Function {
        /// The name.
        name: String,
        /// Those of all functions.
        known: Vec<String>,
    },
    /// Too many inputs or outputs, or too few.
    #[error("`{function}` has {expected} {what}, not {found}")]
    Count {
        /// The function's name.
        function: String,
        /// Inputs or outputs.
        what: &'static str,
        /// How many it has.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// An array that has not a number for each element of each instance.
    #[error("`{argument}` needs {elements} numbers for each of {instances} instances, it has {found} in all")]
    Length {
        /// The argument's name.
        argument: String,
        /// The number of its elements.
        elements: usize,
        /// The number of instances.
        instances: usize,
        /// The length of the array.
        found: usize,
    },
}

impl<'e> Batch<'e> {
    /// Instances of one robot.
    #[must_use]
    pub fn of(robot: &'e GraphModel) -> Self {
        Self::new(robot.evaluator(), Robots::One(robot))
    }

    /// Instances of as many robots, with a number for each parameter of each: those of
    /// [`Structure::parameters`](planar_layout::structure::Structure::parameters) in its order, kg, kg m², m and rad;
    /// those of a layout are given by [`parameters`](planar_layout::structure::parameters). What follows from the
    /// parameters alone is computed for each instance, which takes about half as long as forward dynamics.
    ///
    /// Of functions with a pivot, instances with a mass or moment of inertia of 0 are [`Singular`](Status::Singular). With
    /// one below 0 the system is singular or the motion impossible; that is not looked for.
    #[must_use]
    pub fn of_each(evaluator: &'e Evaluator, parameters: &'e [f64]) -> Self {
        Self::new(evaluator, Robots::Each(parameters))
    }

    fn new(evaluator: &'e Evaluator, robots: Robots<'e>) -> Self {
        Self { evaluator, robots, order: Order::default(), instructions: InstructionSet::default() }
    }

    /// With arrays, those of parameters too, in another order than [`Order::Instances`].
    #[must_use]
    pub fn in_order(self, order: Order) -> Self {
        Self { order, ..self }
    }

    /// With other instructions than the best of the processor.
    #[must_use]
    pub fn with_instructions(self, instructions: InstructionSet) -> Self {
        Self { instructions, ..self }
    }

    /// Calls the function of a name: the status of every instance, and of those that are [`Status::Done`] the outputs;
    /// those of others stay as they were. `None` is an output that is not wanted.
    ///
    /// An instance is [`NotFinite`](Status::NotFinite) where an input or a parameter is NaN or infinite; else
    /// [`Singular`](Status::Singular) where the function has an output `smallest_pivot` and that is at or below 8
    /// roundings; else `NotFinite` where a wanted output has such a number.
    ///
    /// # Errors
    /// [`CallError`]; nothing is written then.
    pub fn call(
        &self,
        function: &str,
        inputs: &[&[f64]],
        outputs: &mut [Option<&mut [f64]>],
        statuses: &mut [Status],
    ) -> Result<(), CallError> {
        let function = self.function(function)?;
        let (instances, order) = (statuses.len(), self.order);
        let count = |what, expected: usize, found: usize| {
            let name = || function.name().to_owned();
            if expected == found { Ok(()) } else { Err(CallError::Count { function: name(), what, expected, found }) }
        };
        let length = |argument: &str, elements: usize, found: usize| {
            let argument = || argument.to_owned();
            let error = || CallError::Length { argument: argument(), elements, instances, found };
            if elements * instances == found { Ok(()) } else { Err(error()) }
        };
        count("inputs", function.inputs().len(), inputs.len())?;
        count("outputs", function.outputs().len(), outputs.len())?;
        let matrix = |numbers, elements| Matrix { numbers, elements, instances, order };
        let constants = match self.robots {
            Robots::One(robot) => Constants::Same(robot.constants(function)),
            Robots::Each(parameters) => {
                let elements = self.evaluator.structure().parameters.len();
                length("parameters", elements, parameters.len())?;
                Constants::Each { program: &self.evaluator.constants, parameters: matrix(parameters, elements) }
            }
        };
        let mut of_inputs = Vec::with_capacity(inputs.len());
        for (input, numbers) in function.inputs().iter().zip(inputs) {
            length(&input.name, input.rows(), numbers.len())?;
            of_inputs.push(matrix(numbers, input.rows()));
        }
        let mut of_outputs = Vec::with_capacity(outputs.len());
        for (output, numbers) in function.outputs().iter().zip(outputs) {
            let elements = output.rows();
            if let Some(numbers) = numbers {
                length(&output.name, elements, numbers.len())?;
            }
            of_outputs.push(numbers.as_deref_mut().map(|numbers| MatrixMut { numbers, elements, instances, order }));
        }
        Call { function, constants, inputs: of_inputs, outputs: of_outputs, statuses }.run(self.instructions);
        Ok(())
    }

    fn function(&self, name: &str) -> Result<&'e Function, CallError> {
        self.evaluator.function(name).ok_or_else(|| CallError::Function {
            name: name.to_owned(),
            known: self.evaluator.functions().map(|function| function.name().to_owned()).collect(),
        })
    }
}
