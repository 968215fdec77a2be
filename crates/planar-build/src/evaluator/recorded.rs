//! Numbers that record what is computed from them: the loops of the core as the operations of a program, which then has
//! their bits.

use super::impact_equations::impact_equations;
use super::values::Values;
use crate::format::{Function, Operation};
use planar_dynamics::scalar::Scalar;
use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number of the recorded operations.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Recorded {
    Number(f64),
    /// One of those that were given, by its index.
    Given(usize),
    /// The result of an operation, by its index.
    Result(usize),
}

/// An operation that was recorded; the second operand of one with one operand is the first.
type Step = (Operation, [Recorded; 2]);

thread_local! {
    static STEPS: RefCell<Vec<Step>> = const { RefCell::new(Vec::new()) };
}

/// Adds the results of the [`impact_equations`] to the values of a program, from `given` ones.
pub(super) fn in_loops(values: &mut Values, function: &Function, given: &[usize]) -> Vec<usize> {
    let all: Vec<Recorded> = (0..given.len()).map(Recorded::Given).collect();
    let outputs = impact_equations(function, &all);
    let steps = STEPS.take();
    let (mut numbers, mut results) = (HashMap::new(), Vec::with_capacity(steps.len()));
    let mut value = |values: &mut Values, results: &[usize], recorded: Recorded| match recorded {
        Recorded::Given(index) => given[index],
        Recorded::Result(index) => results[index],
        // each once: constants have registers
        Recorded::Number(number) => *numbers.entry(number.to_bits()).or_insert_with(|| values.number(number)),
    };
    for (operation, [a, b]) in steps {
        let a = value(values, &results, a);
        let b = (!operation.is_unary()).then(|| value(values, &results, b));
        results.push(values.result(operation, a, b));
    }
    outputs.into_iter().map(|output| value(values, &results, output)).collect()
}

fn record(operation: Operation, a: Recorded, b: Recorded) -> Recorded {
    STEPS.with_borrow_mut(|steps| {
        steps.push((operation, [a, b]));
        Recorded::Result(steps.len() - 1)
    })
}

macro_rules! operators {
    ($($trait:ident $method:ident),*) => {
        $(impl $trait for Recorded {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                record(Operation::$trait, self, other)
            }
        })*
    };
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Recorded {
    type Output = Self;
    fn neg(self) -> Self {
        record(Operation::Neg, self, self)
    }
}

impl Scalar for Recorded {
    const ZERO: Self = Self::Number(0.0);
    const ONE: Self = Self::Number(1.0);

    fn constant(value: f64) -> Self {
        Self::Number(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        unreachable!("loops have matrices, not angles")
    }

    fn sqrt(self) -> Self {
        record(Operation::Sqrt, self, self)
    }

    fn atan2(self, x: Self) -> Self {
        record(Operation::Atan2, self, x)
    }

    fn minimum(self, other: Self) -> Self {
        record(Operation::Min, self, other)
    }
}
