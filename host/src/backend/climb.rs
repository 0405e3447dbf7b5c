//! Refit with one dispatch for all bottom levels and one for the top level, on the CPU and on devices. What is computed is
//! that of the level-by-level passes, word for word.

use std::ops::Range;
use std::time::{Duration, Instant};

use bytemuck::bytes_of;
use glam::UVec3;
use lightbvh::climb::{self, Plan, Start, Step};
use lightbvh::node::{LightNode, kind};
use lightbvh::{Lights, refit};
use lightbvh_kernels::bvh::{Node, WIDTH};
use lightbvh_kernels::refit::{RefitPush, refit_climb, refit_climb_top};

use super::device::{DeviceBackend, device_time};
use super::{Bvh, LightScene, Timed};
use crate::vulkan::{Buffer, Device, Pass, VulkanError};

/// The climbs of both levels, those of the bottom levels first.
struct Climbs {
    plan: Plan,
    bottom: RefitPush,
    top: RefitPush,
}

impl Climbs {
    /// Each level from the nodes with leaves and those with inner children.
    fn new(parents: &[u32], bottom: [Vec<u32>; 2], top: [Vec<u32>; 2]) -> Self {
        let mut plan = Plan::default();
        let mut part = |[leaves, inner]: [Vec<u32>; 2]| {
            let first = plan.starts.len() as u32;
            let count = plan.add(parents, leaves, inner);
            RefitPush { first, count }
        };
        let (bottom, top) = (part(bottom), part(top));
        Self { plan, bottom, top }
    }

    /// All nodes, those of the top level from `top` on.
    fn of_all(nodes: &[Node], top: u32) -> Self {
        let has_inner = |i: &u32| (0..WIDTH).any(|slot| nodes[*i as usize].kind(slot) == kind::INNER);
        let has_leaf = |i: &u32| {
            let is_leaf = |to| to == kind::LIGHT || to == kind::MESH;
            (0..WIDTH).any(|slot| is_leaf(nodes[*i as usize].kind(slot)))
        };
        let part = |range: Range<u32>| {
            let leaves = range.clone().filter(has_leaf).collect();
            [leaves, range.filter(has_inner).collect()]
        };
        Self::new(
            &climb::parents(nodes),
            part(0..top),
            part(top..nodes.len() as u32),
        )
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
    let Climbs { plan, bottom, top } = Climbs::of_all(bvh.nodes(), top);
    let (starts, leaves, steps) = (&plan.starts, &plan.leaves, &plan.steps);
    let mut arrivals = vec![0; steps.len()];
    let meshes = bvh.tree().meshes.to_vec();
    let start = Instant::now();
    // `invocation` numbers x without a bound of its own.
    for i in 0..bottom.count {
        let (id, nodes) = (UVec3::new(i, 0, 0), bvh.nodes_mut());
        refit_climb(
            id,
            &bottom,
            starts,
            leaves,
            steps,
            &mut arrivals,
            lights.triangles(),
            nodes,
        );
    }
    for root in 0..bvh.roots().len() {
        bvh.roots_mut()[root] = refit::root(bvh.nodes(), bvh.roots()[root].node);
    }
    let roots = bvh.roots().to_vec();
    for i in 0..top.count {
        let (id, nodes) = (UVec3::new(i, 0, 0), bvh.nodes_mut());
        refit_climb_top(
            id,
            &top,
            starts,
            leaves,
            steps,
            &mut arrivals,
            &meshes,
            &roots,
            nodes,
        );
    }
    start.elapsed()
}

/// Climbs on a device.
pub(super) struct Climb {
    starts: Buffer<Start>,
    leaves: Buffer<u32>,
    steps: Buffer<Step>,
    /// By step, zero between dispatches.
    arrivals: Buffer<u32>,
    bottom: RefitPush,
    top: RefitPush,
    /// The bottom levels whose bounds the top level reads.
    roots: Buffer<u32>,
}

impl Climb {
    fn new(device: &Device, climbs: &Climbs, roots: &[u32]) -> Result<Self, VulkanError> {
        let plan = &climbs.plan;
        Ok(Self {
            starts: device.upload(&plan.starts)?,
            leaves: device.upload(&plan.leaves)?,
            steps: device.upload(&plan.steps)?,
            arrivals: device.upload(&vec![0; plan.steps.len()])?,
            bottom: climbs.bottom,
            top: climbs.top,
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
                    Climb::new(self.device, &Climbs::of_all(&nodes, top), &roots)?
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
        let bottom = [work.leaves.clone(), work.levels.nodes().to_vec()];
        let top = [work.instances.clone(), work.top.nodes().to_vec()];
        let climbs = Climbs::new(scene.parents(), bottom, top);
        let climb = Climb::new(self.device, &climbs, &work.roots)?;
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
        let (starts, leaves, nodes) = (climb.starts.bind(), climb.leaves.bind(), self.nodes.bind());
        let (steps, arrivals) = (climb.steps.bind(), climb.arrivals.bind());
        let triangles = self.local.as_ref().unwrap_or(&self.triangles).bind();
        let by_triangle = [starts, leaves, steps, arrivals, triangles, nodes];
        let by_root = [climb.roots.bind(), nodes, self.roots.bind()];
        let instances = self.meshes.bind();
        let by_instance = [
            starts,
            leaves,
            steps,
            arrivals,
            instances,
            self.roots.bind(),
            nodes,
        ];
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
