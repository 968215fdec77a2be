//! A program: the statements that some outputs need, on registers.
//!
//! Registers are in this order: constants, inputs, and results, which share registers where one is not needed any more
//! when the next is computed.

use super::instruction::{Instruction, Register};
use super::values::{Source, Value, Values};
use crate::format::Operation;

/// The number of registers there can be: all that their numbers can name.
pub(super) const REGISTERS: usize = 1 << Register::BITS;

/// Instructions, and where the numbers that they begin and end with are.
#[derive(Clone, Debug)]
pub(super) struct Program {
    /// What is in the first registers.
    pub constants: Vec<Source>,
    pub instructions: Vec<Instruction>,
    /// The registers of the outputs' elements.
    pub outputs: Vec<Register>,
}

/// A result that is being computed in place of one or several values.
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
        let mut registers = Registers::new(values, inputs, &uses);
        let last = last_uses(values, &steps, outputs);
        let mut instructions = Vec::with_capacity(steps.len());
        for (now, step) in steps.iter().enumerate() {
            let operands: Vec<usize> = operands(values, step);
            let from: Vec<Register> = operands.iter().map(|value| registers.of(*value)).collect();
            registers.free(operands.iter().copied().filter(|value| last[*value] == now));
            let to: Vec<Register> =
                results(values, step.value).map(|value| registers.take(value)).collect::<Result<_, _>>()?;
            // the sine or the cosine alone may be wanted
            registers.free(results(values, step.value).filter(|value| last[*value] == usize::MAX));
            instructions.push(instruction(values, step, &to, &from));
        }
        let outputs = outputs.iter().map(|value| registers.of(*value)).collect();
        Ok(Self { constants: registers.constants, instructions, outputs })
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
            }
        }
        registers.next = constants + inputs;
        registers
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

fn instruction(values: &Values, step: &Step, to: &[Register], from: &[Register]) -> Instruction {
    let Value::Result { operation, .. } = values.all[step.value] else {
        unreachable!("a step computes a result");
    };
    let result = to[0];
    match (operation, step.products, from) {
        (Operation::SinCos, _, &[a]) => Instruction::SinCos([result, to[1], a]),
        (Operation::Neg, _, &[a]) => Instruction::Neg([result, a]),
        (Operation::Sqrt, _, &[a]) => Instruction::Sqrt([result, a]),
        (Operation::Add, [true, true], &[a, b, c, d]) => Instruction::MulAddMul([result, a, b, c, d]),
        (Operation::Sub, [true, true], &[a, b, c, d]) => Instruction::MulSubMul([result, a, b, c, d]),
        (Operation::Add, [true, false], &[a, b, c]) | (Operation::Add, [false, true], &[c, a, b]) => {
            Instruction::MulAdd([result, a, b, c])
        }
        (Operation::Sub, [true, false], &[a, b, c]) => Instruction::MulSub([result, a, b, c]),
        (Operation::Sub, [false, true], &[c, a, b]) => Instruction::SubMul([result, a, b, c]),
        (Operation::Add, _, &[a, b]) => Instruction::Add([result, a, b]),
        (Operation::Sub, _, &[a, b]) => Instruction::Sub([result, a, b]),
        (Operation::Mul, _, &[a, b]) => Instruction::Mul([result, a, b]),
        (Operation::Div, _, &[a, b]) => Instruction::Div([result, a, b]),
        (Operation::Min, _, &[a, b]) => Instruction::Min([result, a, b]),
        (Operation::Atan2, _, &[a, b]) => Instruction::Atan2([result, a, b]),
        (operation, ..) => unreachable!("{operation:?} of {} operands", from.len()),
    }
}
