//! Kernels that are wrong on purpose, on every device: the self-test says what is wrong with them, and the comparison of whole
//! results counts differing words. What a device may do on its own, it may not do unseen.

use std::sync::OnceLock;

use bytemuck::cast_slice;
use lightbvh::BuildParams;
use lightbvh::device::bvh::follow;
use lightbvh_host::backend::{
    Backend, Bvh, CpuBackend, DeviceBackend, Follow, PMF_RECORD, SAMPLED_RECORD, Sampler, held,
};
use lightbvh_host::scene::Scene;
use lightbvh_host::vulkan::{Device, DeviceInfo, Exactness, Options};
use lightbvh_host::words::compare_words;
use lightbvh_host::workload::{arrays_at, build, lights_at, queries};
use lightbvh_kernels::bvh::Paper;
use lightbvh_tests::broken::{Variant, module};
use lightbvh_tests::devices::{devices, open};

/// What a sample costs a software device with kernels ten times as long.
const QUERIES: u32 = 4000;
/// The quantised moments of a node round away most of what contraction does to them; the bounds of Eq. 4 do not.
const KERNELS: [&str; 6] = [
    "self_test",
    "refit_bottom_eq4",
    "refit_top_eq4",
    "refit_nodes_eq4",
    "sample_eq4",
    "pmf_eq4",
];

/// Differing words of nodes, samples, pmfs; and the verdict of the self-test.
struct Seen {
    verdict: Exactness,
    different: [u64; 3],
}

/// With kernels as `variant` has them, or as they are.
fn see(info: &DeviceInfo, variant: Option<Variant>) -> Seen {
    let device = open(info, Options::default());
    if let Some(variant) = variant {
        for name in KERNELS {
            device
                .kernel_from_words(name, &module(name, variant))
                .unwrap_or_else(|e| panic!("{variant:?} {name}: {e}"));
        }
    }
    let seen = Seen {
        verdict: device.self_test().expect("a verdict"),
        different: different(&device),
    };
    device.close().expect("a clean tear-down");
    println!(
        "{}, {variant:?}: {}; different: {:?}",
        info.probe.name, seen.verdict, seen.different
    );
    seen
}

/// Of a built-in scene, its trees built at one frame and refitted to another, as `lightbvh verify`: differing words of nodes, of
/// samples and of pmfs.
fn different(device: &Device) -> [u64; 3] {
    let scene = Scene::open("street").expect("a built-in scene");
    let lights = [0, 40].map(|frame| lights_at(&scene, frame).expect("lights"));
    let bvh: Bvh<Paper, 4> = build(&lights[0], Sampler::TwoLevel, &BuildParams::default());
    let arrays = arrays_at(&scene, 40, 16, 16).expect("arrays");
    let mut asked = queries(&arrays, 1, 0, QUERIES);
    let mut cpu = CpuBackend::<Paper, 4>::new(bvh.clone());
    let mut other = DeviceBackend::<Paper, 4>::new(device, &bvh).expect("an upload");
    follow(cpu.bvh_mut(), &lights[1]).expect("the same lights");
    let nodes = &held(cpu.bvh())[0];
    other.follow(cpu.bvh()).expect("copies and a refit");
    let found = &other.held(cpu.bvh()).expect("a read")[0];
    let of_nodes = compare_words(&nodes.record, &nodes.words, &found.words).expect("whole records");
    // Each kernel by itself: samples are of the right nodes.
    let own = cpu.bvh();
    other
        .write_nodes(own.view().nodes(), own.view().top_nodes())
        .expect("an upload");
    let sampled = cpu.sample(&asked).expect("samples").value;
    let found = other.sample(&asked).expect("samples").value;
    let of_samples =
        compare_words(&SAMPLED_RECORD, cast_slice(&sampled), cast_slice(&found)).expect("whole records");
    for (query, sampled) in asked.iter_mut().zip(&sampled) {
        query.words = [sampled.light, sampled.instance];
    }
    let pmfs = cpu.pmf(&asked).expect("pmfs").value;
    let found = other.pmf(&asked).expect("pmfs").value;
    let of_pmfs = compare_words(&PMF_RECORD, cast_slice(&pmfs), cast_slice(&found)).expect("whole records");
    [of_nodes, of_samples, of_pmfs].map(|comparison| comparison.different)
}

/// On every device that is exact with the kernels as they are.
fn on_each(test: impl Fn(&DeviceInfo)) {
    static EXACT: OnceLock<Vec<usize>> = OnceLock::new();
    let list = devices().devices;
    let exact = EXACT.get_or_init(|| {
        let exact = |info: &&DeviceInfo| {
            let seen = see(info, None);
            // What the self-test calls exact, gives no word otherwise.
            assert!(
                !seen.verdict.exact || seen.different == [0; 3],
                "{}",
                info.probe.name
            );
            seen.verdict.exact
        };
        list.iter().filter(exact).map(|info| info.index).collect()
    });
    for info in list.iter().filter(|info| exact.contains(&info.index)) {
        test(info);
    }
}

/// What is wrong is found by the self-test under its name, and in refit, samples and pmfs by their words.
#[test]
fn wrong_arithmetic_is_found() {
    let contracted = [
        "multiply_add",
        "multiply_subtract",
        "negated_multiply_add",
        "sum_of_squares",
        "horner",
    ];
    for (variant, checks) in [
        (Variant::Contracted, &contracted[..]),
        (
            Variant::Reassociated,
            &["sum_from_the_left", "product_from_the_left"],
        ),
        (Variant::Truncated, &["sum", "difference"]),
    ] {
        on_each(|info| {
            let (what, seen) = (
                format!("{}: {variant:?}", info.probe.name),
                see(info, Some(variant)),
            );
            let defects = &seen.verdict.defects;
            assert!(!seen.verdict.exact, "{what}");
            for check in checks {
                assert!(defects.iter().any(|own| own.check == *check), "{what}: {check}");
            }
            for (different, of) in seen.different.into_iter().zip(["nodes", "samples", "pmfs"]) {
                assert!(different > 0, "{what}: {of}");
            }
        });
    }
}

/// Flushing that Vulkan does not allow.
#[test]
fn flushing_of_normal_numbers_is_found() {
    on_each(|info| {
        let seen = see(info, Some(Variant::FlushedNormal));
        assert!(!seen.verdict.exact, "{}", info.probe.name);
        assert!(seen.different.iter().sum::<u64>() > 0, "{}", info.probe.name);
    });
}

/// Flushing that Vulkan allows is named and changes nothing, on a device that does not flush by itself either.
#[test]
fn flushing_of_subnormal_numbers_changes_no_word() {
    on_each(|info| {
        let seen = see(info, Some(Variant::FlushedSubnormal));
        assert!(seen.verdict.exact, "{}: {}", info.probe.name, seen.verdict);
        assert!(
            seen.verdict.freedoms.iter().any(|f| f.check == "denormal_result"),
            "{}: {}",
            info.probe.name,
            seen.verdict
        );
        assert_eq!(seen.different, [0; 3], "{}", info.probe.name);
    });
}

/// What the device makes of kernels that forbid it nothing is its own business: but where words come out otherwise, the self-test
/// has found it.
#[test]
fn nothing_that_a_device_does_when_it_may_goes_unseen() {
    on_each(|info| {
        let seen = see(info, Some(Variant::Undecorated));
        assert!(
            seen.different == [0; 3] || !seen.verdict.exact,
            "{}",
            info.probe.name
        );
    });
}
