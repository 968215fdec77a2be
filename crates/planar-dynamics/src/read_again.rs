//! References that the compiler does not know.

use core::hint::black_box;

/// The same references. Where registers are few, the compiler does not know that, and reads what does not change each time:
/// read once, before it is needed, it would be on the stack. Standalone modules have their own.
#[inline(always)]
#[allow(clippy::inline_always, reason = "there is nothing to call")]
pub(crate) fn read_again<X>(references: X) -> X {
    if cfg!(target_arch = "arm") { black_box(references) } else { references }
}
