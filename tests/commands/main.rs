//! What a user types and sees: the commands from a layout to its code, what they print, and what is said of wrong input.

mod check;
mod compare;
mod derivation;
mod diagnostics;
mod eval;
mod generate;
mod rendering;
mod run;
mod urdf;
