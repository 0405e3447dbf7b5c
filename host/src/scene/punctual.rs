//! Lights without area: points, spots, and suns (`KHR_lights_punctual`).

/// A light without area on a node, shining along the node's -Z where it has a direction. It is kept with the scene; nothing samples
/// it yet.
#[derive(Clone, Debug, PartialEq)]
pub struct PunctualLight {
    /// For messages.
    pub name: String,
    /// Index into [`SceneData::nodes`](super::SceneData::nodes).
    pub node: u32,
    /// What kind of light.
    pub kind: PunctualKind,
    /// Linear RGB, not negative.
    pub color: [f32; 3],
    /// Not negative. Of points and spots candela (lm/sr), of suns lux (lm/m²).
    pub intensity: f32,
    /// Metres beyond which nothing is lit, above zero; `None`: as far as light goes.
    pub range: Option<f32>,
}

/// Kinds of lights without area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PunctualKind {
    /// The same light from everywhere, in one direction.
    Directional,
    /// From one point, in all directions.
    Point,
    /// From one point, within a cone.
    Spot {
        /// Angle from the axis up to which the light is whole, radians, from 0.
        inner: f32,
        /// Angle from the axis beyond which there is none, radians, above `inner`, at most a right angle.
        outer: f32,
    },
}
