//! From a light BVH to words.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use core::ops::Range;

use super::header::{FOLLOWS, Header, LENGTH, OUTGOING, STAGED_ONLY};
use crate::bvh::{Bvh, InstanceState};
use crate::light::Light;
use crate::node::{Node, kind};
use crate::tree::INVALID;

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    pub(super) fn written(&self) -> Vec<u32> {
        // Those that a refit has changed since they were built, or will.
        let mut refitted = BTreeSet::new();
        for pending in [&self.changes.new, &self.changes.unrefitted] {
            refitted.extend(&pending.blases);
            refitted.extend(self.parts(pending).into_keys());
        }
        refitted.extend(self.refitted_since(0));
        refitted.retain(|&blas| !self.blases[blas as usize].is_outgoing);
        // Which of both lists an instance is in is told by where it was put.
        let noted: BTreeSet<u32> = self.top.strayed.union(&self.top.lit).copied().collect();
        let header = Header {
            params: self.params,
            single: self.single,
            forgotten: self.forgotten,
            bottom_depth: self.bottom_depth,
            nodes: self.nodes.len() as u32,
            triangles: self.triangles.len() as u32,
            blases: self.blases.len() as u32,
            meshes: self.meshes.len() as u32,
            instances: self.placed.len() as u32,
            lights: self.light_end(),
            removed: self.removed_lights.len() as u32,
            top_root: self.top.root,
            top_nodes: self.top.nodes.len() as u32,
            refitted: refitted.len() as u32,
            strayed: noted.len() as u32,
        };
        let mut words = header.words::<N, W>().to_vec();
        self.write_bottoms(&mut words);
        self.write_instances(&mut words);
        for range in &self.removed_lights {
            words.extend([range.start, range.end]);
        }
        for (number, (&node, &edits)) in self.top.nodes.iter().zip(&self.top.edits).enumerate() {
            words.push(node);
            if node != INVALID {
                let built = self.quality(node).built.to_bits();
                words.extend([edits | self.top.what_rests(number), built]);
                words.extend([self.top.stirred[number], self.top.changes[number]]);
            }
        }
        words.extend(&refitted);
        for blas in refitted {
            let nodes = self.blases[blas as usize].nodes.clone();
            words.extend(nodes.map(|node| self.quality[node as usize].built.to_bits()));
        }
        words.extend(noted);
        self.write_nodes(&mut words);
        self.write_triangles_to(&mut words);
        words[LENGTH] = words.len() as u32;
        words
    }

    fn write_bottoms(&self, words: &mut Vec<u32>) {
        for blas in &self.blases {
            if blas.nodes.is_empty() {
                words.push(INVALID);
                continue;
            }
            words.extend([
                blas.mesh,
                blas.nodes.start,
                blas.nodes.end,
                blas.triangles.start,
                blas.triangles.end,
            ]);
            write_parts(words, &blas.parts);
            let staged_only = if blas.is_staged_only { STAGED_ONLY } else { 0 };
            let outgoing = if blas.is_outgoing { OUTGOING } else { 0 };
            let unsettled = blas.unsettled | staged_only | outgoing;
            words.extend(blas.center.map(f32::to_bits));
            words.extend([blas.known_flux.word(), unsettled, blas.misfits.len() as u32]);
            words.extend(&blas.misfits);
            if blas.is_outgoing {
                let own = &self.blases[self.meshes[blas.mesh as usize].blas as usize];
                words.push(own.outgoing.map_or(0, |outgoing| outgoing.next));
            }
        }
        words.extend(
            self.meshes
                .iter()
                .map(|mesh| if mesh.live { mesh.blas } else { INVALID }),
        );
    }

    fn write_instances(&self, words: &mut Vec<u32>) {
        for (placed, instance) in self.placed.iter().zip(&self.instances) {
            if !placed.live {
                words.push(INVALID);
                continue;
            }
            let InstanceState {
                mesh, user, listed, ..
            } = *placed;
            let is_behind = instance.blas != self.meshes[mesh as usize].blas;
            let user = user | if is_behind { FOLLOWS } else { 0 };
            words.extend([mesh, user, listed, placed.lights.start, placed.radiance.to_bits()]);
            words.extend(placed.hung_words());
            let transform = &placed.transform;
            let entries = transform.columns.iter().flatten().chain(&transform.translation);
            words.extend(entries.map(|x| x.to_bits()));
            write_parts(words, &placed.parts);
            let parts = &self.placed[placed.parts.start as usize..placed.parts.end as usize];
            words.extend(parts.iter().flat_map(InstanceState::hung_words));
        }
    }

    /// Kinds and links of the nodes in use.
    fn write_nodes(&self, words: &mut Vec<u32>) {
        let mut used = alloc::vec![false; self.nodes.len()];
        for range in self.blases.iter().map(|blas| &blas.nodes) {
            used[range.start as usize..range.end as usize].fill(true);
        }
        self.top.in_use().for_each(|node| used[node as usize] = true);
        for (node, &used) in self.nodes.iter().zip(&used) {
            let kind = |slot: usize| if used { node.kind(slot) } else { kind::EMPTY };
            words.push((0..W).fold(0, |kinds, slot| kinds | (kind(slot) << (2 * slot))));
            let children = (0..W).filter(|&slot| kind(slot) != kind::EMPTY);
            words.extend(children.map(|slot| node.link(slot)));
        }
    }

    /// The triangles in use, and a word for each place that is not, or that has those of a tree that goes: they are the mesh's.
    fn write_triangles_to(&self, words: &mut Vec<u32>) {
        let mut used = alloc::vec![false; self.triangles.len()];
        for blas in self.blases.iter().filter(|blas| !blas.is_outgoing) {
            used[blas.triangles.start as usize..blas.triangles.end as usize].fill(true);
        }
        for (triangle, &used) in self.triangles.iter().zip(&used) {
            if used {
                let own: &[u32] = bytemuck::cast_slice(core::slice::from_ref(triangle));
                let places = own.iter().enumerate();
                words.extend(
                    places
                        .filter(|&(place, _)| place != N::Light::MESH_WORD)
                        .map(|(_, word)| word),
                );
            } else {
                words.push(0);
            }
        }
    }
}

/// A range of parts, or one word that there are none.
fn write_parts(words: &mut Vec<u32>, parts: &Range<u32>) {
    if parts.is_empty() {
        words.push(INVALID);
    } else {
        words.extend([parts.start, parts.end]);
    }
}
