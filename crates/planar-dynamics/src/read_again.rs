//! References that the compiler does not know.

use core::hint::black_box;

/// The same references. Where registers are few, the compiler does not know that, and reads what does not change each time:
/// read once, before it is needed, it would be on the stack. Standalone modules have their own.
#[inline(always)]
#[allow(clippy::inline_always, reason = "there is nothing to call")]
pub(crate) fn read_again<X>(references: X) -> X {
    if cfg!(target_arch = "arm") { black_box(references) } else { references }
}

/// The same reference. Where the processor has vectors, the compiler does not know what is there, and loads vectors: it would
/// put them together from the numbers that it has in registers, which takes longer.
#[inline(always)]
#[allow(clippy::inline_always, reason = "there is nothing to call")]
pub(crate) fn from_memory<X>(values: &mut [X]) -> &[X] {
    if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) { black_box(values) } else { values }
}
