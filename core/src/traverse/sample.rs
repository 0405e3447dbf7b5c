//! One light for a point, and the probability of any.

use bytemuck::{Pod, Zeroable};

use super::walk::{Walk, uniform_numbers};
use crate::choose::FULL_BITS;
use crate::exact::{self, div};
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::{Receiver, ShadingPoint};
use crate::random::Random64;
use crate::trail::Path;
use crate::tree::{INVALID, LightTree};

/// A light and the probability with which it was chosen: 12 bytes, the same on devices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SampledLight {
    /// Number of the light; [`INVALID`](Self::INVALID) when no light has flux. (A share of uniform choice may return a light without flux,
    /// with the probability that it has.)
    pub light: u32,
    /// Index of its instance; [`INVALID`](Self::INVALID) in a single-level tree and where there is no light.
    pub instance: u32,
    /// Probability of this light at this point, in (0, 1]; 0 with [`INVALID`](Self::INVALID).
    pub pmf: f32,
}

impl SampledLight {
    /// No light, or no instance: `u32::MAX`, everywhere in this crate.
    pub const INVALID: u32 = INVALID;

    /// No light has flux.
    pub const NONE: Self = Self {
        light: INVALID,
        instance: INVALID,
        pmf: 0.0,
    };
}

impl Default for SampledLight {
    /// [`NONE`](Self::NONE).
    fn default() -> Self {
        Self::NONE
    }
}

/// See [`LightTree::sample`].
#[inline(always)]
pub(super) fn sample<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    point: &P,
    random: Random64,
) -> SampledLight {
    let mut walk = begin(tree, point, random);
    // A single exit at the head, no early return: rust-gpu miscompiles some of the others (spirt issue 31).
    let mut done = walk.walk.done;
    while !done {
        walk.walk.step(tree, point);
        done = walk.walk.done;
    }
    walk.end(tree)
}

/// A walk, and what it was started for.
#[derive(Clone, Copy)]
pub(super) struct Started<'a, N, P = ShadingPoint> {
    pub walk: Walk<'a, N, P>,
    /// The light of a uniform choice, or [`INVALID`].
    light: u32,
    /// Its instance, or [`INVALID`].
    instance: u32,
}

/// Starts a walk by a random number: down the tree, or for a share of the numbers along the path to a light out of all alike.
#[inline(always)]
pub(super) fn begin<'a, N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'a, N, I, W>,
    point: &P,
    random: Random64,
) -> Started<'a, N, P> {
    let taken = uniform_numbers::<N, I, P, W>();
    let (mut light, mut instance, mut path) = (INVALID, INVALID, Path::default());
    if taken > 0 && (random.high >> (32 - FULL_BITS)) < taken {
        // The numbers below `taken` are all numbers halved so often.
        let stretched = random.shifted(I::UNIFORM_HALVINGS);
        (light, instance) = uniform(tree, stretched);
        path = tree.path_of(mesh_light_of(tree, light, instance), instance);
    }
    Started {
        walk: Walk::start(tree, point, random, taken, light != INVALID, path),
        light,
        instance,
    }
}

impl<'a, N, P: Receiver> Started<'a, N, P> {
    /// The light at the end of the walk.
    #[inline(always)]
    pub fn end<I: ImportanceModel<N, W, P>, const W: usize>(
        &self,
        tree: &LightTree<'a, N, I, W>,
    ) -> SampledLight
    where
        N: Node<W>,
    {
        let walk = &self.walk;
        let chosen = self.light != INVALID;
        // The path of an instance that is not in the tree yet leads to another one.
        let reached = (walk.triangle != INVALID) & (!chosen | (walk.instance == self.instance));
        let instance = if chosen { self.instance } else { walk.instance };
        let light = if chosen {
            self.light
        } else {
            light_of(tree, walk.triangle, walk.instance)
        };
        let by_tree = if reached { walk.probability() } else { 0.0 };
        let pmf = by_tree + uniform_probability::<N, I, P, W>(tree, instance);
        if chosen | reached {
            SampledLight { light, instance, pmf }
        } else {
            SampledLight::NONE
        }
    }
}

/// See [`LightTree::pmf`].
#[inline(always)]
pub(super) fn pmf<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    point: &P,
    light: u32,
    instance: u32,
) -> f32 {
    // A single level has one instance, whichever is named.
    let instance = if tree.live > 0 { instance } else { INVALID };
    let triangle = mesh_light_of(tree, light, instance);
    let path = tree.path_of(triangle, instance);
    let number = Random64 { high: 0, low: 0 };
    let taken = uniform_numbers::<N, I, P, W>();
    let mut walk = Walk::start(tree, point, number, taken, true, path);
    let mut done = walk.done;
    while !done {
        walk.step(tree, point);
        done = walk.done;
    }
    let found = (walk.triangle == triangle) & (walk.instance == instance) & (triangle != INVALID);
    let by_tree = if found { walk.probability() } else { 0.0 };
    let uniform = uniform_probability::<N, I, P, W>(tree, instance);
    if is_light(tree, light, instance) {
        by_tree + uniform
    } else {
        0.0
    }
}

/// A light out of all alike, and its instance: out of all instances alike, and out of the instance's lights alike. That needs
/// no table of lights, which would have to change whenever an instance comes or goes.
#[inline(always)]
fn uniform<N, I, const W: usize>(tree: &LightTree<'_, N, I, W>, random: Random64) -> (u32, u32) {
    let (mut light, mut found) = (INVALID, INVALID);
    if tree.live > 0 {
        let (entry, rest) = random.pick(tree.live);
        if entry < tree.instances.len() as u32 {
            let instance = tree.instances[entry as usize].listed;
            if instance < tree.instances.len() as u32 {
                let own = &tree.instances[instance as usize];
                if own.count > 0 {
                    light = own.first.wrapping_add(rest.pick(own.count).0);
                    found = instance;
                }
            }
        }
    } else if tree.lights > 0 {
        light = random.pick(tree.lights).0;
    }
    (light, found)
}

/// The probability of a light of `instance` by a uniform choice, times the share of such choices.
#[inline(always)]
fn uniform_probability<N: Node<W>, I: ImportanceModel<N, W, P>, P, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    instance: u32,
) -> f32 {
    let taken = uniform_numbers::<N, I, P, W>();
    let mut probability = 0.0;
    if taken > 0 {
        let within = tree.live > 0 && instance < tree.instances.len() as u32;
        let own = if within {
            tree.instances[instance as usize].count
        } else {
            tree.lights
        };
        let share = taken as i32 as f32 * exact::pow2(-(FULL_BITS as i32));
        probability = div(div(share, at_least_one(own)), at_least_one(tree.live));
    }
    probability
}

/// A count to divide by. It stays below 2^31, also in malformed words: conversions from `u32` above are wrong on one device.
#[inline(always)]
fn at_least_one(count: u32) -> f32 {
    let bounded = count & 0x7fff_ffff;
    (if bounded > 0 { bounded } else { 1 }) as i32 as f32
}

#[inline(always)]
fn mesh_light_of<N, I, const W: usize>(tree: &LightTree<'_, N, I, W>, light: u32, instance: u32) -> u32 {
    if instance < tree.instances.len() as u32 && tree.live > 0 {
        tree.instances[instance as usize].triangle_of(light)
    } else {
        light
    }
}

#[inline(always)]
pub(super) fn light_of<N, I, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    triangle: u32,
    instance: u32,
) -> u32 {
    if instance < tree.instances.len() as u32 {
        tree.instances[instance as usize].light_of(triangle)
    } else {
        triangle
    }
}

/// Whether there is such a light.
#[inline(always)]
fn is_light<N, I, const W: usize>(tree: &LightTree<'_, N, I, W>, light: u32, instance: u32) -> bool {
    let mut known = false;
    if tree.live > 0 {
        if instance < tree.instances.len() as u32 {
            let own = &tree.instances[instance as usize];
            known = light.wrapping_sub(own.first) < own.count;
        }
    } else {
        known = light < tree.lights;
    }
    known
}
