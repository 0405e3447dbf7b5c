//! An extreme: lights, and points to light.

use lightbvh::{BuildParams, Edit, EmissiveTriangle, Lights, ShadingPoint, Transform};

use super::random::Random;
use crate::backend::Bvh;
use crate::error::HostError;

/// The lights of an extreme.
pub enum Source {
    /// Triangles in the world, for trees of one and of two levels.
    World(Vec<EmissiveTriangle>),
    /// Meshes, and where they stand: mesh, transform, factor on radiance.
    Moving {
        /// Triangles of each mesh.
        meshes: Vec<Vec<EmissiveTriangle>>,
        /// Instances.
        instances: Vec<(usize, Transform, f32)>,
    },
}

/// An extreme to be survived.
pub struct Case {
    /// What is extreme about it.
    pub name: String,
    /// Its lights.
    pub source: Source,
    /// How trees over them are built.
    pub params: BuildParams,
    /// Points to light.
    pub points: Vec<ShadingPoint>,
}

impl Case {
    /// Triangles in the world; points in and about their box and near some of them.
    pub fn new(name: impl Into<String>, triangles: Vec<EmissiveTriangle>) -> Self {
        let random = &mut Random::new(triangles.len() as u32);
        let points = around(&triangles, 16, random);
        Self {
            name: name.into(),
            source: Source::World(triangles),
            params: BuildParams::default(),
            points,
        }
    }

    /// Meshes and instances; points near the instances.
    pub fn moving(
        name: impl Into<String>,
        meshes: Vec<Vec<EmissiveTriangle>>,
        instances: Vec<(usize, Transform, f32)>,
    ) -> Self {
        Self {
            source: Source::Moving { meshes, instances },
            ..Self::new(name, Vec::new())
        }
    }

    /// The same at these points as well.
    pub fn with_points(mut self, points: impl IntoIterator<Item = ShadingPoint>) -> Self {
        self.points.extend(points);
        self
    }

    /// The same at these points alone.
    pub fn at(mut self, points: Vec<ShadingPoint>) -> Self {
        self.points = points;
        self
    }

    /// The same with trees built otherwise.
    pub fn built(mut self, params: BuildParams) -> Self {
        self.params = params;
        self
    }
}

/// A light BVH of moving meshes, and its lights in the world.
pub fn moving_scene(
    name: &str,
    meshes: &[Vec<EmissiveTriangle>],
    instances: &[(usize, Transform, f32)],
    params: &BuildParams,
) -> Result<(Bvh, Lights), HostError> {
    let refused = |error| HostError::in_frame(name, 0, error);
    let mut scene: Bvh = lightbvh::Bvh::new(*params);
    let edits = meshes.iter().map(|triangles| Edit::AddMesh {
        lights: triangles.clone(),
    });
    let ids = scene.apply(edits.collect()).map_err(refused)?.meshes;
    let edits = instances
        .iter()
        .map(|&(mesh, transform, radiance)| Edit::AddInstance {
            mesh: ids[mesh],
            transform,
            radiance: [radiance; 3],
            mask: u32::MAX,
        });
    scene.apply(edits.collect()).map_err(refused)?;
    scene.refit();
    let lights = validated(name, scene.view().world_lights())?;
    Ok((scene, lights))
}

/// Lights in the world as the crate takes them.
pub fn validated(name: &str, triangles: Vec<EmissiveTriangle>) -> Result<Lights, HostError> {
    Lights::new(triangles).map_err(|error| HostError::in_frame(name, 0, error))
}

/// `count` points about the lights: near one of them, at a distance of 2^-8 to 2^4 of its size; or anywhere in a box a
/// little larger than that of all. One in four is in a volume.
pub fn around(lights: &[EmissiveTriangle], count: u32, random: &mut Random) -> Vec<ShadingPoint> {
    if lights.is_empty() {
        return Vec::new();
    }
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for vertex in lights.iter().flat_map(|light| light.p) {
        for k in 0..3 {
            low[k] = low[k].min(vertex[k]);
            high[k] = high[k].max(vertex[k]);
        }
    }
    let most = lightbvh::light::MAX_COORDINATE;
    (0..count)
        .map(|i| {
            let p: [f32; 3] = if i.is_multiple_of(2) {
                let light = &lights[random.below(lights.len() as u32) as usize];
                let size = size(light) * lightbvh::exact::pow2(random.below(13) as i32 - 8);
                let by = random.direction();
                std::array::from_fn(|k| light.p[0][k] + by[k] * size)
            } else {
                std::array::from_fn(|k| low[k] + (high[k] - low[k]) * random.between(-0.25, 1.25))
            };
            let n = if random.below(4) == 0 {
                [0.0; 3]
            } else {
                random.direction()
            };
            ShadingPoint {
                p: p.map(|x| x.clamp(-most, most)),
                n,
            }
        })
        .collect()
}

/// Longest extent of a light along an axis, metres.
fn size(light: &EmissiveTriangle) -> f32 {
    let extent = |k: usize| {
        let of = light.p.map(|v| v[k]);
        of[0].max(of[1]).max(of[2]) - of[0].min(of[1]).min(of[2])
    };
    extent(0).max(extent(1)).max(extent(2))
}
