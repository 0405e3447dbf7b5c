//! Lights of each kind, and a room.

pub use crate::numbers::{Random, Wide, dot, minus, times};
use crate::numbers::{cross, narrow, normalize};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::light::{AnyLight, DiscLight, PointLight, RectangleLight, SphereLight, SpotLight};
use lightbvh::{EmissiveTriangle, Lights, ShadingPoint, Transform};

impl Random {
    pub fn within(&mut self, scale: f32) -> [f32; 3] {
        (self.vector() * scale).to_array()
    }

    pub fn unit_vector(&mut self) -> [f32; 3] {
        self.direction().to_array()
    }

    /// A unit vector at right angles to a unit vector.
    pub fn across(&mut self, axis: [f32; 3]) -> [f32; 3] {
        narrow(normalize(cross(wide(axis), wide(self.within(1.0))))).to_array()
    }

    /// On a surface within `reach`, or one of three in a volume.
    pub fn point(&mut self, reach: f32) -> ShadingPoint {
        let p = self.within(reach);
        let n = match self.below(3) {
            0 => [0.0; 3],
            _ => self.unit_vector(),
        };
        ShadingPoint { p, n }
    }

    /// A rotation times `scale` and up to 4 or a fourth of that, one of two mirrored.
    pub fn similarity(&mut self, reach: f32, scale: f32) -> Transform {
        let [a, b, c] = self.axes().map(|v| narrow(v).to_array());
        let s = scale * 4.0_f32.powf(self.signed());
        let sign = if self.below(2) == 0 { -s } else { s };
        Transform {
            columns: [a.map(|x| x * s), b.map(|x| x * s), c.map(|x| x * sign)],
            translation: self.within(reach),
        }
    }

    /// None in one of ten.
    fn shine(&mut self) -> [f32; 3] {
        let dark = self.unit() < 0.1;
        core::array::from_fn(|_| if dark { 0.0 } else { 0.1 + 5.0 * self.unit() })
    }

    pub fn triangle(&mut self) -> EmissiveTriangle {
        EmissiveTriangle {
            p: core::array::from_fn(|_| self.within(0.5)),
            radiance: self.shine(),
            mesh: 0,
            flags: u32::from(self.unit() < 0.3),
        }
    }

    pub fn bulb(&mut self) -> PointLight {
        PointLight {
            p: self.within(1.0),
            intensity: self.shine(),
            range: 0.0,
            mesh: 0,
        }
    }

    pub fn sphere(&mut self) -> SphereLight {
        SphereLight {
            p: self.within(1.0),
            radius: 0.01 + 0.2 * self.unit(),
            radiance: self.shine(),
            mesh: 0,
        }
    }

    pub fn rectangle(&mut self) -> RectangleLight {
        RectangleLight {
            p: self.within(1.0),
            half: [self.within(0.3), self.within(0.3)],
            radiance: self.shine(),
            mesh: 0,
            flags: u32::from(self.unit() < 0.3),
        }
    }

    pub fn disc(&mut self) -> DiscLight {
        DiscLight {
            p: self.within(1.0),
            half: [self.within(0.3), self.within(0.3)],
            radiance: self.shine(),
            mesh: 0,
            flags: u32::from(self.unit() < 0.3),
        }
    }

    pub fn spot(&mut self) -> SpotLight {
        let outer = self.signed() * 0.95;
        SpotLight {
            p: self.within(1.0),
            intensity: self.shine(),
            range: 0.0,
            axis: self.unit_vector(),
            cos_inner: outer + (1.0 - outer) * self.unit(),
            cos_outer: outer,
            mesh: 0,
        }
    }

    /// A light of kind `kind`, 0 to 5; spots are the last.
    pub fn light(&mut self, kind: u32) -> AnyLight {
        match kind {
            0 => self.triangle().into(),
            1 => self.bulb().into(),
            2 => self.sphere().into(),
            3 => self.rectangle().into(),
            4 => self.disc().into(),
            _ => self.spot().into(),
        }
    }
}

pub fn wide(v: [f32; 3]) -> Wide {
    v.map(f64::from)
}

/// 200 triangles of up to half a metre in a room of 10 m, in four meshes.
pub fn room(random: &mut Random) -> Lights {
    let triangle = |k: u32| {
        let at = random.within(5.0);
        let mut corner = || {
            let edge = random.within(0.5);
            [at[0] + edge[0], at[1] + edge[1], at[2] + edge[2]]
        };
        EmissiveTriangle {
            p: [at, corner(), corner()],
            radiance: [0.1 + 2.0 * unit_f32(hash(k)); 3],
            mesh: k / 50,
            flags: u32::from(k % 5 == 2) * EmissiveTriangle::TWO_SIDED,
        }
    };
    Lights::new((0..200).map(triangle).collect()).expect("in the domain")
}
