//! Kernels and frames of devices are those of lightbvh-gpu.

use std::ffi::CStr;
use std::ptr::null_mut;

use lightbvh::light::{AnyLight, PointLight};
use lightbvh::{AnyLights, Transform};
use lightbvh_c::*;
use lightbvh_gpu::{
    DeviceBuffer, FloatControls, KernelSet, MOMENTS, Mirror, Pass, Step, query_push, self_test,
};

fn ok(status: Status) {
    assert_eq!(status, Status::Ok);
}

/// Each kernel has its module, and each of its bindings a buffer.
#[test]
fn kernels_are_those_of_each_model() {
    let (mut count, mut groups) = (0, [0; 3]);
    for (model, set) in (0..).zip([MOMENTS, KernelSet::ANY, KernelSet::LINKED]) {
        let refits = Pass::ALL.map(|pass| set.refit(pass));
        let others = [set.sample, set.pmf, set.light_points, &self_test::SELF_TEST];
        for (which, expected) in (0..).zip(refits.into_iter().chain(others)) {
            // SAFETY: all pointers are good, or null where nothing is written.
            let (kernel, words) = unsafe {
                let mut kernel: CKernel = std::mem::zeroed();
                ok(lightbvh_kernel_of(model, which, &mut kernel));
                ok(lightbvh_kernel_words(model, which, 2, null_mut(), 0, &mut count));
                let mut words = vec![0; count];
                let module = words.as_mut_ptr();
                ok(lightbvh_kernel_words(model, which, 2, module, count, &mut count));
                (kernel, words)
            };
            let controls = FloatControls {
                rounding_mode_rte_32: true,
                ..FloatControls::default()
            };
            assert_eq!(words, expected.words_for(controls));
            // SAFETY: the last byte of the name is zero.
            let name = unsafe { CStr::from_ptr(kernel.name.as_ptr()) };
            assert_eq!(name.to_str(), Ok(expected.name));
            assert_eq!(kernel.push_bytes, expected.push_constants);
            assert_eq!(kernel.binding_count as usize, expected.bindings.len());
            assert_eq!(expected.workgroup, [64, 1, 1]);
            for (own, binding) in kernel.bindings.iter().zip(expected.bindings) {
                let known = DeviceBuffer::named(binding.name).map(|buffer| buffer as u32);
                assert!(own.buffer <= 11 && known.is_none_or(|buffer| own.buffer == buffer));
                assert_eq!(own.stride, binding.stride);
            }
        }
    }
    // SAFETY: memory of three words.
    ok(unsafe { lightbvh_groups(1000, &mut groups) });
    assert_eq!(groups, [16, 1, 1]);
}

/// The header's numbers of buffers and of bytes are those of Rust.
#[test]
fn header_has_the_numbers_of_rust() {
    let header = include_str!("../include/lightbvh.h");
    for buffer in DeviceBuffer::ALL {
        let line = format!("LIGHTBVH_{} = {}", buffer.name().to_uppercase(), buffer as u32);
        assert!(header.contains(&line), "{line}");
    }
    let line = format!("LIGHTBVH_ANSWERS_BYTES {}\n", self_test::ANSWERS_BYTES);
    assert!(header.contains(&line), "{line}");
}

#[test]
fn self_test_finds_a_wrong_answer() {
    let mut count = 0;
    let answers = vec![0; self_test::ANSWERS_BYTES];
    // SAFETY: all pointers are good, or null where nothing is written.
    unsafe {
        ok(lightbvh_self_test_operands(null_mut(), 0, &mut count));
        assert_eq!(4 * count, self_test::operands().len());
        let found = lightbvh_self_test_check(answers.as_ptr(), answers.len());
        assert_eq!(found, Status::Inexact);
        assert_eq!(lightbvh_self_test_check(answers.as_ptr(), 0), Status::Inexact);
    }
}

/// The steps of frames, word for word; a frame without changes has none.
#[test]
fn frames_have_the_steps_of_rust() {
    let (handle, follower) = (lightbvh_create(1), lightbvh_mirror_create(1));
    let (mut bvh, mut mirror) = (AnyLights::default(), Mirror::default());
    let light = CLight {
        kind: AnyLight::POINT,
        emission: [1.0, 2.0, 3.0],
        ..CLight::default()
    };
    let own = PointLight {
        p: [0.0; 3],
        intensity: [1.0, 2.0, 3.0],
        range: 0.0,
        mesh: 0,
    };
    let mut kinds = [0; 3];
    for k in 0..300_u16 {
        // SAFETY: all pointers are good, and steps and their data are read before the next change.
        unsafe {
            let (mut id, mut frame): (CId, CFrame) = (CId::default(), std::mem::zeroed());
            let place = Transform::at([f32::from(k), 0.0, 0.0]);
            let transform = CTransform {
                columns: place.columns,
                translation: place.translation,
            };
            ok(lightbvh_add_light(handle, &light, &mut id));
            ok(lightbvh_set_transform(handle, id, transform));
            let instance = bvh.add_light(own).unwrap();
            bvh.set_transform(instance, place).unwrap();
            ok(lightbvh_refit(handle));
            bvh.refit();
            ok(lightbvh_mirror_frame(follower, handle, &mut frame));
            let expected = mirror.frame(&bvh);
            assert_eq!(frame.push, query_push(0, expected.words));
            let steps = std::slice::from_raw_parts(frame.steps, frame.count);
            assert_eq!(steps.len(), expected.steps().count());
            for (found, expected) in steps.iter().zip(expected.steps()) {
                let own = match expected {
                    Step::Resize { buffer, bytes } => (0, buffer as u32, 0, bytes, [0; 3], 0),
                    Step::Upload { buffer, at, bytes } => {
                        let data = std::slice::from_raw_parts(found.data.cast::<u8>(), bytes.len());
                        assert_eq!(data, bytes);
                        (1, buffer as u32, at, bytes.len() as u64, [0; 3], 0)
                    }
                    Step::Dispatch { pass, push, count } => (2, pass as u32, 0, 0, push, count),
                };
                let CStep {
                    kind,
                    which,
                    at,
                    bytes,
                    push,
                    count,
                    ..
                } = *found;
                assert_eq!((kind, which, at, bytes, push, count), own);
                kinds[kind as usize] += 1;
            }
            ok(lightbvh_mirror_frame(follower, handle, &mut frame));
            assert_eq!(frame.count, 0);
        }
    }
    assert!(kinds.iter().all(|&count| count > 10), "{kinds:?}");
    // A buffer of the CPU's words has none that differs; without words, all do.
    for buffer in DeviceBuffer::ALL {
        let used = mirror.in_use(&bvh).into_iter().filter(|(own, ..)| *own == buffer);
        let mut held = vec![0; 1 << 20];
        let mut count = 0;
        for (_, at, bytes) in used {
            held[at as usize..][..bytes.len()].copy_from_slice(bytes);
            count += bytes.len() as u64 / 4;
        }
        let compare = |held: &[u8]| {
            let (mut compared, mut different) = (0, 0);
            let (data, bytes, which) = (held.as_ptr(), held.len(), buffer as u32);
            // SAFETY: all pointers are good.
            ok(unsafe {
                lightbvh_mirror_compare(
                    follower,
                    handle,
                    which,
                    data,
                    bytes,
                    &mut compared,
                    &mut different,
                )
            });
            (compared, different)
        };
        assert_eq!(compare(&held), (count, 0));
        assert_eq!(compare(&[]), (count, count));
        assert!(
            count > 0 || buffer as u32 >= DeviceBuffer::Trails as u32,
            "{buffer:?}"
        );
    }
    // SAFETY: they are not used any more.
    unsafe {
        lightbvh_mirror_free(follower);
        lightbvh_free(handle);
    }
}
