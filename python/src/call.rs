//! A function of a graph for many instances, on several threads.

use crate::chunks::{chunk_of_batch, parts, parts_mut};
use planar_capture::evaluator::{Argument, Batch, CallError, Evaluator, Function, GraphModel, Status};
use std::thread;

/// The robots of a batch.
#[derive(Clone, Copy)]
pub enum Robots<'a> {
    /// One for all instances.
    One(&'a GraphModel),
    /// With numbers of their own.
    Each(&'a Evaluator, &'a [f64]),
}

/// A call whose arrays have the lengths of its arguments.
pub struct Call<'a> {
    pub function: &'a Function,
    pub robots: Robots<'a>,
    pub inputs: &'a [&'a [f64]],
    /// Whether an output is computed, for each.
    pub wanted: &'a [bool],
    pub instances: usize,
    /// At most so many; as many as processors by default.
    pub threads: Option<usize>,
}

/// The outputs that are wanted; zeros where the status is not `Done`.
pub struct Results {
    pub outputs: Vec<Option<Vec<f64>>>,
    pub statuses: Vec<Status>,
}

/// What one thread computes.
struct Part<'a> {
    parameters: &'a [f64],
    inputs: Vec<&'a [f64]>,
    outputs: Vec<Option<&'a mut [f64]>>,
    statuses: &'a mut [Status],
}

impl Call<'_> {
    /// Computes all instances. Their bits do not depend on the number of threads.
    ///
    /// # Errors
    /// [`CallError`] for arrays of other lengths.
    pub fn run(&self) -> Result<Results, CallError> {
        let Self { function, instances, .. } = *self;
        let of_output = |(output, wanted): (&Argument, &bool)| wanted.then(|| vec![0.0; output.rows() * instances]);
        let mut outputs: Vec<_> = function.outputs().iter().zip(self.wanted).map(of_output).collect();
        let mut statuses = vec![Status::Done; instances];
        let chunk = chunk_of_batch(instances, self.threads);
        if chunk >= instances {
            let parameters = if let Robots::Each(_, parameters) = self.robots { parameters } else { &[] };
            let whole = outputs.iter_mut().map(Option::as_deref_mut).collect();
            let part = Part { parameters, inputs: self.inputs.to_vec(), outputs: whole, statuses: &mut statuses };
            self.compute(part)?;
        } else {
            let parts = self.parts(&mut outputs, &mut statuses, chunk);
            thread::scope(|scope| {
                let threads: Vec<_> = parts.into_iter().map(|part| scope.spawn(|| self.compute(part))).collect();
                // a thread that panics ends the scope with its panic
                threads.into_iter().filter_map(|thread| thread.join().ok()).collect::<Result<(), _>>()
            })?;
        }
        Ok(Results { outputs, statuses })
    }

    fn parts<'p>(
        &'p self,
        outputs: &'p mut [Option<Vec<f64>>],
        statuses: &'p mut [Status],
        chunk: usize,
    ) -> Vec<Part<'p>> {
        let mut inputs: Vec<_> = self
            .inputs
            .iter()
            .zip(self.function.inputs())
            .map(|(all, input)| parts(all, input.rows(), chunk))
            .collect();
        let mut outputs: Vec<_> = outputs
            .iter_mut()
            .zip(self.function.outputs())
            .map(|(all, output)| all.as_mut().map(|all| parts_mut(all, output.rows(), chunk)))
            .collect();
        let mut parameters = match self.robots {
            Robots::One(_) => None,
            Robots::Each(evaluator, all) => Some(parts(all, evaluator.parameters().len(), chunk)),
        };
        let part = |statuses| Part {
            parameters: parameters.as_mut().and_then(Iterator::next).unwrap_or_default(),
            inputs: inputs.iter_mut().map(|parts| parts.next().unwrap_or_default()).collect(),
            outputs: outputs.iter_mut().map(|parts| parts.as_mut().and_then(Iterator::next)).collect(),
            statuses,
        };
        statuses.chunks_mut(chunk).map(part).collect()
    }

    fn compute(&self, mut part: Part<'_>) -> Result<(), CallError> {
        let batch = match self.robots {
            Robots::One(robot) => Batch::of(robot),
            Robots::Each(evaluator, _) => Batch::of_each(evaluator, part.parameters),
        };
        batch.call(self.function.name(), &part.inputs, &mut part.outputs, part.statuses)
    }
}
