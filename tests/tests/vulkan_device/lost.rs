//! A device that is lost in mid-frame: an error that says so, whichever call finds it; another device takes over.
#![cfg(debug_assertions)]

use lightbvh::{Edit, InstanceId, LightBvh, MeshId, ShadingPoint, Transform};
use lightbvh_host::backend::{Backend, BackendError, CpuBackend, DeviceBackend, Follow};
use lightbvh_host::vulkan::{Options, VulkanError};
use lightbvh_kernels::bvh::Triangles;
use lightbvh_kernels::query::Query;
use lightbvh_tests::devices::{devices, open};
use lightbvh_tests::generate::small_triangles;

type OnDevice<'d> = DeviceBackend<'d, Triangles, 8>;

fn place(k: u32, time: u32) -> Transform {
    let at = |n: u32| (k.wrapping_mul(n) % 101) as f32 + 0.01 * time as f32;
    Transform::at([at(7), at(31), at(59)])
}

/// `count` lamps of a mesh.
fn world(count: u32) -> (LightBvh, MeshId, Vec<InstanceId>) {
    let mut bvh = LightBvh::default();
    let lamp = small_triangles(3, 3, 1.0, 0.4, false, 1);
    let mesh = bvh.add_mesh(lamp).expect("within the domain");
    let add = (0..count).map(|k| Edit::AddInstance {
        mesh,
        transform: place(k, 0),
        radiance: [1.0; 3],
        mask: u32::MAX,
    });
    let ids = bvh.apply(add.collect()).expect("within the domain").instances;
    bvh.refit();
    (bvh, mesh, ids)
}

/// Every `stride`-th lamp takes a step.
fn step(bvh: &mut LightBvh, ids: &[InstanceId], stride: usize, time: u32) {
    for (k, &instance) in (0..).zip(ids).step_by(stride) {
        bvh.set_transform(instance, place(k, time))
            .expect("within the domain");
    }
    bvh.refit();
}

fn queries(count: u32) -> Vec<Query> {
    let at = |k: u32| [k % 97, k % 89, k % 83].map(|x| x as f32);
    (0..count)
        .map(|k| Query {
            point: ShadingPoint {
                p: at(k),
                n: [0.0, 1.0, 0.0],
            },
            words: [k.wrapping_mul(0x9e37_79b9), k],
        })
        .collect()
}

/// Compares samples, which have the bits of the nodes in them.
fn assert_follows(what: &str, bvh: &LightBvh, backend: &mut OnDevice<'_>) {
    let asked = queries(1000);
    let expected = CpuBackend::<Triangles, 8>::new(bvh.clone()).sample(&asked);
    let found = backend.sample(&asked).expect("samples").value;
    assert!(found == expected.expect("samples").value, "{what}");
}

#[test]
fn where_a_device_is_lost_another_takes_over() {
    let options = Options::default();
    // The calls are the host's: one device shows them all.
    let list = devices();
    let Some(info) = list.devices.first() else { return };
    // Opened once, for a device compiles its kernels anew.
    let (lost, second) = (open(info, options), open(info, options));
    let mut found_in = std::collections::BTreeSet::new();
    // In each call that may find it, one after the other, until a frame has no more of them.
    for calls in 0.. {
        lost.lose_after(u32::MAX);
        let (mut bvh, mesh, mut ids) = world(60);
        let mut backend = OnDevice::new(&lost, &bvh).expect("an upload");
        backend.sample(&queries(1)).expect("a sample");
        lost.lose_after(calls);
        ids.push(bvh.add_instance(mesh, Transform::IDENTITY).expect("a place"));
        step(&mut bvh, &ids, 4, 1);
        let result = backend.follow(&bvh).and_then(|_| backend.sample(&queries(50)));
        let what = format!("{}, lost after {calls} calls", info.probe.name);
        let Err(error) = result else {
            assert!(calls > 1, "{what}: the seam is not there");
            break;
        };
        match error {
            BackendError::Vulkan(VulkanError::DeviceLost { call, .. }) => found_in.insert(call),
            other => panic!("{what}: {other}"),
        };
        // It stays lost, and says so.
        let again = backend.sample(&queries(1)).expect_err("lost");
        assert!(
            matches!(again, BackendError::Vulkan(VulkanError::DeviceLost { .. })),
            "{what}: {again}"
        );

        // Another device continues, from the frame that the lost device never did.
        let mut heir = OnDevice::new(&second, &bvh).expect("an upload of everything");
        assert_follows(&what, &bvh, &mut heir);
        step(&mut bvh, &ids, 3, 2);
        heir.follow(&bvh).expect("a frame");
        assert_follows(&what, &bvh, &mut heir);
    }
    for call in ["vkQueueSubmit", "vkWaitForFences", "vkGetQueryPoolResults"] {
        assert!(found_in.contains(call), "{}: {found_in:?}", info.probe.name);
    }
    for device in [lost, second] {
        device.close().expect("a clean tear-down");
    }
}
