//! What an engine on wgpu adds for lightbvh.

use std::collections::HashMap;

use lightbvh::{LightBvh, TreeWords};
use lightbvh_gpu::{DeviceBuffer, MOMENTS, Mirror, Pass, Step};
use wgpu::Buffer;

use crate::Result;
use crate::engine::{Engine, Pipeline};

/// The lights of one scene on one device.
pub struct DeviceLights {
    /// Knows what the device holds.
    pub mirror: Mirror,
    pub buffers: HashMap<DeviceBuffer, Buffer>,
    /// In the order of `Pass::ALL`.
    refits: Vec<Pipeline>,
}

impl DeviceLights {
    pub fn new(engine: &Engine) -> Result<Self> {
        let refits = Pass::ALL.iter().map(|&pass| engine.pipeline(MOMENTS.refit(pass)));
        Ok(Self {
            mirror: Mirror::default(),
            buffers: HashMap::new(),
            refits: refits.collect::<Result<_>>()?,
        })
    }

    /// Updates the device to the light BVH. Returns the push constants of kernels that walk it.
    pub fn update(&mut self, engine: &Engine, bvh: &LightBvh) -> TreeWords {
        let frame = self.mirror.frame(bvh);
        let mut encoder = engine.device.create_command_encoder(&Default::default());
        for step in frame.steps() {
            match step {
                Step::Resize { buffer, bytes } => {
                    self.buffers.insert(buffer, engine.storage(bytes));
                }
                Step::Upload { buffer, at, bytes } => {
                    engine.queue.write_buffer(&self.buffers[&buffer], at, bytes);
                }
                Step::Dispatch { pass, push, count } => {
                    let pipeline = &self.refits[pass as usize];
                    engine.dispatch(&mut encoder, pipeline, |name| self.named(name), &push, count);
                }
            }
        }
        engine.queue.submit([encoder.finish()]);
        frame.words
    }

    /// The buffer that a kernel's binding of this name takes.
    pub fn named(&self, binding: &str) -> Option<&Buffer> {
        DeviceBuffer::named(binding).and_then(|buffer| self.buffers.get(&buffer))
    }
}
