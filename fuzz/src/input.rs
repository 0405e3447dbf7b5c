//! Lights, points and nodes from the fuzzer's bytes.

use arbitrary::{Error, Result, Unstructured};
use lightbvh::exact::pow2;
use lightbvh::{BuildParams, CompactNode, EmissiveTriangle, Heuristic, LightNode, Lights, ShadingPoint};

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
    let heuristic = if u.arbitrary()? {
        Heuristic::Sah
    } else {
        Heuristic::Saoh
    };
    let buckets = u32::from(u.arbitrary::<u8>()? % 40);
    Ok(BuildParams { heuristic, buckets })
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
    let mut triangles = lights.triangles().to_vec();
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
    let mut moved = lights.clone();
    moved.update(triangles).map_err(|_| Error::IncorrectFormat)?;
    Ok(moved)
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
pub fn node(u: &mut Unstructured<'_>) -> Result<CompactNode<2>> {
    let words: [u32; 14] = u.arbitrary()?;
    let mut node: CompactNode<2> = bytemuck::cast(words);
    if u.arbitrary()? {
        for slot in 0..2 {
            let bounds = node.bounds(slot);
            let links: u8 = u.arbitrary()?;
            node.set_child(slot, u32::from(links & 3), u32::from(links >> 2 & 15));
            node.set_bounds(slot, &bounds);
        }
    }
    Ok(node)
}
