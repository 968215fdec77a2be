//! The proof that library and standalone module cannot panic: a program with all their functions, whose handler of panics
//! calls what does not exist. It links only where no path leads to the handler.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod program {
    use control::library::Library;
    use control::mission::Record;
    use control::route::{Case, Route};
    use control::standalone::Standalone;
    use core::hint::black_box;
    use core::panic::PanicInfo;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        keep::<Library>();
        keep::<Standalone>();
        loop {
            cortex_m::asm::nop();
        }
    }

    /// Makes the compiler keep all functions of a route, for any arguments.
    fn keep<R: Route>() {
        for function in R::FUNCTIONS {
            black_box(function.call as fn(&mut Case<R>) -> bool);
        }
        black_box(R::capture as fn(&mut Record) -> Result<(), &'static str>);
        if cfg!(feature = "self_test") {
            black_box(R::self_test as fn() -> bool);
        }
    }

    #[allow(unsafe_code, reason = "a function of which nothing is true")]
    unsafe extern "C" {
        safe fn a_function_can_panic() -> !;
    }

    #[panic_handler]
    fn panic(_: &PanicInfo<'_>) -> ! {
        a_function_can_panic()
    }
}

#[cfg(not(target_os = "none"))]
fn main() {}
