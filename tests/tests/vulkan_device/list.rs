//! The devices found, and which of them is opened.

use lightbvh_gpu::FloatEnvironment;
use lightbvh_host::vulkan::{Device, Options, VulkanError};
use lightbvh_tests::devices::{devices, open};

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
    let (_, module) = module_path!()
        .split_once("::")
        .expect("a module of the tests' program");
    let this_test = format!("{module}::without_a_driver_the_list_is_empty_and_says_why");
    let child = std::process::Command::new(std::env::current_exe().expect("this program"))
        .args(["--exact", &this_test, "--nocapture"])
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
fn set_control_word(mxcsr: u32) {
    // SAFETY: loads a control word without reserved bits; the thread does no float arithmetic of its own before the default
    // is back, but what looks for the mode.
    unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack, preserves_flags)) };
}

#[cfg(target_arch = "x86_64")]
#[test]
fn flushing_and_other_rounding_are_found() {
    // To nearest, down, up, towards zero; with flush-to-zero (bit 15) and denormals-are-zero (bit 6).
    for rounding in [0x0000, 0x2000, 0x4000, 0x6000] {
        for flush in [0x0000, 0x8000, 0x0040, 0x8040] {
            set_control_word(0x1f80 | rounding | flush);
            let found = FloatEnvironment::current();
            set_control_word(0x1f80);
            let expected = FloatEnvironment {
                nearest: rounding == 0,
                keeps_results: flush & 0x8000 == 0,
                keeps_operands: flush & 0x0040 == 0,
            };
            assert_eq!(found, expected, "{rounding:#x} {flush:#x}");
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[test]
fn a_flushing_thread_opens_no_device() {
    for info in &devices().devices {
        set_control_word(0x9fc0);
        let opened = Device::open(info, Options::default());
        set_control_word(0x1f80);
        match opened {
            Err(VulkanError::FloatEnvironment { found, .. }) => {
                assert!(found.nearest && !found.keeps_results && !found.keeps_operands);
            }
            other => panic!(
                "{}: {:?}",
                info.probe.name,
                other.map(|device| device.name().to_owned())
            ),
        }
    }
}
