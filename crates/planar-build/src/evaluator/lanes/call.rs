//! A call of a function for all instances of a batch.

use super::dispatch::{InstructionSet, Kernel};
use super::execute::{Block, LANES, Lanes, execute};
use super::matrix::{Matrix, MatrixMut, Span};
use crate::evaluator::constants;
use crate::evaluator::function::Function;
use crate::evaluator::program::Program;
use crate::evaluator::values::Source;
use planar_dynamics::status::Status;
use planar_dynamics::validate::is_regular;
use std::cell::{Cell, RefCell};

/// What the instances do not share in the first registers of a function.
#[derive(Clone, Copy, Debug)]
pub(in crate::evaluator) enum Constants<'a> {
    /// Nothing: these are theirs.
    Same(&'a [f64]),
    /// All that comes from the parameters, by this program.
    Each { program: &'a Program, parameters: Matrix<'a> },
}

/// A call of a function for all instances of a batch.
#[derive(Debug)]
pub(in crate::evaluator) struct Call<'a> {
    pub function: &'a Function,
    pub constants: Constants<'a>,
    pub inputs: Vec<Matrix<'a>>,
    /// `None` where an output is not wanted.
    pub outputs: Vec<Option<MatrixMut<'a>>>,
    pub statuses: &'a mut [Status],
}

thread_local! {
    static WORKSPACE: RefCell<Vec<Lanes>> = const { RefCell::new(Vec::new()) };
}

/// Registers of this size are there at once: that of half a second-level cache. From the first level they would come
/// sooner, in blocks so small that decoding the instructions takes longer than that.
const CACHE: usize = 256 << 10;

/// So many instances take no longer one by one than as a block.
const FEW: usize = 2;

impl Call<'_> {
    /// Computes the status of each instance, and the outputs of those that are `Done`.
    pub fn run(mut self, instructions: InstructionSet) {
        if self.statuses.len() <= FEW {
            self.statuses.fill(Status::NotFinite);
        } else {
            WORKSPACE.with_borrow_mut(|workspace| instructions.run(&mut self, workspace));
        }
        for instance in 0..self.statuses.len() {
            if self.statuses[instance] != Status::Done {
                self.statuses[instance] = self.one(instance);
            }
        }
    }

    /// The numbers of lanes that both programs need.
    fn registers(&self) -> [usize; 2] {
        let of_model = match self.constants {
            Constants::Same(_) => 0,
            Constants::Each { program, .. } => program.registers,
        };
        [of_model, self.function.program.registers]
    }

    /// Computes instances in whole blocks of C · LANES, and the last ones where C is 1; returns the next instance.
    #[inline(always)]
    fn blocks_of<const C: usize>(&mut self, mut from: usize, workspace: &mut Vec<Lanes>) -> usize {
        let count = self.statuses.len();
        let least = if C == 1 { 1 } else { C * LANES };
        if count - from < least {
            return from;
        }
        let [of_model, of_function] = self.registers();
        workspace.resize(workspace.len().max((of_model + of_function) * C), Lanes([0.0; LANES]));
        let cells = Cell::from_mut(&mut workspace[..]).as_slice_of_cells();
        let (of_model, registers) = cells.as_chunks::<C>().0.split_at(of_model);
        self.set_constants(of_model, registers);
        while count - from >= least {
            let span = Span { from, len: (count - from).min(C * LANES) };
            self.block(of_model, registers, span);
            from += span.len;
        }
        from
    }

    /// Those that are the same for all instances.
    #[inline(always)]
    fn set_constants<const C: usize>(&self, of_model: &[Block<C>], registers: &[Block<C>]) {
        let set =
            |register: &Block<C>, number: f64| register.iter().for_each(|place| place.set(Lanes([number; LANES])));
        match self.constants {
            Constants::Same(numbers) => {
                registers.iter().zip(numbers).for_each(|(register, number)| set(register, *number));
            }
            Constants::Each { program, .. } => {
                for (program, registers) in [(program, of_model), (&self.function.program, registers)] {
                    for (register, source) in registers.iter().zip(&program.constants) {
                        if let Source::Number(number) = source {
                            set(register, *number);
                        }
                    }
                }
            }
        }
    }

    /// Computes the instances of a block.
    #[inline(always)]
    fn block<const C: usize>(&mut self, of_model: &[Block<C>], registers: &[Block<C>], span: Span) {
        let mut zeros = [[0.0; LANES]; C];
        self.load_model(of_model, registers, span, &mut zeros);
        let program = &self.function.program;
        let mut inputs = &registers[program.constants.len()..];
        for input in &self.inputs {
            input.load(span, inputs);
            add_zeros(&mut zeros, &inputs.iter().take(input.elements));
            inputs = &inputs[input.elements..];
        }
        execute(program, registers);
        for (output, wanted) in self.outputs.iter().enumerate() {
            if wanted.is_some() && self.function.pivot != Some(output) {
                add_zeros(&mut zeros, &results(self.function, output, registers));
            }
        }
        let pivots = self.function.pivot.and_then(|output| results(self.function, output, registers).next());
        let pivots = |chunk: usize| pivots.map_or([1.0; LANES], |pivots| pivots[chunk].get().0);
        let mut failed = 0_u64;
        for (chunk, zeros) in zeros.iter().enumerate() {
            let pivots = pivots(chunk);
            for lane in 0..LANES {
                failed += u64::from(!is_done(zeros[lane], pivots[lane]));
            }
        }
        let statuses = &mut self.statuses[span.from..][..span.len];
        if failed == 0 && span.len == C * LANES {
            statuses.fill(Status::Done);
            for (output, matrix) in self.outputs.iter_mut().enumerate() {
                if let Some(matrix) = matrix {
                    matrix.store(span.from, results(self.function, output, registers));
                }
            }
        } else {
            for (i, status) in statuses.iter_mut().enumerate() {
                let (chunk, lane) = (i / LANES, i % LANES);
                let is_done = is_done(zeros[chunk][lane], pivots(chunk)[lane]);
                *status = if is_done { Status::Done } else { Status::NotFinite };
            }
            self.store_done(registers, span);
        }
    }

    /// Where every instance has its own parameters: what comes from them, in the registers of the function.
    #[inline(always)]
    fn load_model<const C: usize>(
        &self,
        of_model: &[Block<C>],
        registers: &[Block<C>],
        span: Span,
        zeros: &mut [[f64; LANES]; C],
    ) {
        let Constants::Each { program, parameters } = self.constants else { return };
        let inputs = &of_model[program.constants.len()..];
        parameters.load(span, inputs);
        add_zeros(zeros, &inputs.iter().take(parameters.elements));
        let of_function = || registers.iter().zip(&self.function.program.constants);
        // before the registers of parameters become those of results
        for (register, source) in of_function() {
            if let Source::Model(index) = source
                && *index < parameters.elements
            {
                copy(&inputs[*index], register);
            }
        }
        execute(program, of_model);
        for (register, source) in of_function() {
            if let Source::Model(index) = source
                && *index >= parameters.elements
            {
                copy(&of_model[usize::from(program.outputs[*index - parameters.elements])], register);
            }
        }
    }

    /// Copies the outputs of those instances of a block that are done.
    #[cold]
    fn store_done<const C: usize>(&mut self, registers: &[Block<C>], span: Span) {
        for (output, matrix) in self.outputs.iter_mut().enumerate() {
            let Some(matrix) = matrix else { continue };
            for (element, register) in results(self.function, output, registers).enumerate() {
                for i in 0..span.len {
                    if self.statuses[span.from + i] == Status::Done {
                        matrix.set(element, span.from + i, register[i / LANES].get().0[i % LANES]);
                    }
                }
            }
        }
    }

    /// Computes one instance by the program of single numbers, whose sines are those of all angles.
    #[cold]
    fn one(&mut self, instance: usize) -> Status {
        let gather = |matrix: &Matrix<'_>| -> Vec<f64> {
            (0..matrix.elements).map(|element| matrix.at(element, instance)).collect()
        };
        let inputs: Vec<Vec<f64>> = self.inputs.iter().map(gather).collect();
        let mut is_given = inputs.iter().flatten().all(|number| number.is_finite());
        let of_each;
        let constants = match self.constants {
            Constants::Same(constants) => constants,
            Constants::Each { program, parameters } => {
                let parameters = gather(&parameters);
                is_given &= parameters.iter().all(|number| number.is_finite());
                of_each = constants::first(&self.function.program, &constants::of_model(program, &parameters));
                &of_each
            }
        };
        let inputs: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
        let Self { function, outputs, .. } = self;
        function.call(constants, &inputs, |results| {
            let is_finite = |(output, wanted): (usize, &Option<_>)| {
                wanted.is_none() || results.elements(output).all(f64::is_finite)
            };
            if !is_given {
                return Status::NotFinite;
            }
            if function.pivot.is_some_and(|output| !is_regular(results.scalar(output))) {
                return Status::Singular;
            }
            if !outputs.iter().enumerate().all(is_finite) {
                return Status::NotFinite;
            }
            for (output, matrix) in outputs.iter_mut().enumerate() {
                let Some(matrix) = matrix else { continue };
                for (element, number) in results.elements(output).enumerate() {
                    matrix.set(element, instance, number);
                }
            }
            Status::Done
        })
    }
}

impl Kernel for Call<'_> {
    /// Computes all instances in blocks. Those with a status that is not `Done` are left to be computed one by one,
    /// some of them because of angles far from 0.
    #[inline(always)]
    fn compute(&mut self, workspace: &mut Vec<Lanes>) {
        let one: usize = self.registers().iter().sum::<usize>() * size_of::<Lanes>();
        let from = if 8 * one <= CACHE { self.blocks_of::<8>(0, workspace) } else { 0 };
        let from = self.blocks_of::<2>(from, workspace);
        self.blocks_of::<1>(from, workspace);
    }
}

/// The registers of an output's elements.
#[inline(always)]
fn results<'r, const C: usize>(
    function: &'r Function,
    output: usize,
    registers: &'r [Block<C>],
) -> impl Iterator<Item = &'r Block<C>> + Clone {
    let elements = &function.program.outputs[function.elements[output].clone()];
    elements.iter().map(|register| &registers[usize::from(*register)])
}

#[inline(always)]
fn copy<const C: usize>(from: &Block<C>, to: &Block<C>) {
    to.iter().zip(from).for_each(|(to, from)| to.set(from.get()));
}

/// Adds 0 for each finite number and NaN for others.
#[inline(always)]
fn add_zeros<'b, const C: usize>(
    sums: &mut [[f64; LANES]; C],
    registers: &(impl Iterator<Item = &'b Block<C>> + Clone),
) {
    for (chunk, sums) in sums.iter_mut().enumerate() {
        let mut sum = *sums;
        for register in registers.clone() {
            let Lanes(numbers) = register[chunk].get();
            for lane in 0..LANES {
                sum[lane] += numbers[lane] * 0.0;
            }
        }
        *sums = sum;
    }
}

/// Without a branch.
#[inline(always)]
fn is_done(zeros: f64, pivot: f64) -> bool {
    (zeros == 0.0) & is_regular(pivot)
}
