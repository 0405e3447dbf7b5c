//! Numbers that look random and are the same in every run, vectors in `f64`, a room, variances in it.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{ImportanceModel, Linked, LinkedPoint, Receiver};
use lightbvh::light::LinkedTriangle;
use lightbvh::node::{LinkedMomentNode, Lit};
use lightbvh::{BuildParams, Bvh, EmissiveTriangle, LightNode, Lights, Transform};

/// Hashes of 1, 2, 3 and so on after its seed.
pub struct Random(pub u32);

impl Random {
    pub fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        hash(self.0)
    }

    pub fn below(&mut self, count: u32) -> u32 {
        ((u64::from(self.word()) * u64::from(count)) >> 32) as u32
    }

    /// From 0 to 1.
    pub fn unit(&mut self) -> f32 {
        unit_f32(self.word())
    }

    /// From -1 to 1.
    pub fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    pub fn vector(&mut self, scale: f32) -> [f32; 3] {
        core::array::from_fn(|_| self.signed() * scale)
    }

    pub fn unit_vector(&mut self) -> [f32; 3] {
        loop {
            let v = self.vector(1.0);
            let squared: f32 = v.iter().map(|x| x * x).sum();
            if (0.01..=1.0).contains(&squared) {
                return v.map(|x| x / squared.sqrt());
            }
        }
    }
}

pub type Wide = [f64; 3];

pub fn wide(v: [f32; 3]) -> Wide {
    v.map(f64::from)
}

pub fn minus(a: Wide, b: Wide) -> Wide {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn dot(a: Wide, b: Wide) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn length(v: Wide) -> f64 {
    dot(v, v).sqrt()
}

pub fn cross(a: Wide, b: Wide) -> Wide {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
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
        let at = random.vector(5.0);
        let mut corner = || {
            let edge = random.vector(0.5);
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

/// The first `lights` of a room, in `count` instances that turn, stretch and mirror.
pub fn rooms<N: LightNode<W>, I, const W: usize>(
    random: &mut Random,
    lights: usize,
    count: u32,
) -> Bvh<N, I, W> {
    let mut bvh = Bvh::default();
    let own = room(random).triangles()[..lights].to_vec();
    let mesh = bvh.add_mesh(own).expect("in the domain");
    for k in 0..count {
        let s = if k % 2 == 0 { 1.0 } else { -1.0 };
        let map = Transform {
            columns: [[0.0, 1.5, 0.0], [-0.7, 0.0, 0.2], [0.0, 0.1, s]],
            translation: random.vector(6.0),
        };
        bvh.add_instance(mesh, map).expect("in the domain");
    }
    bvh.refit();
    bvh
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

type LinkedNode = Lit<LinkedMomentNode<8>, LinkedTriangle>;

/// Of the lights of a room, every third has a bit of the receiver, and it alone a probability.
pub fn masks_go_with<I, P: Receiver>(random: &mut Random, point: impl Fn(&mut Random) -> P)
where
    Linked<I>: ImportanceModel<LinkedNode, 8, LinkedPoint<P>>,
{
    let own = room(random);
    let linked = own.triangles().iter().zip(0..).map(|(&light, k)| LinkedTriangle {
        light,
        mask: 1 << (k % 3),
    });
    let linked = Lights::new(linked.collect()).expect("in the domain");
    let bvh = Bvh::<LinkedNode, Linked<I>, 8>::two_level(&linked, &BuildParams::default());
    let receiver = LinkedPoint {
        point: point(random),
        mask: 0b100,
    };
    let mut sum = 0.0;
    for (light, own) in (0..).zip(own.triangles()) {
        let pmf = bvh.tree().pmf(&receiver, light, own.mesh);
        assert_eq!(pmf > 0.0, light % 3 == 2);
        sum += f64::from(pmf);
    }
    assert!((sum - 1.0).abs() < 1e-5, "{sum}");
}
