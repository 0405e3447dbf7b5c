//! Whole commands: what they print, what they write, and how they refuse.

mod checks;
mod compare;
mod inspect;
mod kinds;
mod model;
mod outputs;
mod program;
mod refusals;
mod render;
mod soak;
mod stability;
