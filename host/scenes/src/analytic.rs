//! Lights by formula: points and spots (`KHR_lights_punctual`), spheres, rectangles and discs.

use lightbvh::light::{AnyLight, DiscLight, PointLight, RectangleLight, SphereLight, SpotLight};

/// A light on a node, shining along the node's -Z where it has a direction.
#[derive(Clone, Debug, PartialEq)]
pub struct AnalyticLight {
    /// For messages.
    pub name: String,
    /// Index into [`SceneData::nodes`](super::SceneData::nodes).
    pub node: u32,
    /// What kind of light.
    pub kind: AnalyticKind,
    /// Linear RGB, not negative.
    pub color: [f32; 3],
    /// Factor on the colour, not negative. Of points and spots radiant intensity, W/sr (glTF: candela), of spheres, rectangles and
    /// discs radiance, W/(m² sr).
    pub intensity: f32,
    /// Of points and spots: metres from which on nothing arrives, 2^-20 to 2^40; without, light arrives everywhere.
    pub range: Option<f32>,
}

/// Kinds of lights by formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnalyticKind {
    /// From one point, in all directions.
    Point,
    /// From one point, within a cone.
    Spot {
        /// Angle from the axis up to which the light is whole, radians, from 0.
        inner: f32,
        /// Angle from the axis beyond which there is none, radians, above 0, not below `inner`, at most a right angle.
        outer: f32,
    },
    /// From the surface of a sphere, outward.
    Sphere {
        /// Metres.
        radius: f32,
    },
    /// From one side of a rectangle in the node's plane z = 0.
    Rectangle {
        /// Half its size along x and y, metres.
        half: [f32; 2],
    },
    /// From one side of an ellipse there.
    Disc {
        /// Half its size along x and y, metres.
        half: [f32; 2],
    },
}

impl AnalyticKind {
    /// Half the size of a light with a size, metres; empty for lights without, which scales of their nodes do not change.
    pub(super) fn half(&self) -> &[f32] {
        match self {
            Self::Point | Self::Spot { .. } => &[],
            Self::Sphere { radius } => std::slice::from_ref(radius),
            Self::Rectangle { half } | Self::Disc { half } => half,
        }
    }
}

impl AnalyticLight {
    /// Colour times intensity.
    pub(super) fn emission(&self) -> [f32; 3] {
        self.color.map(|channel| channel * self.intensity)
    }

    /// The light in the space of its node.
    pub fn light(&self) -> AnyLight {
        let emission = self.emission();
        let (p, mesh) = ([0.0; 3], 0);
        let range = self.range.unwrap_or(0.0);
        // The front of what has one is the node's -Z.
        let flat = |[x, y]: [f32; 2]| [[0.0, y, 0.0], [x, 0.0, 0.0]];
        match self.kind {
            AnalyticKind::Point => PointLight {
                p,
                intensity: emission,
                range,
                mesh,
            }
            .into(),
            AnalyticKind::Spot { inner, outer } => SpotLight {
                p,
                intensity: emission,
                range,
                axis: [0.0, 0.0, -1.0],
                cos_inner: cosine(inner),
                cos_outer: cosine(outer).min(1.0 - 2.0_f32.powi(-20)),
                mesh,
            }
            .into(),
            AnalyticKind::Sphere { radius } => SphereLight {
                p,
                radius,
                radiance: emission,
                mesh,
            }
            .into(),
            AnalyticKind::Rectangle { half } => RectangleLight {
                p,
                half: flat(half),
                radiance: emission,
                mesh,
                flags: 0,
            }
            .into(),
            AnalyticKind::Disc { half } => DiscLight {
                p,
                half: flat(half),
                radiance: emission,
                mesh,
                flags: 0,
            }
            .into(),
        }
    }
}

fn cosine(angle: f32) -> f32 {
    libm::cos(f64::from(angle)) as f32
}
