//! The checked constructor: what a scene must be before anything is built on it.

mod deform;

use lightbvh::light::{MAX_COORDINATE, MAX_RADIANCE};
use lightbvh_kernels::shading::sky::MAX_SUNS;

use super::analytic::AnalyticKind;
use super::clips::named;
use super::error::SceneError;
use super::flush::flush_tiny;
use super::frame::emits;
use super::lamps::Facets;
use super::model::{Animation, Channel, Counts, Interpolation, Material, Primitive, Scene, SceneData};
use super::motion_bounds;
use super::paint::{MAX_SIDE, Opacity, Paint, Picture};
use super::transform::Transform;

/// Most triangles of a frame, over all instances: 2^26, some 3 GiB of records, well inside 32-bit indices.
pub const MAX_TRIANGLES: u64 = 1 << 26;

/// Greatest magnitude of a texture coordinate, and of a number of a texture's transform: 2^20.
pub(super) const MAX_TEXTURE_COORDINATE: f32 = 1_048_576.0;

/// Greatest factor on how far normals bend.
const MAX_BUMP: f32 = 1024.0;

impl Scene {
    /// Checks `data` and wraps it.
    ///
    /// Coordinates and radiances below 2^-100 become +0. A scene without lights passes; commands that need lights
    /// call [`Scene::require_lights`].
    ///
    /// # Errors
    /// A value that is not finite, negative emission, a coordinate that could leave ±[`MAX_COORDINATE`] in any frame, an
    /// index out of range, a parent after its child, too many triangles, no triangle at all.
    pub fn new(mut data: SceneData) -> Result<Self, SceneError> {
        flush_tiny(&mut data);
        let check = Check { scene: &data.name };
        check.limit("nodes", data.nodes.len(), u64::from(u32::MAX))?;
        for (index, picture) in data.pictures.iter().enumerate() {
            check.picture(index, picture)?;
        }
        for (index, material) in data.materials.iter().enumerate() {
            check.material(index, material)?;
            if let Some(paint) = &material.paint {
                check.paint(index, paint, data.pictures.len())?;
            }
        }
        for (m, mesh) in data.meshes.iter().enumerate() {
            for (p, primitive) in mesh.primitives.iter().enumerate() {
                check.primitive(
                    &format!("mesh {m} `{}` primitive {p}", mesh.name),
                    primitive,
                    data.materials.len(),
                )?;
            }
        }
        check.nodes(&data)?;
        check.skins(&data)?;
        check.animations(&data)?;
        for (index, light) in data.analytic.iter().enumerate() {
            check.analytic(index, light, &data.nodes)?;
        }
        for (index, camera) in data.cameras.iter().enumerate() {
            check.index(
                || format!("node of camera {index}"),
                camera.node,
                data.nodes.len(),
            )?;
            if !(camera.yfov > 0.0 && camera.yfov < std::f32::consts::PI) {
                let element = format!("vertical field of view of camera {index}");
                return Err(check.out_of_range(element, camera.yfov, "radians above 0 and below pi"));
            }
        }
        check.color(|| String::from("background"), data.background)?;
        let counts = check.count(&data)?;
        motion_bounds::check(&data)?;
        Ok(Self::from_checked(data, counts))
    }

    /// Shows these animations and no others, where they are sound; else all stays as it was.
    pub(super) fn show(&mut self, animations: Vec<Animation>) -> Result<(), SceneError> {
        let mut data = std::mem::take(&mut self.data);
        let old = std::mem::replace(&mut data.animations, animations);
        let check = Check { scene: &data.name };
        let found = check.animations(&data).and_then(|()| motion_bounds::check(&data));
        if found.is_err() {
            data.animations = old;
        }
        self.data = data;
        found
    }
}

/// The checks, with the name that their errors carry.
struct Check<'a> {
    scene: &'a str,
}

impl Check<'_> {
    fn scene(&self) -> String {
        self.scene.to_owned()
    }

    fn invalid(&self, problem: String) -> SceneError {
        SceneError::Invalid {
            scene: self.scene(),
            problem,
        }
    }

    fn out_of_range(&self, element: String, value: impl Into<f64>, expected: &str) -> SceneError {
        self.invalid(format!("{element} is {}, expected {expected}", value.into()))
    }

    fn limit(&self, what: &'static str, count: usize, limit: u64) -> Result<(), SceneError> {
        if count as u64 > limit {
            return Err(SceneError::TooMany {
                scene: self.scene(),
                what,
                count: count as u64,
                limit,
            });
        }
        Ok(())
    }

    fn index(&self, element: impl Fn() -> String, index: u32, count: usize) -> Result<(), SceneError> {
        if index as usize >= count {
            let element = element();
            return Err(self.invalid(format!(
                "{element} is {index}, but there are only {count}; repair the model's references"
            )));
        }
        Ok(())
    }

    fn length(&self, element: impl Fn() -> String, found: usize, expected: usize) -> Result<(), SceneError> {
        if found != expected {
            let element = element();
            return Err(self.invalid(format!(
                "{element} has {found} entries, expected {expected}; export the scene again"
            )));
        }
        Ok(())
    }

    fn finite(&self, element: impl Fn() -> String, values: &[f32]) -> Result<(), SceneError> {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            let value = f64::from(*value);
            return Err(SceneError::NotFinite {
                scene: self.scene(),
                element: element(),
                value,
            });
        }
        Ok(())
    }

    /// Finite and not negative.
    fn color(&self, element: impl Fn() -> String, rgb: [f32; 3]) -> Result<(), SceneError> {
        self.finite(&element, &rgb)?;
        if let Some(&value) = rgb.iter().find(|&&channel| channel < 0.0) {
            return Err(self.out_of_range(element(), value, "at least 0; light cannot be negative"));
        }
        if let Some(&value) = rgb.iter().find(|&&channel| channel > MAX_RADIANCE) {
            return Err(self.out_of_range(element(), value, "at most 2^100; lower the emissive strength"));
        }
        Ok(())
    }

    fn material(&self, index: usize, material: &Material) -> Result<(), SceneError> {
        let name = |what: &str| format!("{what} of material {index} `{}`", material.name);
        self.color(|| name("radiance"), material.radiance)?;
        let [r, g, b] = material.base_color;
        for (what, value) in [
            ("base colour", r),
            ("base colour", g),
            ("base colour", b),
            ("metallic", material.metallic),
            ("roughness", material.roughness),
            ("transmission", material.transmission),
        ] {
            self.finite(|| name(what), &[value])?;
            if !(0.0..=1.0).contains(&value) {
                return Err(self.out_of_range(name(what), value, "0 to 1"));
            }
        }
        Ok(())
    }

    fn picture(&self, index: usize, picture: &Picture) -> Result<(), SceneError> {
        for size in [picture.width, picture.height] {
            if !(1..=MAX_SIDE).contains(&size) {
                let element = format!("a side of picture {index}");
                return Err(self.out_of_range(element, size, "1 to 16384 texels"));
            }
        }
        let texels = picture.width as usize * picture.height as usize;
        self.length(
            || format!("texel bytes of picture {index}"),
            picture.texels.len(),
            4 * texels,
        )
    }

    fn paint(&self, index: usize, paint: &Paint, pictures: usize) -> Result<(), SceneError> {
        let name = |what: &str| format!("{what} of the paint of material {index}");
        self.color(|| name("radiance"), paint.radiance)?;
        let [r, g, b, opacity] = paint.base;
        for (what, value) in [
            ("base colour", r),
            ("base colour", g),
            ("base colour", b),
            ("opacity", opacity),
            ("metallic", paint.metallic),
            ("roughness", paint.roughness),
            ("transmission", paint.transmission),
        ] {
            self.finite(|| name(what), &[value])?;
            if !(0.0..=1.0).contains(&value) {
                return Err(self.out_of_range(name(what), value, "0 to 1"));
            }
        }
        self.finite(|| name("factor of normals"), &[paint.bump])?;
        if paint.bump.abs() > MAX_BUMP {
            return Err(self.out_of_range(
                name("factor of normals"),
                paint.bump,
                "at most 2^10 in magnitude",
            ));
        }
        if let Opacity::Cut(cutoff) = paint.opacity {
            self.finite(|| name("cutoff"), &[cutoff])?;
        }
        for (what, texture) in paint.textures() {
            self.index(
                || name(&format!("picture of the {what}")),
                texture.picture,
                pictures,
            )?;
            let element = || name(&format!("scale or offset of the {what} texture"));
            self.finite(element, texture.transform.as_flattened())?;
            if let Some(&value) = texture
                .transform
                .as_flattened()
                .iter()
                .find(|x| x.abs() > MAX_TEXTURE_COORDINATE)
            {
                return Err(self.out_of_range(
                    element(),
                    value,
                    "at most 2^20 in magnitude; give its transform a smaller scale or offset",
                ));
            }
        }
        Ok(())
    }

    fn primitive(&self, name: &str, primitive: &Primitive, materials: usize) -> Result<(), SceneError> {
        self.index(|| format!("material of {name}"), primitive.material, materials)?;
        for (v, position) in primitive.positions.iter().enumerate() {
            self.finite(|| format!("position {v} of {name}"), position)?;
            if let Some(&value) = position.iter().find(|x| x.abs() > MAX_COORDINATE) {
                let element = format!("position {v} of {name}");
                return Err(self.out_of_range(
                    element,
                    value,
                    "a coordinate within 2^40 metres of the origin",
                ));
            }
        }
        let vertices = primitive.positions.len();
        for (t, triangle) in primitive.triangles.iter().enumerate() {
            for &vertex in triangle {
                self.index(|| format!("a vertex of triangle {t} of {name}"), vertex, vertices)?;
            }
        }
        if let Some(radiance) = &primitive.radiance {
            self.length(
                || format!("radiance list of {name}"),
                radiance.len(),
                primitive.triangles.len(),
            )?;
            for (t, &rgb) in radiance.iter().enumerate() {
                self.color(|| format!("radiance of triangle {t} of {name}"), rgb)?;
            }
        }
        if let Some(coordinates) = &primitive.coordinates {
            self.length(
                || format!("texture coordinates of {name}"),
                coordinates.len(),
                vertices,
            )?;
            for (v, uv) in coordinates.iter().enumerate() {
                self.finite(|| format!("texture coordinate {v} of {name}"), uv)?;
                if let Some(&value) = uv.iter().find(|x| x.abs() > MAX_TEXTURE_COORDINATE) {
                    let element = format!("texture coordinate {v} of {name}");
                    return Err(self.out_of_range(
                        element,
                        value,
                        "at most 2^20 in magnitude; move the coordinates nearer to 0",
                    ));
                }
            }
        }
        self.bends(name, primitive)
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
            let own = named(animation.place, &animation.name);
            for (c, channel) in animation.channels.iter().enumerate() {
                self.channel(&format!("channel {c} of animation {own}"), channel, data)?;
            }
            for (c, channel) in animation.morphs.iter().enumerate() {
                let name = format!("channel {c} of weights of animation {own}");
                self.morph(&name, channel, data)?;
            }
        }
        Ok(())
    }

    fn channel(&self, name: &str, channel: &Channel, data: &SceneData) -> Result<(), SceneError> {
        self.index(|| format!("node of {name}"), channel.node, data.nodes.len())?;
        let rows = self.keys(name, &channel.times, channel.interpolation)?;
        self.length(|| format!("value list of {name}"), channel.values.len(), rows)?;
        self.finite(|| format!("a value of {name}"), channel.values.as_flattened())?;
        if !matches!(data.nodes[channel.node as usize].transform, Transform::Trs { .. }) {
            let element = format!("target of {name}: node");
            return Err(self.out_of_range(
                element,
                channel.node,
                "a node with translation, rotation and scale",
            ));
        }
        Ok(())
    }

    /// How many rows of values the keys have.
    fn keys(&self, name: &str, times: &[f32], interpolation: Interpolation) -> Result<usize, SceneError> {
        if times.is_empty() {
            return Err(self.out_of_range(format!("number of keys of {name}"), 0.0, "at least 1"));
        }
        self.finite(|| format!("a time of {name}"), times)?;
        if times[0] < 0.0 || times.windows(2).any(|pair| pair[1] < pair[0]) {
            let element = format!("first time of {name}");
            return Err(self.out_of_range(element, times[0], "times from 0 up, in ascending order"));
        }
        Ok(match interpolation {
            Interpolation::CubicSpline => 3 * times.len(),
            Interpolation::Step | Interpolation::Linear => times.len(),
        })
    }

    /// Sizes of every frame, and whether 32-bit indices and memory can hold them.
    fn count(&self, data: &SceneData) -> Result<Counts, SceneError> {
        let per_mesh: Vec<Counts> = data
            .meshes
            .iter()
            .map(|mesh| {
                let mut counts = Counts::default();
                for primitive in &mesh.primitives {
                    let material = &data.materials[primitive.material as usize];
                    let all = 0..primitive.triangles.len();
                    let lit = all
                        .clone()
                        .filter(|&t| emits(primitive.triangle_radiance(t, material.radiance)))
                        .count();
                    let shown = all.filter(|&t| primitive.is_shown(t, material)).count();
                    counts.triangles += shown;
                    counts.clear += primitive.triangles.len() - shown;
                    counts.emissive += lit;
                    counts.mesh_lights += usize::from(lit > 0);
                }
                counts
            })
            .collect();
        let mut total = Counts::default();
        for mesh in data.nodes.iter().filter_map(|node| node.mesh) {
            let counts = per_mesh[mesh as usize];
            total.triangles = total.triangles.saturating_add(counts.triangles);
            total.clear = total.clear.saturating_add(counts.clear);
            total.emissive = total.emissive.saturating_add(counts.emissive);
            total.mesh_lights = total.mesh_lights.saturating_add(counts.mesh_lights);
        }
        let fine = Facets::of(data);
        for light in &data.analytic {
            total.triangles = total.triangles.saturating_add(light.facets(fine));
            let is_sun = light.kind == AnalyticKind::Directional;
            total.analytic += usize::from(!is_sun);
            total.suns += usize::from(is_sun);
        }
        self.limit("suns", total.suns, MAX_SUNS as u64)?;
        let all = total.triangles.saturating_add(total.clear);
        self.limit("triangles over all instances", all, MAX_TRIANGLES)?;
        if all == 0 {
            return Err(SceneError::Empty {
                scene: self.scene(),
                left_out: data.warnings.clone(),
            });
        }
        Ok(total)
    }
}
