//! From words to what they say. Every number is checked before anything is done by it.

use crate::model::Model;
use alloc::vec::Vec;

use super::header::{FORGOTTEN, Header, SINGLE};
use super::words::{ReadError, Words, damaged, taken};
use crate::bvh::area::is_by_area;
use crate::bvh::check::factor;
use crate::bvh::records::Mesh;
use crate::bvh::top::{Opened, Shape, Top};
use crate::bvh::{Bvh, EditReason, InstanceState};
use crate::light::Light;
use crate::node::{Node, kind};
use crate::transform::{Transform, reach_of};
use crate::tree::INVALID;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    pub(super) fn read(words: &mut Words<'_>) -> Result<Self, ReadError> {
        let (header, params) = Header::read::<M::Node, W>(words)?;
        let mut bvh = Self::new(params);
        bvh.single = header.has(SINGLE);
        bvh.forgotten = header.has(FORGOTTEN);
        bvh.bottom_depth = header.bottom_depth;
        bvh.read_meshes(words, &header)?;
        bvh.read_instances(words, &header)?;
        words.need(header.removed)?;
        for _ in 0..header.removed {
            let range = words.range(header.numbers, "removed lights")?;
            bvh.removed_lights.push(range);
        }
        words.expect(!bvh.forgotten || header.removed > 0, "removed lights")?;
        bvh.read_top(words, &header)?;
        let count = words.need(header.nodes)?;
        bvh.nodes = alloc::vec![M::Node::EMPTY; count];
        for index in 0..count {
            bvh.nodes[index] = read_node(words)?;
        }
        bvh.read_lights(words, &header)?;
        bvh.restore(&header)?;
        Ok(bvh)
    }

    fn read_meshes(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        self.meshes = Vec::with_capacity(words.need(header.meshes)?);
        for index in 0..header.meshes {
            let start = words.one()?;
            let mut mesh = Mesh {
                live: start != INVALID,
                ..Mesh::default()
            };
            if mesh.live {
                let [end, capacity] = words.array()?;
                let is_range = start <= end && end <= capacity && capacity <= header.nodes;
                words.expect(is_range, "nodes of a mesh")?;
                (mesh.nodes, mesh.capacity) = (start..end, capacity);
                mesh.lights = words.range(header.lights, "lights of a mesh")?;
                let is_alone = self.is_alone(mesh.lights.len());
                words.expect(is_alone == (start == end), "nodes of a mesh")?;
                words.expect(!is_alone || start == capacity, "nodes of a mesh")?;
                let flags = words.one()?;
                // A mesh without nodes is never rebuilt.
                let is_known = flags < 4 && flags & (if is_alone { 1 } else { 2 }) == 0;
                words.expect(is_known, "whether a mesh changed or is a light")?;
                mesh.is_light = flags & 2 != 0;
                if flags & 1 != 0 {
                    self.reshaped.insert(index);
                }
            }
            self.meshes.push(mesh);
        }
        let live = || (0u32..).zip(&self.meshes).filter(|(_, mesh)| mesh.live);
        let nodes = live().map(|(_, mesh)| mesh.nodes.start..mesh.capacity);
        self.node_ranges = taken(header.nodes, nodes.collect(), "nodes")?;
        let lights = live().map(|(_, mesh)| mesh.lights.clone());
        self.light_ranges = taken(header.lights, lights.collect(), "lights")?;
        let meshes = live().map(|(index, _)| index..index + 1).collect();
        self.mesh_ranges = taken(header.meshes, meshes, "meshes")?;
        Ok(())
    }

    fn read_instances(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        self.placed = Vec::with_capacity(words.need(header.instances)?);
        for _ in 0..header.instances {
            let mesh = words.one()?;
            let mut placed = InstanceState::NONE;
            placed.live = mesh != INVALID;
            if placed.live {
                let own = self.meshes.get(mesh as usize).filter(|own| own.live);
                let Some(own) = own else {
                    return Err(words.wrong("mesh of an instance"));
                };
                placed.mesh = mesh;
                placed.user = words.one()?;
                placed.listed = words.one()?;
                let first = words.one()?;
                let lights = own.lights.len() as u32;
                let lights = first.checked_add(lights).filter(|&end| end <= header.numbers);
                let Some(end) = lights else {
                    return Err(words.wrong("first light of an instance"));
                };
                placed.numbers = first..end;
                placed.radiance = words.array::<3>()?.map(f32::from_bits);
                placed.mask = words.one()?;
                let entries = words.array::<12>()?.map(f32::from_bits);
                let column = |k: usize| [entries[3 * k], entries[3 * k + 1], entries[3 * k + 2]];
                placed.transform = Transform {
                    columns: [column(0), column(1), column(2)],
                    translation: column(3),
                };
            }
            self.placed.push(placed);
        }
        let used = (0..).zip(&self.placed).filter(|(_, placed)| placed.live);
        let used = used.map(|(index, _)| index..index + 1).collect();
        self.placed_ranges = taken(header.instances, used, "instances")?;
        Ok(())
    }

    fn read_top(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        let mut top = Top {
            root: header.top_root,
            ..Top::default()
        };
        words.need(header.top_free)?;
        for _ in 0..header.top_free {
            let index = words.one()?;
            words.expect(index < header.top_nodes, "free node")?;
            top.free.push(index);
        }
        words.need(header.opened)?;
        let mut places = Vec::new();
        for _ in 0..header.opened {
            let [instance, first] = words.array()?;
            words.expect(instance < header.instances, "instance that may be opened")?;
            if first != INVALID {
                let is_within = u64::from(first) + W as u64 <= u64::from(header.parts);
                words.expect(is_within, "parts of an instance")?;
                places.push(first..first + W as u32);
            }
            let own = Opened {
                first,
                parts: Vec::new(),
            };
            let known = top.opened.insert(instance, own);
            words.expect(known.is_none(), "instance that may be opened")?;
        }
        taken(header.parts, places, "parts")?;
        top.parts = alloc::vec![INVALID; header.parts as usize];
        top.nodes = Vec::with_capacity(words.need(header.top_nodes)?);
        let mut free = alloc::vec![false; header.top_nodes as usize];
        top.free.iter().for_each(|&node| free[node as usize] = true);
        for is_free in free {
            let used = words.one()?;
            words.expect(used == u32::from(!is_free), "whether a node is in use")?;
            let mut shape = Shape::default();
            if is_free {
                top.nodes.push(M::Node::EMPTY);
            } else {
                shape.half = words.array()?.map(f32::from_bits);
                shape.from = words.array()?.map(f32::from_bits);
                shape.height = 1;
                top.nodes.push(read_node(words)?);
            }
            top.shapes.push(shape);
        }
        top.above = alloc::vec![INVALID; top.nodes.len()];
        self.top = top;
        Ok(())
    }

    fn read_lights(&mut self, words: &mut Words<'_>, header: &Header) -> Result<(), ReadError> {
        self.lights = alloc::vec![M::Light::DARK; words.need(header.lights)?];
        for (index, mesh) in (0..).zip(&self.meshes) {
            for light in &mut self.lights[mesh.lights.start as usize..mesh.lights.end as usize] {
                *light = light.of_mesh(index);
            }
        }
        for (index, light) in (0..).zip(&mut self.lights) {
            let mesh = light.mesh();
            if mesh == INVALID {
                let gap = words.one()?;
                words.expect(gap == 0, "place of no light")?;
                continue;
            }
            for (place, word) in bytemuck::cast_slice_mut::<_, u32>(core::slice::from_mut(light))
                .iter_mut()
                .enumerate()
            {
                if place != M::Light::MESH_WORD {
                    *word = words.one()?;
                }
            }
            let checked = light.checked();
            *light = checked.map_err(|error| damaged(format_args!("light {index}: {error}")))?;
        }
        for mesh in &mut self.meshes {
            let range = mesh.lights.start as usize..mesh.lights.end as usize;
            mesh.reach = reach_of(&self.lights[range.clone()]);
            mesh.is_by_area = is_by_area(&self.lights[range]);
        }
        for (instance, placed) in (0..).zip(&self.placed).filter(|(_, placed)| placed.live) {
            let checked = placed.transform.check(self.meshes[placed.mesh as usize].reach);
            checked
                .map_err(EditReason::Transform)
                .and_then(|()| factor(placed.radiance))
                .map_err(|reason| damaged(format_args!("instance {instance}: {reason}")))?;
        }
        Ok(())
    }
}

/// A node with kinds and links.
fn read_node<N: Node<W>, const W: usize>(words: &mut Words<'_>) -> Result<N, ReadError> {
    let kinds = words.one()?;
    words.expect(
        kinds.checked_shr(2 * W as u32).unwrap_or(0) == 0,
        "kinds of a node",
    )?;
    let mut node = N::EMPTY;
    for slot in 0..W {
        let to = (kinds >> (2 * slot)) & 3;
        if to != kind::EMPTY {
            node.set_child(slot, to, words.one()?);
        }
    }
    Ok(node)
}
