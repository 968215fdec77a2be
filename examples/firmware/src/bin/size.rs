//! What a route's functions add to a program: compiled with `--cfg route="…" --cfg part="…"`, or without them as what is
//! there without any.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod program {
    #[cfg(route = "c")]
    use control::c::C as Chosen;
    #[cfg(route = "library")]
    use control::library::Library as Chosen;
    #[cfg(route = "standalone")]
    use control::standalone::Standalone as Chosen;
    use core::panic::PanicInfo;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        #[cfg(any(route = "c", route = "library", route = "standalone"))]
        keep();
        loop {
            cortex_m::asm::nop();
        }
    }

    #[cfg(any(route = "c", route = "library", route = "standalone"))]
    fn keep() {
        use control::mission::Record;
        use control::route::Route;
        use core::hint::black_box;

        if cfg!(any(part = "forward_dynamics", part = "four_functions")) {
            black_box(const { Chosen::FUNCTIONS[1].call });
        }
        if cfg!(part = "four_functions") {
            black_box(const { Chosen::FUNCTIONS[0].call });
            black_box(const { Chosen::FUNCTIONS[2].call });
            black_box(const { Chosen::FUNCTIONS[3].call });
        }
        if cfg!(part = "control_loop") {
            black_box(Chosen::capture as fn(&mut Record) -> Result<(), &'static str>);
        }
    }

    #[panic_handler]
    fn panic(_: &PanicInfo<'_>) -> ! {
        loop {
            cortex_m::asm::nop();
        }
    }
}

#[cfg(not(target_os = "none"))]
fn main() {}
