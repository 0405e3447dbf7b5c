//! A device that is lost in mid-frame: an error that says so, whichever call finds it; another device takes over.
#![cfg(debug_assertions)]

use lightbvh_host::backend::{Backend, BackendError, DeviceBackend, Follow};
use lightbvh_host::vulkan::{Options, VulkanError};
use lightbvh_kernels::bvh::Standard;
use lightbvh_tests::devices::{devices, open};

use super::frames::{assert_follows, queries, step, world};

type OnDevice<'d> = DeviceBackend<'d, Standard, 8>;

#[test]
fn where_a_device_is_lost_another_takes_over() {
    let options = Options {
        force_staging: true,
        ..Options::default()
    };
    for info in &devices().devices {
        let mut found_in = std::collections::BTreeSet::new();
        // In each call that may find it, one after the other, until a frame has no more of them.
        for calls in 0.. {
            let lost = open(info, options);
            let (mut bvh, meshes, mut ids) = world(60);
            let mut backend = OnDevice::new(&lost, &bvh).expect("an upload");
            backend.sample(&queries(1)).expect("a sample");
            lost.lose_after(calls);
            ids.push(
                bvh.add_instance(meshes[0], lightbvh::Transform::IDENTITY)
                    .expect("a place"),
            );
            step(&mut bvh, &ids, 4, 1);
            bvh.refit();
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
            let second = open(info, options);
            let mut heir = OnDevice::new(&second, &bvh).expect("an upload of everything");
            assert_follows(&what, &bvh, &mut heir);
            step(&mut bvh, &ids, 3, 2);
            bvh.refit();
            heir.follow(&bvh).expect("a frame");
            assert_follows(&what, &bvh, &mut heir);
            drop((backend, heir));
            let closed = lost.close();
            assert!(
                !matches!(closed, Err(VulkanError::Validation { .. })),
                "{what}: {closed:?}"
            );
            second.close().expect("a clean tear-down");
        }
        for call in ["vkQueueSubmit", "vkWaitForFences", "vkGetQueryPoolResults"] {
            assert!(found_in.contains(call), "{}: {found_in:?}", info.probe.name);
        }
    }
}
