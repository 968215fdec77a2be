//! The route `control::library` on the board; on another machine there is nothing to do.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    firmware::board::run::<control::library::Library>()
}

#[cfg(not(target_os = "none"))]
fn main() {}
