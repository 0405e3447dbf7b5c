//! Whole commands: what they print, what they write, and how they refuse.

mod animate;
mod checks;
mod compare;
mod gallery;
mod inspect;
mod kinds;
mod program;
mod refusals;
mod render;
mod soak;
mod stability;
