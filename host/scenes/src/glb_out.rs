//! Any scene as `.glb`: the loader is exercised by the built-in scenes, and other programs can show them.

mod bend;
mod material;
mod paint;

use std::collections::HashMap;

use gltf::binary::{Glb, Header};
use serde_json::{Value, json};

use self::bend::light;
use self::material::{is_product, material};
use super::error::SceneError;
use super::gltf_in::{BACKGROUND_EXTRA, IES, RADIANCE_ATTRIBUTE};
use super::model::{Channel, Interpolation, Material, Primitive, Property, Scene};
use super::transform::Transform;

/// glTF's numbers for component types.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_SHORT: u32 = 5123;

impl Scene {
    /// The scene as the bytes of a `.glb` file.
    ///
    /// Reading them back gives a scene with the same frames, word for word. Emission that differs from triangle to
    /// triangle, or whose channels are too far apart for a factor, goes into the vertex attribute `_RADIANCE`, the
    /// background into the scene's `extras`. Pictures are PNG; where textures are turned, coordinates on them change by rounding.
    ///
    /// # Errors
    /// [`SceneError::TooMany`] beyond the 4 GiB that the container can name.
    pub fn to_glb(&self) -> Result<Vec<u8>, SceneError> {
        let mut out = Writer::default();
        let root = out.root(self);
        let text = root.to_string().into_bytes();
        // Header, and a header and up to three bytes of padding for each of two chunks.
        let length = (12 + 2 * (8 + 3) + text.len() + out.binary.len()) as u64;
        if length > u64::from(u32::MAX) {
            return Err(SceneError::TooMany {
                scene: self.name().to_owned(),
                what: "bytes as .glb",
                count: length,
                limit: u64::from(u32::MAX),
            });
        }
        let container = Glb {
            header: Header {
                magic: *b"glTF",
                version: 2,
                length: length as u32,
            },
            json: text.into(),
            bin: Some(out.binary.into()),
        };
        Ok(container.to_vec().expect("writing to memory does not fail"))
    }
}

/// The binary part so far, and the JSON that describes it.
#[derive(Default)]
struct Writer {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    /// Accessor of each list of times, by its bits: channels often share one.
    times: HashMap<Vec<u32>, usize>,
}

impl Writer {
    fn root(&mut self, scene: &Scene) -> Value {
        let data = scene.data();
        let meshes: Vec<Value> = data
            .meshes
            .iter()
            .map(|mesh| {
                let primitives: Vec<Value> = mesh
                    .primitives
                    .iter()
                    .map(|primitive| self.primitive(primitive, &data.materials))
                    .collect();
                json!({ "name": mesh.name, "primitives": primitives })
            })
            .collect();
        let mut animations = Vec::new();
        // As the file had them: engines choose by number.
        let mut all: Vec<_> = data.animations.iter().chain(&data.clips).collect();
        all.sort_by_key(|animation| animation.place);
        for animation in all {
            let moving = animation.channels.iter().map(|channel| self.sampler(channel));
            let mut samplers: Vec<Value> = moving.collect();
            samplers.extend(animation.morphs.iter().map(|channel| self.morph(channel)));
            let moving = animation.channels.iter().map(|c| (c.node, path(c.property)));
            let bending = animation.morphs.iter().map(|c| (c.node, "weights"));
            let channels: Vec<Value> = (0..)
                .zip(moving.chain(bending))
                .map(|(sampler, (node, path))| target(sampler, node, path))
                .collect();
            animations.push(json!({ "name": animation.name, "samplers": samplers, "channels": channels }));
        }
        let cameras = data.cameras.iter().map(
            |camera| json!({ "type": "perspective", "perspective": { "yfov": camera.yfov, "znear": 0.01 } }),
        );
        let roots: Vec<usize> = (0..data.nodes.len())
            .filter(|&node| data.nodes[node].parent.is_none())
            .collect();
        let skins: Vec<Value> = data.skins.iter().map(|skin| self.skin(skin)).collect();
        let images: Vec<Value> = data.pictures.iter().map(|own| self.picture(own)).collect();
        let mut textures = paint::Textures::default();
        let painted = |own: &Material| {
            let mut written = material(own);
            if let Some(paint) = &own.paint {
                textures.paint(paint, &mut written);
            }
            written
        };
        let materials: Vec<Value> = data.materials.iter().map(painted).collect();
        let profiles: Vec<Value> = data.profiles.iter().map(|own| self.profile(own)).collect();
        let mut root = json!({
            "asset": { "version": "2.0", "generator": "lightbvh" },
            "extensionsUsed": ["KHR_materials_emissive_strength", "KHR_materials_transmission"],
            "scene": 0,
            "scenes": [{ "name": data.name, "nodes": roots, "extras": { BACKGROUND_EXTRA: data.background } }],
            "nodes": nodes(scene),
            "meshes": meshes,
            "materials": materials,
            "images": images,
            "animations": animations,
            "skins": skins,
            "cameras": cameras.collect::<Vec<_>>(),
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.binary.len() }],
        });
        textures.finish(&mut root);
        let lights: Vec<Value> = data.analytic.iter().filter_map(light).collect();
        if !lights.is_empty() {
            root["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
            root["extensionsUsed"]
                .as_array_mut()
                .into_iter()
                .for_each(|used| used.push("KHR_lights_punctual".into()));
        }
        if !profiles.is_empty() {
            root["extensions"][IES] = json!({ "lights": profiles });
            root["extensionsUsed"]
                .as_array_mut()
                .into_iter()
                .for_each(|used| used.push(IES.into()));
        }
        // glTF wants lists that are there to have entries.
        if let Value::Object(members) = &mut root {
            members.retain(|_, value| value.as_array().is_none_or(|list| !list.is_empty()));
        }
        root
    }

    fn primitive(&mut self, primitive: &Primitive, materials: &[Material]) -> Value {
        let own = materials[primitive.material as usize].radiance;
        let radiance = match &primitive.radiance {
            Some(of_triangles) => Some(of_triangles.clone()),
            None => (!is_product(own)).then(|| vec![own; primitive.triangles.len()]),
        };
        // Radiance per triangle needs three vertices of its own for each.
        let order = radiance
            .is_some()
            .then(|| primitive.triangles.as_flattened().to_vec());
        let (positions, triangles) = match &order {
            None => (primitive.positions.clone(), primitive.triangles.clone()),
            Some(order) => {
                let positions = order
                    .iter()
                    .map(|&vertex| primitive.positions[vertex as usize])
                    .collect();
                let triangles = (0..primitive.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
                (positions, triangles.collect())
            }
        };
        if triangles.is_empty() {
            // Empty accessors are not allowed; a primitive of points is skipped when it is read back.
            let point = self.floats(&[[0.0_f32; 3]], "VEC3");
            return json!({ "attributes": { "POSITION": point }, "material": primitive.material, "mode": 0 });
        }
        let position = self.floats(&positions, "VEC3");
        if let Some(accessor) = self.accessors.last_mut() {
            let fold = |pick: fn(f32, f32) -> f32, start: f32| {
                positions
                    .iter()
                    .fold([start; 3], |m, p| [0, 1, 2].map(|i| pick(m[i], p[i])))
            };
            accessor["min"] = json!(fold(f32::min, f32::INFINITY));
            accessor["max"] = json!(fold(f32::max, f32::NEG_INFINITY));
        }
        let mut attributes = json!({ "POSITION": position });
        if let Some(radiance) = &radiance {
            let of_vertices: Vec<[f32; 3]> = radiance.iter().flat_map(|&rgb| [rgb; 3]).collect();
            attributes[format!("_{RADIANCE_ATTRIBUTE}")] = json!(self.floats(&of_vertices, "VEC3"));
        }
        if let Some(coordinates) = &primitive.coordinates {
            let own: Vec<[f32; 2]> = match &order {
                None => coordinates.clone(),
                Some(order) => order.iter().map(|&vertex| coordinates[vertex as usize]).collect(),
            };
            attributes["TEXCOORD_0"] = json!(self.floats(&own, "VEC2"));
        }
        let words: Vec<[u8; 4]> = triangles
            .as_flattened()
            .iter()
            .map(|vertex| vertex.to_le_bytes())
            .collect();
        let indices = self.accessor(words.as_flattened(), words.len(), UNSIGNED_INT, "SCALAR");
        let mut out = json!({ "attributes": attributes, "indices": indices, "material": primitive.material });
        self.bends(&mut out, primitive, order.as_deref());
        out
    }

    /// The accessor of a list of times.
    fn input(&mut self, times: &[f32]) -> usize {
        let bits: Vec<u32> = times.iter().map(|time| time.to_bits()).collect();
        if let Some(&input) = self.times.get(&bits) {
            return input;
        }
        let list: Vec<[f32; 1]> = times.iter().map(|&time| [time]).collect();
        let input = self.floats(&list, "SCALAR");
        self.accessors[input]["min"] = json!([times.first()]);
        self.accessors[input]["max"] = json!([times.last()]);
        self.times.insert(bits, input);
        input
    }

    fn sampler(&mut self, channel: &Channel) -> Value {
        let input = self.input(&channel.times);
        let output = if channel.property == Property::Rotation {
            self.floats(&channel.values, "VEC4")
        } else {
            let values: Vec<[f32; 3]> = channel.values.iter().map(|&[x, y, z, _]| [x, y, z]).collect();
            self.floats(&values, "VEC3")
        };
        json!({ "input": input, "output": output, "interpolation": interpolation(channel.interpolation) })
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], shape: &str) -> usize {
        let bytes: Vec<[u8; 4]> = values
            .as_flattened()
            .iter()
            .map(|value| value.to_le_bytes())
            .collect();
        self.accessor(bytes.as_flattened(), values.len(), FLOAT, shape)
    }

    fn accessor(&mut self, bytes: &[u8], count: usize, component: u32, shape: &str) -> usize {
        let view = json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() });
        self.binary.extend(bytes);
        self.views.push(view);
        let view = self.views.len() - 1;
        self.accessors
            .push(json!({ "bufferView": view, "componentType": component, "count": count, "type": shape }));
        self.accessors.len() - 1
    }
}

fn nodes(scene: &Scene) -> Vec<Value> {
    let data = scene.data();
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); data.nodes.len()];
    for (index, node) in data.nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            children[parent as usize].push(index);
        }
    }
    let mut out = Vec::with_capacity(data.nodes.len());
    for (node, children) in data.nodes.iter().zip(children) {
        let mut value = match node.transform {
            Transform::Trs {
                translation,
                rotation,
                scale,
            } => {
                json!({ "translation": translation, "rotation": rotation, "scale": scale })
            }
            Transform::Matrix([a, b, c, d]) => json!({ "matrix": [
                a[0], a[1], a[2], 0.0, b[0], b[1], b[2], 0.0, c[0], c[1], c[2], 0.0, d[0], d[1], d[2], 1.0,
            ] }),
        };
        value["name"] = json!(node.name);
        if let Some(mesh) = node.mesh {
            value["mesh"] = json!(mesh);
        }
        if let Some(skin) = node.skin {
            value["skin"] = json!(skin);
        }
        if !node.weights.is_empty() {
            value["weights"] = json!(node.weights);
        }
        if !children.is_empty() {
            value["children"] = json!(children);
        }
        out.push(value);
    }
    let punctual = data.analytic.iter().filter(|own| light(own).is_some());
    let punctual = punctual
        .enumerate()
        .map(|(index, light)| (light, json!({ "KHR_lights_punctual": { "light": index } })));
    let measured = data
        .analytic
        .iter()
        .filter_map(|own| Some((own, bend::profile_light(own)?)));
    for (light, named) in punctual.chain(measured) {
        // A node has one light; a further one of the same node stands on a node of its own.
        let on = light.node as usize;
        if out[on].get("extensions").is_none() {
            out[on]["extensions"] = named;
        } else {
            let own = out.len();
            out.push(json!({ "extensions": named }));
            match out[on]["children"].as_array_mut() {
                Some(children) => children.push(own.into()),
                None => out[on]["children"] = json!([own]),
            }
        }
    }
    for (index, camera) in data.cameras.iter().enumerate() {
        out[camera.node as usize]["camera"] = json!(index);
    }
    out
}

fn target(sampler: usize, node: u32, path: &str) -> Value {
    json!({ "sampler": sampler, "target": { "node": node, "path": path } })
}

fn path(property: Property) -> &'static str {
    match property {
        Property::Translation => "translation",
        Property::Rotation => "rotation",
        Property::Scale => "scale",
    }
}

fn interpolation(interpolation: Interpolation) -> &'static str {
    match interpolation {
        Interpolation::Step => "STEP",
        Interpolation::Linear => "LINEAR",
        Interpolation::CubicSpline => "CUBICSPLINE",
    }
}
