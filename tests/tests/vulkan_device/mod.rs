//! The host's Vulkan side, on every device of the machine and under the validation layer.

mod errors;
mod list;
mod lost;

use bytemuck::{Pod, Zeroable};
use lightbvh_host::vulkan::{Device, Options, Pass, UNWRITTEN};
use lightbvh_kernels::scatter::{LANES, Run, ScatterPush};
use lightbvh_tests::devices::on_each_device;

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
    let bytes = include_bytes!("../../data/vulkan/scale_index.spv");
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

fn on_each(test: impl Fn(&Device)) {
    on_each_device(Options::default(), test);
}

#[test]
fn results_come_back_and_surplus_words_stay_unwritten() {
    on_each(|device| {
        for (count, spare) in [(0, 0), (0, 2), (1000, 24)] {
            let input = values(count);
            let output = run(device, &input, 3, spare);
            let expected = [expected(&input, 3), vec![[UNWRITTEN; 2]; spare]].concat();
            assert_eq!(output, expected, "{}", device.name());
        }
        device.run(&Pass::new()).expect("an empty pass");
    });
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

/// More bytes than a staging buffer has, in two parts, the later one first.
#[test]
fn parts_of_a_write_arrive_and_nothing_else_changes() {
    on_each(|device| {
        let words = values((33 << 20) / 4 + 5);
        let buffer = device.output::<u32>(words.len() + 10).expect("a buffer");
        let (first, second) = words.split_at(words.len() / 2);
        let parts = [(first.len() + 9, second), (1, first)];
        buffer.write(&parts).expect("within");
        let found = buffer.read().expect("a read");
        let gap = [UNWRITTEN; 8];
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
        let values = values(count);
        let mut expected = vec![7_u32; count as usize + 1];
        let target = device.upload(&expected).expect("an upload");
        let (mut at, mut runs) = (1, Vec::new());
        for length in lengths {
            let (from, to) = (at as usize - 1, at as usize);
            let words = length as usize;
            expected[to..to + words].copy_from_slice(&values[from..from + words]);
            runs.push(Run {
                from: at - 1,
                to: at,
                words: length,
            });
            at += length + 1;
        }
        // Something else comes first in the staging buffer.
        let mut staged = [&[9; 5], &values[..]].concat();
        let push = ScatterPush {
            runs: runs.len() as u32,
            list: staged.len() as u32,
            first: 5,
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

#[test]
fn later_dispatches_of_a_pass_see_earlier_ones_and_all_have_a_time() {
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
        if device.probe().timestamp_valid_bits > 0 {
            let kernels = timings.kernels.expect("a time where the device keeps time");
            let [kernels, wall] = [kernels, timings.wall].map(|time| time.as_nanos() as f64);
            // Both clocks count nanoseconds; a tenth and a microsecond are for their different rates and steps.
            assert!(
                kernels > 0.0 && kernels <= wall * 1.1 + 1e3,
                "{} {kernels} ns of {wall}",
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
