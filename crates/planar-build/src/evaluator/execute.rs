//! The execution of a program on single numbers.

use super::instruction::{Kind, Operands, Register};
use super::program::{Program, REGISTERS};
use planar_dynamics::scalar::Scalar;

/// All registers there can be: none has to be looked for beyond the end.
pub(super) type Registers = [f64; REGISTERS];

/// Registers on the heap; only those that are used are ever touched.
#[allow(clippy::unnecessary_box_returns, reason = "half a megabyte has no place on the stack")]
pub(super) fn registers() -> Box<Registers> {
    let all = vec![0.0; REGISTERS].into_boxed_slice();
    all.try_into().unwrap_or_else(|_| unreachable!("so many they are"))
}

/// Executes the instructions one after the other.
pub(super) fn execute(program: &Program, registers: &mut Registers) {
    for (kind, instructions) in program.runs() {
        match kind {
            Kind::Neg => all(registers, instructions, |[a, ..]| -a),
            Kind::Sqrt => all(registers, instructions, |[a, ..]| Scalar::sqrt(a)),
            Kind::SinCos => instructions.chunks(SINES).for_each(|some| sines(registers, some, &program.terms)),
            Kind::Add => all(registers, instructions, |[a, b, ..]| a + b),
            Kind::Sub => all(registers, instructions, |[a, b, ..]| a - b),
            Kind::Mul => all(registers, instructions, |[a, b, ..]| a * b),
            Kind::Div => all(registers, instructions, |[a, b, ..]| a / b),
            Kind::Min => all(registers, instructions, |[a, b, ..]| Scalar::minimum(a, b)),
            Kind::Atan2 => all(registers, instructions, |[a, b, ..]| Scalar::atan2(a, b)),
            Kind::MulAdd => all(registers, instructions, |[a, b, c, _]| a * b + c),
            Kind::MulSub => all(registers, instructions, |[a, b, c, _]| a * b - c),
            Kind::SubMul => all(registers, instructions, |[a, b, c, _]| c - a * b),
            Kind::MulAddMul => all(registers, instructions, |[a, b, c, d]| a * b + c * d),
            Kind::MulSubMul => all(registers, instructions, |[a, b, c, d]| a * b - c * d),
        }
    }
}

/// Executes instructions of one result; operands that an operation does not use are not loaded.
#[inline(always)]
#[allow(clippy::inline_always, reason = "the operation would have to load all operands")]
fn all(registers: &mut Registers, instructions: &[Operands], operation: impl Fn([f64; 4]) -> f64) {
    for [to, operands @ ..] in instructions {
        registers[usize::from(*to)] = operation(operands.map(|register| at(registers, register)));
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as for those that use it")]
fn at(registers: &Registers, register: Register) -> f64 {
    registers[usize::from(register)]
}

/// Angles whose sines are computed at once.
const SINES: usize = 8;

/// Executes at most so many instructions for sines and cosines, of angles that are sums of these terms, if of any.
#[inline(never)]
fn sines(registers: &mut Registers, instructions: &[Operands], terms: &[Register]) {
    if let ([[sine, cosine, angle, ..]], []) = (instructions, terms) {
        let (s, c) = Scalar::sin_cos(at(registers, *angle));
        (registers[usize::from(*sine)], registers[usize::from(*cosine)]) = (s, c);
        return;
    }
    let mut angles = [0.0; SINES];
    for (angle, [_, _, from, ..]) in angles.iter_mut().zip(instructions) {
        *angle = at(registers, *from);
    }
    // NaN where one is not finite
    if !terms.is_empty() && angles.iter().fold(0.0, |sum, angle| sum + angle * 0.0) != 0.0 {
        saturate(&mut angles, registers, terms);
    }
    for ([sine, cosine, ..], (s, c)) in instructions.iter().zip(Scalar::sin_cos_all(angles)) {
        (registers[usize::from(*sine)], registers[usize::from(*cosine)]) = (s, c);
    }
}

/// Sums of finite terms that are infinite count as the largest number.
#[cold]
#[inline(never)]
fn saturate(sums: &mut [f64], registers: &Registers, terms: &[Register]) {
    if terms.iter().all(|term| at(registers, *term).is_finite()) {
        for sum in sums {
            *sum = sum.saturated();
        }
    }
}
