//! Words compared, by what they are of.

use std::collections::BTreeMap;

use bytemuck::cast_slice;
use serde::Serialize;

use super::subject::Tree;
use crate::backend::PIXEL_RECORD;
use crate::error::HostError;
use crate::words::{Record, compare_words};

/// What words are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::IntoStaticStr, Serialize)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub(in crate::cli) enum Kind {
    Nodes,
    Samples,
    Pmfs,
    Pixels,
}

impl Kind {
    /// As in reports.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Words of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(in crate::cli) struct Words {
    pub compared: u64,
    pub different: u64,
}

/// What was compared with one device. Nodes, samples, pmfs and pixels are counted as such, the others in words.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub(in crate::cli) struct Tally {
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

/// What was compared with each device, and of the CPU's words those that it computes twice.
#[derive(Default)]
pub(super) struct Tallies {
    pub devices: Vec<Tally>,
    pub cpu: Tally,
    /// Trees that were checked on the CPU.
    pub trees: Vec<Tree>,
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

    /// Compares images.
    pub fn take_pixels(
        &mut self,
        what: &str,
        cpu: &[[f32; 3]],
        device: &[[f32; 3]],
    ) -> Result<(), HostError> {
        let (cpu, device) = (cast_slice(cpu), cast_slice(device));
        self.take(Kind::Pixels, what, &PIXEL_RECORD, cpu, device)
    }
}
