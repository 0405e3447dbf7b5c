//! What a document says: scenes, nodes, meshes, animations, accessors, most of it sound.

use super::{Document, PNG};

impl Document {
    pub(super) fn write(&mut self, shape: u32) {
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
        if has(7) {
            self.animation(shape, nodes);
        }
        self.accessors(shape);
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
        self.raw("}");
        if !has(10) {
            self.number(",\"indices\":", 1.0);
        }
        self.number(",\"material\":", 0.0);
        self.number(",\"mode\":", 4.0);
        self.numbers("}]}],\"materials\":[{\"emissiveFactor\":", &[1.0, 0.5, 0.25]);
        if has(8) {
            self.number(",\"emissiveTexture\":{\"index\":", 0.0);
            self.number(",\"texCoord\":", 0.0);
            self.raw("}");
        }
        if has(11) {
            let before = ",\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":";
            self.number(before, 5.0);
            self.raw("}}");
        }
        self.numbers(
            ",\"pbrMetallicRoughness\":{\"baseColorFactor\":",
            &[0.1, 0.2, 0.3, 1.0],
        );
        self.number(",\"metallicFactor\":", 0.5);
        self.raw("}}");
        if has(8) {
            self.number("],\"textures\":[{\"source\":", 0.0);
            self.number("}],\"images\":[{\"bufferView\":", 4.0);
            self.raw(",\"mimeType\":\"image/png\"}");
        }
    }

    fn animation(&mut self, shape: u32, nodes: usize) {
        let property = (shape >> 12 & 3) as usize % 3;
        let kind = (shape >> 14 & 3) as usize % 3;
        self.number("],\"animations\":[{\"channels\":[{\"sampler\":", 0.0);
        self.number(",\"target\":{\"node\":", (nodes - 1) as f64);
        self.word(",\"path\":", ["translation", "rotation", "scale"][property]);
        self.number("}}],\"samplers\":[{\"input\":", 2.0);
        let output = if property == 1 { 4.0 } else { 3.0 } + if kind == 2 { 5.0 } else { 0.0 };
        self.number(",\"output\":", output);
        self.word(",\"interpolation\":", ["LINEAR", "STEP", "CUBICSPLINE"][kind]);
        self.raw("}]}");
    }

    fn accessors(&mut self, shape: u32) {
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
        ];
        self.raw("],\"accessors\":[");
        for (i, (view, component, count, kind)) in list.into_iter().enumerate() {
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
        let views = [(0, 48), (48, 12), (60, 12), (72, 144), (216, PNG.len())];
        for (i, (start, length)) in views.into_iter().enumerate() {
            self.number(if i == 0 { "{\"buffer\":" } else { ",{\"buffer\":" }, 0.0);
            self.number(",\"byteOffset\":", start as f64);
            self.number(",\"byteLength\":", length as f64);
            if i == 0 && shape >> 20 & 1 != 0 {
                self.number(",\"byteStride\":", 12.0);
            }
            self.raw("}");
        }
        let length = self.buffer.len() as f64;
        self.number("],\"buffers\":[{\"byteLength\":", length);
        self.raw("}]");
    }
}
