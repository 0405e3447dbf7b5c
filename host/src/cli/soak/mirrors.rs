//! Devices that follow the scene, and their words against its own.

use std::collections::BTreeMap;

use bytemuck::cast_slice;
use serde::Serialize;

use crate::backend::{Bvh, DeviceArrays, DeviceBackend, Follow};
use crate::cli::devices::Opened;
use crate::error::HostError;

/// Words of a device compared so far.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Tally {
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
}

impl<'d> Mirrors<'d> {
    pub fn new(opened: &'d [Opened], bvh: &mut Bvh) -> Result<Self, HostError> {
        let mut devices = Vec::new();
        // From here on each plan says what changed since the last.
        bvh.plan();
        bvh.refit();
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
        Ok(Self { devices })
    }

    /// After a plan, before its refit.
    pub fn follow(&mut self, bvh: &Bvh) -> Result<(), HostError> {
        for (device, _) in &mut self.devices {
            device.follow(bvh)?;
        }
        Ok(())
    }

    /// All words that are in use, after the refit.
    pub fn compare(&mut self, frame: u32, bvh: &Bvh) -> Result<(), HostError> {
        for (device, tally) in &mut self.devices {
            tally.take(frame, bvh, &device.arrays()?);
        }
        Ok(())
    }

    pub fn tallies(self) -> Vec<Tally> {
        self.devices.into_iter().map(|(_, tally)| tally).collect()
    }
}

impl Tally {
    fn take(&mut self, frame: u32, bvh: &Bvh, found: &DeviceArrays) {
        let everything = bvh.plan_of_everything();
        let nodes = [everything.bottom.nodes(), everything.top.nodes()].concat();
        let width = size_of_val(&bvh.nodes()[0]) / 4;
        for node in nodes {
            self.words(
                "nodes",
                frame,
                cast_slice(bvh.nodes()),
                &found.nodes,
                node as usize,
                width,
            );
        }
        for &root in &everything.roots {
            self.words(
                "roots",
                frame,
                cast_slice(bvh.roots()),
                &found.roots,
                root as usize,
                size_of_val(&bvh.roots()[0]) / 4,
            );
        }
        let tree = bvh.tree();
        let width = size_of_val(&bvh.triangles()[0]) / 4;
        let trail = tree.trail_words as usize;
        for (index, instance) in (0..).zip(bvh.instances()) {
            let own = cast_slice(bvh.instances());
            self.words(
                "instances",
                frame,
                own,
                &found.instances,
                index as usize,
                size_of_val(instance) / 4,
            );
            if bvh.instance_id(index).is_none() {
                continue;
            }
            for at in instance.first_triangle..instance.first_triangle + instance.count {
                let at = at as usize;
                self.words(
                    "triangles",
                    frame,
                    cast_slice(bvh.triangles()),
                    &found.triangles,
                    at,
                    width,
                );
                self.words("trails", frame, tree.trails, &found.trails, at, trail);
            }
        }
    }

    /// One element of `width` words.
    fn words(
        &mut self,
        array: &'static str,
        frame: u32,
        expected: &[u32],
        found: &[u32],
        index: usize,
        width: usize,
    ) {
        let range = index * width..(index + 1) * width;
        let expected = &expected[range.clone()];
        let different = match found.get(range) {
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
