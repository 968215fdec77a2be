//! The execution of a program.

use super::instruction::{Instruction, Register};
use super::program::REGISTERS;
use planar_dynamics::scalar::Scalar;

/// All registers there can be: none has to be looked for beyond the end.
pub(super) type Registers<T> = [T; REGISTERS];

/// Registers on the heap; only those that are used are ever touched.
#[allow(clippy::unnecessary_box_returns, reason = "half a megabyte has no place on the stack")]
pub(super) fn registers<T: Scalar>() -> Box<Registers<T>> {
    let all = vec![T::ZERO; REGISTERS].into_boxed_slice();
    all.try_into().unwrap_or_else(|_| unreachable!("so many they are"))
}

/// Executes the instructions one after the other.
#[inline]
pub(super) fn execute<T: Scalar>(instructions: &[Instruction], registers: &mut Registers<T>) {
    for instruction in instructions {
        let at = |register: Register| registers[usize::from(register)];
        let (to, result) = match *instruction {
            Instruction::Neg([to, a]) => (to, -at(a)),
            Instruction::Sqrt([to, a]) => (to, at(a).sqrt()),
            Instruction::SinCos([sine, cosine, a]) => {
                let (s, c) = at(a).sin_cos();
                registers[usize::from(sine)] = s;
                (cosine, c)
            }
            Instruction::Add([to, a, b]) => (to, at(a) + at(b)),
            Instruction::Sub([to, a, b]) => (to, at(a) - at(b)),
            Instruction::Mul([to, a, b]) => (to, at(a) * at(b)),
            Instruction::Div([to, a, b]) => (to, at(a) / at(b)),
            Instruction::Min([to, a, b]) => (to, at(a).minimum(at(b))),
            Instruction::Atan2([to, a, b]) => (to, at(a).atan2(at(b))),
            Instruction::MulAdd([to, a, b, c]) => (to, at(a) * at(b) + at(c)),
            Instruction::MulSub([to, a, b, c]) => (to, at(a) * at(b) - at(c)),
            Instruction::SubMul([to, a, b, c]) => (to, at(c) - at(a) * at(b)),
            Instruction::MulAddMul([to, a, b, c, d]) => (to, at(a) * at(b) + at(c) * at(d)),
            Instruction::MulSubMul([to, a, b, c, d]) => (to, at(a) * at(b) - at(c) * at(d)),
        };
        registers[usize::from(to)] = result;
    }
}
