//! Answers of functions of the core: arithmetic, summaries of lights, the words of nodes, weights.

use lightbvh::importance::Cluster;
use lightbvh::node::kind;
use lightbvh::summary::{Lanes, SUMMARY_WORDS};
use lightbvh::{
    BoundsNode, CompactNode, EmissiveTriangle, Eq4, FluxOverDistance, ImportanceModel, Instance, LightBounds,
    LightMoments, MomentNode, Moments, Node, ShadingPoint, Summary, exact,
};

use super::file::{Answer, File};

/// The slot of a node of four that `encode` writes.
const SLOT: usize = 2;

/// Answers all tables of a file whose tables are named after functions.
///
/// # Panics
/// If a table is named after none.
#[must_use]
pub fn answer(file: &File) -> Vec<Answer> {
    file.tables
        .iter()
        .map(|table| Answer {
            table: table.name.clone(),
            words: table
                .rows()
                .flat_map(|row| {
                    let input = &row[..table.inputs];
                    arithmetic(&table.name, input)
                        .map(|word| vec![word])
                        .or_else(|| of_lights(&table.name, input))
                        .unwrap_or_else(|| panic!("{}.txt: no function `{}`", file.name, table.name))
                })
                .collect(),
        })
        .collect()
}

/// The exact arithmetic; of division and square root also the form that devices run, which must agree.
fn arithmetic(name: &str, input: &[u32]) -> Option<u32> {
    let f = |k: usize| f32::from_bits(input[k]);
    let agreed = |shared: f32, emulated: f32| {
        assert_eq!(
            shared.to_bits(),
            emulated.to_bits(),
            "{name}: two forms of {input:08x?}"
        );
        shared
    };
    let float = match name {
        "div" => agreed(exact::div(f(0), f(1)), exact::div_emulated(f(0), f(1))),
        "sqrt" => agreed(exact::sqrt(f(0)), exact::sqrt_emulated(f(0))),
        "recip" => exact::recip(f(0)),
        "recip_rough" => exact::recip_rough(f(0)),
        "rsqrt" => exact::rsqrt(f(0)),
        "rsqrt_rough" => exact::rsqrt_rough(f(0)),
        "min" => exact::min(f(0), f(1)),
        "max" => exact::max(f(0), f(1)),
        "clamp" => exact::clamp(f(0), f(1), f(2)),
        "abs" => exact::abs(f(0)),
        "flush" => exact::flush(f(0), f(1)),
        "significand" => exact::significand(f(0)),
        "pow2" => exact::pow2(input[0] as i32),
        "unit_f32" => exact::unit_f32(input[0]),
        "add" => f(0) + f(1),
        "sub" => f(0) - f(1),
        "mul" => f(0) * f(1),
        "multiply_add" => f(0) * f(1) + f(2),
        "floor_u32" => return Some(exact::floor_u32(f(0))),
        "floor_small" => return Some(exact::floor_small(f(0))),
        "order_key" => return Some(exact::order_key(f(0))),
        "exponent" => return Some(exact::exponent(f(0)) as u32),
        "hash" => return Some(exact::hash(input[0])),
        _ => return None,
    };
    Some(float.to_bits())
}

/// Words of an instance.
const INSTANCE: usize = size_of::<Instance>() / 4;

fn of_lights(name: &str, input: &[u32]) -> Option<Vec<u32>> {
    let instance = || record::<Instance>(&input[..INSTANCE]);
    Some(match name {
        "triangle_bounds" => words_of(&LightBounds::of_triangle(&record::<EmissiveTriangle>(input))),
        "triangle_moments" => words_of(&LightMoments::of_triangle(&record::<EmissiveTriangle>(input))),
        "merge_bounds" => words_of(&LightBounds::merged(&Lanes::of(&summaries::<LightBounds, 4>(
            input,
        )))),
        "merge_moments" => words_of(&LightMoments::merged(&Lanes::of(&summaries::<LightMoments, 8>(
            input,
        )))),
        "bounds_to_world" => words_of(
            &summary::<LightBounds>(&input[INSTANCE..]).to_world::<lightbvh::EmissiveTriangle>(&instance()),
        ),
        "moments_to_world" => words_of(
            &summary::<LightMoments>(&input[INSTANCE..]).to_world::<lightbvh::EmissiveTriangle>(&instance()),
        ),
        "encode_bounds" => encode_bounds(&summary(input)),
        "encode_moments" => {
            let node = node::<MomentNode<8>, 8>(input);
            let mut out = bytemuck::cast_slice::<_, u32>(&[node]).to_vec();
            out.extend((0..8).flat_map(|slot| words_of(&node.summary(slot))));
            out
        }
        "vertex" => {
            let vertex = instance().vertex(record(&input[INSTANCE..]));
            vertex.map(f32::to_bits).to_vec()
        }
        "to_local" => {
            let local = instance().to_local(&record::<ShadingPoint>(&input[INSTANCE..]));
            bytemuck::cast_slice(&[local]).to_vec()
        }
        "eq4" => weights::<CompactNode<4>, Eq4, 4>(input),
        "moments" => weights::<MomentNode<8>, Moments, 8>(input),
        "flux_over_distance" => weights::<CompactNode<4>, FluxOverDistance, 4>(input),
        _ => return None,
    })
}

/// Weights of the children of a node with the summaries that come first, at the point that comes after them.
fn weights<N: Node<W>, I: ImportanceModel<N, W>, const W: usize>(input: &[u32]) -> Vec<u32> {
    let point = record::<ShadingPoint>(&input[W * SUMMARY_WORDS..]);
    I::weights(&node::<N, W>(input), &point)
        .map(f32::to_bits)
        .to_vec()
}

/// A node of lights with these summaries.
fn node<N: Node<W>, const W: usize>(words: &[u32]) -> N {
    let mut node = N::EMPTY;
    for slot in 0..W {
        node.set_child(slot, kind::LIGHT, slot as u32);
    }
    node.set_summaries(&summaries(words));
    node
}

/// The seven words of a slot, the bounds that they decode to, and the cluster that importance sees.
fn encode_bounds(bounds: &LightBounds) -> Vec<u32> {
    let mut node = <CompactNode<4> as Node<4>>::EMPTY;
    node.set_child(SLOT, kind::LIGHT, 7);
    let mut children = [LightBounds::EMPTY; 4];
    children[SLOT] = *bounds;
    node.set_summaries(&children);
    let words: [u32; 28] = bytemuck::cast(node);
    let mut out: Vec<u32> = words.chunks_exact(4).map(|field| field[SLOT]).collect();
    out.extend(words_of(&node.summary(SLOT)));
    out.extend(words_of_cluster(&node.cluster(SLOT)));
    out
}

fn record<T: bytemuck::AnyBitPattern>(words: &[u32]) -> T {
    bytemuck::pod_read_unaligned(bytemuck::cast_slice(words))
}

/// A summary of twelve words.
fn summary<S: Summary>(words: &[u32]) -> S {
    S::from_words(&std::array::from_fn(|i| f32::from_bits(words[i])))
}

fn summaries<S: Summary, const W: usize>(words: &[u32]) -> [S; W] {
    std::array::from_fn(|slot| summary(&words[slot * SUMMARY_WORDS..]))
}

/// The words of a summary.
#[must_use]
pub fn words_of<S: Summary>(summary: &S) -> Vec<u32> {
    summary.to_words().map(f32::to_bits).to_vec()
}

/// Fourteen words: centre, half extents, r², axis, cos θ_o, sin θ_o, cos θ_e, Φ.
fn words_of_cluster(cluster: &Cluster) -> Vec<u32> {
    let (c, e, a) = (cluster.center, cluster.extent, cluster.axis);
    [
        c.x,
        c.y,
        c.z,
        e.x,
        e.y,
        e.z,
        cluster.radius_squared,
        a.x,
        a.y,
        a.z,
    ]
    .into_iter()
    .chain([
        cluster.cos_theta_o,
        cluster.sin_theta_o,
        cluster.cos_theta_e,
        cluster.phi,
    ])
    .map(f32::to_bits)
    .collect()
}
