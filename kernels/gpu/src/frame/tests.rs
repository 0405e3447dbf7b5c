//! A device made of plain arrays follows a scene by frames alone.

use alloc::vec;
use alloc::vec::Vec;

use bytemuck::{cast_slice, cast_slice_mut};
use lightbvh::importance::ImportanceModel;
use lightbvh::light::{AnyLight, BoxLight, PointLight, SphereLight};
use lightbvh::node::{Lit, Node, SpotMomentNode};
use lightbvh::refit::{self, BlasRoot, Child, LIMITED_ROWS, PLAIN_ROWS};
use lightbvh::summary::Summary;
use lightbvh::{
    Bvh, CompactNode, Edit, EmissiveTriangle, Instance, LightTree, MomentNode, Random64, ShadingPoint,
    Transform,
};

use super::*;
use crate::refit::Pass;

/// What a device would hold, as words.
#[derive(Default)]
struct Device {
    mirror: Mirror,
    buffers: [Vec<u32>; Buffer::ALL.len()],
}

/// Puts a child where a kernel does.
fn put<N: Node<W>, const W: usize>(child: &Child<N::Summary>, children: &mut [u32], place: u32, slot: usize) {
    if refit::child_rows::<N, W>() == LIMITED_ROWS {
        child.put::<W, LIMITED_ROWS>(cast_slice_mut(children), place, slot);
    } else {
        child.put::<W, PLAIN_ROWS>(cast_slice_mut(children), place, slot);
    }
}

/// The copies of the buffers after this one.
fn regions_after(frame: &Frame, number: usize) -> Vec<(Buffer, Vec<Region>)> {
    frame.regions(0).split_off(number + 1)
}

impl Device {
    fn buffer(&self, buffer: Buffer) -> &[u32] {
        &self.buffers[buffer as usize]
    }

    fn follow<N: Node<W>, const W: usize>(&mut self, scene: &Bvh<N, (), W>) -> Frame {
        let frame = self.mirror.frame(scene);
        for &(buffer, bytes) in &frame.resizes {
            // New memory holds anything.
            self.buffers[buffer as usize].resize(bytes as usize / 4, 0xdead_beef);
        }
        // By way of a staging buffer.
        let start = 12;
        let mut staging = vec![0xcc_u8; start];
        for copy in &frame.copies {
            staging.extend(copy.source(scene));
        }
        assert_eq!(staging.len() as u64, start as u64 + frame.staged_bytes());
        let regions = frame.regions(start as u64);
        for (number, (buffer, regions)) in regions.iter().enumerate() {
            let to: &mut [u8] = cast_slice_mut(&mut self.buffers[*buffer as usize]);
            for region in regions {
                let Region { from, to: at, bytes } = region;
                assert_eq!(
                    region.run().map(|words| u64::from(words) * 4),
                    [*from, *at, *bytes]
                );
                let [from, at, bytes] = [from, at, bytes].map(|byte| *byte as usize);
                to[at..at + bytes].copy_from_slice(&staging[from..from + bytes]);
            }
            let is_same = |(other, _): &(Buffer, Vec<Region>)| other == buffer;
            assert!(!regions.is_empty() && !regions_after(&frame, number).iter().any(is_same));
        }
        let mut children = vec![0xdead_beef; frame.refit.children as usize / 4];
        for dispatch in &frame.refit.dispatches {
            let [first, count, top] = dispatch.push();
            for i in 0..count {
                let list = &frame.refit.list[first as usize..];
                self.compute::<N, W>(dispatch.pass, list, i, top, &mut children);
            }
        }
        frame
    }

    /// Invocation `i` of a dispatch over `list`.
    fn compute<N: Node<W>, const W: usize>(
        &mut self,
        pass: Pass,
        list: &[u32],
        i: u32,
        top: u32,
        children: &mut [u32],
    ) {
        let (place, slot) = match pass {
            Pass::Bottom | Pass::Top => (i / W as u32, i as usize % W),
            Pass::Roots | Pass::Nodes => (i, 0),
        };
        let entry = list[place as usize];
        let nodes: &[N] = cast_slice(self.buffer(Buffer::Nodes));
        let roots: &[BlasRoot] = cast_slice(self.buffer(Buffer::Roots));
        let triangles: &[N::Light] = cast_slice(self.buffer(Buffer::Triangles));
        let instances: &[Instance] = cast_slice(self.buffer(Buffer::Instances));
        let at = entry as usize;
        match pass {
            Pass::Bottom => {
                let child = refit::bottom_child::<N, W>(nodes, triangles, entry, slot);
                put::<N, W>(&child, children, place, slot);
            }
            Pass::Roots => {
                let root = refit::root::<N, W>(nodes, roots[at].node);
                cast_slice_mut::<u32, BlasRoot>(&mut self.buffers[Buffer::Roots as usize])[at] = root;
            }
            Pass::Top => {
                let child = refit::top_child::<N, W>(nodes, top, instances, roots, entry, slot);
                put::<N, W>(&child, children, place, slot);
            }
            Pass::Nodes => {
                let node = if refit::child_rows::<N, W>() == LIMITED_ROWS {
                    refit::assembled::<N, W, LIMITED_ROWS>(nodes, entry, cast_slice(children), place)
                } else {
                    refit::assembled::<N, W, PLAIN_ROWS>(nodes, entry, cast_slice(children), place)
                };
                cast_slice_mut::<u32, N>(&mut self.buffers[Buffer::Nodes as usize])[at] = node;
            }
        }
    }

    /// Checks that words in use are bit-identical, and walks too.
    fn assert_is<N: Node<W>, const W: usize>(&self, scene: &Bvh<N, (), W>, frame: impl core::fmt::Display) {
        let used = scene.plan_of_everything();
        let top = self.mirror.top::<N>();
        let nodes: &[N] = cast_slice(self.buffer(Buffer::Nodes));
        for (&index, base, own) in used
            .bottom
            .nodes()
            .iter()
            .map(|index| (index, 0, scene.nodes()))
            .chain(
                used.top
                    .nodes()
                    .iter()
                    .map(|index| (index, top, scene.top_nodes())),
            )
        {
            let (found, expected) = (&nodes[(index + base) as usize], &own[index as usize]);
            let same = bytemuck::bytes_of(found) == bytemuck::bytes_of(expected);
            assert!(same, "frame {frame}: node {index}, {base}");
        }
        let roots: &[BlasRoot] = cast_slice(self.buffer(Buffer::Roots));
        for &index in &used.roots {
            assert_eq!(
                roots[index as usize],
                scene.roots()[index as usize],
                "frame {frame}"
            );
        }
        let instances: &[Instance] = cast_slice(self.buffer(Buffer::Instances));
        let triangles: &[u32] = cast_slice(scene.triangles());
        assert!(instances.starts_with(scene.instances()), "frame {frame}");
        let held = self.buffer(Buffer::Triangles);
        assert!(held.starts_with(triangles), "frame {frame}");
        let trails = self.buffer(Buffer::Trails);
        let there: LightTree<'_, N, Choice, W> = self.mirror.words(scene).tree(nodes, instances, trails);
        let here = scene.by::<Choice>();
        for k in 0..16_u32 {
            let point = ShadingPoint {
                p: [(k % 4) as f32 * 3.0, -1.0, (k / 4) as f32 * 3.0],
                n: [0.0, 1.0, 0.0],
            };
            let number = Random64::from(lightbvh::exact::hash(k));
            let [a, b] = [here.sample(&point, number), there.sample(&point, number)];
            assert_eq!(a, b, "frame {frame}");
            let pmf = there.pmf(&point, a.light, a.instance);
            assert_eq!(a.pmf.to_bits(), pmf.to_bits(), "frame {frame}");
        }
    }
}

/// Children are chosen by flux alone, in any layout, and one light in four by its path.
#[derive(Clone, Copy)]
struct Choice;

impl<N: Node<W>, const W: usize> ImportanceModel<N, W> for Choice {
    const UNIFORM_HALVINGS: u32 = 2;

    fn weights_in(node: &N, _: &ShadingPoint, _: f32) -> [f32; W] {
        core::array::from_fn(|slot| node.summary(slot).phi())
    }
}

/// A light for the meshes here.
trait Lamp: Sized {
    fn numbered(number: u32) -> Self;
}

impl Lamp for EmissiveTriangle {
    fn numbered(number: u32) -> Self {
        let number = number as f32;
        let p = [number % 13.0, number % 5.0, number % 7.0];
        Self {
            p: [p, [p[0] + 0.5, p[1], p[2]], [p[0], p[1] + 0.5, p[2] + 0.1]],
            radiance: [1.0 + number % 3.0, 1.0, 1.0],
            mesh: 0,
            flags: 0,
        }
    }
}

impl Lamp for AnyLight {
    fn numbered(number: u32) -> Self {
        let triangle = EmissiveTriangle::numbered(number);
        let (p, shine, mesh) = (triangle.p[0], triangle.radiance, 0);
        let size = 0.1 + 0.01 * p[0];
        match number % 4 {
            0 => triangle.into(),
            1 => PointLight {
                p,
                intensity: shine,
                range: 0.0,
                mesh,
            }
            .into(),
            2 => SphereLight {
                p,
                radius: size,
                radiance: shine,
                mesh,
            }
            .into(),
            _ => BoxLight {
                p,
                half: [[size, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.1, size]],
                radiance: shine,
                mesh,
            }
            .into(),
        }
    }
}

fn mesh<L: Lamp>(count: u32, seed: u32) -> Vec<L> {
    (0..count).map(|i| L::numbered(i * 7 + seed)).collect()
}

/// A frame of edits of each kind; meshes and instances come and go, so that every buffer grows.
fn edit<N: Node<W>, const W: usize>(
    scene: &mut Bvh<N, (), W>,
    ids: &mut (Vec<lightbvh::MeshId>, Vec<lightbvh::InstanceId>),
    frame: u32,
) where
    N::Light: Lamp,
{
    let transform = Transform::at([frame as f32, 1.0, 0.5 * frame as f32]);
    let (meshes, instances) = ids;
    if frame.is_multiple_of(3) {
        let triangles = mesh(20 + 5 * frame, frame);
        meshes.extend(scene.apply(vec![Edit::AddMesh { triangles }]).unwrap().meshes);
        let mesh = *meshes.last().unwrap();
        let add = Edit::AddInstance {
            mesh,
            transform,
            radiance: 1.0,
        };
        instances.extend(scene.apply(vec![add.clone(), add]).unwrap().instances);
    }
    let mut edits = vec![Edit::SetTransform {
        instance: instances[frame as usize % instances.len()],
        transform,
    }];
    if frame % 4 == 1 {
        edits.push(Edit::SetTriangles {
            mesh: meshes[0],
            triangles: mesh(20, 100 + frame),
        });
    }
    if frame % 5 == 4 {
        edits.push(Edit::SetRadiance {
            instance: instances[0],
            radiance: 2.0,
        });
    }
    if frame % 7 == 6 {
        edits.push(Edit::RemoveInstance(instances.pop().unwrap()));
    }
    scene.apply(edits).unwrap();
}

/// Two devices, one of which skips frames.
fn follows<N: Node<W>, const W: usize>(rebuilds: bool)
where
    N::Light: Lamp,
{
    let mut scene = Bvh::<N, (), W>::default();
    let (mut devices, mut ids) = (<[Device; 2]>::default(), Default::default());
    for frame in 0..40 {
        edit(&mut scene, &mut ids, frame);
        scene.refit();
        if rebuilds && frame % 3 == 1 {
            scene.rebuild();
        }
        for (device, every) in devices.iter_mut().zip([1, 3]) {
            if frame % every == 0 {
                device.follow(&scene);
                device.assert_is(&scene, frame);
            }
        }
    }
}

#[test]
fn device_follows_edits() {
    follows::<MomentNode<8>, 8>(false);
    follows::<CompactNode<4>, 4>(false);
    follows::<Lit<SpotMomentNode<8>, AnyLight>, 8>(false);
}

#[test]
fn device_follows_rebuilds() {
    follows::<MomentNode<8>, 8>(true);
    follows::<CompactNode<4>, 4>(true);
    follows::<Lit<SpotMomentNode<8>, AnyLight>, 8>(true);
}

#[test]
fn first_frame_copies_everything_and_still_one_nothing() {
    let mut scene = Bvh::<MomentNode<8>, (), 8>::default();
    edit(&mut scene, &mut Default::default(), 0);
    scene.refit();
    let mut device = Device::default();
    let first = device.follow(&scene);
    assert_eq!(first.resizes.len(), Buffer::ALL.len());
    for (buffer, bytes) in first.resizes {
        let own = first.copies.iter().filter(|copy| copy.buffer == buffer);
        let copied: u64 = own.map(|copy| copy.bytes.end - copy.bytes.start).sum();
        assert_eq!(copied, bytes, "{buffer:?}");
    }
    device.assert_is(&scene, 0);
    scene.apply(vec![]).unwrap();
    scene.refit();
    let still = device.follow(&scene);
    assert!(still.copies.is_empty() && still.resizes.is_empty() && still.refit.dispatches.is_empty());
}

#[test]
fn mirror_may_change_to_another_light_bvh() {
    let mut device = Device::default();
    for count in [50, 3, 20] {
        let mut scene = Bvh::<MomentNode<8>, (), 8>::default();
        let mesh = scene.add_mesh(mesh(count, 1)).expect("a mesh");
        scene.add_instance(mesh, Transform::IDENTITY).expect("one");
        scene.refit();
        device.follow(&scene);
        device.assert_is(&scene, count);
    }
}
