//! Skins, targets and influences, and keys of weights; lights without area.

use super::material::strength;
use serde_json::{Value, json};

use super::{UNSIGNED_SHORT, Writer, interpolation};
use crate::gltf_in::IES;
use crate::{AnalyticKind, AnalyticLight, Influence, MorphChannel, Primitive, Profile, Skin};

impl Writer {
    /// Targets and influences of a primitive, whose vertices are written in this order.
    pub(super) fn bends(&mut self, out: &mut Value, primitive: &Primitive, order: Option<&[u32]>) {
        let vertices = order.map_or(primitive.positions.len(), <[u32]>::len);
        let old = |new: usize| order.map_or(new, |order| order[new] as usize);
        if !primitive.targets.is_empty() {
            let targets = primitive.targets.iter().map(|target| {
                let moved: Vec<[f32; 3]> = (0..vertices)
                    .map(|vertex| target.get(old(vertex)).copied().unwrap_or_default())
                    .collect();
                json!({ "POSITION": self.floats(&moved, "VEC3") })
            });
            out["targets"] = targets.collect();
        }
        for (set, influences) in primitive.influences.iter().enumerate() {
            let all: Vec<Influence> = (0..vertices).map(|vertex| influences[old(vertex)]).collect();
            let joints: Vec<u8> = all
                .iter()
                .flat_map(|influence| influence.joints)
                .flat_map(u16::to_le_bytes)
                .collect();
            let weights: Vec<[f32; 4]> = all.iter().map(|influence| influence.weights).collect();
            let attributes = &mut out["attributes"];
            attributes[format!("JOINTS_{set}")] =
                self.accessor(&joints, vertices, UNSIGNED_SHORT, "VEC4").into();
            attributes[format!("WEIGHTS_{set}")] = self.floats(&weights, "VEC4").into();
        }
    }

    pub(super) fn skin(&mut self, skin: &Skin) -> Value {
        let matrix = |[a, b, c, d]: &[[f32; 3]; 4]| {
            [
                a[0], a[1], a[2], 0.0, b[0], b[1], b[2], 0.0, c[0], c[1], c[2], 0.0, d[0], d[1], d[2], 1.0,
            ]
        };
        let matrices: Vec<[f32; 16]> = skin.inverse_bind.iter().map(matrix).collect();
        if matrices.is_empty() {
            // Empty accessors are not allowed.
            return json!({ "joints": skin.joints });
        }
        json!({ "joints": skin.joints, "inverseBindMatrices": self.floats(&matrices, "MAT4") })
    }

    pub(super) fn morph(&mut self, channel: &MorphChannel) -> Value {
        let input = self.input(&channel.times);
        let values: Vec<[f32; 1]> = channel.values.iter().map(|&value| [value]).collect();
        let output = self.floats(&values, "SCALAR");
        json!({ "input": input, "output": output, "interpolation": interpolation(channel.interpolation) })
    }
}

/// A light by formula; `None` for kinds that glTF has no word for.
pub(super) fn light(light: &AnalyticLight) -> Option<Value> {
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
        AnalyticKind::Directional => "directional".into(),
        AnalyticKind::Point => "point".into(),
        AnalyticKind::Spot { inner, outer } => {
            out["spot"] = json!({ "innerConeAngle": inner, "outerConeAngle": outer });
            "spot".into()
        }
        _ => return None,
    };
    Some(out)
}

/// What a node says of a photometric light on it; `None` for other kinds.
pub(super) fn profile_light(light: &AnalyticLight) -> Option<Value> {
    match light.kind {
        AnalyticKind::Profile { profile, .. } => Some(json!({ IES: {
            "light": profile,
            "multiplier": light.intensity,
            "color": light.color,
        } })),
        _ => None,
    }
}

impl Writer {
    /// A photometric file.
    pub(super) fn profile(&mut self, profile: &Profile) -> Value {
        let view = json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": profile.file.len() });
        self.binary.extend(profile.file.iter());
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.views.push(view);
        json!({
            "name": profile.name,
            "bufferView": self.views.len() - 1,
            "mimeType": "application/x-ies-lm-63",
        })
    }
}
