//! Light linking against an exhaustive oracle: a light has a probability just where it has flux and a bit in common with the
//! receiver, through edits, refits, rebuilds and files.

mod levels;
mod shares;

use crate::kit::Random;
use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::{AnyLight, Light, LinkedAny, LinkedTriangle, PointLight, SphereLight};
use lightbvh::node::{LinkedMomentNode, Lit, Node};
use lightbvh::tree::LightTree;
use lightbvh::{
    Bvh, EmissiveTriangle, Flux, Glossy, GlossyPoint, ImportanceModel, Moments, Random64, Receiver,
    SampledLight, ShadingPoint, Transform,
};

type Layout<L> = Lit<LinkedMomentNode<8>, L>;

type Tree<L> = Bvh<Layout<L>, Linked<Moments>, 8>;

impl Random {
    /// Of few bits, so that some receivers have few lights; none for one in eight, all for one in eight.
    fn mask(&mut self) -> u32 {
        match self.below(8) {
            0 => 0,
            1 => u32::MAX,
            2 => 1 << 31,
            _ => 1 << self.below(12),
        }
    }

    fn receiver(&mut self, reach: f32) -> LinkedPoint<ShadingPoint> {
        let n = if self.below(3) == 0 {
            [0.0; 3]
        } else {
            self.unit_vector()
        };
        LinkedPoint {
            point: ShadingPoint {
                p: self.vector(reach),
                n,
            },
            mask: match self.below(6) {
                0 => self.word(),
                _ => self.mask(),
            },
        }
    }

    /// None in one of eight, else over six orders of magnitude: what is left may be far dimmer than what is masked out.
    fn radiance(&mut self) -> [f32; 3] {
        let level = 10.0_f32.powf(3.0 * self.signed());
        let dark = self.below(8) == 0;
        core::array::from_fn(|_| if dark { 0.0 } else { level * (0.1 + self.unit()) })
    }
}

fn triangle(random: &mut Random) -> LinkedTriangle {
    let at = random.vector(5.0);
    let mut p = [at; 3];
    // One in sixteen has no area.
    if random.below(16) > 0 {
        for vertex in &mut p[1..] {
            let edge = random.vector(0.3);
            *vertex = core::array::from_fn(|k| at[k] + edge[k]);
        }
    }
    LinkedTriangle {
        light: EmissiveTriangle {
            p,
            radiance: random.radiance(),
            mesh: 0,
            flags: random.below(2),
        },
        mask: random.mask(),
    }
}

fn any(random: &mut Random) -> LinkedAny {
    let light: AnyLight = match random.below(3) {
        0 => PointLight {
            p: random.vector(5.0),
            intensity: random.radiance(),
            range: 0.0,
            mesh: 0,
        }
        .into(),
        1 => SphereLight {
            p: random.vector(5.0),
            radius: 0.01 + random.unit(),
            radiance: random.radiance(),
            mesh: 0,
        }
        .into(),
        _ => triangle(random).light.into(),
    };
    LinkedAny {
        light,
        mask: random.mask(),
    }
}

fn place(random: &mut Random) -> Transform {
    let turn = random.unit() * core::f32::consts::TAU;
    let (s, c) = (turn.sin(), turn.cos());
    let mut columns = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]];
    for column in &mut columns {
        let scale = 0.25 + 2.0 * random.unit();
        *column = column.map(|x| x * scale);
    }
    Transform {
        columns,
        translation: random.vector(30.0),
    }
}

/// Flux of a light of a mesh, by what it is made of.
trait Shines: Light {
    fn shines(&self) -> bool;
    fn bits(&self) -> u32;
}

fn shines(radiance: [f32; 3], p: [[f32; 3]; 3]) -> bool {
    let edge = |k: usize| -> [f64; 3] { core::array::from_fn(|i| f64::from(p[k][i]) - f64::from(p[0][i])) };
    let (a, b) = (edge(1), edge(2));
    let cross = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    radiance.iter().any(|&x| x > 0.0) && cross.iter().any(|&x| x != 0.0)
}

impl Shines for LinkedTriangle {
    fn shines(&self) -> bool {
        shines(self.light.radiance, self.light.p)
    }

    fn bits(&self) -> u32 {
        self.mask
    }
}

impl Shines for LinkedAny {
    fn shines(&self) -> bool {
        match EmissiveTriangle::try_from(self.light) {
            Ok(own) => shines(own.radiance, own.p),
            Err(other) => other.emission().iter().any(|&x| x > 0.0),
        }
    }

    fn bits(&self) -> u32 {
        self.mask
    }
}

/// A light's number, its instance, and whether the scene, by what it was given, has flux of it.
struct Known {
    light: u32,
    instance: u32,
    shines: bool,
    mask: u32,
}

fn known<L: Shines>(bvh: &Tree<L>) -> Vec<Known> {
    let mut all = Vec::new();
    if bvh.is_single_level() {
        let triangles = bvh.triangles();
        all.extend((0..).zip(triangles).map(|(light, own)| Known {
            light,
            instance: u32::MAX,
            shines: own.shines(),
            mask: own.bits(),
        }));
        return all;
    }
    for index in 0..bvh.instances().len() as u32 {
        let Some(id) = bvh.instance_id(index) else {
            continue;
        };
        let lights = bvh.lights_of(id).expect("of an instance");
        let mesh = bvh.mesh_of(id).expect("of an instance");
        let own = bvh.mesh_triangles(mesh).expect("of a mesh");
        let on = bvh.instances()[index as usize].radiance > 0.0;
        all.extend(lights.zip(own).map(|(light, own)| Known {
            light,
            instance: index,
            shines: on && own.shines(),
            mask: own.bits(),
        }));
    }
    all
}

/// What was seen, so that no case is missing.
#[derive(Debug, Default)]
struct Seen {
    receivers: u32,
    without: u32,
    partial: u32,
    of_one: u32,
}

fn check<N: Node<8>, I, P: Receiver>(
    tree: &LightTree<'_, N, I, 8>,
    known: &[Known],
    receiver: &LinkedPoint<P>,
    random: &mut Random,
    seen: &mut Seen,
) where
    I: ImportanceModel<N, 8, LinkedPoint<P>>,
{
    let (mut sum, mut allowed, mut shining) = (0.0, 0, 0);
    let mut pmfs = Vec::with_capacity(known.len());
    for own in known {
        let pmf = tree.pmf(receiver, own.light, own.instance);
        let is_allowed = own.shines && own.mask & receiver.mask != 0;
        assert_eq!(
            pmf > 0.0,
            is_allowed,
            "light {} of {}: pmf {pmf}, mask {:#x} & {:#x}",
            own.light,
            own.instance,
            own.mask,
            receiver.mask
        );
        if !is_allowed {
            assert_eq!(pmf.to_bits(), 0, "exactly none");
        }
        sum += f64::from(pmf);
        allowed += u32::from(is_allowed);
        shining += u32::from(own.shines);
        pmfs.push(pmf);
    }
    seen.receivers += 1;
    seen.without += u32::from(allowed == 0);
    seen.partial += u32::from(0 < allowed && allowed < shining);
    seen.of_one += u32::from(allowed == 1);
    let expected = if allowed > 0 { 1.0 } else { 0.0 };
    assert!((sum - expected).abs() < 1e-5, "pmfs sum to {sum}");
    let right = |sampled: &SampledLight| {
        if allowed == 0 {
            assert_eq!(*sampled, SampledLight::NONE);
            return;
        }
        let at = known.iter().position(|own| {
            own.light == sampled.light && (own.instance == sampled.instance || own.instance == u32::MAX)
        });
        let at = at.expect("a light of the scene");
        assert!(known[at].shines && known[at].mask & receiver.mask != 0);
        assert_eq!(sampled.pmf.to_bits(), pmfs[at].to_bits());
    };
    for _ in 0..24 {
        let number = Random64 {
            high: random.word(),
            low: random.word(),
        };
        let sampled = tree.sample(receiver, number);
        right(&sampled);
        let many = tree.sample_many::<LinkedPoint<P>, 5>(receiver, number);
        for (k, one) in (0..).zip(&many) {
            assert_eq!(*one, tree.sample(receiver, number.spaced(k, 5)));
        }
        let mut batch = [SampledLight::NONE; 2];
        tree.sample_batch(&[*receiver; 2], &[number; 2], &mut batch);
        assert_eq!(batch, [sampled; 2]);
    }
    for number in [0, u32::MAX] {
        right(&tree.sample(
            receiver,
            Random64 {
                high: number,
                low: number,
            },
        ));
    }
}

fn check_all<L: Shines>(bvh: &Tree<L>, receivers: u32, random: &mut Random, seen: &mut Seen) {
    bvh.validate().expect("nodes are what refit makes");
    let known = known(bvh);
    for _ in 0..receivers {
        let receiver = random.receiver(if bvh.is_single_level() { 6.0 } else { 32.0 });
        check(&bvh.tree(), &known, &receiver, random, seen);
    }
    // Some light at hand, so that a receiver inside a bright, masked one is among them.
    let near = random.below(known.len().max(1) as u32) as usize;
    if let Some(own) = known.get(near) {
        if let Some(light) = bvh.triangle(own.light, own.instance) {
            let receiver = LinkedPoint {
                point: ShadingPoint {
                    p: light.centroid(),
                    n: [0.0, 1.0, 0.0],
                },
                mask: !own.mask,
            };
            check(&bvh.tree(), &known, &receiver, random, seen);
            check(&bvh.by::<Linked<Flux>>(), &known, &receiver, random, seen);
            check(
                &bvh.by::<Linked<Leveled<Moments, 9>>>(),
                &known,
                &receiver,
                random,
                seen,
            );
            let glossy = LinkedPoint {
                point: GlossyPoint {
                    point: receiver.point,
                    mirror: [0.0, 1.0, 0.0],
                    diffuse: 0.0,
                    specular: 1.0,
                    exponent: 65_536.0,
                },
                mask: random.word(),
            };
            check(
                &bvh.by::<Linked<Glossy<Moments>>>(),
                &known,
                &glossy,
                random,
                seen,
            );
        }
    }
}

fn lights<L>(count: u32, random: &mut Random, light: fn(&mut Random) -> L) -> Vec<L> {
    (0..count).map(|_| light(random)).collect()
}
