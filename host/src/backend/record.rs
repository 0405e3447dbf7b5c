//! Records that are compared: results of passes, and the arrays of a light BVH.

use bytemuck::cast_slice;
use lightbvh::Instance;
use lightbvh::tree::Model;
use lightbvh_gpu::{DeviceBuffer, Mirror};

use super::{BackendError, Bvh};
use crate::words::Record;

/// A sampled light.
pub const SAMPLED_RECORD: Record = record("sampled light", 3);

/// A pmf.
pub const PMF_RECORD: Record = record("pmf", 1);

/// A pixel.
pub const PIXEL_RECORD: Record = record("pixel", 3);

const fn record(name: &'static str, words: usize) -> Record {
    Record { name, words }
}

/// The words in use of a buffer of a light BVH.
#[derive(Clone, Debug)]
pub struct Held {
    /// Which one.
    pub buffer: DeviceBuffer,
    /// What the words are of.
    pub record: Record,
    /// The words.
    pub words: Vec<u32>,
}

/// The words in use of each buffer of `bvh`, as the CPU has them.
pub fn held<M: Model<W>, const W: usize>(bvh: &Bvh<M, W>) -> Vec<Held> {
    let all = held_by(bvh, &Mirror::default(), |_| Ok(None));
    all.expect("nothing is read")
}

/// The words in use of each buffer of `bvh`: those that `read` returns of the buffer, laid out by `mirror`, or else the CPU's.
pub(super) fn held_by<M: Model<W>, const W: usize>(
    bvh: &Bvh<M, W>,
    mirror: &Mirror,
    read: impl Fn(DeviceBuffer) -> Result<Option<Vec<u32>>, BackendError>,
) -> Result<Vec<Held>, BackendError> {
    let used = mirror.in_use(bvh);
    let buffers = [
        (DeviceBuffer::Nodes, size_of::<M::Node>()),
        (DeviceBuffer::Lights, size_of::<M::Light>()),
        (DeviceBuffer::Instances, size_of::<Instance>()),
        (DeviceBuffer::Trails, size_of::<u32>()),
    ];
    let held = buffers.into_iter().map(|(buffer, bytes)| {
        let all = read(buffer)?;
        let own = used.iter().filter(|(of, ..)| *of == buffer);
        let words = own.flat_map(|&(_, at, bytes)| match &all {
            Some(all) => &all[at as usize / 4..][..bytes.len() / 4],
            None => cast_slice(bytes),
        });
        Ok(Held {
            buffer,
            record: record(buffer.name(), bytes / 4),
            words: words.copied().collect(),
        })
    });
    held.collect()
}
