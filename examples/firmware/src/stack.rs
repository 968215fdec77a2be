//! How much stack a call takes: memory below the stack is painted, and looked at after the call.
#![allow(unsafe_code, reason = "the stack is memory that no variable has")]

use core::hint::black_box;
use core::ptr;

/// The memory that is painted, in words; the stack of a call has to be smaller.
const WORDS: usize = 8192;
const PAINT: u32 = 0x5aa5_c33c;

/// Bytes of stack below this function's own that `call` writes to.
#[inline(never)]
pub fn used(call: &mut dyn FnMut()) -> usize {
    let top = (cortex_m::register::msp::read() as usize) as *mut u32;
    // SAFETY: below the stack pointer, which a function does not move after its start, is free memory: the board's RAM
    // is larger than WORDS, no interrupt is enabled, and nothing is called before `call`
    unsafe {
        for word in 1..=WORDS {
            ptr::write_volatile(top.sub(word), PAINT);
        }
    }
    black_box(call)();
    let mut deepest = WORDS;
    // SAFETY: as above; these are reads
    unsafe {
        while deepest > 0 && ptr::read_volatile(top.sub(deepest)) == PAINT {
            deepest -= 1;
        }
    }
    4 * deepest
}
