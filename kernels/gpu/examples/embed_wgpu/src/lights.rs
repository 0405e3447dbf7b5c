//! What an engine on wgpu adds for lightbvh: copies, refit and samples of each frame.

use bytemuck::cast_slice;
use lightbvh::{LightBvh, SampledLight};
use lightbvh::node::DefaultNode;
use lightbvh_gpu::{Buffer as Array, Frame, MOMENTS, Mirror, Pass, Query, query_push};
use wgpu::Buffer;

use crate::Result;
use crate::engine::{Engine, Pipeline};

/// The lights of one scene on one device.
pub struct DeviceLights<'a> {
    engine: &'a Engine,
    /// Knows which bytes the device holds.
    mirror: Mirror,
    /// One for each of `Array::ALL`.
    arrays: Vec<Buffer>,
    refits: Vec<(Pass, Pipeline)>,
    sample: Pipeline,
}

/// What one frame gave, copied back to be compared.
pub struct Results {
    pub nodes: Vec<u8>,
    pub samples: Vec<u8>,
}

impl<'a> DeviceLights<'a> {
    pub fn new(engine: &'a Engine) -> Result<Self> {
        Ok(Self {
            engine,
            mirror: Mirror::default(),
            arrays: Array::ALL.iter().map(|_| engine.storage(0)).collect(),
            refits: Pass::ALL
                .into_iter()
                .map(|pass| Ok((pass, engine.pipeline(MOMENTS.refit(pass))?)))
                .collect::<Result<_>>()?,
            sample: engine.pipeline(MOMENTS.sample)?,
        })
    }

    /// Offset of the top level's nodes, bytes.
    pub fn top_bytes(&self) -> usize {
        self.mirror.top::<DefaultNode>() as usize * size_of::<DefaultNode>()
    }

    /// Updates the device to the light BVH, and samples there.
    pub fn frame(&mut self, bvh: &LightBvh, queries: &[Query]) -> Result<Results> {
        let engine = self.engine;
        let frame = self.mirror.frame(bvh);
        self.grow(&frame);
        for copy in &frame.copies {
            let bytes = copy.source(bvh);
            let array = &self.arrays[copy.buffer as usize];
            engine.queue.write_buffer(array, copy.bytes.start, bytes);
        }
        let list = engine.stored(cast_slice(&frame.refit.list));
        let children = engine.storage(frame.refit.children);
        let asked = engine.stored(cast_slice(queries));
        let answers = engine.storage(size_of::<SampledLight>() as u64 * queries.len() as u64);
        // Bindings have names. Those that `Array::named` does not know are this frame's.
        let named = |name: &str| match (Array::named(name), name) {
            (Some(array), _) => &self.arrays[array as usize],
            (None, "list") => &list,
            (None, "children") => &children,
            (None, "queries") => &asked,
            (None, _) => &answers,
        };
        let refits: Vec<_> = self
            .refits
            .iter()
            .map(|(pass, pipeline)| (*pass, pipeline, engine.bind(pipeline, named)))
            .collect();
        let bound = engine.bind(&self.sample, named);

        let mut encoder = engine.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        for dispatch in &frame.refit.dispatches {
            let refit = refits.iter().find(|(pass, ..)| *pass == dispatch.pass);
            let (_, refit, bound) = refit.expect("there is one for each pass");
            refit.dispatch(&mut pass, bound, &dispatch.push(), dispatch.count);
        }
        let count = queries.len() as u32;
        self.sample
            .dispatch(&mut pass, &bound, &query_push(count, frame.words), count);
        drop(pass);
        engine.queue.submit([encoder.finish()]);
        Ok(Results {
            nodes: engine.read(&self.arrays[Array::Nodes as usize])?,
            samples: engine.read(&answers)?,
        })
    }

    /// Makes larger what became too small, and copies what it held.
    fn grow(&mut self, frame: &Frame) {
        let engine = self.engine;
        // Submitted by itself, for `write_buffer` comes before all that is submitted after it.
        let mut encoder = engine.device.create_command_encoder(&Default::default());
        for &(array, bytes) in &frame.resizes {
            let held = &mut self.arrays[array as usize];
            if bytes > held.size() {
                let new = engine.storage(bytes + bytes / 8 * 4);
                encoder.copy_buffer_to_buffer(held, 0, &new, 0, held.size());
                *held = new;
            }
        }
        engine.queue.submit([encoder.finish()]);
    }
}
