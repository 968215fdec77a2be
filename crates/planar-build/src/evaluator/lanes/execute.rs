//! The execution of a program on lanes of instances.

use crate::evaluator::instruction::{Kind, Operands, Register};
use crate::evaluator::program::Program;
use planar_dynamics::scalar::Scalar;
use planar_dynamics::scalar::lane::Lane;
use std::cell::Cell;

/// Instances that a loop without branches computes at once: one of the widest vectors, or several of others.
pub(in crate::evaluator) const LANES: usize = 8;

/// A number of each instance, in a line of the cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(in crate::evaluator) struct Lanes(pub [f64; LANES]);

/// A number of each instance of a block of C times as many. In cells, so that the result of an instruction may have the
/// register of an operand.
pub(in crate::evaluator) type Block<const C: usize> = [Cell<Lanes>; C];

/// Executes the instructions one after the other. Sines are NaN for angles far from 0.
#[inline(always)]
pub(in crate::evaluator) fn execute<const C: usize>(program: &Program, registers: &[Block<C>]) {
    for (kind, instructions) in program.runs() {
        let all = All { registers, instructions };
        match kind {
            Kind::Neg => all.one(|a| -a),
            Kind::Sqrt => all.one(sqrt),
            Kind::SinCos => all.sin_cos(),
            Kind::Add => all.two(|a, b| a + b),
            Kind::Sub => all.two(|a, b| a - b),
            Kind::Mul => all.two(|a, b| a * b),
            Kind::Div => all.two(|a, b| a / b),
            Kind::Min => all.two(|a, b| Lane::<false>(a).minimum(Lane(b)).0),
            Kind::Atan2 => all.two(atan2),
            Kind::MulAdd => all.three(|a, b, c| a * b + c),
            Kind::MulSub => all.three(|a, b, c| a * b - c),
            Kind::SubMul => all.three(|a, b, c| c - a * b),
            Kind::MulAddMul => all.four(|a, b, c, d| a * b + c * d),
            Kind::MulSubMul => all.four(|a, b, c, d| a * b - c * d),
        }
    }
}

/// Of parameters, not of states: a call for each.
#[inline(never)]
fn sqrt(value: f64) -> f64 {
    Scalar::sqrt(value)
}

/// As [`sqrt`].
#[inline(never)]
fn atan2(y: f64, x: f64) -> f64 {
    Scalar::atan2(y, x)
}

/// Instructions of one kind.
struct All<'a, const C: usize> {
    registers: &'a [Block<C>],
    instructions: &'a [Operands],
}

impl<const C: usize> All<'_, C> {
    #[inline(always)]
    fn at<const N: usize>(&self, registers: [Register; N]) -> [&Block<C>; N] {
        registers.map(|register| &self.registers[usize::from(register)])
    }

    #[inline(always)]
    fn one(&self, operation: impl Fn(f64) -> f64) {
        for &[to, a, ..] in self.instructions {
            let [to, a] = self.at([to, a]);
            for chunk in 0..C {
                let (Lanes(a), mut result) = (a[chunk].get(), [0.0; LANES]);
                for lane in 0..LANES {
                    result[lane] = operation(a[lane]);
                }
                to[chunk].set(Lanes(result));
            }
        }
    }

    #[inline(always)]
    fn two(&self, operation: impl Fn(f64, f64) -> f64) {
        for &[to, a, b, ..] in self.instructions {
            let [to, a, b] = self.at([to, a, b]);
            for chunk in 0..C {
                let (Lanes(a), Lanes(b), mut result) = (a[chunk].get(), b[chunk].get(), [0.0; LANES]);
                for lane in 0..LANES {
                    result[lane] = operation(a[lane], b[lane]);
                }
                to[chunk].set(Lanes(result));
            }
        }
    }

    #[inline(always)]
    fn three(&self, operation: impl Fn(f64, f64, f64) -> f64) {
        for &[to, a, b, c, _] in self.instructions {
            let [to, a, b, c] = self.at([to, a, b, c]);
            for chunk in 0..C {
                let [Lanes(a), Lanes(b), Lanes(c)] = [a, b, c].map(|block| block[chunk].get());
                let mut result = [0.0; LANES];
                for lane in 0..LANES {
                    result[lane] = operation(a[lane], b[lane], c[lane]);
                }
                to[chunk].set(Lanes(result));
            }
        }
    }

    #[inline(always)]
    #[allow(clippy::many_single_char_names, reason = "the operands have no other names")]
    fn four(&self, operation: impl Fn(f64, f64, f64, f64) -> f64) {
        for &registers in self.instructions {
            let [to, a, b, c, d] = self.at(registers);
            for chunk in 0..C {
                let [Lanes(a), Lanes(b), Lanes(c), Lanes(d)] = [a, b, c, d].map(|block| block[chunk].get());
                let mut result = [0.0; LANES];
                for lane in 0..LANES {
                    result[lane] = operation(a[lane], b[lane], c[lane], d[lane]);
                }
                to[chunk].set(Lanes(result));
            }
        }
    }

    #[inline(always)]
    fn sin_cos(&self) {
        for &[sine, cosine, angle, ..] in self.instructions {
            let [to_sine, to_cosine, angle] = self.at([sine, cosine, angle]);
            for chunk in 0..C {
                let Lanes(angle) = angle[chunk].get();
                let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
                for lane in 0..LANES {
                    let (sine, cosine) = Lane::<false>(angle[lane]).sin_cos();
                    (sines[lane], cosines[lane]) = (sine.0, cosine.0);
                }
                to_sine[chunk].set(Lanes(sines));
                to_cosine[chunk].set(Lanes(cosines));
            }
        }
    }
}
