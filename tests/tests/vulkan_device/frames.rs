//! What a frame of moving lights costs a device: submissions, waits, regions and bytes, counted; and its words.

use lightbvh::bvh::Cursor;
use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightBvh, MeshId, ShadingPoint, Transform};
use lightbvh_host::backend::{Backend, CpuBackend, DeviceBackend, Follow, node_words, nodes_in_use};
use lightbvh_host::vulkan::{Counts, Device, Options, Pass, VulkanError};
use lightbvh_kernels::bvh::Standard;
use lightbvh_kernels::query::Query;
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

fn counted(device: &Device, work: impl FnOnce()) -> Counts {
    let before = device.counts();
    work();
    device.counts() - before
}

/// With and without staging buffers for what is read: what a frame does is the same.
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
fn a_frame_is_one_submission_without_a_wait_whatever_moves() {
    on_each(|device| {
        let (mut bvh, _, ids) = world(6_000);
        let mut backend = OnDevice::new(device, &bvh).expect("an upload");
        let mut cursor = Cursor::default();
        assert!(bvh.plan(&mut cursor).everything);
        // The first frame grows the ring and the list.
        for (time, stride) in (1..).zip([3, 6_000, 60, 3, 1]) {
            let moved = 6_000_u64.div_ceil(stride as u64);
            step(&mut bvh, &ids, stride, time);
            bvh.refit();
            let refitted = bvh.plan(&mut cursor).computed() as u64;
            let counts = counted(device, || {
                backend.follow_ahead(&bvh).expect("a frame");
                backend.flush().expect("a submission");
            });
            let what = format!("{}, {moved} moved: {counts:?}", device.name());
            assert_eq!(counts.submissions, 1, "{what}");
            assert_eq!(counts.waits, 0, "{what}");
            // One for each lamp and one for the list; those that are neighbours are one. Many go by a dispatch, with an entry each.
            let parts = if stride == 1 { 1 } else { moved };
            let (regions, runs) = if parts > 16 { (1, parts) } else { (parts + 1, 0) };
            assert_eq!((counts.regions, counts.runs), (regions, runs), "{what}");
            let record = size_of::<lightbvh::Instance>() as u64;
            assert_eq!(counts.bytes, moved * record + 4 * refitted + 12 * runs, "{what}");
            assert!(time == 1 || counts.buffers == 0 || stride == 1, "{what}");
            assert_follows(&what, &bvh, &mut backend);
        }
        let idle = counted(device, || {
            backend.follow(&bvh).expect("nothing to do");
        });
        assert_eq!(idle, Counts::default(), "{}: nothing changed", device.name());
    });
}

#[test]
fn what_is_asked_next_goes_with_the_frame() {
    on_each(|device| {
        let (mut bvh, _, ids) = world(500);
        let mut backend = OnDevice::new(device, &bvh).expect("an upload");
        let asked = queries(200);
        for time in 1..4 {
            step(&mut bvh, &ids, 5, time);
            bvh.refit();
            let mut found = Vec::new();
            let counts = counted(device, || {
                backend.follow_ahead(&bvh).expect("a frame");
                found = backend.sample(&asked).expect("samples").value;
            });
            // What is read from memory that the host does not reach is a copy more, the caller's.
            let reads = u64::from(!device.probe().unified_memory || counts.submissions > 1);
            let what = format!("{}: {counts:?}", device.name());
            assert_eq!(counts.submissions, 1 + reads, "{what}");
            assert!(counts.waits <= 1, "{what}");
            let mut cpu = CpuBackend::<Standard, 8>::new(bvh.clone());
            assert!(found == cpu.sample(&asked).expect("samples").value, "{what}");
        }
    });
}

#[test]
fn frames_that_grow_copy_what_is_new_and_carry_the_rest() {
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
            let counts = counted(device, || backend.follow_ahead(&bvh).expect("a frame"));
            let what = format!("{} frame {time}: {counts:?}", device.name());
            assert_eq!(counts.waits, 0, "{what}");
            if time % 2 > 0 {
                continue; // The next frame submits it.
            }
            assert_follows(&what, &bvh, &mut backend);
        }
    });
}

#[test]
fn frames_larger_than_what_is_kept_are_submitted_at_once() {
    on_each(|device| {
        let (mut bvh, _, ids) = world(30_000);
        let mut backend = OnDevice::new(device, &bvh).expect("an upload");
        step(&mut bvh, &ids, 1, 1);
        bvh.refit();
        let counts = counted(device, || backend.follow_ahead(&bvh).expect("a frame"));
        assert!(counts.bytes > 1 << 20, "{}: {counts:?}", device.name());
        assert_eq!(
            (counts.submissions, counts.waits),
            (1, 0),
            "{}: {counts:?}",
            device.name()
        );
        assert_follows(device.name(), &bvh, &mut backend);
    });
}

#[test]
fn passes_that_write_more_than_the_ring_holds_are_whole() {
    on_each(|device| {
        let words = super::values((70 << 20) / 4 + 5);
        let buffer = device.buffer::<u32>(words.len(), 0).expect("a buffer");
        let mut pass = Pass::new();
        // In two parts, the later one first.
        let half = words.len() / 2;
        pass.write(&buffer, half, &words[half..]).expect("within");
        pass.write(&buffer, 0, &words[..half]).expect("within");
        let counts = counted(device, || {
            device.submit(&pass).expect("a submission");
        });
        let what = format!("{}: {counts:?}", device.name());
        assert_eq!(counts.bytes, words.len() as u64 * 4, "{what}");
        // 70 MiB in parts of 16 MiB, each one region.
        assert_eq!((counts.submissions, counts.regions), (5, 5), "{what}");
        assert!(buffer.read().expect("a read") == words, "{what}");
    });
}

/// Runs of any length between each other, into two buffers, in two orders: what is short goes by a dispatch where it is much,
/// all arrives, nothing else changes.
#[test]
fn short_runs_and_long_ones_arrive() {
    on_each(|device| {
        let lengths = [1, 2, 15, 16, 17, 100, 1023, 1024, 1025, 5000];
        for (turns, is_much) in [(1, false), (3, true)] {
            let count: usize = turns * lengths.iter().map(|length| length + 1).sum::<usize>();
            let words = super::values(count as u32);
            let held = vec![7_u32; count + 1];
            let buffers = [(); 2].map(|()| device.upload(&held).expect("an upload"));
            let (mut pass, mut expected) = (Pass::new(), held.clone());
            let mut first = 1;
            let mut runs: Vec<_> = lengths
                .iter()
                .cycle()
                .take(turns * lengths.len())
                .map(|&length| {
                    let run = first..first + length;
                    first += length + 1;
                    run
                })
                .collect();
            for run in &runs {
                expected[run.clone()].copy_from_slice(&words[run.start - 1..run.end - 1]);
            }
            for buffer in &buffers {
                for run in &runs {
                    pass.write(buffer, run.start, &words[run.start - 1..run.end - 1])
                        .expect("within");
                }
                runs.reverse();
            }
            let counts = counted(device, || {
                device.run(&pass).expect("a run");
            });
            let what = format!("{}: {counts:?}", device.name());
            let long = 2 * turns as u64 * 2;
            let short = 2 * turns as u64 * 8;
            let expected_counts = if is_much { (long, short) } else { (long + short, 0) };
            assert_eq!((counts.regions, counts.runs), expected_counts, "{what}");
            for buffer in &buffers {
                assert!(buffer.read().expect("a read") == expected, "{what}");
            }
        }
    });
}

#[test]
fn neighbours_are_one_region_and_overlaps_are_refused() {
    on_each(|device| {
        let buffer = device.output::<u32>(100).expect("a buffer");
        let mut pass = Pass::new();
        let parts = [40, 20, 30, 70].map(|first| (first, [first as u32; 10]));
        for (first, data) in &parts {
            pass.write(&buffer, *first, data).expect("within");
        }
        let counts = counted(device, || {
            device.run(&pass).expect("a run");
        });
        assert_eq!((counts.regions, counts.bytes), (2, 160), "{}", device.name());
        let found = buffer.read().expect("a read");
        for (at, word) in found.iter().enumerate() {
            let expected = match at {
                20..50 | 70..80 => at as u32 / 10 * 10,
                _ => lightbvh_host::vulkan::UNWRITTEN,
            };
            assert_eq!(*word, expected, "{} {at}", device.name());
        }
        pass.write(&buffer, 75, &[1, 2]).expect("within");
        let refused = device.run(&pass).expect_err("written twice");
        assert!(
            matches!(
                refused,
                VulkanError::OverlappingWrites {
                    first: 300,
                    end: 320,
                    ..
                }
            ),
            "{refused}"
        );
        assert!(matches!(
            pass.write(&buffer, 99, &[1, 2]).map(drop),
            Err(VulkanError::WrongLength {
                given: 101,
                held: 100
            })
        ));
    });
}

#[test]
fn submissions_run_on_while_the_host_goes_on() {
    on_each(|device| {
        let buffer = device.output::<u32>(3).expect("a buffer");
        // Many more than are under way at once, each seeing the one before.
        let values: Vec<[u32; 3]> = (0..200).map(|k| [k, k + 1, k + 2]).collect();
        for value in &values {
            let other = device.buffer::<u32>(3, 0).expect("a buffer");
            let mut pass = Pass::new();
            pass.write(&other, 0, value).expect("within");
            device.submit(&pass).expect("a submission");
            let mut pass = Pass::new();
            pass.carry(&other, &buffer);
            // Both handles are dropped while it may still run.
            device.submit(&pass).expect("a submission");
        }
        assert_eq!(
            buffer.read().expect("a read"),
            [199, 200, 201],
            "{}",
            device.name()
        );
    });
}
