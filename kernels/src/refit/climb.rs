//! Passes `refit_climb`, `refit_roots`, `refit_climb_top`: the words of the level-by-level passes with one dispatch for all
//! bottom levels and one for the top level ([`lightbvh::climb`]).

use glam::UVec3;
use lightbvh::climb::{Start, Step};
use lightbvh::refit::{self, BlasRoot};
use lightbvh::trail::max_levels;
use lightbvh::{EmissiveTriangle, INVALID, Instance};
use spirv_std::spirv;

use super::RefitPush;
use crate::arrival::arrive;
use crate::bvh::{Node, WIDTH};
use crate::invocation;

/// As many nodes as a way up has: steps that lead in a circle (hostile words) end here.
const MOST_STEPS: u32 = max_levels(WIDTH);

/// Bottom levels, by the climbs `starts[push.first + i]`. `arrivals` has a counter for each step, zero before and after.
#[spirv(compute(threads(64), entry_point_name = "refit_climb"))]
pub fn refit_climb(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] starts: &[Start],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] list: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] steps: &[Step],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] arrivals: &mut [u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] triangles: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] nodes: &mut [Node],
) {
    let start = start(id, push, starts);
    let mut entry = start.first;
    while entry < start.end && entry < list.len() as u32 {
        let node = list[entry as usize];
        if node < nodes.len() as u32 {
            nodes[node as usize] = refit::leaves::<Node, WIDTH>(nodes, triangles, node);
        }
        entry += 1;
    }
    climb(start.step, steps, arrivals, nodes);
}

/// The top level, in the same way; the roots of the bottom levels are refitted before.
#[spirv(compute(threads(64), entry_point_name = "refit_climb_top"))]
pub fn refit_climb_top(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] starts: &[Start],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] list: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] steps: &[Step],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] arrivals: &mut [u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] roots: &[BlasRoot],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] nodes: &mut [Node],
) {
    let start = start(id, push, starts);
    let mut entry = start.first;
    while entry < start.end && entry < list.len() as u32 {
        let node = list[entry as usize];
        if node < nodes.len() as u32 {
            nodes[node as usize] = refit::mesh_leaves::<Node, Instance, WIDTH>(nodes, instances, roots, node);
        }
        entry += 1;
    }
    climb(start.step, steps, arrivals, nodes);
}

/// What an invocation begins with; nothing for those beyond the list.
#[inline(always)]
fn start(id: UVec3, push: &RefitPush, starts: &[Start]) -> Start {
    let i = invocation(id);
    let entry = push.first.wrapping_add(i);
    let mut start = Start {
        first: 0,
        end: 0,
        step: INVALID,
    };
    if i < push.count && entry < starts.len() as u32 {
        start = starts[entry as usize];
    }
    start
}

/// Merges children from step `from` upward, as long as this invocation is the last to come to a node.
#[inline(always)]
fn climb(from: u32, steps: &[Step], arrivals: &mut [u32], nodes: &mut [Node]) {
    let mut at = from;
    let mut left = MOST_STEPS;
    while at < steps.len() as u32 && left > 0 {
        left -= 1;
        let node = steps[at as usize].node;
        if node < nodes.len() as u32 {
            nodes[node as usize] = refit::level::<Node, WIDTH>(nodes, node);
        }
        at = next(steps, arrivals, at);
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
