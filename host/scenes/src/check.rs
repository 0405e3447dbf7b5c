//! The checked constructor: what a scene must be before anything is built on it.

use std::ops::RangeInclusive;

use glam::DVec3;
use lightbvh::light::{MAX_COORDINATE, MAX_RADIANCE};

use super::analytic::{AnalyticKind, AnalyticLight};
use super::animate::Pose;
use super::camera::around;
use super::error::{SceneError, malformed};
use super::flush::flush_tiny;
use super::model::{Channel, Interpolation, Material, Mesh, Node, Primitive, SceneData, emits};
use super::scene::{Counts, Scene};
use super::textures::{MAX_SIDE, MaterialTextures, Picture};
use super::transform::Transform;

/// Most triangles of a frame, over all instances: 2^26, some 3 GiB of records, well inside 32-bit indices.
pub const MAX_TRIANGLES: u64 = 1 << 26;

const FINITE: RangeInclusive<f32> = f32::MIN..=f32::MAX;
const IS_FINITE: &str = "expected a finite number; repair the model and export it again";
const COORDINATES: RangeInclusive<f32> = -MAX_COORDINATE..=MAX_COORDINATE;
const IS_NEAR: &str = "expected a coordinate within 2^40 metres of the origin";
const IS_SHARE: &str = "expected 0 to 1";

impl Scene {
    /// Checks `data` and wraps it.
    ///
    /// Coordinates and radiances below 2^-100 become +0; texture coordinates are cut to ±2^20. A scene without lights passes; commands that need lights
    /// call [`Scene::require_lights`].
    ///
    /// # Errors
    /// A value that is not finite, negative emission, a vertex beyond ±[`MAX_COORDINATE`] in frame 0, an index out of range, a parent after its child, too many triangles, no triangle at all.
    pub fn new(mut data: SceneData) -> Result<Self, SceneError> {
        flush_tiny(&mut data);
        let check = Check { scene: &data.name };
        for (index, picture) in data.pictures.iter().enumerate() {
            check.picture(index, picture)?;
        }
        for (index, material) in data.materials.iter().enumerate() {
            check.material(index, material)?;
            if let Some(textures) = &material.textures {
                check.textures(index, textures, data.pictures.len())?;
            }
        }
        for (m, mesh) in data.meshes.iter().enumerate() {
            for (p, primitive) in mesh.primitives.iter().enumerate() {
                let name = format!("mesh {m} `{}` primitive {p}", mesh.name);
                check.primitive(&name, primitive, data.materials.len())?;
            }
        }
        check.nodes(&data)?;
        check.animations(&data)?;
        for (index, light) in data.analytic.iter().enumerate() {
            check.analytic(index, light, &data.nodes)?;
        }
        for (index, camera) in data.cameras.iter().enumerate() {
            let node = || format!("node of camera {index}");
            check.index(node, camera.node, data.nodes.len())?;
            let yfov = || format!("vertical field of view of camera {index}");
            let expected = "expected radians above 0 and below pi";
            let below = std::f32::consts::PI.next_down();
            check.within(yfov, &[camera.yfov], f32::MIN_POSITIVE..=below, expected)?;
        }
        check.color(|| String::from("background"), data.background)?;
        let counts = check.count(&data)?;
        let bounds = check.places(&data)?;
        if data.cameras.is_empty() {
            data.look(&around(bounds));
        }
        Ok(Self::from_checked(data, counts))
    }
}

/// The checks, with the name that their errors carry.
struct Check<'a> {
    scene: &'a str,
}

impl Check<'_> {
    fn wrong(&self, problem: String, advice: &str) -> SceneError {
        malformed(format!("scene `{}`", self.scene), problem, advice)
    }

    fn limit(&self, what: &'static str, count: usize, limit: u64) -> Result<(), SceneError> {
        if count as u64 > limit {
            let problem = format!("has {count} {what}, more than the {limit} that fit");
            return Err(self.wrong(problem, "split the scene or use fewer instances"));
        }
        Ok(())
    }

    fn index(&self, element: impl Fn() -> String, index: u32, count: usize) -> Result<(), SceneError> {
        if index as usize >= count {
            let problem = format!("{} is {index}, but there are only {count}", element());
            return Err(self.wrong(problem, "repair the model's references"));
        }
        Ok(())
    }

    fn length(&self, element: impl Fn() -> String, found: usize, expected: usize) -> Result<(), SceneError> {
        if found != expected {
            let problem = format!("{} has {found} entries, expected {expected}", element());
            return Err(self.wrong(problem, "export the scene again"));
        }
        Ok(())
    }

    /// All of `values` in `range`, in which NaN is not.
    fn within<T: PartialOrd + Copy + std::fmt::Display>(
        &self,
        element: impl Fn() -> String,
        values: &[T],
        range: RangeInclusive<T>,
        expected: &str,
    ) -> Result<(), SceneError> {
        match values.iter().find(|value| !range.contains(value)) {
            Some(value) => Err(self.wrong(format!("{} is {value}", element()), expected)),
            None => Ok(()),
        }
    }

    fn finite(&self, element: impl Fn() -> String, values: &[f32]) -> Result<(), SceneError> {
        self.within(element, values, FINITE, IS_FINITE)
    }

    fn color(&self, element: impl Fn() -> String, rgb: [f32; 3]) -> Result<(), SceneError> {
        let expected = "expected 0 to 2^100: light cannot be negative, and brighter light needs a lower emissive strength";
        self.within(element, &rgb, 0.0..=MAX_RADIANCE, expected)
    }

    fn material(&self, index: usize, material: &Material) -> Result<(), SceneError> {
        let name = |what: &str| format!("{what} of material {index} `{}`", material.name);
        self.color(|| name("radiance"), material.radiance)?;
        self.within(|| name("base colour"), &material.base_color, 0.0..=1.0, IS_SHARE)?;
        self.within(|| name("metallic"), &[material.metallic], 0.0..=1.0, IS_SHARE)?;
        self.within(|| name("roughness"), &[material.roughness], 0.0..=1.0, IS_SHARE)
    }

    fn picture(&self, index: usize, picture: &Picture) -> Result<(), SceneError> {
        let sides = [picture.width, picture.height];
        let name = || format!("a side of picture {index}");
        self.within(name, &sides, 1..=MAX_SIDE, "expected 1 to 16384 texels")?;
        let texels = picture.width as usize * picture.height as usize;
        let name = || format!("texel bytes of picture {index}");
        self.length(name, picture.texels.len(), 4 * texels)
    }

    fn textures(&self, index: usize, textures: &MaterialTextures, pictures: usize) -> Result<(), SceneError> {
        let name = |what: &str| format!("{what} of the textures of material {index}");
        self.color(|| name("radiance"), textures.radiance)?;
        self.within(
            || name("base colour or opacity"),
            &textures.base,
            0.0..=1.0,
            IS_SHARE,
        )?;
        self.finite(|| name("cutoff"), &[textures.cutoff])?;
        for (what, texture) in textures.all() {
            let picture = || name(&format!("picture of the {what}"));
            self.index(picture, texture.picture, pictures)?;
        }
        Ok(())
    }

    fn primitive(&self, name: &str, primitive: &Primitive, materials: usize) -> Result<(), SceneError> {
        self.index(|| format!("material of {name}"), primitive.material, materials)?;
        for (v, position) in primitive.positions.iter().enumerate() {
            self.within(
                || format!("position {v} of {name}"),
                position,
                COORDINATES,
                IS_NEAR,
            )?;
        }
        let vertices = primitive.positions.len();
        for (t, triangle) in primitive.triangles.iter().enumerate() {
            for &vertex in triangle {
                self.index(|| format!("a vertex of triangle {t} of {name}"), vertex, vertices)?;
            }
        }
        if let Some(radiance) = &primitive.radiance {
            let list = || format!("radiance list of {name}");
            self.length(list, radiance.len(), primitive.triangles.len())?;
            for (t, &rgb) in radiance.iter().enumerate() {
                self.color(|| format!("radiance of triangle {t} of {name}"), rgb)?;
            }
        }
        if let Some(coordinates) = &primitive.coordinates {
            let list = || format!("texture coordinates of {name}");
            self.length(list, coordinates.len(), vertices)?;
        }
        Ok(())
    }

    fn nodes(&self, data: &SceneData) -> Result<(), SceneError> {
        for (n, node) in data.nodes.iter().enumerate() {
            let name = |what: &str| format!("{what} of node {n} `{}`", node.name);
            if let Some(parent) = node.parent {
                // Parents first: the hierarchy cannot have cycles, and one pass composes it.
                self.index(|| name("parent"), parent, n)?;
            }
            if let Some(mesh) = node.mesh {
                self.index(|| name("mesh"), mesh, data.meshes.len())?;
            }
            match &node.transform {
                Transform::Trs {
                    translation,
                    rotation,
                    scale,
                } => {
                    self.finite(|| name("translation"), translation)?;
                    self.finite(|| name("rotation"), rotation)?;
                    self.finite(|| name("scale"), scale)?;
                }
                Transform::Matrix(columns) => self.finite(|| name("matrix"), columns.as_flattened())?,
            }
        }
        Ok(())
    }

    fn animations(&self, data: &SceneData) -> Result<(), SceneError> {
        for animation in &data.animations {
            let own = animation.shown();
            for (c, channel) in animation.channels.iter().enumerate() {
                self.channel(&format!("channel {c} of {own}"), channel, data)?;
            }
        }
        Ok(())
    }

    fn channel(&self, name: &str, channel: &Channel, data: &SceneData) -> Result<(), SceneError> {
        self.index(|| format!("node of {name}"), channel.node, data.nodes.len())?;
        let (times, numbers) = (&channel.times, channel.property.numbers());
        let keys = || format!("number of keys of {name}");
        self.within(keys, &[times.len()], 1..=usize::MAX, "expected at least 1")?;
        self.finite(|| format!("a time of {name}"), times)?;
        if times[0] < 0.0 || times.windows(2).any(|pair| pair[1] < pair[0]) {
            let problem = format!("first time of {name} is {}", times[0]);
            return Err(self.wrong(problem, "expected times from 0 up, in ascending order"));
        }
        let rows = match channel.interpolation {
            Interpolation::CubicSpline => 3 * times.len(),
            Interpolation::Step | Interpolation::Linear => times.len(),
        };
        let values = || format!("value list of {name}");
        self.length(values, channel.values.len(), rows.saturating_mul(numbers))?;
        self.finite(|| format!("a value of {name}"), &channel.values)?;
        let is_movable = matches!(data.nodes[channel.node as usize].transform, Transform::Trs { .. });
        if !is_movable {
            let problem = format!("target of {name} is node {}", channel.node);
            return Err(self.wrong(problem, "expected a node with translation, rotation and scale"));
        }
        Ok(())
    }

    fn analytic(&self, index: usize, light: &AnalyticLight, nodes: &[Node]) -> Result<(), SceneError> {
        let of_light = format!("of light {index} `{}`", light.name);
        self.index(|| format!("node {of_light}"), light.node, nodes.len())?;
        let node = &nodes[light.node as usize].name;
        let name = |what: &str| format!("{what} {of_light} on node {} `{node}`", light.node);
        self.color(|| name("colour"), light.color)?;
        let expected = "expected 0 to 2^100; lower it, or leave the light out";
        let intensity = || name("intensity");
        self.within(intensity, &[light.intensity], 0.0..=MAX_RADIANCE, expected)?;
        if let Some(range) = light.range {
            let expected = "expected 2^-20 to 2^40 metres, or none";
            let near = 2.0_f32.powi(-20);
            self.within(|| name("range"), &[range], near..=MAX_COORDINATE, expected)?;
        }
        if let AnalyticKind::Spot { inner, outer } = light.kind
            && !(inner >= 0.0 && inner <= outer && outer > 0.0 && outer <= std::f32::consts::FRAC_PI_2)
        {
            let problem = format!("{} is {outer}", name("outer angle"));
            let expected = "expected radians above 0, not below the inner angle, up to pi / 2";
            return Err(self.wrong(problem, expected));
        }
        let expected = "expected metres from 1e-9 to 1e9; leave the light out, or scale the scene";
        self.within(|| name("size"), light.kind.half(), 1e-9..=1e9, expected)?;
        let emission = light.color.map(|channel| channel * light.intensity);
        self.color(|| name("emission"), emission)
    }

    /// Vertices of frame 0 are in the domain; light BVHs refuse lights that leave it later. Returns the box around them.
    fn places(&self, data: &SceneData) -> Result<[DVec3; 2], SceneError> {
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let farthest = f64::from(MAX_COORDINATE);
        let pose = Pose::at(data, 0.0);
        for (n, node) in data.nodes.iter().enumerate() {
            let primitives = node
                .mesh
                .map_or(&[][..], |mesh| &data.meshes[mesh as usize].primitives);
            for point in primitives.iter().flat_map(|own| pose.points(n, own)) {
                let element = || format!("coordinate of a vertex of node {n} `{}` in frame 0", node.name);
                self.within(element, &point.to_array(), -farthest..=farthest, IS_NEAR)?;
                bounds = [bounds[0].min(point), bounds[1].max(point)];
            }
        }
        Ok(bounds)
    }

    /// Sizes of every frame, and whether 32-bit indices and memory can hold them.
    fn count(&self, data: &SceneData) -> Result<Counts, SceneError> {
        let add = |a: [usize; 3], b: [usize; 3]| [0, 1, 2].map(|k| a[k].saturating_add(b[k]));
        let of_primitive = |primitive: &Primitive| {
            let material = &data.materials[primitive.material as usize];
            let triangles = primitive.triangles.len();
            let is_lit = |&t: &usize| emits(primitive.triangle_radiance(t, material.radiance));
            let emissive = (0..triangles).filter(is_lit).count();
            [triangles, emissive, usize::from(emissive > 0)]
        };
        let sums = |mesh: &Mesh| mesh.primitives.iter().map(of_primitive).fold([0; 3], add);
        let per_mesh: Vec<[usize; 3]> = data.meshes.iter().map(sums).collect();
        let placed = data.nodes.iter().filter_map(|node| node.mesh);
        let total = placed.map(|mesh| per_mesh[mesh as usize]).fold([0; 3], add);
        let [mut triangles, emissive, mesh_lights] = total;
        for light in &data.analytic {
            triangles = triangles.saturating_add(light.facets());
        }
        self.limit("triangles over all instances", triangles, MAX_TRIANGLES)?;
        if triangles == 0 {
            let mut left_out = data.warnings.join("\n  - ");
            if !left_out.is_empty() {
                left_out.insert_str(0, ". What was left out:\n  - ");
            }
            return Err(SceneError::Empty(self.scene.to_owned(), left_out));
        }
        Ok(Counts {
            triangles,
            emissive,
            mesh_lights,
            analytic: data.analytic.len(),
        })
    }
}
