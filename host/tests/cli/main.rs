//! Whole commands: what they print, what they write, and how they refuse.

mod animate;
mod checks;
mod clips;
mod compare;
mod gallery;
mod inspect;
mod kinds;
mod model;
mod program;
mod refusals;
mod render;
mod soak;
mod stability;
