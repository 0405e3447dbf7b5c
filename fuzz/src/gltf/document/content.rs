//! What a document says: scenes, nodes, meshes, animations, accessors, most of it sound.

use super::{Document, PNG, Packed};

impl Document {
    pub(super) fn write(&mut self, shape: u32, packed: &Packed) {
        let has = |bit: u32| shape >> bit & 1 != 0;
        let nodes = 1 + (shape & 3) as usize;
        self.word("{\"asset\":{\"version\":", "2.0");
        self.number("},\"scene\":", 0.0);
        self.raw(",\"scenes\":[{\"nodes\":[");
        // A chain, or all of them roots.
        let chain = has(2);
        for node in 0..if chain { 1 } else { nodes } {
            self.number(if node == 0 { "" } else { "," }, node as f64);
        }
        self.raw("]");
        if has(3) {
            self.numbers(",\"extras\":{\"lightbvh_background\":", &[0.1, 0.2, 0.3]);
            self.raw("}");
        }
        self.raw("}],\"nodes\":[");
        for node in 0..nodes {
            self.number(if node == 0 { "{\"mesh\":" } else { ",{\"mesh\":" }, 0.0);
            if has(28) {
                self.number(",\"skin\":", 0.0);
            }
            if has(29) {
                self.number(",\"weights\":[", 0.5);
                self.raw("]");
            }
            if has(30) && node == 0 {
                self.number(",\"extensions\":{\"KHR_lights_punctual\":{\"light\":", 0.0);
                self.raw("}}");
            }
            if chain && node + 1 < nodes {
                self.number(",\"children\":[", (node + 1) as f64);
                self.raw("]");
            }
            if has(4) && node == 0 {
                self.number(",\"camera\":", 0.0);
            }
            if has(5) && node == 1 {
                let m = [
                    1.0, 0.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 2.0, 3.0, 4.0, 1.0,
                ];
                self.numbers(",\"matrix\":", &m);
            } else if has(6) {
                self.numbers(",\"translation\":", &[1.0, 2.0, 3.0]);
                self.numbers(",\"rotation\":", &[0.0, 0.6, 0.0, 0.8]);
                self.numbers(",\"scale\":", &[1.0, -2.0, 1.0]);
            }
            self.raw("}");
        }
        self.mesh(shape);
        if has(4) {
            self.number(
                "],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":",
                0.7,
            );
            self.number(",\"znear\":", 0.1);
            self.raw("}}");
        }
        if has(28) {
            self.number("],\"skins\":[{\"joints\":[", (nodes - 1) as f64);
            self.number(",", 0.0);
            self.raw(",0,0]}");
        }
        if has(7) {
            self.animation(shape, nodes);
        }
        self.accessors(shape, packed);
        if has(30) {
            self.word(
                "],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":",
                "spot",
            );
            self.number(",\"intensity\":", 5.0);
            self.number(",\"range\":", 5.0);
            self.number(",\"spot\":{\"innerConeAngle\":", 0.25);
            self.number(",\"outerConeAngle\":", 0.5);
            self.raw("}}]}},\"buffers\":[");
        } else {
            self.raw("],\"buffers\":[");
        }
        let length = self.buffer.len() as f64;
        self.number("{\"byteLength\":", length);
        self.raw("}]");
    }

    fn mesh(&mut self, shape: u32) {
        let has = |bit: u32| shape >> bit & 1 != 0;
        self.number(
            "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":",
            0.0,
        );
        if has(8) {
            self.number(",\"TEXCOORD_0\":", 6.0);
        }
        if has(9) {
            self.number(",\"_RADIANCE\":", 7.0);
        }
        if has(28) {
            self.number(",\"JOINTS_0\":", 10.0);
            self.number(",\"WEIGHTS_0\":", 11.0);
        }
        self.raw("}");
        if has(29) {
            self.number(",\"targets\":[{\"POSITION\":", 5.0);
            self.raw("}]");
        }
        if has(22) && !has(21) {
            self.number(
                ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":",
                5.0,
            );
            self.number(",\"attributes\":{\"POSITION\":", 0.0);
            self.raw("}}}");
        }
        if !has(10) {
            self.number(",\"indices\":", 1.0);
        }
        self.number(",\"material\":", 0.0);
        self.number(",\"mode\":", 4.0);
        self.numbers("}]}],\"materials\":[{\"emissiveFactor\":", &[1.0, 0.5, 0.25]);
        if has(8) {
            self.number(",\"emissiveTexture\":{\"index\":", 0.0);
            self.number(",\"texCoord\":", 0.0);
            if has(31) {
                self.numbers(
                    ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":",
                    &[0.25, 0.5],
                );
                self.number(",\"rotation\":", 0.5);
                self.numbers(",\"scale\":", &[0.5, 2.0]);
                self.raw("}}");
            }
            self.raw("}");
        }
        if has(11) {
            let before = ",\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":";
            self.number(before, 5.0);
            if has(31) {
                self.number("},\"KHR_materials_transmission\":{\"transmissionFactor\":", 0.75);
            }
            if has(27) && has(31) {
                self.raw("},\"KHR_materials_unlit\":{");
            }
            self.raw("}}");
        }
        if has(31) {
            self.raw(",\"alphaMode\":\"BLEND\"");
        }
        self.numbers(
            ",\"pbrMetallicRoughness\":{\"baseColorFactor\":",
            &[0.1, 0.2, 0.3, 1.0],
        );
        self.number(",\"metallicFactor\":", 0.5);
        self.raw("}}");
        if has(8) {
            self.number("],\"textures\":[{\"source\":", 0.0);
            self.number("}],\"images\":[{\"bufferView\":", if has(25) { 6.0 } else { 4.0 });
            self.raw(",\"mimeType\":\"image/png\"}");
        }
    }

    fn animation(&mut self, shape: u32, nodes: usize) {
        let has = |bit: u32| shape >> bit & 1 != 0;
        let property = if has(29) {
            3
        } else {
            (shape >> 12 & 3) as usize % 3
        };
        let kind = (shape >> 14 & 3) as usize % 3;
        self.number("],\"animations\":[{\"channels\":[{\"sampler\":", 0.0);
        self.number(",\"target\":{\"node\":", (nodes - 1) as f64);
        self.word(
            ",\"path\":",
            ["translation", "rotation", "scale", "weights"][property],
        );
        self.number("}}],\"samplers\":[{\"input\":", 2.0);
        // One weight for each key, in the times themselves or in the numbers that follow.
        let output = match (property, kind) {
            (3, 2) => 12.0,
            (3, _) => 2.0,
            (1, _) => {
                if kind == 2 {
                    9.0
                } else {
                    4.0
                }
            }
            (_, 2) => 8.0,
            _ => 3.0,
        };
        self.number(",\"output\":", output);
        self.word(",\"interpolation\":", ["LINEAR", "STEP", "CUBICSPLINE"][kind]);
        self.raw("}]}");
    }

    fn accessors(&mut self, shape: u32, packed: &Packed) {
        let float = 5126.0;
        let list = [
            (0.0, float, 4.0, "VEC3"),
            (1.0, 5123.0, 6.0, "SCALAR"),
            (2.0, float, 3.0, "SCALAR"),
            (3.0, float, 3.0, "VEC3"),
            (3.0, float, 3.0, "VEC4"),
            (0.0, float, 4.0, "VEC3"),
            (0.0, float, 4.0, "VEC2"),
            (0.0, float, 4.0, "VEC3"),
            (3.0, float, 9.0, "VEC3"),
            (3.0, float, 9.0, "VEC4"),
            (1.0, 5121.0, 4.0, "VEC4"),
            (3.0, float, 4.0, "VEC4"),
            (3.0, float, 9.0, "SCALAR"),
        ];
        // The last ones are there for what asks for them.
        let list = &list[..if shape >> 28 & 3 == 0 { 10 } else { 13 }];
        self.raw("],\"accessors\":[");
        for (i, &(view, component, count, kind)) in list.iter().enumerate() {
            self.raw(if i == 0 { "{" } else { ",{" });
            // Without a view an accessor holds zeros.
            if i > 0 || shape >> 16 & 3 != 3 {
                self.number("\"bufferView\":", view);
                self.number(",\"byteOffset\":", 0.0);
                self.raw(",");
            }
            self.number("\"componentType\":", component);
            self.number(",\"count\":", count);
            self.word(",\"type\":", kind);
            if i == 0 && shape >> 16 & 2 != 0 {
                self.number(",\"sparse\":{\"count\":", 2.0);
                self.number(",\"indices\":{\"bufferView\":", 1.0);
                self.number(",\"byteOffset\":", 0.0);
                self.number(",\"componentType\":", 5123.0);
                self.number("},\"values\":{\"bufferView\":", 3.0);
                self.number(",\"byteOffset\":", 0.0);
                self.raw("}}");
            }
            if i < 2 && shape >> 18 & 3 == 3 {
                self.raw(",\"normalized\":true");
            }
            self.raw("}");
        }
        self.raw("],\"bufferViews\":[");
        let mut views = vec![(0, 48), (48, 12), (60, 12), (72, 144), (216, PNG.len())];
        // Joints are small numbers: the indices, four bytes beyond their end.
        if shape >> 28 & 1 != 0 {
            views[1].1 = 16;
        }
        if shape >> 21 & 3 == 2 || shape >> 25 & 1 != 0 {
            views.extend([packed.first, packed.picture]);
        }
        for (i, (start, length)) in views.into_iter().enumerate() {
            self.number(if i == 0 { "{\"buffer\":" } else { ",{\"buffer\":" }, 0.0);
            self.number(",\"byteOffset\":", start as f64);
            self.number(",\"byteLength\":", length as f64);
            if i == 0 && shape >> 20 & 1 != 0 {
                self.number(",\"byteStride\":", 12.0);
            }
            if shape >> 21 & 1 != 0 && i < 2 {
                self.compressed(shape, if i == 0 { packed.first } else { packed.second }, i == 0);
            }
            self.raw("}");
        }
    }

    /// The extension of a compressed view: of vertices, or of indices.
    fn compressed(&mut self, shape: u32, (start, length): (usize, usize), vertices: bool) {
        let has = |bit: u32| shape >> bit & 1 != 0;
        self.number(",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":", 0.0);
        self.number(",\"byteOffset\":", start as f64);
        self.number(",\"byteLength\":", length as f64);
        self.number(",\"byteStride\":", if vertices { 12.0 } else { 2.0 });
        self.number(",\"count\":", if vertices { 4.0 } else { 6.0 });
        let indices = if has(24) { "INDICES" } else { "TRIANGLES" };
        self.word(",\"mode\":", if vertices { "ATTRIBUTES" } else { indices });
        let filter = if vertices && has(23) {
            "EXPONENTIAL"
        } else {
            "NONE"
        };
        self.word(",\"filter\":", filter);
        self.raw("}}");
    }
}
