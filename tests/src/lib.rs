//! Generators, oracles, statistics and devices shared by the tests.

pub mod arithmetic;
pub mod broken;
pub mod devices;
pub mod direct;
pub mod generate;
pub mod layouts;
pub mod oracle;
pub mod placing;
pub mod scenes;
pub mod self_test;
pub mod soup;
pub mod statistics;
pub mod world;
