//! A device made of plain arrays follows a scene by frames alone.

use alloc::vec;
use alloc::vec::Vec;

use bytemuck::{cast_slice, cast_slice_mut};
use lightbvh::importance::Flux;
use lightbvh::refit::{self, BlasRoot};
use lightbvh::{
    Bvh, CompactNode, Defensive, Edit, EmissiveTriangle, Instance, LightNode, LightTree, MomentNode,
    Random64, ShadingPoint, Transform,
};

use super::*;
use crate::refit::Pass;

/// Children are chosen by flux alone, and one light in four by its path.
type Choice = Defensive<Flux, 2>;

/// What a device would hold, as words.
#[derive(Default)]
struct Device {
    mirror: Mirror,
    buffers: [Vec<u32>; Buffer::ALL.len()],
}

impl Device {
    fn buffer(&self, buffer: Buffer) -> &[u32] {
        &self.buffers[buffer as usize]
    }

    fn follow<N: LightNode<W>, const W: usize>(&mut self, scene: &Bvh<N, (), W>) -> Frame {
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
        let all = frame.regions(start as u64);
        for (number, (buffer, regions)) in all.iter().enumerate() {
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
            assert!(!regions.is_empty() && !all[number + 1..].iter().any(is_same));
        }
        let mut level = Pass::Bottom;
        for dispatch in &frame.refit.dispatches {
            let [first, count, top] = dispatch.push().map(|word| word as usize);
            match dispatch.pass {
                // Children are computed with their nodes here.
                Pass::Bottom | Pass::Top => level = dispatch.pass,
                Pass::Roots | Pass::Nodes => {
                    for &entry in &frame.refit.list[first..first + count] {
                        self.compute::<N, W>(dispatch.pass, level, entry, top as u32);
                    }
                }
            }
        }
        frame
    }

    /// A root, or a node of a level of `level`.
    fn compute<N: LightNode<W>, const W: usize>(&mut self, pass: Pass, level: Pass, entry: u32, top: u32) {
        let nodes: &[N] = cast_slice(self.buffer(Buffer::Nodes));
        let roots: &[BlasRoot] = cast_slice(self.buffer(Buffer::Roots));
        let at = entry as usize;
        if pass == Pass::Roots {
            let root = refit::root::<N, W>(nodes, roots[at].node);
            cast_slice_mut::<u32, BlasRoot>(&mut self.buffers[Buffer::Roots as usize])[at] = root;
            return;
        }
        let node = match level {
            Pass::Top => {
                let instances: &[Instance] = cast_slice(self.buffer(Buffer::Instances));
                refit::top(nodes, top, instances, roots, entry)
            }
            _ => refit::bottom(nodes, cast_slice(self.buffer(Buffer::Triangles)), entry),
        };
        cast_slice_mut::<u32, N>(&mut self.buffers[Buffer::Nodes as usize])[at] = node;
    }

    /// Checks that words in use are bit-identical, and walks too.
    fn assert_is<N: LightNode<W>, const W: usize>(
        &self,
        scene: &Bvh<N, (), W>,
        frame: impl core::fmt::Display,
    ) {
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

fn mesh(count: u32, seed: u32) -> Vec<EmissiveTriangle> {
    let lamp = |i: u32| {
        let number = (i * 7 + seed) as f32;
        let p = [number % 13.0, number % 5.0, number % 7.0];
        EmissiveTriangle {
            p: [p, [p[0] + 0.5, p[1], p[2]], [p[0], p[1] + 0.5, p[2] + 0.1]],
            radiance: [1.0 + number % 3.0, 1.0, 1.0],
            mesh: 0,
            flags: 0,
        }
    };
    (0..count).map(lamp).collect()
}

/// A frame of edits of each kind; meshes and instances come and go, so that every buffer grows.
fn edit<N: LightNode<W>, const W: usize>(
    scene: &mut Bvh<N, (), W>,
    ids: &mut (Vec<lightbvh::MeshId>, Vec<lightbvh::InstanceId>),
    frame: u32,
) {
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
fn follows<N: LightNode<W>, const W: usize>(rebuilds: bool) {
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
}

#[test]
fn device_follows_rebuilds() {
    follows::<MomentNode<8>, 8>(true);
    follows::<CompactNode<4>, 4>(true);
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
