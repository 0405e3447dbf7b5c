//! Refit with one dispatch for all bottom levels and one for the top level, on the CPU and on devices. What is computed is
//! that of the level-by-level passes, word for word.

use std::time::{Duration, Instant};

use bytemuck::bytes_of;
use glam::UVec3;
use lightbvh::climb::{self, Step};
use lightbvh::{Lights, refit};
use lightbvh_kernels::bvh::Node;
use lightbvh_kernels::refit::{RefitPush, refit_climb, refit_climb_top};

use super::device::{DeviceBackend, device_time};
use super::{Bvh, LightScene, Timed};
use crate::vulkan::{Buffer, Device, Pass, VulkanError};

/// The steps of both levels, those of the bottom levels first.
struct Plan {
    steps: Vec<Step>,
    /// The steps to start from.
    bottom: RefitPush,
    top: RefitPush,
}

impl Plan {
    fn new(parents: &[u32], bottom: Vec<u32>, top: Vec<u32>) -> Self {
        let mut steps = Vec::new();
        let mut part = |nodes| {
            let first = steps.len() as u32;
            let count = climb::plan(parents, nodes, &mut steps);
            RefitPush { first, count }
        };
        let (bottom, top) = (part(bottom), part(top));
        Self { steps, bottom, top }
    }

    /// All nodes, those of the top level from `top` on.
    fn of_all(nodes: &[Node], top: u32) -> Self {
        let end = nodes.len() as u32;
        Self::new(&climb::parents(nodes), (0..top).collect(), (top..end).collect())
    }
}

/// [`lightbvh::LightBvh::refit`] through the kernels' bodies, one invocation after the other: each goes up as far as all
/// below is done. Returns the time that this takes, without that of the plan.
pub(super) fn refit_once(bvh: &mut Bvh, lights: &Lights) -> Duration {
    let top = if bvh.is_two_level() {
        bvh.tree().root
    } else {
        bvh.nodes().len() as u32
    };
    let plan = Plan::of_all(bvh.nodes(), top);
    let mut arrivals = vec![0; plan.steps.len()];
    let meshes = bvh.tree().meshes.to_vec();
    let start = Instant::now();
    // `invocation` numbers x without a bound of its own.
    for i in 0..plan.bottom.count {
        let (id, nodes) = (UVec3::new(i, 0, 0), bvh.nodes_mut());
        refit_climb(
            id,
            &plan.bottom,
            &plan.steps,
            &mut arrivals,
            lights.triangles(),
            nodes,
        );
    }
    for root in 0..bvh.roots().len() {
        bvh.roots_mut()[root] = refit::root(bvh.nodes(), bvh.roots()[root].node);
    }
    let roots = bvh.roots().to_vec();
    for i in 0..plan.top.count {
        let (id, nodes) = (UVec3::new(i, 0, 0), bvh.nodes_mut());
        refit_climb_top(id, &plan.top, &plan.steps, &mut arrivals, &meshes, &roots, nodes);
    }
    start.elapsed()
}

/// A plan on a device.
pub(super) struct Climb {
    steps: Buffer<Step>,
    /// By step, zero between dispatches.
    arrivals: Buffer<u32>,
    bottom: RefitPush,
    top: RefitPush,
    /// The bottom levels whose bounds the top level reads.
    roots: Buffer<u32>,
}

impl Climb {
    fn new(device: &Device, plan: &Plan, roots: &[u32]) -> Result<Self, VulkanError> {
        Ok(Self {
            steps: device.upload(&plan.steps)?,
            arrivals: device.upload(&vec![0; plan.steps.len()])?,
            bottom: plan.bottom,
            top: plan.top,
            roots: device.upload(roots)?,
        })
    }
}

impl DeviceBackend<'_> {
    /// See [`Backend::refit_once`](super::Backend::refit_once).
    pub(super) fn refit_bvh_once(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError> {
        self.triangles.write(lights.triangles())?;
        let mut time = Duration::ZERO;
        if self.local.is_none() {
            let climb = match self.climb.take() {
                Some(climb) => climb,
                None => {
                    let nodes = self.nodes.read()?;
                    let top = match self.tree.two_level {
                        0 => nodes.len() as u32,
                        _ => self.tree.root,
                    };
                    let roots: Vec<u32> = (0..self.roots.len() as u32).collect();
                    Climb::new(self.device, &Plan::of_all(&nodes, top), &roots)?
                }
            };
            time = self.run(&climb)?;
            // Not after a failure: its counters may be at anything then.
            self.climb = Some(climb);
        }
        let value = self.nodes.read()?;
        Ok(Timed { time, value })
    }

    /// As [`Backend::follow`](super::Backend::follow), in one dispatch for each level of the scene.
    ///
    /// # Errors
    /// [`VulkanError`] from the device.
    pub fn follow_once(&mut self, scene: &LightScene, lights: &Lights) -> Result<Timed<()>, VulkanError> {
        self.copy_changes(scene, lights)?;
        let work = scene.work();
        let top = [&work.instances, work.top.nodes()].concat();
        let plan = Plan::new(scene.parents(), work.leaves.clone(), top);
        let climb = Climb::new(self.device, &plan, &work.roots)?;
        let time = self.run(&climb)?;
        Ok(Timed { time, value: () })
    }

    fn run(&self, climb: &Climb) -> Result<Duration, VulkanError> {
        let device = self.device;
        let bottom = device.kernel("refit_climb")?;
        let roots = device.kernel("refit_roots")?;
        let top = device.kernel("refit_climb_top")?;
        let all_roots = RefitPush {
            first: 0,
            count: climb.roots.len() as u32,
        };
        let (steps, arrivals, nodes) = (climb.steps.bind(), climb.arrivals.bind(), self.nodes.bind());
        let triangles = self.local.as_ref().unwrap_or(&self.triangles).bind();
        let by_triangle = [steps, arrivals, triangles, nodes];
        let by_root = [climb.roots.bind(), nodes, self.roots.bind()];
        let by_instance = [steps, arrivals, self.meshes.bind(), self.roots.bind(), nodes];
        let mut pass = Pass::new();
        for (kernel, bindings, push) in [
            (&bottom, &by_triangle[..], &climb.bottom),
            (&roots, &by_root[..], &all_roots),
            (&top, &by_instance[..], &climb.top),
        ] {
            if push.count > 0 {
                pass.dispatch(kernel, bindings, bytes_of(push), push.count);
            }
        }
        Ok(device_time(&device.run(&pass)?))
    }
}
