//! Devices that follow the scene, and their words against its own.

use std::collections::BTreeMap;

use bytemuck::{Pod, cast_slice};
use lightbvh::node::{Node as _, kind};
use lightbvh::tree::{INVALID, OPENED, TreeWords};
use lightbvh_gpu::Mirror;
use lightbvh_kernels::bvh::WIDTH;
use serde::Serialize;

use crate::backend::{Bvh, DeviceArrays, DeviceBackend, Follow};
use crate::cli::devices::Opened;
use crate::error::HostError;

/// Words of a device compared so far.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::verify) struct Tally {
    pub name: String,
    pub compared: u64,
    pub different: u64,
    /// Different words by array.
    pub arrays: BTreeMap<&'static str, u64>,
    /// Frame of the first.
    pub first: Option<u32>,
}

/// A device each.
pub(super) struct Mirrors<'d> {
    devices: Vec<(DeviceBackend<'d>, Tally)>,
    /// Follows as they do, and so has the offsets of their links.
    layout: Mirror,
}

impl<'d> Mirrors<'d> {
    pub fn new(opened: &'d [Opened], bvh: &Bvh) -> Result<Self, HostError> {
        let mut layout = Mirror::default();
        layout.frame(bvh);
        let mut devices = Vec::new();
        for o in opened {
            let tally = Tally {
                name: o.device.name().to_owned(),
                compared: 0,
                different: 0,
                arrays: BTreeMap::new(),
                first: None,
            };
            devices.push((DeviceBackend::new(&o.device, bvh)?, tally));
        }
        Ok(Self { devices, layout })
    }

    /// Updates all devices. Call it after a refit.
    pub fn follow(&mut self, bvh: &Bvh) -> Result<(), HostError> {
        for (device, _) in &mut self.devices {
            device.follow(bvh)?;
        }
        self.layout.frame(bvh);
        Ok(())
    }

    /// Compares all words that are in use.
    pub fn compare(&mut self, frame: u32, bvh: &Bvh) -> Result<(), HostError> {
        let words = self.layout.words(bvh);
        for (device, tally) in &mut self.devices {
            tally.take(frame, bvh, &device.arrays()?, &words);
        }
        Ok(())
    }

    pub fn tallies(self) -> Vec<Tally> {
        self.devices.into_iter().map(|(_, tally)| tally).collect()
    }
}

impl Tally {
    fn take(&mut self, frame: u32, bvh: &Bvh, found: &DeviceArrays, words: &TreeWords) {
        let (tree, all) = (bvh.tree(), bvh.plan_of_everything());
        let (bottom, top) = (all.bottom.nodes(), all.top.nodes());
        let records: Vec<u32> = (0..tree.instances.len() as u32).collect();
        let live = records.iter().copied();
        let live: Vec<u32> = live.filter(|&index| bvh.instance_id(index).is_some()).collect();
        let lights: Vec<u32> = live
            .iter()
            .map(|&index| tree.instances[index as usize])
            .flat_map(|own| own.first_triangle..own.first_triangle + own.count)
            .collect();
        let opened = live
            .iter()
            .map(|&index| (index, tree.links.places[index as usize]));
        let opened = opened.filter(|(_, place)| (OPENED..INVALID).contains(place));
        let parts: Vec<u32> = opened
            .flat_map(|(index, place)| {
                let root = &bvh.nodes()[tree.instances[index as usize].root as usize];
                let count = (0..WIDTH).filter(|&slot| root.kind(slot) == kind::INNER).count() as u32;
                place - OPENED..place - OPENED + count
            })
            .collect();
        let behind = size_of_val(bvh.nodes()) / 4;
        let [above, places, first] = [words.above, words.places, words.parts].map(|word| word as usize);
        let trails = &found.trails;
        self.array(frame, "nodes", bvh.nodes(), &found.nodes, bottom);
        self.array(frame, "top", bvh.top_nodes(), &found.nodes[behind..], top);
        self.array(frame, "roots", bvh.roots(), &found.roots, &all.roots);
        self.array(frame, "instances", tree.instances, &found.instances, &records);
        self.array(frame, "triangles", bvh.triangles(), &found.triangles, &lights);
        match tree.trail_words {
            1 => self.array(frame, "trails", tree.trails, trails, &lights),
            _ => self.array::<[u32; 2]>(frame, "trails", cast_slice(tree.trails), trails, &lights),
        }
        self.array(frame, "above", tree.links.above, &trails[above..], top);
        self.array(frame, "places", tree.links.places, &trails[places..], &live);
        self.array(frame, "parts", tree.links.parts, &trails[first..], &parts);
    }

    /// The elements of an array that are in use.
    fn array<T: Pod>(
        &mut self,
        frame: u32,
        array: &'static str,
        expected: &[T],
        found: &[u32],
        indices: &[u32],
    ) {
        let width = size_of::<T>() / 4;
        for &index in indices {
            let expected: &[u32] = cast_slice(&expected[index as usize..][..1]);
            let different = match found.get(index as usize * width..(index as usize + 1) * width) {
                Some(found) => expected.iter().zip(found).filter(|(a, b)| a != b).count(),
                None => width,
            };
            self.compared += width as u64;
            if different > 0 {
                self.different += different as u64;
                *self.arrays.entry(array).or_default() += different as u64;
                self.first.get_or_insert(frame);
            }
        }
    }
}
