//! Comparing and measuring a route on the board.

use crate::stack;
use control::mission::Record;
use control::route::{Case, Function, NAMES, Route};
use control::states::{FIRST_FAR, STATES, inputs};
use control::vectors::{bits, vectors};
use core::hint::black_box;
use core::panic::PanicInfo;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hprintln;

/// What the host computes, see `Vectors`.
struct Expected {
    record: &'static [u64],
    checksums: [u64; NAMES.len()],
    results: [u16; NAMES.len()],
}

/// What every route computes on the host.
const EXPECTED: Expected = include!(concat!(env!("OUT_DIR"), "/expected.rs"));

/// An instruction is a nanosecond (`-icount shift=0`), and the timer counts at 25 MHz.
const INSTRUCTIONS_PER_TICK: u32 = 40;

/// Compares and measures; ends the emulation with its exit status.
pub fn run<R: Route>() -> ! {
    let done = (!cfg!(feature = "self_test") || R::self_test()) && agrees::<R>();
    if done {
        measure::<R>();
    }
    debug::exit(if done { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::nop();
    }
}

/// Whether all bits are those of the host; says what is not.
fn agrees<R: Route>() -> bool {
    let found = match vectors::<R>() {
        Ok(found) => found,
        Err(why) => {
            hprintln!("error: {}", why);
            return false;
        }
    };
    let mut agrees = true;
    for (place, (number, wanted)) in found.record.iter().zip(EXPECTED.record).enumerate() {
        if bits(*number) != *wanted {
            hprintln!("error: {}: number {} of the mission is {:e}, not that of the host", R::NAME, place, number);
            agrees = false;
        }
    }
    for (index, name) in NAMES.iter().enumerate() {
        if (found.checksums[index], found.results[index]) != (EXPECTED.checksums[index], EXPECTED.results[index]) {
            hprintln!("error: {}: {} has not the bits of the host", R::NAME, name);
            agrees = false;
        }
    }
    let [yaw, x, y, ..] = found.record;
    hprintln!("{}: contact at base pose {:.6} {:.6} {:.6}", R::NAME, yaw, x, y);
    hprintln!("agrees {} {}", found.record.len(), STATES);
    agrees
}

/// Prints a line for each function, and one for the mission.
fn measure<R: Route>() {
    let timer = Timer::new();
    let overhead = timer.instructions(&Function { call: nothing::<R>, results: |_, _| () }, &mut R::case(&inputs(0)));
    let mut empty = R::case(&inputs(0));
    let none = stack::used(&mut || {
        black_box(nothing::<R> as fn(&mut Case<R>) -> bool)(&mut empty);
    });
    for (function, name) in R::FUNCTIONS.iter().zip(NAMES) {
        let mut near = [u32::MAX, 0];
        let mut far = 0;
        let mut deepest = [0, 0];
        for state in 0..STATES {
            let mut case = R::case(&inputs(state));
            let instructions = timer.instructions(function, &mut case) - overhead;
            let stack = stack::used(&mut || {
                black_box(function.call)(&mut case);
            })
            .saturating_sub(none);
            if state < FIRST_FAR {
                near = [near[0].min(instructions), near[1].max(instructions)];
                deepest[0] = deepest[0].max(stack);
            } else {
                far = far.max(instructions);
                deepest[1] = deepest[1].max(stack);
            }
        }
        let ([least, most], [stack, far_stack]) = (near, deepest);
        hprintln!("measured {} {} {} {} {} {}", name, least, most, far, stack, far_stack);
    }
    let mut record: Record = [0.0; _];
    let stack = stack::used(&mut || {
        let _ = black_box(R::capture as fn(&mut Record) -> Result<(), &'static str>)(&mut record);
    })
    .saturating_sub(none);
    hprintln!("mission {}", stack);
}

/// What calling costs.
#[inline(never)]
fn nothing<R: Route>(case: &mut Case<R>) -> bool {
    black_box(case);
    true
}

/// The timer of the system.
struct Timer {
    _enabled: SYST,
}

impl Timer {
    fn new() -> Self {
        let mut timer = cortex_m::Peripherals::take().expect("it is taken once").SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(0x00ff_ffff);
        timer.clear_current();
        timer.enable_counter();
        Self { _enabled: timer }
    }

    /// Of a call: as many calls as there are instructions per tick take as many ticks.
    #[inline(never)]
    fn instructions<R: Route>(&self, function: &Function<R>, case: &mut Case<R>) -> u32 {
        let call = black_box(function.call);
        let start = SYST::get_current();
        for _ in 0..INSTRUCTIONS_PER_TICK {
            call(case);
        }
        start.wrapping_sub(SYST::get_current()) & 0x00ff_ffff
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    hprintln!("error: {}", info);
    debug::exit(EXIT_FAILURE);
    loop {
        cortex_m::asm::nop();
    }
}
