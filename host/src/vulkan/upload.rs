//! How the bytes of a pass get from the host into their buffers: one after another in the staging ring, and from there by one
//! copy for each buffer, of some regions, and by one dispatch where there are many short ones.

use super::buffer::Binding;
use super::kernel::Kernel;
use super::memory::{Region, copy};
use super::pass::Write;
use super::ring::PART;
use super::run::barrier;
use super::scatter::{ENTRY, Scatter};
use ash::vk;
use lightbvh_kernels::scatter::Run;

/// What one submission writes.
#[derive(Default)]
pub(super) struct Part<'a> {
    /// The bytes, one after another.
    pieces: Vec<&'a [u8]>,
    /// Those of the pieces.
    data: u64,
    /// The copies: for each buffer its regions, whose `from` counts from the first byte of the part.
    copies: Vec<(Binding, Vec<Region>)>,
    /// What goes by dispatches, and the runs of all of them: behind the pieces.
    scatters: Vec<Scatter>,
    list: Vec<Run>,
}

impl<'a> Part<'a> {
    /// Splits writes, sorted by buffer and place, into parts that the ring takes. There is always a last one.
    pub fn split(writes: &[&'a Write<'a>]) -> Vec<Self> {
        let mut parts = vec![Self::default()];
        for write in writes {
            let (mut at, mut data) = (write.at, write.data());
            while !data.is_empty() {
                let last = parts.len() - 1;
                // With its entry in the list.
                let room = PART.saturating_sub(parts[last].most() + ENTRY) as usize;
                if room == 0 {
                    parts.push(Self::default());
                    continue;
                }
                let (now, later) = data.split_at(data.len().min(room));
                parts[last].push(&write.target, at, now);
                at += now.len() as u64;
                data = later;
            }
        }
        parts.iter_mut().for_each(Self::scatter);
        parts
    }

    /// Bytes of the ring, where all went by dispatches.
    fn most(&self) -> u64 {
        self.data + self.regions() * ENTRY
    }

    /// Has many short runs go by dispatches.
    fn scatter(&mut self) {
        for (target, regions) in &mut self.copies {
            self.scatters
                .extend(Scatter::take(target, regions, &mut self.list));
        }
        self.copies.retain(|(_, regions)| !regions.is_empty());
    }

    /// Bytes of the ring.
    pub fn bytes(&self) -> u64 {
        self.data + self.list.len() as u64 * ENTRY
    }

    /// Whether nothing is written.
    pub fn is_empty(&self) -> bool {
        self.data == 0
    }

    /// Appends a region, to the one before where they are neighbours.
    fn push(&mut self, target: &Binding, at: u64, data: &'a [u8]) {
        let region = Region {
            from: self.data,
            to: at,
            bytes: data.len() as u64,
        };
        self.pieces.push(data);
        self.data += region.bytes;
        let is_same = |(last, _): &&mut (Binding, Vec<Region>)| last.memory.buffer == target.memory.buffer;
        match self.copies.last_mut().filter(is_same) {
            Some((_, regions)) => match regions.last_mut() {
                Some(last) if last.to + last.bytes == region.to => last.bytes += region.bytes,
                _ => regions.push(region),
            },
            None => self.copies.push((target.clone(), vec![region])),
        }
    }

    /// What it does, for the error of a time limit.
    pub fn name(&self) -> String {
        format!("copying {} bytes", self.bytes())
    }

    /// Regions of all copies.
    pub fn regions(&self) -> u64 {
        self.copies.iter().map(|(_, regions)| regions.len() as u64).sum()
    }

    /// Runs of all dispatches.
    pub fn runs(&self) -> u64 {
        self.scatters.iter().map(Scatter::len).sum()
    }

    /// Dispatches.
    pub fn dispatches(&self) -> usize {
        self.scatters.len()
    }

    /// Writes the bytes to their place in the ring.
    pub fn stage(&self, mut place: &mut [u8]) {
        for piece in self
            .pieces
            .iter()
            .copied()
            .chain([bytemuck::cast_slice(&self.list)])
        {
            let (now, later) = place.split_at_mut(piece.len());
            now.copy_from_slice(piece);
            place = later;
        }
    }

    /// Records what goes from the ring, where the part begins at `start`; with a set of the kernel for each dispatch.
    pub fn record(
        &self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        (ring, start): (vk::Buffer, u64),
        kernel: &Kernel,
        sets: &[vk::DescriptorSet],
    ) {
        for (target, regions) in &self.copies {
            let placed: Vec<Region> = regions
                .iter()
                .map(|region| Region {
                    from: region.from + start,
                    ..*region
                })
                .collect();
            copy(device, commands, ring, target.memory.buffer, &placed);
        }
        if !self.copies.is_empty() && !self.scatters.is_empty() {
            // A dispatch may write anything of a buffer, as far as others know.
            barrier(device, commands);
        }
        let words = [start, start + self.data].map(|bytes| (bytes / 4) as u32);
        for (scatter, set) in self.scatters.iter().zip(sets) {
            scatter.record(device, commands, (kernel, *set), ring, words.into());
        }
    }
}
