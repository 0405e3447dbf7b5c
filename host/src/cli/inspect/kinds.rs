//! Lights by their kind, and the tree over all of them.

use lightbvh::light::{AnyLight, Light};
use lightbvh::node::Limits;
use lightbvh_kernels::bvh::WIDTH;
use serde_json::{Value, json};

/// Lights by their kind.
pub(super) struct LightKinds {
    /// How many of each, by [`AnyLight::kind`].
    counts: [usize; 6],
    /// How many have a range, or send their light into a cone of less than a right angle around their axis.
    limited: usize,
}

/// The kinds by their number.
const NAMES: [&str; 6] = [
    "EmissiveTriangle",
    "PointLight",
    "SpotLight",
    "SphereLight",
    "RectangleLight",
    "DiscLight",
];

impl LightKinds {
    /// Of lights; those of kinds that are not known are not counted.
    pub fn of(lights: &[AnyLight]) -> Self {
        let (mut counts, mut limited) = ([0; 6], 0);
        for light in lights {
            if let Some(count) = counts.get_mut(light.kind() as usize) {
                *count += 1;
            }
            let is_limited = light.beam().is_narrow() || light.end() < Limits::ENDLESS;
            limited += usize::from(light.has_flux() && is_limited);
        }
        Self { counts, limited }
    }

    /// The type of the lights: the only kind that there is, or [`AnyLight`].
    fn light_type(&self) -> &'static str {
        let mut there = (0..6).filter(|&kind| self.counts[kind] > 0);
        match (there.next(), there.next()) {
            (Some(kind), None) => NAMES[kind],
            _ => "AnyLight",
        }
    }

    /// The type of a node `width` wide over all of them, as Rust has it. With cones and ranges
    /// ([`SpotMomentNode`](lightbvh::node::SpotMomentNode)) where any light has one: without, points beside or beyond choose it,
    /// which costs variance and no bias.
    fn node_type(&self, width: usize) -> String {
        let layout = ["MomentNode", "SpotMomentNode"][usize::from(self.limited > 0)];
        match self.light_type() {
            "EmissiveTriangle" => format!("{layout}<{width}>"),
            light => format!("{layout}<{width}, {light}>"),
        }
    }

    /// How many there are of each, in words; empty where there is none.
    fn said(&self) -> String {
        let parts = self.counts.iter().zip(NAMES).filter(|(count, _)| **count > 0);
        let parts: Vec<String> = parts.map(|(count, name)| format!("{count} {name}")).collect();
        parts.join(", ")
    }

    /// The same, and how many have a cone or a range.
    pub fn cones(&self) -> String {
        let (said, limited) = (self.said(), self.limited);
        format!(
            "{said}; {limited} of them send their light into a cone of less than 90 degrees, or have a range"
        )
    }

    /// The type of the light BVH over all of them.
    pub fn tree(&self) -> String {
        format!("Bvh<({}, DefaultImportance)>", self.node_type(WIDTH))
    }

    pub fn json(&self) -> Value {
        json!({ "said": self.said(), "narrow": self.limited, "light": self.light_type(), "node": self.node_type(WIDTH) })
    }
}

#[cfg(test)]
mod tests {
    use lightbvh::light::SpotLight;

    use super::*;

    #[test]
    fn cones_below_a_right_angle_that_shine_need_a_wider_node() {
        for (cos_outer, intensity, node) in [
            (0.0, 1.0, "MomentNode<8, SpotLight>"),
            (0.5, 0.0, "MomentNode<8, SpotLight>"),
            (0.5, 1.0, "SpotMomentNode<8, SpotLight>"),
        ] {
            let spot = AnyLight::from(SpotLight {
                p: [0.0; 3],
                intensity: [intensity; 3],
                range: 0.0,
                axis: [0.0, -1.0, 0.0],
                cos_inner: 1.0,
                cos_outer,
                mesh: 0,
            });
            assert_eq!(LightKinds::of(&[spot]).node_type(8), node);
        }
    }
}
