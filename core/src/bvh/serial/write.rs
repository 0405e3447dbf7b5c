//! From a light BVH to words.

use crate::model::Model;
use alloc::vec::Vec;
use core::mem::offset_of;

use super::header::{FORGOTTEN, FORMAT, HEADER_WORDS, Header, MAGIC, OPENS, SINGLE, code, layout};
use crate::bvh::{Bvh, InstanceState};
use crate::light::Light;
use crate::node::{Node, kind};
use crate::tree::INVALID;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// The BVH as words, which [`from_words`](Self::from_words) reads; a file holds them in little-endian order. They name the
    /// layout and the width, not the importance, of which no word depends. Takes time and memory in proportion to
    /// the arrays.
    ///
    /// Nothing is refitted here, and nothing need be: where edits wait for their refit, what is read has been refitted, and may
    /// be once more. Trees that later edits build are then as good, but not the same word for word as those of the original,
    /// which built them before its refit: refit first where that matters.
    #[must_use]
    pub fn to_words(&self) -> Vec<u32> {
        let flag = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
        let header = Header {
            magic: MAGIC,
            format: FORMAT,
            length: 0,
            layout: layout::<M::Node, W>(),
            width: W as u32,
            flags: flag(self.single, SINGLE)
                | flag(self.forgotten, FORGOTTEN)
                | flag(self.params.opens, OPENS),
            heuristic: code(self.params.heuristic),
            buckets: self.params.buckets,
            bottom_depth: self.bottom_depth,
            nodes: self.nodes.len() as u32,
            lights: self.lights.len() as u32,
            meshes: self.meshes.len() as u32,
            instances: self.placed.len() as u32,
            numbers: self.view().light_end(),
            removed: self.removed_lights.len() as u32,
            top_root: self.top.root,
            top_nodes: self.top.nodes.len() as u32,
            top_free: self.top.free.len() as u32,
            opened: self.top.opened.len() as u32,
            parts: self.top.parts.len() as u32,
        };
        let mut words = bytemuck::cast::<_, [u32; HEADER_WORDS]>(header).to_vec();
        for (index, mesh) in (0u32..).zip(&self.meshes) {
            let flags = u32::from(self.reshaped.contains(&index)) | (u32::from(mesh.is_light) << 1);
            let (nodes, lights, end) = (&mesh.nodes, &mesh.lights, mesh.capacity);
            match mesh.live {
                true => words.extend([nodes.start, nodes.end, end, lights.start, lights.end, flags]),
                false => words.push(INVALID),
            }
        }
        self.write_instances(&mut words);
        for range in &self.removed_lights {
            words.extend([range.start, range.end]);
        }
        self.write_top(&mut words);
        self.write_nodes(&mut words);
        self.write_lights_to(&mut words);
        words[offset_of!(Header, length) / 4] = words.len() as u32;
        words
    }

    fn write_instances(&self, words: &mut Vec<u32>) {
        for placed in &self.placed {
            if !placed.live {
                words.push(INVALID);
                continue;
            }
            let InstanceState {
                mesh, user, listed, ..
            } = *placed;
            words.extend([mesh, user, listed, placed.numbers.start]);
            words.extend(placed.radiance.map(f32::to_bits));
            words.push(placed.mask);
            let transform = &placed.transform;
            let entries = transform.columns.iter().flatten().chain(&transform.translation);
            words.extend(entries.map(|x| x.to_bits()));
        }
    }

    fn write_top(&self, words: &mut Vec<u32>) {
        words.extend(&self.top.free);
        for (&instance, own) in &self.top.opened {
            words.extend([instance, own.first]);
        }
        for (node, shape) in self.top.nodes.iter().zip(&self.top.shapes) {
            words.push(u32::from(shape.height > 0));
            if shape.height > 0 {
                words.extend(
                    [shape.half, shape.from]
                        .as_flattened()
                        .iter()
                        .map(|x| x.to_bits()),
                );
                write_node(words, node);
            }
        }
    }

    /// Kinds and links of the nodes of meshes.
    fn write_nodes(&self, words: &mut Vec<u32>) {
        let mut used = alloc::vec![false; self.nodes.len()];
        for range in self.meshes.iter().map(|mesh| &mesh.nodes) {
            used[range.start as usize..range.end as usize].fill(true);
        }
        let nothing = M::Node::EMPTY;
        for (node, &used) in self.nodes.iter().zip(&used) {
            write_node(words, if used { node } else { &nothing });
        }
    }

    /// The lights in use, and a word for each place that is not.
    fn write_lights_to(&self, words: &mut Vec<u32>) {
        let mut used = alloc::vec![false; self.lights.len()];
        for mesh in &self.meshes {
            used[mesh.lights.start as usize..mesh.lights.end as usize].fill(true);
        }
        for (light, &used) in self.lights.iter().zip(&used) {
            if used {
                let own: &[u32] = bytemuck::cast_slice(core::slice::from_ref(light));
                let places = own.iter().enumerate();
                words.extend(
                    places
                        .filter(|&(place, _)| place != M::Light::MESH_WORD)
                        .map(|(_, word)| word),
                );
            } else {
                words.push(0);
            }
        }
    }
}

fn write_node<N: Node<W>, const W: usize>(words: &mut Vec<u32>, node: &N) {
    words.push((0..W).fold(0, |kinds, slot| kinds | (node.kind(slot) << (2 * slot))));
    let children = (0..W).filter(|&slot| node.kind(slot) != kind::EMPTY);
    words.extend(children.map(|slot| node.link(slot)));
}
