//! The CPU's part of the page: moves the lights, and says by which copies and dispatches the device follows.
//!
//! The page calls the functions below in WebAssembly. Each that returns words returns their address; they are valid until the next call.

mod world;

use std::cell::RefCell;

use bytemuck::cast_slice;
use lightbvh::{ShadingPoint, TreeWords};
use lightbvh_gpu::{Mirror, Step};
use world::World;

/// Words of a record of a step: its kind, and up to six numbers.
const RECORD: usize = 7;

/// All that the page has.
struct Page {
    world: World,
    mirror: Mirror,
    /// What the last call returned.
    words: Vec<u32>,
    /// Bytes that the last call's words name.
    bytes: Vec<u8>,
}

thread_local! {
    /// Begins with an empty world and a device that holds nothing.
    static PAGE: RefCell<Page> = RefCell::new(Page {
        world: World::new(),
        mirror: Mirror::default(),
        words: Vec::new(),
        bytes: Vec::new(),
    });
}

fn with<T>(act: impl FnOnce(&mut Page) -> T) -> T {
    PAGE.with_borrow_mut(act)
}

/// Does the edits of a frame, and refits: `count` instances of [`world::LIGHTS`] lights each, as they are at `time`, s.
#[unsafe(no_mangle)]
pub extern "C" fn advance(count: u32, time: f32) {
    with(|page| page.world.advance(count as usize, time));
}

/// The device's work for the frame, as words: the push constants of kernels that walk the tree; the number of instances, and their
/// indices; the number of steps; and for each a record:
/// - 0, buffer, bytes: resize,
/// - 1, buffer, at, address, length: upload,
/// - 2, pass, push constants, invocations: dispatch.
#[unsafe(no_mangle)]
pub extern "C" fn follow() -> *const u32 {
    with(|page| {
        let Page {
            world,
            mirror,
            words,
            bytes,
        } = page;
        let frame = mirror.frame(&world.bvh);
        let live = world.live();
        words.clear();
        words.extend(cast_slice::<TreeWords, u32>(&[frame.words]));
        words.push(live.len() as u32);
        words.extend(live);
        words.push(frame.steps().count() as u32);
        // No address is taken before all bytes are there.
        bytes.clear();
        for step in frame.steps() {
            if let Step::Upload { bytes: own, .. } = step {
                bytes.extend(own);
            }
        }
        let mut address = bytes.as_ptr() as u32;
        for step in frame.steps() {
            let mut record = [0; RECORD];
            match step {
                Step::Resize { buffer, bytes } => {
                    record[1..3].copy_from_slice(&[buffer as u32, bytes as u32])
                }
                Step::Upload { buffer, at, bytes } => {
                    let length = bytes.len() as u32;
                    record[..5].copy_from_slice(&[1, buffer as u32, at as u32, address, length]);
                    address += length;
                }
                Step::Dispatch {
                    pass,
                    push: [a, b, c],
                    count,
                } => record[..6].copy_from_slice(&[2, pass as u32, a, b, c, count]),
            }
            words.extend(record);
        }
        words.as_ptr()
    })
}

/// The words that the device must hold now: the number of ranges, and for each the buffer, its first byte there, its address here, its
/// length.
#[unsafe(no_mangle)]
pub extern "C" fn in_use() -> *const u32 {
    with(|page| {
        let used = page.mirror.in_use(&page.world.bvh);
        page.words.clear();
        page.words.push(used.len() as u32);
        for (buffer, at, own) in used {
            let address = own.as_ptr() as u32;
            page.words
                .extend([buffer as u32, at as u32, address, own.len() as u32]);
        }
        page.words.as_ptr()
    })
}

/// The light that the CPU picks at the point (x, y, z) of a plane that faces up, by the number `high` + 2^-32 `low`: light, instance,
/// bits of its probability.
#[unsafe(no_mangle)]
pub extern "C" fn sample(x: f32, y: f32, z: f32, high: u32, low: u32) -> *const u32 {
    with(|page| {
        let point = ShadingPoint {
            p: [x, y, z],
            n: [0.0, 1.0, 0.0],
        };
        let number = u64::from(high) << 32 | u64::from(low);
        let sampled = page.world.bvh.tree().sample(&point, number);
        page.words.clear();
        page.words
            .extend([sampled.light, sampled.instance, sampled.pmf.to_bits()]);
        page.words.as_ptr()
    })
}
