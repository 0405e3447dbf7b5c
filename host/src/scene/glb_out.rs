//! Any scene as `.glb`: the loader is exercised by the built-in scenes, and other programs can show them.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::Path;

use serde_json::{Value, json};

use super::error::SceneError;
use super::gltf_in::{BACKGROUND_EXTRA, RADIANCE_ATTRIBUTE};
use super::model::{Channel, Interpolation, Material, Primitive, Property, Scene};
use super::transform::Transform;

/// glTF's numbers for component types.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;

impl Scene {
    /// Writes the scene as `.glb`. The file appears under its name only when it is whole.
    ///
    /// # Errors
    /// [`SceneError::Write`] where the folder cannot be written to; [`SceneError::TooMany`] beyond 4 GiB.
    pub fn write_glb(&self, path: &Path) -> Result<(), SceneError> {
        let bytes = self.to_glb()?;
        let mut temporary = path.as_os_str().to_owned();
        temporary.push(format!(".{}.tmp", std::process::id()));
        let temporary = Path::new(&temporary);
        let written = fs::write(temporary, bytes).and_then(|()| fs::rename(temporary, path));
        written.map_err(|source: io::Error| {
            // The first error is the one to report; without the file there is nothing to remove.
            let _ = fs::remove_file(temporary);
            SceneError::Write {
                path: path.to_owned(),
                source,
            }
        })
    }

    /// The scene as the bytes of a `.glb` file.
    ///
    /// Reading them back gives a scene with the same frames, word for word. Emission that differs from triangle to
    /// triangle, or whose channels are too far apart for a factor, goes into the vertex attribute `_RADIANCE`, the
    /// background into the scene's `extras`.
    ///
    /// # Errors
    /// [`SceneError::TooMany`] beyond the 4 GiB that the container can name.
    pub fn to_glb(&self) -> Result<Vec<u8>, SceneError> {
        let mut out = Writer::default();
        let root = out.root(self);
        let mut text = root.to_string().into_bytes();
        // Chunks end on four bytes: JSON with spaces, binary with zeros (glTF 2.0, section 4.4.3).
        text.resize(text.len().next_multiple_of(4), b' ');
        out.binary.resize(out.binary.len().next_multiple_of(4), 0);

        let length = 12 + 8 + text.len() + 8 + out.binary.len();
        let Ok(total) = u32::try_from(length) else {
            let (scene, count, limit) = (self.name().to_owned(), length as u64, u64::from(u32::MAX));
            return Err(SceneError::TooMany {
                scene,
                what: "bytes as .glb",
                count,
                limit,
            });
        };
        let mut glb = Vec::with_capacity(length);
        glb.extend(b"glTF");
        for word in [2, total, text.len() as u32] {
            glb.extend(word.to_le_bytes());
        }
        glb.extend(b"JSON");
        glb.extend(text);
        glb.extend((out.binary.len() as u32).to_le_bytes());
        glb.extend(b"BIN\0");
        glb.extend(out.binary);
        Ok(glb)
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
        for animation in &data.animations {
            let samplers: Vec<Value> = animation
                .channels
                .iter()
                .map(|channel| self.sampler(channel))
                .collect();
            let channels: Vec<Value> = animation
                .channels
                .iter()
                .enumerate()
                .map(|(s, c)| target(s, c))
                .collect();
            animations.push(json!({ "name": animation.name, "samplers": samplers, "channels": channels }));
        }
        let cameras = data.cameras.iter().map(
            |camera| json!({ "type": "perspective", "perspective": { "yfov": camera.yfov, "znear": 0.01 } }),
        );
        let roots: Vec<usize> = (0..data.nodes.len())
            .filter(|&node| data.nodes[node].parent.is_none())
            .collect();
        let mut root = json!({
            "asset": { "version": "2.0", "generator": "lightbvh" },
            "extensionsUsed": ["KHR_materials_emissive_strength"],
            "scene": 0,
            "scenes": [{ "name": data.name, "nodes": roots, "extras": { BACKGROUND_EXTRA: data.background } }],
            "nodes": nodes(scene),
            "meshes": meshes,
            "materials": data.materials.iter().map(material).collect::<Vec<_>>(),
            "animations": animations,
            "cameras": cameras.collect::<Vec<_>>(),
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.binary.len() }],
        });
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
        let (positions, triangles) = match &radiance {
            None => (primitive.positions.clone(), primitive.triangles.clone()),
            Some(_) => {
                let corners = primitive.triangles.as_flattened().iter();
                let positions = corners
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
        let words: Vec<[u8; 4]> = triangles
            .as_flattened()
            .iter()
            .map(|vertex| vertex.to_le_bytes())
            .collect();
        let indices = self.accessor(words.as_flattened(), words.len(), UNSIGNED_INT, "SCALAR");
        json!({ "attributes": attributes, "indices": indices, "material": primitive.material })
    }

    fn sampler(&mut self, channel: &Channel) -> Value {
        let bits: Vec<u32> = channel.times.iter().map(|time| time.to_bits()).collect();
        let input = match self.times.get(&bits) {
            Some(&input) => input,
            None => {
                let times: Vec<[f32; 1]> = channel.times.iter().map(|&time| [time]).collect();
                let input = self.floats(&times, "SCALAR");
                self.accessors[input]["min"] = json!([channel.times.first()]);
                self.accessors[input]["max"] = json!([channel.times.last()]);
                self.times.insert(bits, input);
                input
            }
        };
        let output = if channel.property == Property::Rotation {
            self.floats(&channel.values, "VEC4")
        } else {
            let values: Vec<[f32; 3]> = channel.values.iter().map(|&[x, y, z, _]| [x, y, z]).collect();
            self.floats(&values, "VEC3")
        };
        let interpolation = match channel.interpolation {
            Interpolation::Step => "STEP",
            Interpolation::Linear => "LINEAR",
            Interpolation::CubicSpline => "CUBICSPLINE",
        };
        json!({ "input": input, "output": output, "interpolation": interpolation })
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
        if !children.is_empty() {
            value["children"] = json!(children);
        }
        out.push(value);
    }
    for (index, camera) in data.cameras.iter().enumerate() {
        out[camera.node as usize]["camera"] = json!(index);
    }
    out
}

/// The least power of two, from 1 on, that is not below any channel: the strength with which factors lie in [0, 1].
fn strength(radiance: [f32; 3]) -> f32 {
    let peak = radiance.iter().fold(0.0_f32, |m, &channel| m.max(channel));
    let mut strength = 1.0_f32;
    // 2^127 is the largest power of two in `f32`.
    while strength < peak && strength < 1.0 / f32::MIN_POSITIVE {
        strength *= 2.0;
    }
    strength
}

/// Whether every channel is the product of an `f32` and the strength: one that is 2^126 times weaker may not be.
fn is_product(radiance: [f32; 3]) -> bool {
    let strength = strength(radiance);
    radiance
        .iter()
        .all(|&channel| channel / strength * strength == channel)
}

/// Emission as a factor in [0, 1] and a strength.
fn material(material: &Material) -> Value {
    let strength = strength(material.radiance);
    json!({
        "name": material.name,
        "doubleSided": material.double_sided,
        "emissiveFactor": material.radiance.map(|channel| channel / strength),
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": strength } },
        "pbrMetallicRoughness": {
            "baseColorFactor": [material.base_color[0], material.base_color[1], material.base_color[2], 1.0],
            "metallicFactor": material.metallic,
            "roughnessFactor": material.roughness,
        },
    })
}

fn target(sampler: usize, channel: &Channel) -> Value {
    let path = match channel.property {
        Property::Translation => "translation",
        Property::Rotation => "rotation",
        Property::Scale => "scale",
    };
    json!({ "sampler": sampler, "target": { "node": channel.node, "path": path } })
}
