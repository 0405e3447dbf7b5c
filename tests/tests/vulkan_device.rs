//! The host's Vulkan side, on every device of the machine and under the validation layer.

use bytemuck::{Pod, Zeroable};
use lightbvh_host::vulkan::{Device, Options, Pass, UNWRITTEN, VulkanError};
use lightbvh_tests::devices::{devices, on_each_device, open};
use std::time::{Duration, Instant};

/// Push constants of the test kernel `scale_index` (tests/data/vulkan).
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Push {
    count: u32,
    factor: u32,
}

/// Items that fill one row of a 2-D dispatch.
const ROW: u32 = 65_535 * 64;

fn scale_index() -> Vec<u32> {
    let bytes = include_bytes!("../data/vulkan/scale_index.spv");
    bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes(word.try_into().expect("four bytes")))
        .collect()
}

/// What `scale_index` computes.
fn expected(input: &[u32], factor: u32) -> Vec<[u32; 2]> {
    (0..)
        .zip(input)
        .map(|(i, value)| [value.wrapping_mul(factor).wrapping_add(i), i])
        .collect()
}

/// Runs `scale_index` over `input` with room for `spare` more results.
fn run(device: &Device, input: &[u32], factor: u32, spare: usize) -> Vec<[u32; 2]> {
    let kernel = device
        .kernel_from_words("scale_index", &scale_index())
        .expect("a kernel");
    let count = u32::try_from(input.len()).expect("a count");
    let buffer = device.upload(input).expect("an upload");
    let output = device.output::<[u32; 2]>(input.len() + spare).expect("an output");
    let mut pass = Pass::new();
    let push = Push { count, factor };
    pass.dispatch(
        &kernel,
        &[buffer.bind(), output.bind()],
        bytemuck::bytes_of(&push),
        count,
    );
    device.run(&pass).expect("a run");
    output.read().expect("the results")
}

fn values(count: u32) -> Vec<u32> {
    (0..count)
        .map(|i| i.wrapping_mul(0x9e37_79b9) ^ (i >> 3))
        .collect()
}

#[test]
fn results_come_back_and_surplus_words_stay_unwritten() {
    for force_staging in [false, true] {
        on_each_device(
            Options {
                force_staging,
                ..Options::default()
            },
            |device| {
                let input = values(1000);
                let output = run(device, &input, 3, 24);
                assert_eq!(output[..1000], expected(&input, 3), "{}", device.name());
                assert_eq!(output[1000..], [[UNWRITTEN; 2]; 24], "{}", device.name());
            },
        );
    }
}

#[test]
fn dispatches_above_65535_groups_number_every_item_once() {
    on_each_device(Options::default(), |device| {
        for count in [ROW - 1, ROW, ROW + 1, ROW + 12_345] {
            let input = values(count);
            let output = run(device, &input, 7, 1);
            assert!(
                output[..count as usize] == expected(&input, 7),
                "{} {count}",
                device.name()
            );
            assert_eq!(
                output[count as usize],
                [UNWRITTEN; 2],
                "{} {count}",
                device.name()
            );
        }
    });
}

#[test]
fn copies_larger_than_the_staging_buffer_are_whole() {
    on_each_device(
        Options {
            force_staging: true,
            ..Options::default()
        },
        |device| {
            let words = values((33 << 20) / 4 + 5);
            let mut buffer = device.upload(&words).expect("an upload");
            assert!(buffer.read_words().expect("a read") == words, "{}", device.name());
            buffer.mark_unwritten().expect("a fill");
            assert!(
                buffer
                    .read()
                    .expect("a read")
                    .iter()
                    .all(|word| *word == UNWRITTEN),
                "{}",
                device.name()
            );
        },
    );
}

#[test]
fn empty_buffers_and_empty_dispatches_are_fine() {
    for force_staging in [false, true] {
        on_each_device(
            Options {
                force_staging,
                ..Options::default()
            },
            |device| {
                assert_eq!(run(device, &[], 3, 0), Vec::<[u32; 2]>::new());
                assert_eq!(run(device, &[], 3, 2), vec![[UNWRITTEN; 2]; 2]);
                let timings = device.run(&Pass::new()).expect("an empty pass");
                assert_eq!(timings.dispatch_ns.unwrap_or_default(), Vec::<f64>::new());
            },
        );
    }
}

#[test]
fn later_dispatches_of_a_pass_see_earlier_ones_and_each_has_a_time() {
    on_each_device(Options::default(), |device| {
        let kernel = device
            .kernel_from_words("scale_index", &scale_index())
            .expect("a kernel");
        let input = values(100_000);
        let buffer = device.upload(&input).expect("an upload");
        let output = device.output::<[u32; 2]>(input.len()).expect("an output");
        let pushes: Vec<Push> = (1..=10)
            .map(|factor| Push {
                count: 100_000,
                factor,
            })
            .collect();
        let mut pass = Pass::new();
        for push in &pushes {
            pass.dispatch(
                &kernel,
                &[buffer.bind(), output.bind()],
                bytemuck::bytes_of(push),
                push.count,
            );
        }
        let timings = device.run(&pass).expect("a run");
        assert!(
            output.read().expect("the results") == expected(&input, 10),
            "{}",
            device.name()
        );
        if device.probe().limits.timestamp_valid_bits > 0 {
            let times = timings.dispatch_ns.expect("times where the device keeps time");
            assert_eq!(times.len(), 10);
            assert!(
                times.iter().all(|ns| ns.is_finite() && *ns >= 0.0),
                "{} {times:?}",
                device.name()
            );
            let sum: f64 = times.iter().sum();
            let wall = timings.wall.as_nanos() as f64;
            // Both clocks count nanoseconds; a tenth and a microsecond are for their different rates and steps.
            assert!(
                sum > 0.0 && sum <= wall * 1.1 + 1e3,
                "{} {sum} ns of {wall}",
                device.name()
            );
        }
    });
}

#[test]
fn the_self_test_runs_and_software_devices_are_exact() {
    on_each_device(Options::default(), |device| {
        let verdict = device.self_test().expect("a verdict");
        println!("{} ({}): {verdict}", device.name(), device.probe().driver.info);
        assert_eq!(verdict.exact, verdict.defects.is_empty());
        // VkDriverId of SwiftShader and llvmpipe; other devices get a verdict, whatever it is.
        if [10, 13].contains(&device.probe().driver.id) {
            assert!(verdict.exact, "{}: {:#?}", device.name(), verdict.defects);
        }
    });
}

#[test]
fn misuse_that_validation_sees_is_an_error() {
    for info in &devices().devices {
        let device = open(info, Options::default());
        // The module claims 64-bit integers, a feature this host never enables.
        let mut words = scale_index();
        words.splice(5..5, [2 << 16 | 17, 11]);
        match device.kernel_from_words("int64", &words) {
            Err(VulkanError::Validation { count, first, .. }) => {
                assert!(count > 0 && !first.is_empty());
                assert!(device.close().is_err(), "what was said is not forgotten");
            }
            other => assert!(
                matches!(
                    Device::open(
                        info,
                        Options {
                            validation: true,
                            ..Options::default()
                        }
                    ),
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
        let words = scale_index();
        let refused = |words: &[u32]| match device.kernel_from_words("corrupt", words) {
            Err(VulkanError::BadModule { source, .. }) => source.at,
            other => panic!("{}: {other:?}", device.name()),
        };
        assert_eq!(refused(&[]), 0);
        assert_eq!(refused(&words[..4]), 4);
        assert_eq!(refused(&[words.as_slice(), &[0]].concat()), words.len());
        assert_eq!(refused(&words[..7]), 7);
        let mut swapped = words.clone();
        swapped[0] = swapped[0].swap_bytes();
        assert_eq!(refused(&swapped), 0);
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
        let limit = device.probe().limits.max_storage_buffer_range;
        let Ok(words) = usize::try_from(limit / 4 + 1) else {
            return;
        };
        match device.output::<u32>(words) {
            Err(VulkanError::BufferTooLarge {
                bytes, limit: named, ..
            }) => {
                assert!(bytes == words as u64 * 4 && bytes > named, "{}", device.name());
            }
            other => panic!("{}: {:?}", device.name(), other.map(|buffer| buffer.len())),
        }
        let mut buffer = device.upload(&[1u32, 2]).expect("an upload");
        assert!(matches!(
            buffer.write(&[1]),
            Err(VulkanError::WrongLength { given: 1, held: 2 })
        ));
    });
}

#[test]
fn work_beyond_the_time_limit_is_an_error_and_the_device_recovers() {
    // No time at all: every submission is over the limit, and memory that the host reaches needs none to be filled.
    on_each_device(
        Options {
            time_limit: Duration::ZERO,
            ..Options::default()
        },
        |device| {
            if !device.probe().unified_memory {
                return;
            }
            let kernel = device
                .kernel_from_words("scale_index", &scale_index())
                .expect("a kernel");
            let input = values(ROW);
            let buffer = device.upload(&input).expect("an upload");
            let output = device.output::<[u32; 2]>(input.len()).expect("an output");
            let push = Push {
                count: ROW,
                factor: 5,
            };
            let mut pass = Pass::new();
            pass.dispatch(
                &kernel,
                &[buffer.bind(), output.bind()],
                bytemuck::bytes_of(&push),
                ROW,
            );
            match device.run(&pass) {
                Err(VulkanError::Timeout { work, .. }) => assert_eq!(work, "scale_index"),
                other => panic!("{}: {other:?}", device.name()),
            }
            let start = Instant::now();
            let results = loop {
                match output.read() {
                    Err(VulkanError::Busy { .. }) if start.elapsed() < Duration::from_secs(60) => {
                        std::thread::sleep(Duration::from_millis(1));
                    }
                    results => break results.expect("the results, late"),
                }
            };
            assert!(results == expected(&input, 5), "{}", device.name());
        },
    );
}

#[test]
fn devices_are_picked_by_index_and_by_name() {
    let list = devices();
    for info in &list.devices {
        assert_eq!(
            list.select(&info.index.to_string()).expect("by index").index,
            info.index
        );
        let shouted = info.probe.name.to_uppercase();
        assert_eq!(
            list.select(&shouted).expect("by name").probe.name,
            info.probe.name
        );
    }
    let (Some(first), many) = (list.devices.first(), list.devices.len()) else {
        return;
    };
    for wanted in ["no such device", "", &many.to_string()] {
        let Err(error @ VulkanError::UnknownDevice { .. }) = list.select(wanted) else {
            panic!("`{wanted}`")
        };
        assert!(
            error.to_string().contains(&format!("0: {}", first.probe.name)),
            "{error}"
        );
    }
    let device = open(first, Options::default());
    let Err(VulkanError::UnknownKernel { known, .. }) = device.kernel("no such kernel") else {
        panic!()
    };
    assert!(known.contains("self_test"), "{known}");
}

/// Tells the child process of the test below that it is one.
const CHILD: &str = "LIGHTBVH_TEST_WITHOUT_DRIVER";

#[test]
fn without_a_driver_the_list_is_empty_and_says_why() {
    if std::env::var_os(CHILD).is_some() {
        let list = Device::list().expect("a list");
        assert!(list.devices.is_empty() && !list.notes.is_empty());
        assert!(matches!(list.select("0"), Err(VulkanError::NoDevice { .. })));
        println!("notes: {}", list.notes.join("; "));
        return;
    }
    let child = std::process::Command::new(std::env::current_exe().expect("this program"))
        .args([
            "--exact",
            "without_a_driver_the_list_is_empty_and_says_why",
            "--nocapture",
        ])
        .env(CHILD, "1")
        .env("VK_DRIVER_FILES", "/nonexistent.json")
        .env("VK_ICD_FILENAMES", "/nonexistent.json")
        .output()
        .expect("a child process");
    let text = String::from_utf8_lossy(&child.stdout);
    assert!(
        child.status.success() && text.contains("notes: "),
        "{text}\n{child:?}"
    );
}

#[cfg(target_arch = "x86_64")]
#[test]
fn a_flushing_thread_opens_no_device() {
    fn set_control_word(mxcsr: u32) {
        // SAFETY: loads a control word without reserved bits; the thread does no float arithmetic of its own before
        // the default is back.
        unsafe {
            std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack, preserves_flags))
        };
    }
    for info in &devices().devices {
        set_control_word(0x9fc0);
        let opened = Device::open(info, Options::default());
        set_control_word(0x1f80);
        match opened {
            Err(VulkanError::FloatEnvironment { mxcsr, .. }) => assert_eq!(mxcsr & 0xffc0, 0x9fc0),
            other => panic!(
                "{}: {:?}",
                info.probe.name,
                other.map(|device| device.name().to_owned())
            ),
        }
    }
}
