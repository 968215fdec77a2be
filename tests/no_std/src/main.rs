//! The proof that no part of the core can panic: a program with all functions of this crate, whose handler of panics calls
//! what does not exist. It links only where no path leads to the handler.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod program {
    use core::hint::black_box;
    use core::panic::PanicInfo;

    /// Makes the compiler keep all functions, for any arguments.
    macro_rules! keep {
        ($($function:ident)*) => { $(black_box(no_std_firmware::$function as *const ());)* };
    }

    #[unsafe(no_mangle)]
    extern "C" fn start() {
        keep! {
            model approach_step exact_step computed_step steered_step stabilise_step capture paper integrate_to_contact
            reduced_step symplectic_step look touch held_step impulse_ellipse
        }
    }

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
