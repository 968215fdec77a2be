//! What a core cannot do faster: operations of an evaluation, and how many of them it makes in a second at most.

use crate::clock::Clock;
use crate::measure::consume;
use crate::states::State;
use planar_capture::generated::dual_arm_3r::Model;
use planar_capture::scalar::Scalar;
use std::array::from_fn;
use std::cell::Cell;
use std::hint::black_box;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The vector that a register of the build holds.
#[cfg(target_feature = "avx512f")]
type Register = wide::f64x8;
#[cfg(all(target_feature = "avx", not(target_feature = "avx512f")))]
type Register = wide::f64x4;
#[cfg(not(target_feature = "avx"))]
type Register = wide::f64x2;

/// As many independent sums as hide each other's latency, and with two constants fit into 16 registers.
const SUMS: usize = 12;
const TURNS: u16 = 1000;

/// Products and sums of numbers that are in registers.
pub fn operation(clock: &mut impl Clock) {
    let constants = [0.999, 1e-3].map(Register::constant);
    let lanes = size_of::<Register>() / size_of::<f64>();
    let operations = u32::from(TURNS) * u32::try_from(2 * SUMS * lanes).expect("some hundred");
    clock.each("operation at the peak", operations, &[constants], |&[factor, addend]| {
        let mut sums = [factor; SUMS];
        for _ in 0..TURNS {
            for sum in &mut sums {
                *sum = Scalar::mul_add(*sum, factor, addend);
            }
        }
        black_box(sums);
    });
}

thread_local! {
    static COUNT: Cell<u32> = const { Cell::new(0) };
}

/// A number that counts sums, products and divisions.
#[derive(Clone, Copy)]
struct Counted(f64);

/// Those of a sine with its cosine: three products and sums reduce an angle, two polynomials of degree 5 and their ends follow.
const OF_SINES: u32 = 35;

fn counted(operations: u32, value: f64) -> Counted {
    COUNT.set(COUNT.get() + operations);
    Counted(value)
}

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl $trait for Counted {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                counted(1, self.0 $operator other.0)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Scalar for Counted {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    fn constant(value: f64) -> Self {
        Self(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Scalar::sin_cos(self.0);
        (counted(OF_SINES, sine), Self(cosine))
    }

    fn sqrt(self) -> Self {
        counted(1, Scalar::sqrt(self.0))
    }

    fn atan2(self, x: Self) -> Self {
        counted(1, Scalar::atan2(self.0, x.0))
    }

    fn minimum(self, other: Self) -> Self {
        Self(Scalar::minimum(self.0, other.0))
    }
}

/// Operations of forward dynamics, of generalized inertia, bias and Jacobian, of the paper's impact and of the exact one.
pub fn operations(s: &State) -> [u32; 4] {
    let model = Model::<Counted>::default();
    let (pose, twist) = (s.base_pose.map(Counted), s.base_twist.map(Counted));
    let [angles, rates, torques] = [s.joint_angles, s.joint_rates, s.torques].map(|numbers| numbers.map(Counted));
    let [masses, inertias] = [s.masses, s.inertias].map(|numbers| numbers.map(Counted));
    let contacts = from_fn(|arm| s.contacts[arm].map(Counted));
    let twists = from_fn(|arm| s.twists[arm].map(Counted));
    let of = |evaluate: &dyn Fn()| {
        COUNT.set(0);
        evaluate();
        COUNT.get()
    };
    [
        of(&|| consume(model.forward_dynamics(&pose, &angles, &twist, &rates, &torques))),
        of(&|| consume(model.reduced_dynamics(&pose, &angles, &twist, &rates))),
        of(&|| consume(model.reduced_impact(&pose, &angles, &rates, &masses, &inertias, &contacts, &twists))),
        of(&|| consume(model.full_impact(&pose, &angles, &twist, &rates, &masses, &inertias, &contacts, &twists))),
    ]
}
