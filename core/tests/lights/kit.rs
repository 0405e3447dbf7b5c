//! Lights of each kind, a room, variances in it.

pub use crate::numbers::{Random, Wide, cross, dot, minus, times};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{ImportanceModel, Receiver};
use lightbvh::light::{
    AnyLight, BoxLight, DiscLight, PointLight, ProfileLight, RectangleLight, SphereLight, SpotLight,
};
use lightbvh::{BuildParams, Bvh, EmissiveTriangle, LightNode, Lights, ShadingPoint, Transform};

impl Random {
    pub fn within(&mut self, scale: f32) -> [f32; 3] {
        (self.vector() * scale).to_array()
    }

    pub fn unit_vector(&mut self) -> [f32; 3] {
        loop {
            let v = self.within(1.0);
            let squared: f32 = v.iter().map(|x| x * x).sum();
            if (0.01..=1.0).contains(&squared) {
                return v.map(|x| x / squared.sqrt());
            }
        }
    }

    /// A unit vector at right angles to a unit vector.
    pub fn across(&mut self, axis: [f32; 3]) -> [f32; 3] {
        loop {
            let other = self.unit_vector();
            let d: f32 = (0..3).map(|k| other[k] * axis[k]).sum();
            if d.abs() < 0.9 {
                let v: [f32; 3] = core::array::from_fn(|k| other[k] - d * axis[k]);
                let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
                return v.map(|x| x / length);
            }
        }
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
        let a = self.unit_vector();
        let b = self.across(a);
        let c: [f32; 3] =
            core::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
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

    pub fn glow(&mut self) -> BoxLight {
        BoxLight {
            p: self.within(1.0),
            half: [self.within(0.3), self.within(0.3), self.within(0.3)],
            radiance: self.shine(),
            mesh: 0,
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

    pub fn profile(&mut self) -> ProfileLight {
        let axis = self.unit_vector();
        let outer = self.signed() * 0.95;
        ProfileLight {
            p: self.within(1.0),
            intensity: self.shine(),
            axis,
            across: self.across(axis),
            cos_outer: outer,
            whole: 0.1 + 0.9 * (1.0 - outer) * self.unit(),
            mean_cosine: outer + (1.0 - outer) * self.unit(),
            mesh: 0,
            flags: 2 * u32::from(self.unit() < 0.3),
        }
    }

    /// A light of kind `kind`, 0 to 7; spots and profiles are the last two.
    pub fn light(&mut self, kind: u32) -> AnyLight {
        match kind {
            0 => self.triangle().into(),
            1 => self.bulb().into(),
            2 => self.sphere().into(),
            3 => self.rectangle().into(),
            4 => self.disc().into(),
            5 => self.glow().into(),
            6 => self.spot().into(),
            _ => self.profile().into(),
        }
    }
}

pub fn wide(v: [f32; 3]) -> Wide {
    v.map(f64::from)
}

pub fn length(v: Wide) -> f64 {
    dot(v, v).sqrt()
}

/// Twice a triangle's area times its normal, and the middles of `N`² pieces of it.
pub fn pieces<const N: usize>(triangle: &EmissiveTriangle) -> (Wide, Vec<Wide>) {
    let v = triangle.p.map(wide);
    let (a, b) = (minus(v[1], v[0]), minus(v[2], v[0]));
    let middle = |i: usize| {
        let (mut s, mut t) = (
            ((i / N) as f64 + 0.4) / N as f64,
            ((i % N) as f64 + 0.5) / N as f64,
        );
        // Pieces of a square, the upper half of which is the lower one turned.
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        core::array::from_fn(|k| v[0][k] + a[k] * s + b[k] * t)
    };
    (cross(a, b), (0..N * N).map(middle).collect())
}

/// What of a cosine at its front a triangle emits by.
pub fn emitted(triangle: &EmissiveTriangle, cosine: f64) -> f64 {
    if triangle.is_two_sided() {
        cosine.abs()
    } else {
        cosine.max(0.0)
    }
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

/// Mean relative variance of one sample in a room, by enumeration of all lights. `query` returns a
/// receiver as the importance takes it, and the light that arrives there; receivers without light do not count.
pub fn variance<N, I, P, F, const W: usize>(
    two: bool,
    count: u32,
    query: impl Fn(&mut Random) -> (P, F),
) -> f64
where
    N: LightNode<W>,
    P: Receiver,
    I: ImportanceModel<N, W, P>,
    F: Fn(&EmissiveTriangle) -> f64,
{
    let random = &mut Random(4);
    let lights = room(random);
    let bvh: Bvh<N, I, W> = if two {
        Bvh::two_level(&lights, &BuildParams::default())
    } else {
        Bvh::single_level(&lights, &BuildParams::default())
    };
    let (mut all, mut reached) = (0.0, 0.0);
    for index in 0..count {
        let (told, received) = query(random);
        let (mut mean, mut square, mut sum) = (0.0, 0.0, 0.0);
        for (light, triangle) in (0..).zip(lights.triangles()) {
            let instance = if two { triangle.mesh } else { 0 };
            let pmf = f64::from(bvh.tree().pmf(&told, light, instance));
            let f = received(triangle);
            assert!(pmf > 0.0 || f == 0.0, "{light} is lost at receiver {index}");
            mean += f;
            square += if f > 0.0 { f * f / pmf } else { 0.0 };
            sum += pmf;
        }
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        if mean > 0.0 {
            all += square / (mean * mean) - 1.0;
            reached += 1.0;
        }
    }
    assert!(reached > 0.9 * f64::from(count), "{reached}");
    all / reached
}
