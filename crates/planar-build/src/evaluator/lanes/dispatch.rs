//! The instruction set of a batch, chosen when it runs.

use super::execute::Lanes;
use multiversion::multiversion;

/// The instructions that a batch is computed with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InstructionSet {
    /// The best of the processor that the program runs on: AVX-512 (from Ice Lake and Zen 4 on: before, clocks were lowered for it), AVX2
    /// with FMA, or those of the build.
    #[default]
    Detected,
    /// AVX2 with FMA at most; for tests and comparisons.
    Avx2,
    /// Those of the build; for tests and comparisons.
    AsBuilt,
}

/// What is computed with the instructions of a set: all that it calls has to be inlined.
pub(super) trait Kernel {
    /// Computes it, in this place for registers.
    fn compute(&mut self, workspace: &mut Vec<Lanes>);
}

impl InstructionSet {
    /// Computes with these instructions.
    pub(super) fn run<K: Kernel>(self, kernel: &mut K, workspace: &mut Vec<Lanes>) {
        match self {
            Self::Detected => detected(kernel, workspace),
            Self::Avx2 => avx2(kernel, workspace),
            Self::AsBuilt => kernel.compute(workspace),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2+fma", "x86_64+avx2+fma"))]
fn detected<K: Kernel>(kernel: &mut K, workspace: &mut Vec<Lanes>) {
    kernel.compute(workspace);
}

#[multiversion(targets("x86_64+avx2+fma"))]
fn avx2<K: Kernel>(kernel: &mut K, workspace: &mut Vec<Lanes>) {
    kernel.compute(workspace);
}
