//! Light linking against an exhaustive oracle: a light has a probability just where it has flux and its instance a bit in common with
//! the receiver, through edits, refits, rebuilds and files.

use crate::kit::Random;
use lightbvh::bvh::{RebuilderParams, Swap};
use lightbvh::importance::{
    Leveled, Linked, LinkedPoint, RaySegment, Subtended, Transmissive, TransmissivePoint,
};
use lightbvh::light::{AnyLight, Light};
use lightbvh::node::{LinkedSpotMomentNode, Node, SpotMomentNode};
use lightbvh::tree::{LightTree, OPENED};
use lightbvh::{
    BuildParams, Bvh, Edit, Flux, Glossy, GlossyPoint, ImportanceModel, Instance, InstanceId, Lights, MeshId,
    MomentNode, Moments, Random64, Rebuilder, Receiver, SampledLight, ShadingPoint, Transform,
};

type Tree = Bvh<(LinkedSpotMomentNode<8, AnyLight>, Linked<Moments>)>;

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
        LinkedPoint {
            point: self.point(reach),
            mask: match self.below(6) {
                0 => self.word(),
                _ => self.mask(),
            },
        }
    }

    /// Emission over six orders of magnitude: what is left may be far dimmer than what is masked out. One in eight has none.
    fn leveled(&mut self) -> AnyLight {
        let kind = self.below(6);
        let level = 10.0_f32.powf(3.0 * self.signed());
        let level = if self.below(8) == 0 { 0.0 } else { level };
        let light = self.light(kind);
        light.with_emission(light.emission().map(|x| x * level))
    }

    /// A factor on radiance, one of three of one colour alone.
    fn factor(&mut self) -> [f32; 3] {
        [[0.0; 3], [1.0; 3], [40.0, 0.0, 0.0]][self.below(3) as usize]
    }

    fn place(&mut self) -> Transform {
        let mut place = self.similarity(30.0, 1.0);
        place.columns[0] = place.columns[0].map(|x| x * 2.0);
        place
    }
}

fn lights(random: &mut Random, count: u32) -> Vec<AnyLight> {
    (0..count).map(|_| random.leveled()).collect()
}

fn put(bvh: &mut Tree, mesh: MeshId, random: &mut Random) -> InstanceId {
    let id = bvh.add_instance(mesh, random.place()).expect("in the domain");
    bvh.set_mask(id, random.mask()).expect("an instance");
    id
}

/// A light's number, its instance, and whether it has flux.
struct Known {
    light: u32,
    instance: u32,
    shines: bool,
    mask: u32,
}

fn known(bvh: &Tree) -> Vec<Known> {
    let mut all = Vec::new();
    let view = bvh.view();
    for id in view.instance_ids() {
        let mesh = view.mesh_of(id).expect("of an instance");
        let own = view.mesh_lights(mesh).expect("of a mesh");
        let Instance { radiance, mask, .. } = view.instances()[id.index() as usize];
        let is_on = radiance.iter().any(|&x| x > 0.0);
        let numbers = view.lights_of(id).expect("of an instance");
        all.extend(numbers.zip(own).map(|(light, own)| Known {
            light,
            instance: id.index(),
            shines: is_on && own.has_flux(),
            mask,
        }));
    }
    all
}

/// What was seen, so that no case is missing.
#[derive(Debug, Default)]
struct Seen {
    without: u32,
    partial: u32,
    of_one: u32,
}

fn check<N: Node<8>, I: ImportanceModel<N, 8, LinkedPoint<P>>, P: Receiver>(
    tree: &LightTree<'_, N, I, 8>,
    known: &[Known],
    receiver: &LinkedPoint<P>,
    random: &mut Random,
    seen: &mut Seen,
) {
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
        sum += f64::from(pmf);
        allowed += u32::from(is_allowed);
        shining += u32::from(own.shines);
        pmfs.push(pmf);
    }
    seen.without += u32::from(allowed == 0);
    seen.partial += u32::from(0 < allowed && allowed < shining);
    seen.of_one += u32::from(allowed == 1);
    let expected = if allowed > 0 { 1.0 } else { 0.0 };
    assert!((sum - expected).abs() < 1e-5, "pmfs sum to {sum}");
    for k in 0..26 {
        let number = match k {
            0 => Random64 { high: 0, low: 0 },
            1 => Random64::from(u64::MAX),
            _ => Random64::from(random.word()),
        };
        let sampled = tree.sample(receiver, number);
        if allowed == 0 {
            assert_eq!(sampled, SampledLight::NONE);
        } else {
            let at = known
                .iter()
                .position(|own| own.light == sampled.light && own.instance == sampled.instance);
            assert_eq!(sampled.pmf.to_bits(), pmfs[at.expect("a light")].to_bits());
            assert!(sampled.pmf > 0.0);
        }
        let many = tree.sample_many::<LinkedPoint<P>, 5>(receiver, number);
        assert_eq!(many[3], tree.sample(receiver, number.spaced(3, 5)));
        let mut batch = [SampledLight::NONE; 2];
        tree.sample_batch(&[*receiver; 2], &[number; 2], &mut batch);
        assert_eq!(batch, [sampled; 2]);
    }
}

/// The same for receivers of every kind in the bright, masked-out light `near`.
fn check_all(bvh: &Tree, receivers: u32, random: &mut Random, seen: &mut Seen) {
    bvh.view().validate().expect("nodes are what refit makes");
    let known = known(bvh);
    for _ in 0..receivers {
        let receiver = random.receiver(32.0);
        check(&bvh.tree(), &known, &receiver, random, seen);
    }
    let near = known.get(random.below(known.len().max(1) as u32) as usize);
    let Some((own, light)) = near.and_then(|own| Some((own, bvh.view().light(own.light, own.instance)?)))
    else {
        return;
    };
    macro_rules! check_by {
        ($importance:ty, $point:expr) => {
            let (point, mask) = ($point, !own.mask);
            let receiver = LinkedPoint { point, mask };
            check(
                &bvh.tree().by::<Linked<$importance>>(),
                &known,
                &receiver,
                random,
                seen,
            );
        };
    }
    let point = ShadingPoint {
        p: light.centroid(),
        n: [0.0, 1.0, 0.0],
    };
    let glossy = GlossyPoint {
        point,
        mirror: [0.0, 1.0, 0.0],
        diffuse: 0.0,
        specular: 1.0,
        exponent: 65_536.0,
    };
    let leaf = TransmissivePoint {
        point,
        front: 0.4,
        back: 0.6,
    };
    let ray = RaySegment {
        from: point.p,
        to: random.within(20.0),
    };
    check_by!(Moments, point);
    check_by!(Flux, point);
    check_by!(Leveled<Moments, 9>, point);
    check_by!(Glossy<Moments>, glossy);
    check_by!(Transmissive<Moments>, leaf);
    check_by!(Subtended, ray);
}

/// With beams beside the masks, and large meshes whose parts are leaves of the top level with the instance's mask.
#[test]
fn two_levels_go_on_by_edits() {
    let (mut seen, mut opened) = (Seen::default(), 0);
    for seed in 0..4 {
        let random = &mut Random(1000 * seed + 7);
        let mut bvh = Tree::default();
        let mut ids = Vec::new();
        for _ in 0..2 + random.below(6) {
            let count = if seed == 3 { 300 } else { 1 + random.below(40) };
            let own = lights(random, count);
            let mesh = bvh.add_mesh(own).expect("in the domain");
            for _ in 0..=random.below(8) {
                ids.push(put(&mut bvh, mesh, random));
            }
        }
        bvh.refit();
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        for frame in 0..30 {
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            let at = random.below(ids.len() as u32) as usize;
            let mesh = bvh.view().mesh_of(ids[at]).expect("a mesh");
            let count = bvh.view().mesh_lights(mesh).expect("a mesh").len() as u32;
            match random.below(7) {
                0 => bvh.set_transform(ids[at], random.place()).expect("in the domain"),
                1 => bvh.set_radiance(ids[at], random.factor()).expect("a factor"),
                2 | 3 => {
                    let first = random.below(count);
                    let some = 1 + random.below(count - first);
                    let lights = lights(random, some);
                    bvh.apply(vec![Edit::SetLightRange { mesh, first, lights }])
                        .expect("in the mesh");
                }
                4 if ids.len() > 2 => {
                    bvh.remove(ids.swap_remove(at)).expect("it is there");
                }
                5 => bvh.set_mask(ids[at], random.mask()).expect("an instance"),
                _ => ids.push(put(&mut bvh, mesh, random)),
            }
            bvh.refit();
            rebuilder.end_frame(&bvh);
            if frame % 3 == 0 {
                check_all(&bvh, 3, random, &mut seen);
            }
        }
        bvh.rebuild();
        check_all(&bvh, 6, random, &mut seen);
        let places = bvh.tree().links.places.iter();
        opened += places
            .filter(|&&place| place != u32::MAX && place & OPENED != 0)
            .count();
        let words = bvh.to_words();
        let read = Tree::from_words(&words).expect("the words just written");
        assert!(read.to_words() == words);
        check_all(&read, 4, random, &mut seen);
        assert!(Bvh::<(MomentNode<8, AnyLight>, Moments)>::from_words(&words).is_err());
    }
    assert!(
        seen.without > 30 && seen.partial > 100 && opened > 0,
        "{seen:?} {opened}"
    );
}

/// With every bit in common, light and probability are those of the importance, to the bit; and other importances do not see masks.
#[test]
fn masks_that_allow_all_change_nothing() {
    let random = &mut Random(9);
    let own: Vec<_> = (0..700).map(|_| random.triangle()).collect();
    let lights = Lights::new(own).expect("in the domain");
    let plain: Bvh<(SpotMomentNode<8>, Moments)> = Bvh::single_level(&lights, &BuildParams::default());
    let masked: Bvh<(LinkedSpotMomentNode<8>, Linked<Moments>)> =
        Bvh::single_level(&lights, &BuildParams::default());
    // The words of a node but for the last row are those without masks.
    let row = size_of::<[u32; 8]>();
    let (a, b) = (plain.view().nodes(), masked.view().nodes());
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        let b = bytemuck::bytes_of(b);
        assert_eq!(bytemuck::bytes_of(a), &b[..b.len() - row]);
    }
    for k in 0..3000 {
        let mut receiver = random.receiver(2.0);
        receiver.mask |= 1 << (k % 32);
        let number = random.word();
        let (plain, masked) = (plain.tree(), masked.tree());
        let sampled = plain.sample(&receiver.point, number);
        assert_eq!(sampled, masked.sample(&receiver, number));
        assert_eq!(sampled, masked.by::<Moments>().sample(&receiver.point, number));
        assert_eq!(
            plain.pmf(&receiver.point, k % 700, 0).to_bits(),
            masked.pmf(&receiver, k % 700, 0).to_bits()
        );
    }
}

/// A least share of each child is a least probability of each light, of those that are allowed.
#[test]
fn least_shares_bound_probabilities() {
    const LEAST: f64 = 1.0 / 512.0;
    let random = &mut Random(12);
    let mut bvh = Tree::default();
    for _ in 0..60 {
        let mesh = bvh.add_mesh(lights(random, 10)).expect("in the domain");
        put(&mut bvh, mesh, random);
    }
    bvh.refit();
    // What is raised adds to the sum; shares are whole numbers of 2^21 at least.
    let of_node = LEAST / (1.0 + 8.0 * LEAST) - 2f64.powi(-20);
    let bound = of_node.powi(bvh.view().depth() as i32);
    let tree = bvh.tree().by::<Linked<Leveled<Moments, 9>>>();
    let mut below = 0;
    for _ in 0..40 {
        let receiver = random.receiver(30.0);
        for own in known(&bvh) {
            let plain = bvh.tree().pmf(&receiver, own.light, own.instance);
            let pmf = f64::from(tree.pmf(&receiver, own.light, own.instance));
            assert_eq!(plain > 0.0, pmf > 0.0);
            assert!(pmf == 0.0 || pmf >= bound, "{pmf} of {bound}");
            below += u32::from(plain > 0.0 && f64::from(plain) < bound);
        }
    }
    assert!(below > 0, "nothing is tested");
}
