//! From a scene to what the backends run: arrays of a frame, light BVHs, queries.

use lightbvh::exact::hash;
use lightbvh::light::Light;
use lightbvh::tree::Model;
use lightbvh::{BuildParams, Bvh, INVALID, Lights, Random64, ShadingPoint};
use lightbvh_kernels::query::Query;
use lightbvh_kernels::render::RenderParams;

use crate::backend::{Sampler, SceneArrays};
use crate::error::HostError;
use crate::render::{RayBvh, camera};
use crate::scene::{Scene, SceneLight, TextureArrays};
use crate::stability::random::Random;
use crate::vector::{dot, normal};

/// Parameters of an image of this size, lit by single candidates.
pub const fn render_params(
    (width, height): (u32, u32),
    samples: u32,
    seed: u32,
    background: [f32; 3],
) -> RenderParams {
    RenderParams {
        width,
        height,
        samples,
        first: 0,
        all: 0,
        candidates: 1,
        part: 0,
        parts: 1,
        seed,
        jitter: 0,
        background,
    }
}

/// The emissive triangles of `scene` at `frame`.
pub fn lights_at(scene: &Scene, frame: u32) -> Result<Lights, HostError> {
    lights_of(scene, frame)
}

/// The lights of `scene` at `frame` that type `L` holds.
pub fn lights_of<L: SceneLight>(scene: &Scene, frame: u32) -> Result<Lights<L>, HostError> {
    listed(scene, frame, scene.frame(frame).lights())
}

fn listed<L: SceneLight>(scene: &Scene, frame: u32, lights: Vec<L>) -> Result<Lights<L>, HostError> {
    match L::IS_ANY {
        true => scene.require_any_light()?,
        false => scene.require_lights()?,
    }
    Lights::new(lights).map_err(|error| HostError::in_frame(scene.name(), frame, error))
}

/// The arrays of `scene` at `frame` for an image of `width` × `height`, lit by its emissive triangles.
pub fn arrays_at(scene: &Scene, frame: u32, width: u32, height: u32) -> Result<SceneArrays, HostError> {
    arrays_lit_by(scene, frame, width, height)
}

/// [`arrays_at`], lit by all lights that type `L` holds.
pub fn arrays_lit_by<L: SceneLight>(
    scene: &Scene,
    frame: u32,
    width: u32,
    height: u32,
) -> Result<SceneArrays<L>, HostError> {
    let data = scene.frame(frame);
    let lights = listed(scene, frame, data.lights())?;
    let rays =
        RayBvh::build(&data.triangles).map_err(|error| HostError::in_frame(scene.name(), frame, error))?;
    let textures = if L::IS_ANY {
        data.textures(&rays)
    } else {
        TextureArrays::default()
    };
    let camera = camera(&data.camera, width, height);
    Ok(SceneArrays::new(rays, data.materials, lights, camera).textured(textures))
}

/// The light BVH that `sampler` walks; the other samplers walk none and get the two-level one.
pub fn build<M: Model<W>, const W: usize>(
    lights: &Lights<M::Light>,
    sampler: Sampler,
    params: &BuildParams,
) -> Bvh<M, W> {
    match sampler {
        Sampler::SingleLevel => Bvh::single_level(lights, params),
        _ => Bvh::two_level(lights, params),
    }
}

/// The instance of light `light` in a BVH that was built over `lights`: what a pmf is asked for beside the light.
pub fn instance_of<M: Model<W>, const W: usize>(
    bvh: &Bvh<M, W>,
    lights: &Lights<M::Light>,
    light: u32,
) -> u32 {
    match lights.all().get(light as usize) {
        Some(light) if !bvh.view().is_single_level() => light.mesh(),
        _ => INVALID,
    }
}

/// `count` queries numbered from `first`: most on surfaces of the scene, some in volumes, some anywhere in and around
/// it, a few where arithmetic is hard: on a light, at the origin, far away.
pub fn queries<L: SceneLight>(scene: &SceneArrays<L>, seed: u32, first: u32, count: u32) -> Vec<Query> {
    let surfaces: Vec<Corners> = scene.rays.triangles().map(|(_, triangle)| triangle.p).collect();
    let bounds = bounding_box(&surfaces);
    (first..first.wrapping_add(count))
        .map(|i| query(scene, &surfaces, &bounds, hash(seed ^ hash(i))))
        .collect()
}

/// Of a triangle.
type Corners = [[f32; 3]; 3];

fn query<L: SceneLight>(
    scene: &SceneArrays<L>,
    surfaces: &[Corners],
    bounds: &([f32; 3], [f32; 3]),
    random: u32,
) -> Query {
    let random = &mut Random::new(random);
    let kind = random.unit();
    let lights = scene.lights.all();
    let (mut p, mut n) = if !(0.75..0.98).contains(&kind) {
        let corners = match kind < 0.75 && !surfaces.is_empty() {
            true => surfaces[random.below(surfaces.len() as u32) as usize],
            false => lights[random.below(lights.len() as u32) as usize].corners(),
        };
        let (p, n) = on_triangle(&corners, random.unit(), random.unit());
        let side = if random.below(2) == 0 { -1.0 } else { 1.0 };
        (p, n.map(|x| x * side))
    } else {
        let (low, high) = bounds;
        let p = std::array::from_fn(|k| low[k] + (high[k] - low[k]) * random.between(-0.25, 1.25));
        (p, random.direction())
    };
    if random.below(16) == 0 {
        n = [0.0; 3];
    }
    if kind >= 0.997 {
        p = p.map(|x| x * 1.0e6);
    } else if kind >= 0.995 {
        p = [0.0; 3];
    }
    let number = Random64::from(random.bits());
    Query {
        point: ShadingPoint { p, n },
        words: [number.high, number.low],
    }
}

/// A point of a triangle and its unit normal; an arbitrary normal if it has no area.
pub(crate) fn on_triangle(p: &Corners, u: f32, v: f32) -> ([f32; 3], [f32; 3]) {
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let point = std::array::from_fn(|k| p[0][k] + (p[1][k] - p[0][k]) * u + (p[2][k] - p[0][k]) * v);
    let m = normal(*p);
    let length = dot(m, m).sqrt();
    let n = if length > 0.0 {
        m.map(|x| (x / length) as f32)
    } else {
        [0.0, 1.0, 0.0]
    };
    (point, n)
}

/// Of surfaces; a metre around the origin where there is none.
fn bounding_box(surfaces: &[Corners]) -> ([f32; 3], [f32; 3]) {
    if surfaces.is_empty() {
        return ([-1.0; 3], [1.0; 3]);
    }
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for p in surfaces.iter().flatten() {
        for k in 0..3 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    (low, high)
}
