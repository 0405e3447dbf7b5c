//! Any scene as `.glb`: the loader is exercised by the built-in scenes, and other programs can show them.

mod material;

use gltf::binary::{Glb, Header};
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use serde_json::{Value, json};

use self::material::{Textures, is_product, strength};
use super::analytic::{AnalyticKind, AnalyticLight};
use super::error::{SceneError, malformed};
use super::gltf_in::{BACKGROUND_EXTRA, RADIANCE_ATTRIBUTE};
use super::model::{Animation, Interpolation, Material, Primitive, Property};
use super::scene::Scene;
use super::textures::Picture;
use super::transform::Transform;

/// The extension for lights by formula.
const PUNCTUAL: &str = "KHR_lights_punctual";

/// glTF's numbers for component types.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;

impl Scene {
    /// The scene as the bytes of a `.glb` file.
    ///
    /// Reading them back gives a scene with the same frames, word for word. Emission that differs from triangle to
    /// triangle, or whose channels are too far apart for a factor, goes into the vertex attribute `_RADIANCE`, the
    /// background into the scene's `extras`. Pictures are PNG; where textures are turned, coordinates on them change by rounding.
    ///
    /// # Errors
    /// [`SceneError::Malformed`] beyond the 4 GiB that the container can name.
    pub fn to_glb(&self) -> Result<Vec<u8>, SceneError> {
        let mut out = Writer::default();
        let root = out.root(self);
        let text = root.to_string().into_bytes();
        // Header, and a header and up to three bytes of padding for each of two chunks.
        let length = 12 + 2 * (8 + 3) + text.len() + out.binary.len();
        let Ok(length) = u32::try_from(length) else {
            let problem = format!("is {length} bytes as .glb, more than the {} that fit", u32::MAX);
            return Err(malformed(self.name(), problem, "split the scene"));
        };
        let container = Glb {
            header: Header {
                magic: *b"glTF",
                version: 2,
                length,
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
}

impl Writer {
    fn root(&mut self, scene: &Scene) -> Value {
        let data = scene.data();
        let mut meshes = Vec::new();
        for mesh in &data.meshes {
            let primitives = mesh.primitives.iter();
            let primitives = primitives.map(|own| self.primitive(own, &data.materials));
            meshes.push(json!({ "name": mesh.name, "primitives": primitives.collect::<Vec<_>>() }));
        }
        let animations: Vec<Value> = data.animations.iter().map(|own| self.animation(own)).collect();
        let cameras = data.cameras.iter().map(
            |camera| json!({ "type": "perspective", "perspective": { "yfov": camera.yfov, "znear": 0.01 } }),
        );
        let roots: Vec<usize> = (0..data.nodes.len())
            .filter(|&node| data.nodes[node].parent.is_none())
            .collect();
        let images: Vec<Value> = data.pictures.iter().map(|own| self.picture(own)).collect();
        let mut textures = Textures::default();
        let materials: Vec<Value> = data.materials.iter().map(|own| textures.material(own)).collect();
        let lights: Vec<Value> = data.analytic.iter().filter_map(light).collect();
        let mut used = vec!["KHR_materials_emissive_strength"];
        let mut extensions = json!({});
        if !lights.is_empty() {
            extensions[PUNCTUAL] = json!({ "lights": lights });
            used.push(PUNCTUAL);
        }
        if textures.has_transforms {
            used.push("KHR_texture_transform");
        }
        let mut root = json!({
            "asset": { "version": "2.0", "generator": "lightbvh" },
            "extensionsUsed": used,
            "extensions": extensions,
            "scene": 0,
            "scenes": [{ "name": data.name, "nodes": roots, "extras": { BACKGROUND_EXTRA: data.background } }],
            "nodes": nodes(scene),
            "meshes": meshes,
            "materials": materials,
            "images": images,
            "textures": textures.textures,
            "samplers": textures.samplers,
            "animations": animations,
            "cameras": cameras.collect::<Vec<_>>(),
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.binary.len() }],
        });
        // glTF wants lists that are there to have entries.
        if let Value::Object(members) = &mut root {
            members.retain(|_, value| *value != json!([]) && *value != json!({}));
        }
        root
    }

    fn primitive(&mut self, primitive: &Primitive, materials: &[Material]) -> Value {
        let own = materials[primitive.material as usize].radiance;
        let triangles = primitive.triangles.len();
        if triangles == 0 {
            // Empty accessors are not allowed; a primitive of points is skipped when it is read back.
            let point = self.floats(&[0.0; 3], "VEC3");
            return json!({ "attributes": { "POSITION": point }, "material": primitive.material, "mode": 0 });
        }
        let radiance = match &primitive.radiance {
            Some(of_triangles) => Some(of_triangles.clone()),
            None => (!is_product(own)).then(|| vec![own; triangles]),
        };
        // Radiance per triangle needs three vertices of its own for each.
        let corners = primitive.triangles.as_flattened();
        let (order, indices): (Vec<usize>, Vec<u32>) = match radiance {
            None => ((0..primitive.positions.len()).collect(), corners.to_vec()),
            Some(_) => {
                let order = corners.iter().map(|&vertex| vertex as usize);
                (order.collect(), (0..3 * triangles as u32).collect())
            }
        };
        let positions: Vec<[f32; 3]> = order.iter().map(|&v| primitive.positions[v]).collect();
        let position = self.floats(positions.as_flattened(), "VEC3");
        let fold = |pick: fn(f32, f32) -> f32, start: f32| {
            let all = positions.iter();
            all.fold([start; 3], |m, p| [0, 1, 2].map(|i| pick(m[i], p[i])))
        };
        self.accessors[position]["min"] = json!(fold(f32::min, f32::INFINITY));
        self.accessors[position]["max"] = json!(fold(f32::max, f32::NEG_INFINITY));
        let mut attributes = json!({ "POSITION": position });
        if let Some(radiance) = &radiance {
            let of_vertices: Vec<[f32; 3]> = radiance.iter().flat_map(|&rgb| [rgb; 3]).collect();
            attributes[format!("_{RADIANCE_ATTRIBUTE}")] =
                json!(self.floats(of_vertices.as_flattened(), "VEC3"));
        }
        if let Some(coordinates) = &primitive.coordinates {
            let own: Vec<[f32; 2]> = order.iter().map(|&vertex| coordinates[vertex]).collect();
            attributes["TEXCOORD_0"] = json!(self.floats(own.as_flattened(), "VEC2"));
        }
        let words: Vec<u8> = indices.iter().flat_map(|vertex| vertex.to_le_bytes()).collect();
        let indices = self.accessor(&words, indices.len(), UNSIGNED_INT, "SCALAR");
        json!({ "attributes": attributes, "indices": indices, "material": primitive.material })
    }

    fn animation(&mut self, animation: &Animation) -> Value {
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for channel in &animation.channels {
            let (path, shape) = match channel.property {
                Property::Translation => ("translation", "VEC3"),
                Property::Rotation => ("rotation", "VEC4"),
                Property::Scale => ("scale", "VEC3"),
            };
            let interpolation = match channel.interpolation {
                Interpolation::Step => "STEP",
                Interpolation::Linear => "LINEAR",
                Interpolation::CubicSpline => "CUBICSPLINE",
            };
            let input = self.floats(&channel.times, "SCALAR");
            self.accessors[input]["min"] = json!([channel.times.first()]);
            self.accessors[input]["max"] = json!([channel.times.last()]);
            let output = self.floats(&channel.values, shape);
            let target = json!({ "node": channel.node, "path": path });
            channels.push(json!({ "sampler": samplers.len(), "target": target }));
            samplers.push(json!({ "input": input, "output": output, "interpolation": interpolation }));
        }
        json!({ "name": animation.name, "samplers": samplers, "channels": channels })
    }

    /// A picture as PNG.
    fn picture(&mut self, picture: &Picture) -> Value {
        let mut bytes = Vec::new();
        PngEncoder::new(&mut bytes)
            .write_image(
                &picture.texels,
                picture.width,
                picture.height,
                ExtendedColorType::Rgba8,
            )
            .expect("writing a whole picture to memory does not fail");
        json!({ "bufferView": self.view(&bytes), "mimeType": "image/png" })
    }

    fn floats(&mut self, values: &[f32], shape: &str) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let each = match shape {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        self.accessor(&bytes, values.len() / each, FLOAT, shape)
    }

    fn accessor(&mut self, bytes: &[u8], count: usize, component: u32, shape: &str) -> usize {
        let view = self.view(bytes);
        self.accessors
            .push(json!({ "bufferView": view, "componentType": component, "count": count, "type": shape }));
        self.accessors.len() - 1
    }

    /// A view of these bytes, which begins at a multiple of four.
    fn view(&mut self, bytes: &[u8]) -> usize {
        let view = json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() });
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.views.len() - 1
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
            Transform::Matrix(columns) => json!({ "matrix": matrix(&columns) }),
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
    let punctual = data.analytic.iter().filter(|own| light(own).is_some());
    for (index, light) in punctual.enumerate() {
        let named = json!({ PUNCTUAL: { "light": index } });
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

/// Four columns of three rows as a matrix of four rows.
fn matrix([a, b, c, d]: &[[f32; 3]; 4]) -> [f32; 16] {
    [
        a[0], a[1], a[2], 0.0, b[0], b[1], b[2], 0.0, c[0], c[1], c[2], 0.0, d[0], d[1], d[2], 1.0,
    ]
}

/// A light by formula; `None` for kinds that `KHR_lights_punctual` has no word for.
fn light(light: &AnalyticLight) -> Option<Value> {
    // Colours of glTF are at most 1; a power of two changes no product.
    let strength = strength(light.color);
    let mut out = json!({
        "name": light.name,
        "color": light.color.map(|channel| channel / strength),
        "intensity": light.intensity * strength,
    });
    if let Some(range) = light.range {
        out["range"] = range.into();
    }
    out["type"] = match light.kind {
        AnalyticKind::Point => "point".into(),
        AnalyticKind::Spot { inner, outer } => {
            out["spot"] = json!({ "innerConeAngle": inner, "outerConeAngle": outer });
            "spot".into()
        }
        _ => return None,
    };
    Some(out)
}
