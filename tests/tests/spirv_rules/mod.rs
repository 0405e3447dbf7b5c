//! The committed kernels belong to the committed sources and obey the rules; modules that do not are refused.

mod module;
mod operations;
mod shapes;
mod shipped;
