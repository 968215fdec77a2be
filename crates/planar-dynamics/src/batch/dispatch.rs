//! The instruction set of a batch, chosen when it runs.

use super::block::{Number, Place};
use crate::scalar::lane::Lane;
use crate::status::Status;
use multiversion::multiversion;
use multiversion::target::match_target;

/// A function of a batch.
pub trait Kernel {
    /// The model with another scalar.
    type Model<T: Number>;

    /// The model.
    fn model<T: Number>(&self) -> Self::Model<T>;

    /// Whether all parameters of the model are finite.
    fn is_finite(&self) -> bool;

    /// Computes the instances of a place in blocks of B: the results of those that are done, and the statuses of the others.
    fn evaluate<T: Number, const B: usize>(&mut self, model: &Self::Model<T>, place: Place, statuses: &mut [Status]);
}

/// A choice of the instruction set.
pub trait Instructions {
    /// Computes a batch, and the status of each instance.
    fn run<K: Kernel>(kernel: &mut K, statuses: &mut [Status]);
}

impl Number for f64 {
    const DECIDES: bool = true;

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
}

/// What has no result here is computed again, one by one.
impl<const FUSED: bool> Number for Lane<FUSED> {
    const DECIDES: bool = false;

    #[inline(always)]
    fn value(self) -> f64 {
        self.0
    }
}

/// The best instruction set of the processor that the program runs on: AVX-512 (from Ice Lake and Zen 4 on: before, clocks were
/// lowered for it, and the crate `multiversion` leaves it out), AVX2 with FMA, or that of the build.
#[derive(Clone, Copy, Debug)]
pub struct Detected;

/// AVX2 with FMA at most; for tests and comparisons.
#[derive(Clone, Copy, Debug)]
pub struct Avx2;

/// The instruction set of the build; for tests and comparisons.
#[derive(Clone, Copy, Debug)]
pub struct AsBuilt;

impl Instructions for Detected {
    #[inline]
    fn run<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
        detected(kernel, statuses);
    }
}

impl Instructions for Avx2 {
    #[inline]
    fn run<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
        avx2(kernel, statuses);
    }
}

impl Instructions for AsBuilt {
    #[inline]
    fn run<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
        as_built(kernel, statuses);
    }
}

/// Whether generated text has products that are fused with sums.
const FUSED: bool = cfg!(feature = "fused");

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2+fma", "x86_64+avx2+fma"))]
fn detected<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
    match_target! {
        "x86_64+fma" => blocks::<Lane<FUSED>, K>(kernel, statuses),
        _ => as_built(kernel, statuses),
    }
}

#[multiversion(targets("x86_64+avx2+fma"))]
fn avx2<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
    match_target! {
        "x86_64+fma" => blocks::<Lane<FUSED>, K>(kernel, statuses),
        _ => as_built(kernel, statuses),
    }
}

/// Fused where [`mul_add`](crate::scalar::Scalar::mul_add) of `f64` is.
fn as_built<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
    const HARDWARE: bool = FUSED && cfg!(any(target_feature = "fma", target_arch = "aarch64"));
    blocks::<Lane<HARDWARE>, K>(kernel, statuses);
}

/// Instances of a block: many enough that rows are copied at the speed of memory, few enough that they stay in the
/// first-level cache.
const BLOCK: usize = 64;

#[inline(always)]
fn blocks<T: Number, K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
    statuses.fill(Status::Done);
    let columns = statuses.len();
    kernel.evaluate::<T, BLOCK>(&kernel.model(), Place { from: 0, len: columns, columns }, statuses);
    if statuses.iter().any(|status| *status != Status::Done) {
        one_by_one(kernel, statuses);
    }
}

/// Instances without a result, some of them because of angles far from 0.
#[cold]
#[inline(never)]
fn one_by_one<K: Kernel>(kernel: &mut K, statuses: &mut [Status]) {
    let (model, columns) = (kernel.model::<f64>(), statuses.len());
    for from in 0..columns {
        match statuses.get_mut(from) {
            Some(status) if *status != Status::Done => *status = Status::Done,
            _ => continue,
        }
        kernel.evaluate::<f64, 1>(&model, Place { from, len: 1, columns }, statuses);
    }
    if !kernel.is_finite() {
        // as the functions for one state say, whatever else there is
        statuses.iter_mut().filter(|status| **status != Status::Done).for_each(|status| *status = Status::NotFinite);
    }
}
