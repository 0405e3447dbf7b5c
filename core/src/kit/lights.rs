//! One light of each kind.

use crate::light::{DiscLight, RectangleLight, SphereLight, SpotLight};

pub const SHINE: [f32; 3] = [2.0, 3.0, 5.0];

pub fn spot(cos_inner: f32, cos_outer: f32) -> SpotLight {
    SpotLight {
        p: [1.0, 2.0, -1.0],
        intensity: SHINE,
        range: 0.0,
        axis: [0.36, -0.8, 0.48],
        cos_inner,
        cos_outer,
        mesh: 0,
    }
}

pub fn sphere() -> SphereLight {
    SphereLight {
        p: [1.0, 2.0, -1.0],
        radius: 0.75,
        radiance: SHINE,
        mesh: 0,
    }
}

pub fn rectangle(flags: u32) -> RectangleLight {
    RectangleLight {
        p: [1.0, 2.0, -1.0],
        half: [[1.5, 0.0, 0.5], [0.1, 0.25, -0.3]],
        radiance: SHINE,
        mesh: 0,
        flags,
    }
}

pub fn disc(flags: u32) -> DiscLight {
    DiscLight {
        p: [1.0, 2.0, -1.0],
        half: [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]],
        radiance: SHINE,
        mesh: 0,
        flags,
    }
}
