//! What a scene is made of.

use lightbvh_kernels::shading::material::Material as SurfaceMaterial;

use super::analytic::AnalyticLight;
use super::textures::{MaterialTextures, Picture};
use super::transform::Transform;

/// Everything a scene is made of, unchecked, open for construction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneData {
    /// Built-in name or path of the file.
    pub name: String,
    /// Parents before their children.
    pub nodes: Vec<Node>,
    /// Meshes, placed by nodes, any number of times each.
    pub meshes: Vec<Mesh>,
    /// Materials, named by primitives.
    pub materials: Vec<Material>,
    /// All animations run at once, each looping over its own duration.
    pub animations: Vec<Animation>,
    /// The first one is the one that frames are seen from; a scene has one.
    pub cameras: Vec<Camera>,
    /// Lights by formula.
    pub analytic: Vec<AnalyticLight>,
    /// Named by textures.
    pub pictures: Vec<Picture>,
    /// Radiance of rays that leave the scene, W/(m² sr), linear RGB.
    pub background: [f32; 3],
    /// What the loader left out, one sentence each.
    pub warnings: Vec<String>,
}

impl SceneData {
    /// Whether any material has textures or cut-outs.
    pub fn has_textures(&self) -> bool {
        self.materials
            .iter()
            .any(|material| material.textures.as_ref().is_some_and(MaterialTextures::is_seen))
    }
}

/// One place in the hierarchy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Node {
    /// For messages; need not be unique.
    pub name: String,
    /// Index into [`SceneData::nodes`], below the node's own index.
    pub parent: Option<u32>,
    /// Relative to the parent.
    pub transform: Transform,
    /// Index into [`SceneData::meshes`].
    pub mesh: Option<u32>,
}

/// Primitives that move together.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// For messages and for the names of mesh lights.
    pub name: String,
    /// One material each.
    pub primitives: Vec<Primitive>,
}

/// Indexed triangles of one material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Primitive {
    /// Metres, in the node's space; each coordinate within ±2^40.
    pub positions: Vec<[f32; 3]>,
    /// Vertex indices, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`SceneData::materials`].
    pub material: u32,
    /// Radiance of each triangle where an emissive texture makes them differ; replaces the material's.
    pub radiance: Option<Vec<[f32; 3]>>,
    /// Texture coordinates of each vertex, where the material has textures that lie by them.
    pub coordinates: Option<Vec<[f32; 2]>>,
}

/// How a surface reflects and emits.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// For messages.
    pub name: String,
    /// Linear RGB, each in [0, 1].
    pub base_color: [f32; 3],
    /// Emitted radiance, W/(m² sr), linear RGB, emissive strength included; not negative.
    pub radiance: [f32; 3],
    /// Whether the back side reflects and emits too.
    pub double_sided: bool,
    /// In [0, 1].
    pub metallic: f32,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// Its textures, of which the fields above are the means. Where the reference renderer does not show it, the
    /// surface is opaque.
    pub textures: Option<MaterialTextures>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::from("default"),
            base_color: [1.0; 3],
            radiance: [0.0; 3],
            double_sided: false,
            metallic: 0.0,
            roughness: 1.0,
            textures: None,
        }
    }
}

impl Material {
    /// The reference renderer's two lobes.
    pub fn surface(&self) -> SurfaceMaterial {
        SurfaceMaterial::of(self.base_color, self.metallic, self.roughness)
    }
}

/// Channels that share a clock.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// For messages.
    pub name: String,
    /// Its place in the file, from 0.
    pub place: u32,
    /// The channels, one for each animated property.
    pub channels: Vec<Channel>,
}

impl Animation {
    /// Its number and its name, so that a terminal shows it as it is, and not all of a long one.
    pub(super) fn shown(&self) -> String {
        let name = self.name.chars().take(80).collect::<String>();
        format!("animation {} \"{}\"", self.place, name.escape_debug())
    }

    /// Time of the last key of any channel, in seconds; the animation starts again there.
    pub fn duration(&self) -> f32 {
        let ends = self
            .channels
            .iter()
            .filter_map(|channel| channel.times.last().copied());
        ends.fold(0.0, f32::max)
    }
}

/// Keys for one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Index into [`SceneData::nodes`]; the node's transform must be [`Transform::Trs`].
    pub node: u32,
    /// What the values replace.
    pub property: Property,
    /// How values between keys are found.
    pub interpolation: Interpolation,
    /// Seconds, not negative, ascending.
    pub times: Vec<f32>,
    /// A row of the property's numbers for each key; for [`Interpolation::CubicSpline`] rows of in-tangents, values and
    /// out-tangents for each key.
    pub values: Vec<f32>,
}

/// What a channel replaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Metres.
    Translation,
    /// Quaternion `[x, y, z, w]`.
    Rotation,
    /// Factors.
    Scale,
}

impl Property {
    /// Numbers in a row of values.
    pub fn numbers(self) -> usize {
        match self {
            Self::Translation | Self::Scale => 3,
            Self::Rotation => 4,
        }
    }
}

/// glTF 2.0, appendix C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The last key's value.
    Step,
    /// Straight lines; spherical for rotations.
    Linear,
    /// Hermite splines with given tangents.
    CubicSpline,
}

/// A perspective camera on a node, looking along the node's -Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Index into [`SceneData::nodes`].
    pub node: u32,
    /// Vertical field of view, radians, in (0, π).
    pub yfov: f32,
}

impl Primitive {
    /// Whether triangle `index` emits, given its material's radiance.
    pub(super) fn triangle_radiance(&self, index: usize, of_material: [f32; 3]) -> [f32; 3] {
        self.radiance
            .as_ref()
            .map_or(of_material, |radiance| radiance[index])
    }
}

/// Whether any channel is above zero.
pub(super) fn emits(radiance: [f32; 3]) -> bool {
    radiance.iter().any(|&channel| channel > 0.0)
}
