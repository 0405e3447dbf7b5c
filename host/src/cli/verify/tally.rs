//! Words compared, by what they are of.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::compare::{Record, compare_words};
use crate::error::HostError;

/// What words are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Kind {
    Nodes,
    Samples,
    Pmfs,
    Pixels,
    Surfaces,
    Reservoirs,
}

impl Kind {
    /// As in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nodes => "nodes",
            Self::Samples => "samples",
            Self::Pmfs => "pmfs",
            Self::Pixels => "pixels",
            Self::Surfaces => "surfaces",
            Self::Reservoirs => "reservoirs",
        }
    }
}

/// Words of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(super) struct Words {
    pub compared: u64,
    pub different: u64,
}

/// What was compared with one device. Nodes, samples, pmfs and pixels are counted as such, the others in words.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub(super) struct Tally {
    pub compared: u64,
    pub different: u64,
    pub nodes: u64,
    pub samples: u64,
    pub pmfs: u64,
    pub pixels: u64,
    /// Words by kind; together `compared` and `different`.
    pub words: BTreeMap<Kind, Words>,
    /// Scene, method, frame and kernel, then record, index, field and both words.
    pub first_difference: Option<String>,
}

impl Tally {
    /// Compares a device's records with the CPU's; `what` says where they come from.
    pub fn take(
        &mut self,
        kind: Kind,
        what: &str,
        record: &Record,
        cpu: &[u32],
        device: &[u32],
    ) -> Result<(), HostError> {
        let comparison = compare_words(record, cpu, device)?;
        let records = (cpu.len() / record.words().max(1)) as u64;
        match kind {
            Kind::Nodes => self.nodes += records,
            Kind::Samples => self.samples += records,
            Kind::Pmfs => self.pmfs += records,
            Kind::Pixels => self.pixels += records,
            Kind::Surfaces | Kind::Reservoirs => {}
        }
        self.compared += comparison.compared;
        self.different += comparison.different;
        let words = self.words.entry(kind).or_default();
        words.compared += comparison.compared;
        words.different += comparison.different;
        if let (None, Some(first)) = (&self.first_difference, comparison.first) {
            self.first_difference = Some(format!("{what}: {first}"));
        }
        Ok(())
    }
}
