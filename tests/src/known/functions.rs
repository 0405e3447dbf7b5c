//! Answers of functions of the core: arithmetic, bounds, the words of a node's slot, importance.

use glam::Vec3;
use lightbvh::importance::{Cluster, Importance};
use lightbvh::node::kind;
use lightbvh::{
    CompactNode, EmissiveTriangle, Eq4, FluxOverDistance, ImportanceModel, Instance, LightBounds, LightNode,
    MeshLeaf, Receiver, ShadingPoint, exact,
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

fn of_lights(name: &str, input: &[u32]) -> Option<Vec<u32>> {
    Some(match name {
        "triangle_bounds" => words_of(&LightBounds::of_triangle(&record::<EmissiveTriangle>(input))),
        "merge" => words_of(&bounds(&input[..12]).merge(&bounds(&input[12..]))),
        "encode" => encode(&bounds(input)),
        "to_world" => {
            let instance: Instance = record(&input[..24]);
            words_of(&instance.to_world(&bounds(&input[24..])))
        }
        "vertex" => {
            let instance: Instance = record(&input[..24]);
            instance.vertex(record(&input[24..])).map(f32::to_bits).to_vec()
        }
        "inside" => {
            let local = record::<Instance>(&input[..24]).inside(&record::<ShadingPoint>(&input[24..]));
            let (p, n) = (local.position(), local.normal());
            [p.x, p.y, p.z, n.x, n.y, n.z]
                .into_iter()
                .chain([local.slack(), local.near_squared(), local.tilt()])
                .map(f32::to_bits)
                .collect()
        }
        "importance" => {
            let cluster = cluster_of(&input[..14]);
            let point: ShadingPoint = record(&input[14..]);
            both_models(&cluster, &point)
        }
        "importance_inside" => {
            let cluster = cluster_of(&input[..14]);
            let local = record::<Instance>(&input[14..38]).inside(&record::<ShadingPoint>(&input[38..]));
            both_models(&cluster, &local)
        }
        _ => return None,
    })
}

fn both_models<R: Receiver>(cluster: &Cluster, point: &R) -> Vec<u32> {
    let words = |i: Importance| [i.significand.to_bits(), i.exponent as u32];
    [
        words(Eq4::importance(cluster, point)),
        words(FluxOverDistance::importance(cluster, point)),
    ]
    .concat()
}

/// The seven words of a slot, the bounds that they decode to, and the cluster that importance sees.
fn encode(bounds: &LightBounds) -> Vec<u32> {
    let mut node = <CompactNode<4> as LightNode<4>>::EMPTY;
    node.set_child(SLOT, kind::LIGHT, 7);
    node.set_bounds(SLOT, bounds);
    let words: [u32; 28] = bytemuck::cast(node);
    let mut out: Vec<u32> = words.chunks_exact(4).map(|field| field[SLOT]).collect();
    out.extend(words_of(&node.bounds(SLOT)));
    out.extend(words_of_cluster(&node.cluster(SLOT)));
    out
}

fn record<T: bytemuck::AnyBitPattern>(words: &[u32]) -> T {
    bytemuck::pod_read_unaligned(bytemuck::cast_slice(words))
}

fn vector(words: &[u32]) -> Vec3 {
    Vec3::new(
        f32::from_bits(words[0]),
        f32::from_bits(words[1]),
        f32::from_bits(words[2]),
    )
}

/// Bounds of twelve words: min, max, axis, cos θ_o, cos θ_e, Φ.
#[must_use]
pub fn bounds(words: &[u32]) -> LightBounds {
    LightBounds {
        min: vector(words),
        max: vector(&words[3..]),
        axis: vector(&words[6..]),
        cos_theta_o: f32::from_bits(words[9]),
        cos_theta_e: f32::from_bits(words[10]),
        phi: f32::from_bits(words[11]),
    }
}

/// The words that [`bounds`] reads.
#[must_use]
pub fn words_of(bounds: &LightBounds) -> Vec<u32> {
    let [a, b, c] = [bounds.min, bounds.max, bounds.axis].map(|v| [v.x, v.y, v.z]);
    let rest = [bounds.cos_theta_o, bounds.cos_theta_e, bounds.phi];
    [a, b, c, rest].concat().into_iter().map(f32::to_bits).collect()
}

fn cluster_of(words: &[u32]) -> Cluster {
    let f = |k: usize| f32::from_bits(words[k]);
    Cluster {
        center: vector(words),
        extent: vector(&words[3..]),
        radius_squared: f(6),
        axis: vector(&words[7..]),
        cos_theta_o: f(10),
        sin_theta_o: f(11),
        cos_theta_e: f(12),
        phi: f(13),
    }
}

/// Fourteen words: centre, half extents, r², axis, cos θ_o, sin θ_o, cos θ_e, Φ.
#[must_use]
pub fn words_of_cluster(cluster: &Cluster) -> Vec<u32> {
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
