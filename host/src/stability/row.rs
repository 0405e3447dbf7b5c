//! What is checked, against which bound, and what came out.

use serde::Serialize;
use strum::{IntoStaticStr, VariantArray};

/// The checks: what each measures, and why its bound is what it is.
macro_rules! checks {
    ($($name:ident: $reason:literal,)*) => {
        /// A check; every row is one of them for one extreme, one structure and one device.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, IntoStaticStr, VariantArray)]
        #[serde(rename_all = "kebab-case")]
        #[strum(serialize_all = "kebab-case")]
        pub enum Check {
            $(#[doc = $reason] $name,)*
        }

        impl Check {
            /// All of them.
            pub const ALL: &[Self] = Self::VARIANTS;

            /// As in JSON.
            pub fn name(self) -> &'static str {
                self.into()
            }

            /// What is measured, and why the bound is what it is.
            pub fn reason(self) -> &'static str {
                match self {
                    $(Self::$name => $reason,)*
                }
            }
        }
    };
}

checks! {
    Finite: "probabilities that are not numbers in [0, 1]; none may be",
    Sum: "|sum of pmf - 1|; a tree's probabilities are exact shares of one range of numbers, and adding the uniform share \
        rounds each by 3 times 2^-24 at most: 2^-22",
    Equal: "samples whose pmf differs from the evaluated one in any bit, or without a light though one has a probability; \
        both come from the same range of numbers, so none",
    Starved: "lights with flux that have no probability by weights alone; weights are positive wherever there is flux, so none",
    Deviation: "standard deviation of the estimate (root mean square over points), against the untouched scene; another \
        tree may be worse, within a factor of 2",
    RefitWords: "words of the refitted arrays that a device holds otherwise than the CPU; none may be",
    SampleWords: "words of sampled lights and their pmfs that the device computes otherwise than the CPU; none may be",
    PmfWords: "words of evaluated pmfs that the device computes otherwise than the CPU; none may be",
}

/// One line of the report.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Extreme, structure and check.
    pub name: String,
    /// The extreme.
    pub extreme: String,
    /// What was walked.
    pub structure: String,
    /// The check.
    pub check: Check,
    /// `cpu`, or the name of a device.
    pub device: String,
    /// The worst that was found.
    pub worst: f64,
    /// The most that is allowed.
    pub bound: f64,
    /// Whether it is.
    pub pass: bool,
    /// Where the worst was found, in a row that fails.
    pub at: Option<String>,
}

impl Row {
    /// A row on the CPU.
    pub fn new(extreme: &str, structure: &str, check: Check, worst: f64, bound: f64) -> Self {
        Self {
            name: format!("{extreme}, {structure}: {}", check.name()),
            extreme: extreme.to_owned(),
            structure: structure.to_owned(),
            check,
            device: "cpu".to_owned(),
            // JSON has neither NaN nor infinity.
            worst: if worst.is_finite() { worst } else { f64::MAX },
            bound,
            pass: worst <= bound,
            at: None,
        }
    }

    /// The same on a device.
    pub fn on(mut self, device: &str) -> Self {
        device.clone_into(&mut self.device);
        self
    }

    /// With the place of the worst, which is kept if the row fails.
    pub fn at(mut self, place: Option<String>) -> Self {
        self.at = place.filter(|_| !self.pass);
        self
    }
}
