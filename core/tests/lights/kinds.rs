//! A light BVH over each kind of light: probabilities sum to one, no light is lost, estimates converge to the sum over all
//! lights, and edits, rebuilds and files go on with it.

use crate::kit::Random;
use lightbvh::exact::hash;
use lightbvh::light::{AnyLight, Light};
use lightbvh::{Bvh, Defensive, Edit, MomentNode, Moments, Random64, Rebuilder, ShadingPoint, Transform};

type Tree = Bvh<(MomentNode<8, AnyLight>, Defensive<Moments, 6>)>;

const PER_MESH: usize = 24;

/// 40 instances of four meshes.
fn scene(random: &mut Random, light: &dyn Fn(&mut Random) -> AnyLight) -> Tree {
    let mut bvh = Tree::default();
    let meshes = [(); 4].map(|()| {
        let lights = (0..PER_MESH).map(|_| light(random)).collect();
        bvh.add_mesh(lights).expect("in the domain")
    });
    for k in 0..40 {
        let id = bvh
            .add_instance(meshes[k % 4], place(random))
            .expect("in the domain");
        if k % 7 == 0 {
            bvh.set_radiance(id, [0.0, 0.25, 2.0]).expect("a factor");
        }
    }
    bvh.refit();
    bvh
}

fn place(random: &mut Random) -> Transform {
    random.similarity(20.0, 0.5)
}

fn luminance(rgb: [f32; 3]) -> f64 {
    let [r, g, b] = rgb.map(f64::from);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// What one random point of a light sends.
fn sent(light: &AnyLight, point: &ShadingPoint, random: &mut Random) -> f64 {
    let uv = [random.unit(), random.unit()];
    luminance(light.point_for(point.p.into(), uv).irradiance(point))
}

fn check_sampling(name: &str, bvh: &Tree, random: &mut Random) {
    bvh.view().validate().expect(name);
    let world = bvh.view().world_lights();
    for _ in 0..6 {
        let point = random.point(22.0);
        let (mut sum, mut expected, mut squares) = (0.0, 0.0, 0.0);
        for (light, own) in (0..).zip(&world).filter(|(_, own)| own.mesh() != u32::MAX) {
            let pmf = f64::from(bvh.tree().pmf(&point, light, own.mesh()));
            assert!(
                !own.has_flux() || pmf > 0.0,
                "{name}: light {light} is lost at {point:?}"
            );
            sum += pmf;
            for _ in 0..64 {
                let one = sent(own, &point, random);
                expected += one / 64.0;
                squares += if one > 0.0 { one * one / pmf / 64.0 } else { 0.0 };
            }
        }
        assert!((sum - 1.0).abs() < 1e-5, "{name}: pmfs sum to {sum} at {point:?}");
        // The estimate by samples: its mean is that of all lights within six of its standard deviations.
        const SAMPLES: u32 = 20_000;
        let mut mean = 0.0;
        for _ in 0..SAMPLES {
            let sampled = bvh.tree().sample(&point, Random64::from(random.word()));
            let pmf = bvh.tree().pmf(&point, sampled.light, sampled.instance);
            assert_eq!(sampled.pmf.to_bits(), pmf.to_bits(), "{name}");
            let light = bvh.owner(&sampled).expect("a light").light;
            mean += sent(&light, &point, random) / f64::from(pmf) / f64::from(SAMPLES);
        }
        let deviation = (squares / f64::from(SAMPLES)).sqrt();
        // The sum over all lights is an estimate by 64 points of each.
        assert!(
            (mean - expected).abs() <= 6.0 * deviation + 0.03 * expected,
            "{name}: {mean:e}, expected {expected:e} within {deviation:e} at {point:?}"
        );
    }
}

#[test]
fn each_kind_alone_and_all_in_one_tree() {
    for kind in 0..7 {
        let light = |random: &mut Random| {
            let kind = if kind < 6 { kind } else { random.below(6) };
            random.light(kind)
        };
        let random = &mut Random(11);
        let mut bvh = scene(random, &light);
        let name = &*format!("kind {kind}");
        check_sampling(name, &bvh, random);
        // Edits, rebuilds meanwhile, and the words of what is refitted against what is read from a file.
        let mut rebuilder = Rebuilder::default();
        for _ in 0..12 {
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            let ids: Vec<_> = bvh.view().instance_ids().collect();
            let id = ids[random.below(ids.len() as u32) as usize];
            bvh.set_transform(id, place(random)).expect("in the domain");
            let mesh = bvh.view().mesh_of(id).expect("a mesh");
            let new = (0..PER_MESH).map(|_| light(random)).collect();
            let (first, lights) = (3, vec![light(random)]);
            let some = Edit::SetLightRange { mesh, first, lights };
            bvh.apply(vec![Edit::SetLights { mesh, lights: new }, some])
                .expect("in the mesh");
            bvh.remove(id).expect("it is there");
            bvh.add_instance(mesh, place(random)).expect("in the domain");
            bvh.refit();
            rebuilder.end_frame(&bvh);
        }
        check_sampling(name, &bvh, random);
        let words = bvh.to_words();
        let read = Tree::from_words(&words).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(read.view().world_lights(), bvh.view().world_lights(), "{name}");
        assert!(read.to_words() == words, "{name}");
        let error = lightbvh::LightBvh::from_words(&words).expect_err("of another kind");
        assert!(error.to_string().contains("emissive triangle"), "{error}");
    }
}

/// A light of any kind is what it was made of.
#[test]
fn any_light_is_its_kind() {
    fn same<L: Light + Into<AnyLight> + TryFrom<AnyLight, Error = AnyLight>>(own: L, random: &mut Random) {
        let any: AnyLight = own.into();
        assert_eq!(L::try_from(any), Ok(own));
        assert_eq!(
            any.checked().map(|any| L::try_from(any).ok()),
            own.checked().map(Some)
        );
        assert_eq!((any.moments(), any.bounds()), (own.moments(), own.bounds()));
        assert_eq!(
            (any.centroid(), any.reach(), any.has_flux(), any.beam()),
            (own.centroid(), own.reach(), own.has_flux(), own.beam())
        );
        let from = random.within(3.0).into();
        let uv = [random.unit(), random.unit()];
        assert_eq!(any.point_for(from, uv), own.point_for(from, uv));
        let mut bvh = Tree::default();
        let mesh = bvh.add_mesh(vec![any]).expect("in the domain");
        bvh.add_instance(mesh, place(random)).expect("in the domain");
        let instance = &bvh.view().instances()[0];
        let world = any.in_world(instance, 5);
        assert_eq!(L::try_from(world), Ok(own.in_world(instance, 5)));
    }
    let random = &mut Random(hash(3));
    for _ in 0..200 {
        same(random.triangle(), random);
        same(random.bulb(), random);
        same(random.spot(), random);
        same(random.sphere(), random);
        same(random.rectangle(), random);
        same(random.disc(), random);
    }
    // Words of no kind, and flags of kinds without sides, are refused.
    let words: &mut [u32] = &mut [0; 14];
    for kind in [6, 255, 1 | (1 << 8), 4 | (2 << 8)] {
        words[13] = kind;
        let any: AnyLight = *bytemuck::from_bytes(bytemuck::cast_slice(words));
        any.checked().expect_err("of no kind");
    }
}
