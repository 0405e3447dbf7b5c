//! A street whose lights come, move, flicker, bend and go: what the engine tells lightbvh in each frame.

use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightBvh, MeshId, ShadingPoint, Transform};

use super::Result;

/// Lamps of the chain.
const LAMPS: u16 = 40;

/// The lights.
pub struct World {
    pub bvh: LightBvh,
    lamp: MeshId,
    chain: MeshId,
    lamps: Vec<InstanceId>,
}

impl World {
    /// Two meshes, a chain over the street, no other lamps yet.
    pub fn new() -> Result<Self> {
        let mut bvh = LightBvh::default();
        // 5 cm² that shine down with 900 W/(m² sr).
        let lamp = bvh.add_mesh(vec![lamp([0.0, 3.0, 0.0], 900.0)])?;
        let chain = bvh.add_mesh(waving(0.0))?;
        bvh.add_instance(chain, Transform::at([0.0, 6.0, 10.0]))?;
        Ok(Self {
            bvh,
            lamp,
            chain,
            lamps: Vec::new(),
        })
    }

    /// The edits of frame `frame`, done as one batch. Every fourth frame begins with a new top level.
    pub fn step(&mut self, frame: u16) -> Result<()> {
        if frame % 4 == 3 {
            // In an engine this runs on another thread; `lightbvh::Rebuilder` does that.
            self.bvh.rebuild();
        }
        let time = f32::from(frame) * 0.1;
        let mut edits = vec![Edit::SetLights {
            mesh: self.chain,
            lights: waving(time),
        }];
        for (k, &instance) in (0_u16..).zip(&self.lamps) {
            // A third of the lamps drives, a third flickers, a third stands.
            match k % 3 {
                0 => edits.push(Edit::SetTransform {
                    instance,
                    transform: Transform::at([f32::from(k) + time, 0.0, time]),
                }),
                1 => edits.push(Edit::SetRadiance {
                    instance,
                    radiance: [0.0, 2.0, 4.0].map(|phase| 1.0 + 0.5 * swing(time + phase + f32::from(k))),
                }),
                _ => {}
            }
        }
        // Lamps come; after ten frames the oldest go.
        for k in 0..30_u16 {
            edits.push(Edit::AddInstance {
                mesh: self.lamp,
                transform: Transform::at([f32::from(frame), 0.0, f32::from(k) * 2.0]),
                radiance: [1.0; 3],
                mask: u32::MAX,
            });
        }
        if frame >= 10 {
            edits.extend(self.lamps.drain(..20).map(Edit::RemoveInstance));
        }
        self.lamps.extend(self.bvh.apply(edits)?.instances);
        self.bvh.refit();
        Ok(())
    }
}

/// `count` points on the ground, each with a random number.
pub fn points(frame: u16, count: u32) -> Vec<(ShadingPoint, u32)> {
    let hash = |k: u32| lightbvh::exact::hash(k ^ u32::from(frame) << 20);
    let metres = |k: u32| (hash(k) >> 8) as f32 / 524_288.0;
    (0..count)
        .map(|k| {
            let point = ShadingPoint {
                p: [metres(3 * k), 0.0, metres(3 * k + 1)],
                n: [0.0, 1.0, 0.0],
            };
            (point, hash(3 * k + 2))
        })
        .collect()
}

/// A chain of lamps that waves.
fn waving(time: f32) -> Vec<EmissiveTriangle> {
    let x = |k: u16| f32::from(k) * 0.1;
    (0..LAMPS)
        .map(|k| lamp([x(k), 0.0, 0.3 * swing(3.0 * x(k) + 5.0 * time)], 5.0))
        .collect()
}

/// Only the CPU moves the world, so any function does.
#[allow(clippy::disallowed_methods)]
fn swing(x: f32) -> f32 {
    x.sin()
}

fn lamp([x, y, z]: [f32; 3], radiance: f32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [[x, y, z], [x + 0.03, y, z], [x, y, z + 0.03]],
        radiance: [radiance; 3],
        mesh: 0,
        flags: 0,
    }
}
