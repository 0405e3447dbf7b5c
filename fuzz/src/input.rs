//! Lights, points and nodes from the fuzzer's bytes.

use lightbvh::tree::Model;
use arbitrary::{Error, Result, Unstructured};
use lightbvh::exact::pow2;
use lightbvh::{
    BuildParams, Bvh, EmissiveTriangle, Heuristic, INVALID, ImportanceModel, LightNode, Lights, ShadingPoint,
    Summary,
};

/// Most triangles of an input: enough for several levels.
const MOST: u8 = 40;
/// Most triangles of most inputs: few enough for many runs per second.
const USUAL: u8 = 12;

/// How coordinates come about.
#[derive(Clone, Copy)]
pub enum Coordinates {
    /// Whole multiples of a power of two, few of them: much coincides, is collinear or has no area.
    Grid(f32),
    /// Any magnitude of the domain.
    Wide,
}

impl Coordinates {
    /// One of the two, with its step.
    pub fn choose(u: &mut Unstructured<'_>) -> Result<Self> {
        if u.arbitrary()? {
            Ok(Self::Grid(pow2(u.int_in_range(-60..=30)?)))
        } else {
            Ok(Self::Wide)
        }
    }

    fn one(self, u: &mut Unstructured<'_>) -> Result<f32> {
        match self {
            Self::Grid(step) => Ok(f32::from(u.int_in_range(-4_i8..=4)?) * step),
            Self::Wide => {
                let significand = f32::from(u.arbitrary::<i16>()?) * pow2(-15);
                Ok(significand * pow2(u.int_in_range(-80..=39)?))
            }
        }
    }

    /// A vertex, or a vector.
    pub fn vertex(self, u: &mut Unstructured<'_>) -> Result<[f32; 3]> {
        Ok([self.one(u)?, self.one(u)?, self.one(u)?])
    }
}

/// Build parameters, also outside of their range.
pub fn params(u: &mut Unstructured<'_>) -> Result<BuildParams> {
    let bits: u8 = u.arbitrary()?;
    let heuristic = [Heuristic::Saoh, Heuristic::Sah, Heuristic::Ward][usize::from(bits & 3).min(2)];
    let buckets = u32::from(u.arbitrary::<u8>()? % 40);
    Ok(BuildParams {
        heuristic,
        buckets,
        opens: bits & 8 == 0,
    })
}

/// Zero, or a power of two of the domain.
fn radiance(u: &mut Unstructured<'_>) -> Result<f32> {
    let e = u.int_in_range(-101..=100)?;
    Ok(if e < -100 { 0.0 } else { pow2(e) })
}

/// Number of triangles: seldom more than the usual.
fn count(u: &mut Unstructured<'_>) -> Result<u8> {
    const MANY: u8 = u8::MAX - MOST + 1;
    let byte: u8 = u.arbitrary()?;
    Ok(1 + if byte < MANY { byte % USUAL } else { byte - MANY })
}

/// Triangles within the domain, in mesh lights of any sizes.
pub fn triangles(u: &mut Unstructured<'_>) -> Result<Vec<EmissiveTriangle>> {
    let coordinates = Coordinates::choose(u)?;
    let count = count(u)?;
    triangles_within(u, coordinates, count)
}

/// `count` triangles within the domain, in mesh lights of any sizes.
pub fn triangles_within(
    u: &mut Unstructured<'_>,
    coordinates: Coordinates,
    count: u8,
) -> Result<Vec<EmissiveTriangle>> {
    let mut mesh = 0;
    (0..count)
        .map(|i| {
            let p = [
                coordinates.vertex(u)?,
                coordinates.vertex(u)?,
                coordinates.vertex(u)?,
            ];
            let radiance = [radiance(u)?, radiance(u)?, radiance(u)?];
            let bits: u8 = u.arbitrary()?;
            mesh += u32::from(i > 0 && bits & 6 == 0);
            Ok(EmissiveTriangle {
                p,
                radiance,
                mesh,
                flags: u32::from(bits & 1),
            })
        })
        .collect()
}

/// Triangles of any words.
pub fn any_triangles(u: &mut Unstructured<'_>) -> Result<Vec<EmissiveTriangle>> {
    (0..u.int_in_range(0..=4)?)
        .map(|_| {
            let words: [u32; 14] = u.arbitrary()?;
            Ok(bytemuck::cast(words))
        })
        .collect()
}

/// Accepted lights.
pub fn lights(u: &mut Unstructured<'_>) -> Result<Lights> {
    Lights::new(triangles(u)?).map_err(|_| Error::IncorrectFormat)
}

/// The same mesh lights with some triangles elsewhere, or of other radiance.
pub fn moved(u: &mut Unstructured<'_>, lights: &Lights) -> Result<Lights> {
    let coordinates = Coordinates::choose(u)?;
    let mut triangles = lights.all().to_vec();
    for triangle in &mut triangles {
        match u.arbitrary::<u8>()? % 4 {
            0 => {
                triangle.p = [
                    coordinates.vertex(u)?,
                    coordinates.vertex(u)?,
                    coordinates.vertex(u)?,
                ]
            }
            1 => triangle.radiance = [radiance(u)?; 3],
            2 => triangle.p.swap(1, 2),
            _ => {}
        }
    }
    Lights::new(triangles).map_err(|_| Error::IncorrectFormat)
}

/// A point on a light, beside one, or anywhere; with a normal along an axis, across one, or none.
pub fn point(u: &mut Unstructured<'_>, lights: &[EmissiveTriangle]) -> Result<ShadingPoint> {
    let coordinates = Coordinates::choose(u)?;
    let near = u.choose(lights)?.p[0];
    let p = match u.arbitrary::<u8>()? % 3 {
        0 => near,
        1 => {
            let by = coordinates.vertex(u)?;
            [near[0] + by[0], near[1] + by[1], near[2] + by[2]]
        }
        _ => coordinates.vertex(u)?,
    };
    let n = u.choose(&[
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, -1.0],
        [0.6, 0.0, 0.8],
        [-0.6, 0.64, 0.48],
    ])?;
    Ok(ShadingPoint {
        p: p.map(|x| x.clamp(-pow2(40), pow2(40))),
        n: *n,
    })
}

/// A point of any words.
pub fn any_point(u: &mut Unstructured<'_>) -> Result<ShadingPoint> {
    let words: [u32; 6] = u.arbitrary()?;
    Ok(bytemuck::cast(words))
}

/// A node of any words, or with links that mostly lead to one of eight nodes.
pub fn node<N: LightNode<W>, const W: usize>(u: &mut Unstructured<'_>) -> Result<N> {
    let words: Vec<u32> = (0..size_of::<N>() / 4)
        .map(|_| u.arbitrary())
        .collect::<Result<_>>()?;
    let mut node: N = bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words));
    if u.arbitrary()? {
        let summaries = std::array::from_fn(|slot| node.summary(slot));
        for slot in 0..W {
            let links: u8 = u.arbitrary()?;
            node.set_child(slot, u32::from(links & 3), u32::from(links >> 2 & 15));
        }
        node.set_summaries(&summaries);
    }
    Ok(node)
}

/// Whether a light has flux, as nodes of layout `N` know it.
pub fn shines<N: LightNode<W>, const W: usize>(triangle: &EmissiveTriangle) -> bool {
    N::Summary::of_light(triangle).phi() > 0.0
}

/// By how much a sum of pmfs of `lights` may be off 1, where a share of 2^-`halvings` is uniform, if any.
///
/// Those of a tree are shares of numbers, so their sum is 1 but for the rounding of the sum itself, at most 2^-54 for each
/// light, and for shares below 2^-98, which count as at least 2^-99. A uniform share s is divided twice, each time within
/// 2^-24, and added to the tree's within 2^-24.
pub fn sum_tolerance(lights: usize, halvings: u32) -> f64 {
    let uniform = if halvings > 0 {
        (1.0 + 2.0 * 0.5f64.powi(halvings as i32)) * 2f64.powi(-24)
    } else {
        0.0
    };
    lights as f64 * 2f64.powi(-53) + uniform
}

/// Asserts that pmfs are probabilities, and sum to one.
pub fn sum_is_one(pmfs: &[f32], halvings: u32, point: &ShadingPoint) {
    for pmf in pmfs {
        assert!((0.0..=1.0).contains(pmf), "pmf {pmf} at {point:?}");
    }
    let off = (pmfs.iter().map(|&pmf| f64::from(pmf)).sum::<f64>() - 1.0).abs();
    let (count, tolerance) = (pmfs.len(), sum_tolerance(pmfs.len(), halvings));
    assert!(
        off <= tolerance,
        "the sum of {count} is off by {off:e}, at most {tolerance:e}, at {point:?}"
    );
}

/// The probability of light `light` of a BVH that was built over `lights`.
pub fn pmf_of<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<impl Model<W, Node = N, Light = EmissiveTriangle>, W>,
    lights: &Lights,
    point: &ShadingPoint,
    light: u32,
) -> f32 {
    let instance = match lights.all().get(light as usize) {
        Some(triangle) if !bvh.view().is_single_level() => triangle.mesh,
        _ => INVALID,
    };
    bvh.tree().by::<I>().pmf(point, light, instance)
}
