//! Frames of moving lights on a device, and the copies that they are made of.

use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightBvh, MeshId, ShadingPoint, Transform};
use lightbvh_host::backend::{Backend, CpuBackend, DeviceBackend, Follow, node_words, nodes_in_use};
use lightbvh_host::vulkan::{Device, Options, Pass};
use lightbvh_kernels::bvh::Standard;
use lightbvh_kernels::query::Query;
use lightbvh_kernels::scatter::{LANES, Run, ScatterPush};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::small_triangles;

type OnDevice<'d> = DeviceBackend<'d, Standard, 8>;

pub(super) fn lamp(seed: u32) -> Vec<EmissiveTriangle> {
    small_triangles(3, 3, 1.0, 0.4, false, seed)
}

fn place(k: u32, time: u32) -> Transform {
    let at = |n: u32| (k.wrapping_mul(n) % 101) as f32 + 0.01 * time as f32;
    Transform::at([at(7), at(31), at(59)])
}

/// `count` lamps of two meshes.
pub(super) fn world(count: u32) -> (LightBvh, [MeshId; 2], Vec<InstanceId>) {
    let mut bvh = LightBvh::default();
    let meshes = [1, 2].map(|seed| bvh.add_mesh(lamp(seed)).expect("within the domain"));
    let add = (0..count).map(|k| Edit::AddInstance {
        mesh: meshes[k as usize % 2],
        transform: place(k, 0),
        radiance: 1.0,
    });
    let ids = bvh.apply(add.collect()).expect("within the domain").instances;
    bvh.refit();
    (bvh, meshes, ids)
}

/// Every `stride`-th lamp takes a step.
pub(super) fn step(bvh: &mut LightBvh, ids: &[InstanceId], stride: usize, time: u32) {
    let moved = (0..).zip(ids).step_by(stride);
    let edits = moved.map(|(k, &instance)| Edit::SetTransform {
        instance,
        transform: place(k, time),
    });
    bvh.apply(edits.collect()).expect("within the domain");
}

pub(super) fn queries(count: u32) -> Vec<Query> {
    (0..count)
        .map(|k| Query {
            point: ShadingPoint {
                p: [(k % 97) as f32, (k % 89) as f32, (k % 83) as f32],
                n: [0.0, 1.0, 0.0],
            },
            words: [k.wrapping_mul(0x9e37_79b9), k],
        })
        .collect()
}

/// Compares the nodes in use, and samples.
pub(super) fn assert_follows(what: &str, bvh: &LightBvh, backend: &mut OnDevice<'_>) {
    let asked = queries(300);
    let mut cpu = CpuBackend::<Standard, 8>::new(bvh.clone());
    let found = backend.sample(&asked).expect("samples").value;
    assert!(
        found == cpu.sample(&asked).expect("samples").value,
        "{what}: samples"
    );
    let found = backend.nodes().expect("nodes");
    let (expected, words) = (node_words(bvh), size_of_val(&bvh.nodes()[0]) / 4);
    for node in nodes_in_use(bvh) {
        let at = node as usize * words..(node as usize + 1) * words;
        assert!(found[at.clone()] == expected[at], "{what}: node {node}");
    }
}

/// With and without staging buffers.
fn on_each(test: impl Fn(&Device)) {
    for force_staging in [false, true] {
        on_each_device(
            Options {
                force_staging,
                ..Options::default()
            },
            &test,
        );
    }
}

#[test]
fn frames_that_move_grow_and_shrink_are_followed() {
    on_each(|device| {
        let (mut bvh, meshes, mut ids) = world(300);
        let mut backend = OnDevice::new(device, &bvh).expect("an upload");
        for time in 1..30 {
            // Fewer and more, moved too, beyond the room of every array.
            if time % 3 == 0 {
                let gone = ids.remove(time as usize);
                bvh.remove_instance(gone).expect("there");
            } else {
                for k in 0..20 {
                    let new = bvh.add_instance(meshes[1], place(1_000 * time + k, time));
                    ids.push(new.expect("a place"));
                }
            }
            step(&mut bvh, &ids, 7, time);
            bvh.refit();
            backend.follow(&bvh).expect("a frame");
            assert_follows(&format!("{} frame {time}", device.name()), &bvh, &mut backend);
        }
    });
}

/// More bytes than a staging buffer has, in two parts, the later one first.
#[test]
fn parts_of_a_write_arrive_and_nothing_else_changes() {
    on_each(|device| {
        let words = super::values((33 << 20) / 4 + 5);
        let buffer = device.output::<u32>(words.len() + 10).expect("a buffer");
        let (first, second) = words.split_at(words.len() / 2);
        let parts = [(first.len() + 9, second), (1, first)];
        buffer.write(&parts).expect("within");
        let found = buffer.read().expect("a read");
        let gap = [lightbvh_host::vulkan::UNWRITTEN; 8];
        let expected = [&gap[..1], first, &gap, second, &gap[..1]].concat();
        assert!(found == expected, "{}", device.name());
    });
}

/// The kernel that engines put many short regions in their places by.
#[test]
fn scattered_runs_arrive_and_nothing_else_changes() {
    on_each(|device| {
        let kernel = device.kernel("scatter").expect("a kernel");
        let lengths = [1, 2, 15, 16, 17, 100, 1023, 1024, 1025, 5000];
        let count: u32 = lengths.iter().map(|length| length + 1).sum();
        let mut staged = super::values(count);
        let mut expected = vec![7_u32; count as usize + 1];
        let target = device.upload(&expected).expect("an upload");
        let (mut at, mut runs) = (1, Vec::new());
        for length in lengths {
            let (from, to) = (at as usize - 1, at as usize);
            let words = length as usize;
            expected[to..to + words].copy_from_slice(&staged[from..from + words]);
            runs.push(Run {
                from: at - 1,
                to: at,
                words: length,
            });
            at += length + 1;
        }
        let push = ScatterPush {
            runs: runs.len() as u32,
            list: staged.len() as u32,
            first: 0,
        };
        staged.extend_from_slice(bytemuck::cast_slice(&runs));
        let staging = device.upload(&staged).expect("an upload");
        let mut pass = Pass::new();
        let buffers = [staging.bind(), target.bind()];
        pass.dispatch(&kernel, &buffers, bytemuck::bytes_of(&push), push.runs * LANES);
        device.run(&pass).expect("a run");
        assert!(target.read().expect("a read") == expected, "{}", device.name());
    });
}
