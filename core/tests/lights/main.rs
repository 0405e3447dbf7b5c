//! Trees over each kind of light and for each kind of receiver, against sums and integrals over all lights in `f64`.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

mod kinds;
mod kit;
mod linked;
mod segments;
mod spots;
mod transmissive;
