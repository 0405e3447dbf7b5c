//! How the bytes of a pass get from the host into their buffers: one after another in the staging ring, and from there by one copy for each
//! buffer, of as many regions as it takes.

use super::buffer::Binding;
use super::memory::{Region, copy};
use super::pass::Write;
use super::ring::PART;
use ash::vk;

/// What one submission writes.
#[derive(Default)]
pub(super) struct Part<'a> {
    /// The bytes, one after another.
    pub pieces: Vec<&'a [u8]>,
    pub bytes: u64,
    /// The copies: for each buffer its regions, whose `from` counts from the first byte of the part.
    pub copies: Vec<(Binding, Vec<Region>)>,
}

impl<'a> Part<'a> {
    /// Splits writes, sorted by buffer and place, into parts that the ring takes. There is always a last one.
    pub fn split(writes: &[&'a Write<'a>]) -> Vec<Self> {
        let mut parts = vec![Self::default()];
        for write in writes {
            let (mut at, mut data) = (write.at, write.data());
            while !data.is_empty() {
                let last = parts.len() - 1;
                let room = (PART - parts[last].bytes) as usize;
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
        parts
    }

    /// Appends a region, to the one before where they are neighbours.
    fn push(&mut self, target: &Binding, at: u64, data: &'a [u8]) {
        let region = Region {
            from: self.bytes,
            to: at,
            bytes: data.len() as u64,
        };
        self.pieces.push(data);
        self.bytes += region.bytes;
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
        format!("copying {} bytes", self.bytes)
    }

    /// Regions of all copies.
    pub fn regions(&self) -> u64 {
        self.copies.iter().map(|(_, regions)| regions.len() as u64).sum()
    }

    /// Writes the bytes to their place in the ring.
    pub fn stage(&self, mut place: &mut [u8]) {
        for piece in &self.pieces {
            let (now, later) = place.split_at_mut(piece.len());
            now.copy_from_slice(piece);
            place = later;
        }
    }

    /// Records the copies from the ring, where the part begins at `start`.
    pub fn record(&self, device: &ash::Device, commands: vk::CommandBuffer, ring: vk::Buffer, start: u64) {
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
    }
}
