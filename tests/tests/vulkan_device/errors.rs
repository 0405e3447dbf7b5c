//! What a device is asked wrongly comes back as an error that says so.

use lightbvh_host::vulkan::{Device, Options, Pass, VulkanError};
use lightbvh_tests::devices::{devices, on_each_device, open};

use super::{Push, scale_index};

#[test]
fn misuse_that_validation_sees_is_an_error() {
    for info in &devices().devices {
        let device = open(info, Options::default());
        // The module claims 64-bit integers, a feature this host never enables.
        let mut words = scale_index();
        words.splice(5..5, [2 << 16 | 17, 11]);
        match device.kernel_from_words("int64", &words) {
            Err(VulkanError::Validation { messages, .. }) => {
                assert!(!messages.is_empty());
                assert!(device.close().is_err(), "what was said is not forgotten");
            }
            other => assert!(
                matches!(
                    Device::open(info, Options { validation: true }),
                    Err(VulkanError::NoValidationLayer)
                ),
                "{}: {other:?}",
                info.probe.name
            ),
        }
    }
}

#[test]
fn corrupt_modules_are_errors() {
    on_each_device(Options::default(), |device| {
        match device.kernel_from_words("corrupt", &scale_index()[..7]) {
            Err(VulkanError::BadModule { source, .. }) => assert_eq!(source.at, 7),
            other => panic!("{}: {other:?}", device.name()),
        }
    });
}

#[test]
fn dispatches_that_do_not_fit_the_kernel_are_errors() {
    on_each_device(Options::default(), |device| {
        let kernel = device
            .kernel_from_words("scale_index", &scale_index())
            .expect("a kernel");
        let input = device.upload(&[1u32, 2, 3]).expect("an upload");
        let output = device.output::<[u32; 2]>(3).expect("an output");
        let push = bytemuck::bytes_of(&Push { count: 3, factor: 1 }).to_vec();
        let refused = |buffers: &[_], push: &[u8], invocations| {
            let mut pass = Pass::new();
            pass.dispatch(&kernel, buffers, push, invocations);
            match device.run(&pass) {
                Err(VulkanError::BadDispatch { what, .. }) => what,
                other => panic!("{}: {other:?}", device.name()),
            }
        };
        let both = [input.bind(), output.bind()];
        assert_eq!(refused(&both[..1], &push, 3), "it takes 2 buffers, 1 were given");
        assert_eq!(
            refused(&both, &push[..4], 3),
            "it takes 8 bytes of push constants, 4 were given"
        );
        let swapped = [output.bind(), input.bind()];
        assert_eq!(
            refused(&swapped, &push, 3),
            "buffer 0 has elements of 8 bytes, not 4"
        );
        assert!(refused(&both, &push, u32::MAX).contains("more than 32 bits"));
    });
}

#[test]
fn objects_of_another_device_are_refused() {
    let list = devices();
    let Some(info) = list.devices.first() else { return };
    let (one, other) = (open(info, Options::default()), open(info, Options::default()));
    let words = scale_index();
    let kernel = one.kernel_from_words("scale_index", &words).expect("a kernel");
    let mut pass = Pass::new();
    pass.dispatch(&kernel, &[], &[], 1);
    assert!(matches!(other.run(&pass), Err(VulkanError::ForeignObject { .. })));
    let kernel = other.kernel_from_words("scale_index", &words).expect("a kernel");
    let input = one.upload(&[1u32]).expect("an upload");
    let output = other.output::<[u32; 2]>(1).expect("an output");
    let mut pass = Pass::new();
    pass.dispatch(&kernel, &[input.bind(), output.bind()], &[0; 8], 1);
    assert!(matches!(other.run(&pass), Err(VulkanError::ForeignObject { .. })));
    let Err(VulkanError::StillHeld { holders: 1, .. }) = one.close() else {
        panic!("a buffer is held")
    };
}

#[test]
fn buffers_over_a_limit_say_so() {
    on_each_device(Options::default(), |device| {
        let words = device.probe().limits.max_storage_buffer_range as usize / 4 + 1;
        match device.output::<u32>(words) {
            Err(VulkanError::BufferTooLarge {
                bytes, limit: named, ..
            }) => {
                assert!(bytes == words as u64 * 4 && bytes > named, "{}", device.name());
            }
            other => panic!("{}: {:?}", device.name(), other.map(|buffer| buffer.len())),
        }
        let buffer = device.upload(&[1u32, 2]).expect("an upload");
        assert!(matches!(
            buffer.write(&[(0, &[1]), (1, &[1, 2])]),
            Err(VulkanError::WrongLength { given: 3, held: 2 })
        ));
    });
}
