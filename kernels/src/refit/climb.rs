//! Passes `refit_climb`, `refit_roots`, `refit_climb_top`: the words of the level-by-level passes with one dispatch for all
//! bottom levels and one for the top level ([`lightbvh::climb`]).

use glam::UVec3;
use lightbvh::climb::{self, Step};
use lightbvh::refit::BlasRoot;
use lightbvh::trail::max_levels;
use lightbvh::{EmissiveTriangle, INVALID, Instance};
use spirv_std::spirv;

use super::RefitPush;
use crate::arrival::arrive;
use crate::bvh::{Node, WIDTH};
use crate::invocation;

/// More nodes than a way up has: steps that lead in a circle (hostile words) end here.
const MOST_STEPS: u32 = max_levels(WIDTH);

/// Bottom levels, from each of the steps `push.first..push.first + push.count` upward, which are those that wait for none.
/// `arrivals` has a counter for each step, zero before and after.
#[spirv(compute(threads(64), entry_point_name = "refit_climb"))]
pub fn refit_climb(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] steps: &[Step],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] arrivals: &mut [u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] nodes: &mut [Node],
) {
    let mut at = start(id, push);
    let mut left = MOST_STEPS;
    while at < steps.len() as u32 && left > 0 {
        left -= 1;
        let node = steps[at as usize].node;
        if node < nodes.len() as u32 {
            nodes[node as usize] = climb::bottom::<Node, WIDTH>(nodes, triangles, node);
        }
        at = next(steps, arrivals, at);
    }
}

/// The top level, in the same way; the roots of the bottom levels are refitted before.
#[spirv(compute(threads(64), entry_point_name = "refit_climb_top"))]
pub fn refit_climb_top(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] steps: &[Step],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] arrivals: &mut [u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] instances: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] roots: &[BlasRoot],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] nodes: &mut [Node],
) {
    let mut at = start(id, push);
    let mut left = MOST_STEPS;
    while at < steps.len() as u32 && left > 0 {
        left -= 1;
        let node = steps[at as usize].node;
        if node < nodes.len() as u32 {
            nodes[node as usize] = climb::top::<Node, Instance, WIDTH>(nodes, instances, roots, node);
        }
        at = next(steps, arrivals, at);
    }
}

/// The step that an invocation starts from.
#[inline(always)]
fn start(id: UVec3, push: &RefitPush) -> u32 {
    let i = invocation(id);
    if i < push.count {
        push.first.wrapping_add(i)
    } else {
        INVALID
    }
}

/// The step above `at`, for the last that arrives there: all below it is done and visible then. For all others, and above a
/// root, [`INVALID`].
#[inline(always)]
fn next(steps: &[Step], arrivals: &mut [u32], at: u32) -> u32 {
    let parent = steps[at as usize].parent;
    let mut next = INVALID;
    if parent < steps.len() as u32 && parent < arrivals.len() as u32 {
        let before = arrive(arrivals, parent);
        if before.wrapping_add(1) == steps[parent as usize].children {
            // Nobody else comes here in this dispatch.
            arrivals[parent as usize] = 0;
            next = parent;
        }
    }
    next
}
