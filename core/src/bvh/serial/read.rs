//! From words to what they say. Every number is checked before anything is done by it.

use alloc::vec::Vec;
use core::ops::Range;

use super::error::ReadError;
use super::header::{FOLLOWS, Header, OUTGOING, STAGED_ONLY};
use super::places::{read_indices, read_range, read_ranges, taken};
use super::words::Words;
use crate::bvh::blas::Blas;
use crate::bvh::check::factor;
use crate::bvh::known_flux::KnownFlux;
use crate::bvh::powers::Powers;
use crate::bvh::stage::{MISFITS, Outgoing};
use crate::bvh::top::{MOST_EDITS, Top};
use crate::bvh::unsettled::MOST;
use crate::bvh::{Bvh, EditReason, InstanceState, Mesh};
use crate::light::Light;
use crate::node::{Node, kind};
use crate::transform::{Extent, Transform};
use crate::tree::INVALID;

const BOTTOMS: ReadError = ReadError::Places {
    what: "bottom levels",
};

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    pub(super) fn read(words: &mut Words<'_>) -> Result<Self, ReadError> {
        let header = Header::read::<N, W>(words)?;
        let mut bvh = Self::new(header.params);
        bvh.single = header.single;
        bvh.forgotten = header.forgotten;
        bvh.bottom_depth = header.bottom_depth;
        bvh.read_bottoms(words, &header)?;
        let behind = bvh.read_instances(words, &header)?;
        bvh.removed_lights = read_ranges(words, header.removed, header.lights, "removed lights")?;
        words.expect(!header.forgotten || header.removed > 0, "removed lights")?;
        bvh.top = Top {
            root: header.top_root,
            nodes: Vec::with_capacity(words.need(header.top_nodes)?),
            ..Top::default()
        };
        let mut top_built = Vec::with_capacity(words.need(header.top_nodes)?);
        for _ in 0..header.top_nodes {
            let node = words.one()?;
            words.expect(node < header.nodes || node == INVALID, "node of the top level")?;
            bvh.top.nodes.push(node);
            let [edits, built, stirred, changes] = match node {
                INVALID => [0, INVALID, 0, 0],
                _ => words.array()?,
            };
            let (rests, edits) = (edits & Top::FLAGS, edits & !Top::FLAGS);
            words.expect(edits <= MOST_EDITS, "edits below a node of the top level")?;
            let is_share = built == INVALID || (0.0..=1.0).contains(&f32::from_bits(built));
            words.expect(is_share, "quality of a node")?;
            bvh.top.edits.push(edits);
            bvh.top.stirred.push(stirred);
            bvh.top.changes.push(changes);
            bvh.top.set_what_rests(rests);
            top_built.push(built);
        }
        let refitted = read_indices(words, header.refitted, header.blases, "refitted bottom level")?;
        let built = bvh.read_quality(words, &refitted)?;
        let strayed = read_indices(words, header.strayed, header.instances, "strayed instance")?;
        let is_sound = |&index: &u32| bvh.placed[index as usize].live;
        words.expect(
            strayed.is_sorted_by(|a, b| a < b) && strayed.iter().all(is_sound),
            "strayed instances",
        )?;
        bvh.read_nodes(words, &header)?;
        bvh.read_triangles(words, &header)?;
        bvh.restore(&header, &behind)?;
        bvh.restore_changes(refitted, built)?;
        bvh.note_sizes();
        bvh.reserve_room();
        bvh.restore_top_quality(&top_built);
        // Where what was written was not refitted.
        let all = Vec::from_iter(0..header.blases);
        strayed.into_iter().for_each(|index| bvh.note(index));
        bvh.note_fluxes(&all);
        bvh.note_centers(&all);
        Ok(bvh)
    }

    fn read_bottoms(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        let mut outgoing = Vec::new();
        self.blases = Vec::with_capacity(words.need(header.blases)?);
        for _ in 0..header.blases {
            let mesh = words.one()?;
            let mut blas = Blas::none::<N::Light>(mesh);
            if mesh != INVALID {
                words.expect(mesh < header.meshes, "mesh of a bottom level")?;
                blas.nodes = read_range(words, header.nodes, "nodes of a bottom level")?;
                blas.triangles = read_range(words, header.triangles, "triangles of a bottom level")?;
                blas.parts = read_parts(words, header.blases)?;
                blas.center = words.array()?.map(f32::from_bits);
                let known = KnownFlux::from_word(words.one()?);
                blas.known_flux = known.ok_or_else(|| words.wrong("flux of a mesh"))?;
                let unsettled = words.one()?;
                blas.is_staged_only = unsettled & STAGED_ONLY != 0;
                blas.is_outgoing = unsettled & OUTGOING != 0;
                blas.unsettled = unsettled & !(STAGED_ONLY | OUTGOING);
                words.expect(blas.unsettled <= MOST, "changes of a mesh")?;
                let misfits = words.one()?;
                words.expect(misfits as usize <= MISFITS, "number of subtrees without another")?;
                for _ in 0..misfits {
                    let node = words.one()?;
                    words.expect(blas.nodes.contains(&node), "subtree without another")?;
                    blas.misfits.push(node);
                }
                if blas.is_outgoing {
                    outgoing.push((self.blases.len() as u32, words.one()?));
                }
            }
            self.blases.push(blas);
        }
        let live = |(_, blas): &(u32, &Blas)| !blas.nodes.is_empty();
        let used = (0..).zip(&self.blases).filter(live);
        let used = used.flat_map(|(i, blas)| [i..i + 1, blas.parts.clone()]);
        self.blas_ranges = taken(header.blases, used.collect(), "bottom levels")?;
        let used = self.blases.iter().map(|blas| blas.triangles.clone()).collect();
        self.triangle_ranges = taken(header.triangles, used, "triangles")?;

        self.meshes = Vec::with_capacity(words.need(header.meshes)?);
        for index in 0..header.meshes {
            let blas = words.one()?;
            let live = blas != INVALID;
            if live {
                let own = self.blases.get(blas as usize).filter(|own| own.mesh == index);
                words.expect(own.is_some(), "bottom level of a mesh")?;
            }
            self.meshes.push(Mesh {
                live,
                generation: 0,
                blas: if live { blas } else { 0 },
                users: Vec::new(),
            });
        }
        for (index, blas) in (0..).zip(&self.blases).filter(live) {
            let mesh = &self.meshes[blas.mesh as usize];
            if !mesh.live || (mesh.blas == index) == blas.is_outgoing {
                return Err(BOTTOMS);
            }
        }
        for (index, next) in outgoing {
            let old = &self.blases[index as usize];
            let (mesh, count) = (old.mesh, old.triangles.len());
            let blas = self.meshes[mesh as usize].blas;
            let own = &mut self.blases[blas as usize];
            if own.outgoing.is_some() || own.triangles.len() != count {
                return Err(BOTTOMS);
            }
            own.outgoing = Some(Outgoing {
                blas: index,
                left: 0,
                next,
            });
            self.handing.push(blas);
        }
        self.handing.sort_unstable();
        let used = (0..).zip(&self.meshes).filter(|(_, mesh)| mesh.live);
        self.mesh_ranges = taken(header.meshes, used.map(|(i, _)| i..i + 1).collect(), "meshes")?;
        Ok(())
    }

    /// Returns those that follow trees that go.
    fn read_instances(&mut self, words: &mut Words<'_>, header: &Header) -> Result<Vec<u32>, ReadError> {
        self.placed = Vec::with_capacity(words.need(header.instances)?);
        let (mut hung, mut behind) = (Vec::new(), Vec::new());
        for _ in 0..header.instances {
            let mesh = words.one()?;
            let mut placed = InstanceState {
                live: mesh != INVALID,
                generation: 0,
                mesh: 0,
                user: 0,
                transform: Transform::IDENTITY,
                radiance: 0.0,
                listed: 0,
                lights: 0..0,
                node: INVALID,
                slot: 0,
                hung: 0,
                hung_radiance: 0.0,
                flickers: false,
                hung_center: [f32::NAN; 3],
                mark: 0,
                changed: 0,
                parts: 0..0,
                part_of: INVALID,
            };
            if placed.live {
                let own = self.meshes.get(mesh as usize).filter(|own| own.live);
                let Some(own) = own else {
                    return Err(words.wrong("mesh of an instance"));
                };
                placed.mesh = mesh;
                let user = words.one()?;
                placed.user = user & !FOLLOWS;
                if user & FOLLOWS != 0 {
                    let outgoing = &mut self.blases[own.blas as usize].outgoing;
                    let Some(outgoing) = outgoing else {
                        return Err(words.wrong("tree that an instance follows"));
                    };
                    outgoing.left += 1;
                    behind.push(self.placed.len() as u32);
                }
                placed.listed = words.one()?;
                let first = words.one()?;
                let triangles = self.blases[own.blas as usize].triangles.len() as u32;
                let lights = first.checked_add(triangles).filter(|&end| end <= header.lights);
                let Some(end) = lights else {
                    return Err(words.wrong("first light of an instance"));
                };
                placed.lights = first..end;
                placed.radiance = f32::from_bits(words.one()?);
                placed.set_hung_words(words.array()?);
                let entries = words.array::<12>()?.map(f32::from_bits);
                let column = |k: usize| [entries[3 * k], entries[3 * k + 1], entries[3 * k + 2]];
                placed.transform = Transform {
                    columns: [column(0), column(1), column(2)],
                    translation: column(3),
                };
                placed.parts = read_parts(words, header.instances)?;
                words.need((placed.parts.len() as u32).saturating_mul(4))?;
                for part in placed.parts.clone() {
                    hung.push((part, words.array()?));
                }
            }
            self.placed.push(placed);
        }
        for (part, own) in hung {
            self.placed[part as usize].set_hung_words(own);
        }
        let used = (0..).zip(&self.placed).filter(|(_, placed)| placed.live);
        let used = used.flat_map(|(i, placed)| [i..i + 1, placed.parts.clone()]);
        self.placed_ranges = taken(header.instances, used.collect(), "instances")?;
        let mut handing = self.handing.iter();
        let left = |blas: &u32| self.blases[*blas as usize].outgoing.map_or(0, |own| own.left);
        if handing.any(|blas| left(blas) == 0) {
            return Err(BOTTOMS);
        }
        Ok(behind)
    }

    /// What was noted of the nodes of bottom levels that were refitted since they were built.
    fn read_quality(&self, words: &mut Words<'_>, refitted: &[u32]) -> Result<Vec<Vec<f32>>, ReadError> {
        let mut all = Vec::with_capacity(refitted.len());
        for &blas in refitted {
            let count = self.blases[blas as usize].nodes.len() as u32;
            let mut built = Vec::with_capacity(words.need(count)?);
            for _ in 0..count {
                let share = f32::from_bits(words.one()?);
                words.expect((0.0..=1.0).contains(&share), "quality of a node")?;
                built.push(share);
            }
            all.push(built);
        }
        Ok(all)
    }

    fn read_nodes(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        let count = words.need(header.nodes)?;
        self.nodes = alloc::vec![N::EMPTY; count];
        self.parents = alloc::vec![INVALID; count];
        for index in 0..count {
            let kinds = words.one()?;
            words.expect(
                kinds.checked_shr(2 * W as u32).unwrap_or(0) == 0,
                "kinds of a node",
            )?;
            for slot in 0..W {
                let to = (kinds >> (2 * slot)) & 3;
                if to != kind::EMPTY {
                    let link = words.one()?;
                    self.nodes[index].set_child(slot, to, link);
                    if to == kind::INNER {
                        let parent = self.parents.get_mut(link as usize);
                        *parent.ok_or_else(|| words.wrong("link of a node"))? = index as u32;
                    }
                }
            }
        }
        Ok(())
    }

    fn read_triangles(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        self.triangles = alloc::vec![N::Light::DARK; words.need(header.triangles)?];
        for (blas, own) in (0..).zip(&self.blases).filter(|(_, own)| !own.is_outgoing) {
            for light in &mut self.triangles[own.triangles.start as usize..own.triangles.end as usize] {
                *light = light.of_mesh(blas);
            }
        }
        for (index, light) in (0..).zip(&mut self.triangles) {
            let mesh = light.mesh();
            if mesh == INVALID {
                let gap = words.one()?;
                words.expect(gap == 0, "place of no triangle")?;
                continue;
            }
            for (place, word) in bytemuck::cast_slice_mut::<_, u32>(core::slice::from_mut(light))
                .iter_mut()
                .enumerate()
            {
                if place != N::Light::MESH_WORD {
                    *word = words.one()?;
                }
            }
            *light = light.checked().map_err(|error| ReadError::Light {
                triangle: index,
                error,
            })?;
        }
        for &blas in &self.handing {
            let own = &self.blases[blas as usize];
            let Some(Outgoing { blas: old, .. }) = own.outgoing else {
                continue;
            };
            let to = self.blases[old as usize].triangles.clone();
            for (from, to) in own.triangles.clone().zip(to) {
                self.triangles[to as usize] = self.triangles[from as usize].of_mesh(old);
            }
        }
        for blas in &mut self.blases {
            let range = blas.triangles.start as usize..blas.triangles.end as usize;
            blas.extent = Extent::of(&self.triangles[range.clone()]);
            blas.powers = Powers::of(&self.triangles[range]);
        }
        for (instance, placed) in (0..).zip(&self.placed).filter(|(_, placed)| placed.live) {
            let wrong = |reason| ReadError::Instance { instance, reason };
            let checked = placed.transform.check(&self.blas_of(placed).extent);
            checked.map_err(|error| wrong(EditReason::Transform(error)))?;
            factor(placed.radiance).map_err(wrong)?;
        }
        Ok(())
    }
}

/// A range of parts below `end`, or one word that there are none.
fn read_parts(words: &mut Words<'_>, end: u32) -> Result<Range<u32>, ReadError> {
    let from = words.one()?;
    if from == INVALID {
        return Ok(0..0);
    }
    let to = words.one()?;
    words.expect(from < to && to <= end, "parts")?;
    Ok(from..to)
}
