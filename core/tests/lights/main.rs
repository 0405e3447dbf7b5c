//! The public interface: trees over each kind of light and for each kind of receiver, against sums and integrals over all lights in
//! `f64`; smaller models; what an engine can rely on.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

mod face;
mod kinds;
mod kit;
mod linked;
mod receivers;
mod smaller;
mod spots;
