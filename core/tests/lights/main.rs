//! The public interface: trees over each kind of light and for each kind of receiver, against sums and integrals over all lights in
//! `f64`; smaller models; what an engine can rely on.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

use lightbvh::exact;

mod cells;
mod face;
mod kinds;
mod kit;
mod linked;
#[path = "../../src/kit/numbers.rs"]
#[allow(dead_code, reason = "shared with the tests of core")]
mod numbers;
mod one_call;
mod receivers;
mod smaller;
mod spots;
