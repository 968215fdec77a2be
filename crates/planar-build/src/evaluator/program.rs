//! A program: the statements that some outputs need, on registers.
//!
//! Registers are in this order: constants, inputs, and results, which have those of inputs and other results where
//! these are not needed any more. Constants stay, and what angles are sums of.

use super::instruction::{Kind, Operands, Register, Run};
use super::schedule::{Wait, schedule};
use super::values::{Source, Value, Values};
use crate::format::Operation;

/// The number of registers there can be: all that their numbers can name.
pub(super) const REGISTERS: usize = 1 << Register::BITS;

/// Instructions, and where the numbers that they begin and end with are.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    /// What is in the first registers.
    pub constants: Vec<Source>,
    runs: Vec<Run>,
    /// Of all instructions.
    operands: Vec<Operands>,
    /// The registers of the outputs' elements.
    pub outputs: Vec<Register>,
    /// Those of all that angles of sines are sums of; none where no angle is a sum.
    pub terms: Vec<Register>,
    /// The number of registers.
    pub registers: usize,
}

/// A result that is being computed in place of one or several values.
#[derive(Clone, Copy)]
struct Step {
    /// With the product of an operand, or of both, as part of it.
    products: [bool; 2],
    value: usize,
}

impl Program {
    /// The program of `outputs`, which are among `values`, with so many elements of inputs.
    ///
    /// # Errors
    /// That there are too many registers.
    pub fn new(values: &Values, inputs: usize, outputs: &[usize]) -> Result<Self, String> {
        let uses = uses(values, outputs);
        let steps = steps(values, &uses);
        let steps: Vec<Step> = schedule(&waits(values, &steps)).into_iter().map(|index| steps[index]).collect();
        let terms = terms(values, &uses);
        let mut registers = Registers::new(values, inputs, &uses);
        registers.keep(&terms);
        let last = last_uses(values, &steps, outputs);
        let mut program = Self { runs: Vec::new(), operands: Vec::with_capacity(steps.len()), ..Self::default() };
        for (now, step) in steps.iter().enumerate() {
            let operands: Vec<usize> = operands(values, step);
            let from: Vec<Register> = operands.iter().map(|value| registers.of(*value)).collect();
            registers.free(operands.iter().copied().filter(|value| last[*value] == now));
            let to: Vec<Register> =
                results(values, step.value).map(|value| registers.take(value)).collect::<Result<_, _>>()?;
            // the sine or the cosine alone may be wanted
            registers.free(results(values, step.value).filter(|value| last[*value] == usize::MAX));
            let (kind, from) = instruction(values, step, &from);
            let mut of_instruction = to.into_iter().chain(from);
            program.push(kind, [(); 5].map(|()| of_instruction.next().unwrap_or(0)));
        }
        program.terms = terms.iter().map(|value| registers.of(*value)).collect();
        program.outputs = outputs.iter().map(|value| registers.of(*value)).collect();
        program.constants = registers.constants;
        program.registers = registers.next;
        Ok(program)
    }

    fn push(&mut self, kind: Kind, operands: Operands) {
        self.operands.push(operands);
        match self.runs.last_mut() {
            Some(run) if run.kind == kind => run.count += 1,
            _ => self.runs.push(Run { kind, count: 1 }),
        }
    }

    /// The instructions: those of one kind that follow each other, with their registers.
    #[inline]
    pub fn runs(&self) -> impl Iterator<Item = (Kind, &[Operands])> {
        let mut rest = self.operands.as_slice();
        self.runs.iter().map(move |run| {
            let (these, after) = rest.split_at(run.count as usize);
            rest = after;
            (run.kind, these)
        })
    }
}

/// How often each value is used, that of outputs included; 0 where it is not needed at all.
fn uses(values: &Values, outputs: &[usize]) -> Vec<usize> {
    let mut uses = vec![0; values.all.len()];
    for output in outputs {
        uses[*output] += 1;
    }
    for index in (0..values.all.len()).rev() {
        let Value::Result { operation, a, b } = values.all[index] else { continue };
        // a cosine stands after its sine, which has the operand
        let needed = uses[index] > 0 || (operation == Operation::SinCos && uses[index + 1] > 0);
        if needed {
            uses[a] += 1;
            if let Some(b) = b {
                uses[b] += 1;
            }
        }
    }
    uses
}

/// What angles of sines that are needed are sums of; nothing where none of them is a sum.
fn terms(values: &Values, uses: &[usize]) -> Vec<usize> {
    let is_needed = |index: usize| uses[index] > 0 || uses[index + 1] > 0;
    let mut is_part = vec![false; values.all.len()];
    for (index, value) in values.all.iter().enumerate() {
        if let Value::Result { operation: Operation::SinCos, a, .. } = value {
            is_part[*a] |= is_needed(index);
        }
    }
    let (mut is_sum, mut terms) = (false, Vec::new());
    // a sum stands after its terms
    for index in (0..is_part.len()).rev() {
        match values.all[index] {
            _ if !is_part[index] => {}
            Value::Result { operation: Operation::Add, a, b } => {
                is_sum = true;
                [Some(a), b].into_iter().flatten().for_each(|term| is_part[term] = true);
            }
            _ => terms.push(index),
        }
    }
    if is_sum { terms } else { Vec::new() }
}

/// The steps in which all values that are needed are computed; products that only one sum uses are part of it.
fn steps(values: &Values, uses: &[usize]) -> Vec<Step> {
    let is_product =
        |index: usize| uses[index] == 1 && matches!(values.all[index], Value::Result { operation: Operation::Mul, .. });
    let mut absorbed = vec![false; values.all.len()];
    let mut steps = Vec::new();
    for (value, found) in values.all.iter().enumerate() {
        let Value::Result { operation, a, b } = *found else { continue };
        if uses[value] == 0 && !(operation == Operation::SinCos && uses[value + 1] > 0) {
            continue;
        }
        let mut products = [false; 2];
        if let (Operation::Add | Operation::Sub, Some(b)) = (operation, b) {
            products = [is_product(a), is_product(b)];
            for (index, part) in [a, b].into_iter().zip(products) {
                absorbed[index] |= part;
            }
        }
        steps.push(Step { products, value });
    }
    steps.retain(|step| !absorbed[step.value]);
    steps
}

/// What each step waits for.
fn waits(values: &Values, steps: &[Step]) -> Vec<Wait> {
    let mut step_of = vec![None; values.all.len()];
    for (index, step) in steps.iter().enumerate() {
        results(values, step.value).for_each(|value| step_of[value] = Some(index));
    }
    let wait = |step: &Step| {
        let mut on: Vec<usize> = operands(values, step).into_iter().filter_map(|value| step_of[value]).collect();
        on.sort_unstable();
        on.dedup();
        Wait { on, kind: kind(values, step) }
    };
    steps.iter().map(wait).collect()
}

/// The values that a step computes: a sine and a cosine, or one.
fn results(values: &Values, value: usize) -> std::ops::Range<usize> {
    let pair = matches!(values.all[value], Value::Result { operation: Operation::SinCos, .. });
    value..value + 1 + usize::from(pair)
}

/// The operands of a step, those of its products in their place.
fn operands(values: &Values, step: &Step) -> Vec<usize> {
    let of = |value: usize| match values.all[value] {
        Value::Result { a, b, .. } => [Some(a), b],
        _ => [None, None],
    };
    let mut operands = Vec::with_capacity(4);
    for (operand, product) in of(step.value).into_iter().zip(step.products) {
        match operand {
            Some(value) if product => operands.extend(of(value).into_iter().flatten()),
            operand => operands.extend(operand),
        }
    }
    operands
}

/// The step that uses each value last: never for outputs, `usize::MAX` for what is not used at all.
fn last_uses(values: &Values, steps: &[Step], outputs: &[usize]) -> Vec<usize> {
    let mut last = vec![usize::MAX; values.all.len()];
    for (now, step) in steps.iter().enumerate() {
        for value in operands(values, step) {
            last[value] = now;
        }
    }
    for output in outputs {
        last[*output] = steps.len();
    }
    last
}

/// The registers of values that are needed now.
struct Registers {
    constants: Vec<Source>,
    /// Of each value.
    of: Vec<Option<Register>>,
    /// Whether a value's register may be another's later.
    shared: Vec<bool>,
    free: Vec<Register>,
    next: usize,
}

impl Registers {
    fn new(values: &Values, inputs: usize, uses: &[usize]) -> Self {
        let mut registers = Self {
            constants: Vec::new(),
            of: vec![None; values.all.len()],
            shared: vec![false; values.all.len()],
            free: Vec::new(),
            next: 0,
        };
        let needed = || values.all.iter().enumerate().filter(|(index, _)| uses[*index] > 0);
        for (index, value) in needed() {
            if let Value::Constant(source) = value {
                registers.of[index] = Register::try_from(registers.constants.len()).ok();
                registers.constants.push(*source);
            }
        }
        let constants = registers.constants.len();
        for (index, value) in needed() {
            if let Value::Input(element) = value {
                registers.of[index] = Register::try_from(constants + element).ok();
                registers.shared[index] = true;
            }
        }
        registers.next = constants + inputs;
        registers
    }

    /// Values whose registers are theirs to the end.
    fn keep(&mut self, values: &[usize]) {
        for value in values {
            self.shared[*value] = false;
        }
    }

    /// That of a value; the last of all where there were too many, which [`take`](Self::take) reports.
    fn of(&self, value: usize) -> Register {
        self.of[value].unwrap_or(Register::MAX)
    }

    fn take(&mut self, value: usize) -> Result<Register, String> {
        let register = if let Some(register) = self.free.pop() {
            register
        } else {
            self.next += 1;
            Register::try_from(self.next - 1).map_err(|_| "it needs too many registers".to_owned())?
        };
        self.of[value] = Some(register);
        self.shared[value] = true;
        Ok(register)
    }

    fn free(&mut self, values: impl Iterator<Item = usize>) {
        for value in values {
            // an operand may stand twice
            if std::mem::take(&mut self.shared[value]) {
                self.free.extend(self.of[value]);
            }
        }
    }
}

/// What an instruction computes, and from which registers of those of the operands of a step.
fn instruction(values: &Values, step: &Step, from: &[Register]) -> (Kind, Vec<Register>) {
    let kind = kind(values, step);
    let from = match (kind, from) {
        (Kind::MulAdd | Kind::SubMul, &[c, a, b]) if !step.products[0] => vec![a, b, c],
        _ => from.to_vec(),
    };
    (kind, from)
}

fn kind(values: &Values, step: &Step) -> Kind {
    let Value::Result { operation, .. } = values.all[step.value] else {
        unreachable!("a step computes a result");
    };
    match (operation, step.products) {
        (Operation::SinCos, _) => Kind::SinCos,
        (Operation::Neg, _) => Kind::Neg,
        (Operation::Sqrt, _) => Kind::Sqrt,
        (Operation::Add, [true, true]) => Kind::MulAddMul,
        (Operation::Sub, [true, true]) => Kind::MulSubMul,
        (Operation::Add, [false, false]) => Kind::Add,
        (Operation::Sub, [false, false]) => Kind::Sub,
        (Operation::Add, _) => Kind::MulAdd,
        (Operation::Sub, [true, false]) => Kind::MulSub,
        (Operation::Sub, [false, true]) => Kind::SubMul,
        (Operation::Mul, _) => Kind::Mul,
        (Operation::Div, _) => Kind::Div,
        (Operation::Min, _) => Kind::Min,
        (Operation::Atan2, _) => Kind::Atan2,
        (Operation::Copy, _) => unreachable!("a copy is another name of a value"),
    }
}
