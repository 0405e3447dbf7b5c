//! A light BVH over each kind of light: probabilities sum to one, no light is lost, estimates converge to the sum over all
//! lights, and edits, rebuilds and files go on with it.

use crate::kit::Random;
use lightbvh::exact::hash;
use lightbvh::light::{
    AnyLight, BoxLight, DiscLight, Light, PointLight, ProfileLight, RectangleLight, SphereLight, SpotLight,
};
use lightbvh::node::Lit;
use lightbvh::{
    Bvh, Defensive, EmissiveTriangle, MomentNode, Moments, Random64, Rebuilder, ShadingPoint, Transform,
};

type Tree = Bvh<Lit<MomentNode<8>, AnyLight>, Defensive<Moments, 6>, 8>;

impl Random {
    fn shine(&mut self) -> [f32; 3] {
        let dark = self.unit() < 0.1;
        core::array::from_fn(|_| if dark { 0.0 } else { 0.1 + 5.0 * self.unit() })
    }
}

const MESHES: usize = 4;

const PER_MESH: usize = 24;

const INSTANCES: u32 = 40;

fn scene(random: &mut Random, light: fn(&mut Random) -> AnyLight) -> Tree {
    let mut bvh = Tree::default();
    let meshes: Vec<_> = (0..MESHES)
        .map(|_| {
            let lights = (0..PER_MESH).map(|_| light(random)).collect();
            bvh.add_mesh(lights).expect("in the domain")
        })
        .collect();
    for k in 0..INSTANCES {
        let id = bvh
            .add_instance(meshes[k as usize % MESHES], place(random))
            .expect("in the domain");
        if k % 7 == 0 {
            bvh.set_radiance(id, 0.25).expect("a factor");
        }
    }
    bvh.refit();
    bvh
}

/// A turn about an axis of the frame, a scale, and a mirror now and then.
fn place(random: &mut Random) -> Transform {
    let (s, turn) = (0.5 + random.unit(), random.unit() * core::f32::consts::TAU);
    let (sin, cos) = (s * turn.sin(), s * turn.cos());
    let mirror = if random.unit() < 0.2 { -s } else { s };
    Transform {
        columns: [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, mirror]],
        translation: random.vector(20.0),
    }
}

fn luminance(rgb: [f32; 3]) -> f64 {
    let [r, g, b] = rgb.map(f64::from);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// What a light sends to a point, in the mean over its own points, and the mean of the square.
fn sent(light: &AnyLight, point: &ShadingPoint, random: &mut Random) -> [f64; 2] {
    const TRIALS: usize = 64;
    let mut sums = [0.0; 2];
    for _ in 0..TRIALS {
        let one = luminance(
            light
                .point_for(glam::Vec3::from_array(point.p), [random.unit(), random.unit()])
                .irradiance(point),
        );
        sums[0] += one / TRIALS as f64;
        sums[1] += one * one / TRIALS as f64;
    }
    sums
}

fn shading_points(random: &mut Random) -> Vec<ShadingPoint> {
    (0..6)
        .map(|k| ShadingPoint {
            p: random.vector(22.0),
            n: if k % 3 == 2 {
                [0.0; 3]
            } else {
                random.unit_vector()
            },
        })
        .collect()
}

fn check_sampling(name: &str, bvh: &Tree, random: &mut Random) {
    bvh.validate().unwrap_or_else(|error| panic!("{name}: {error}"));
    let world = bvh.world_lights();
    for point in shading_points(random) {
        let (mut sum, mut expected, mut squares) = (0.0, 0.0, 0.0);
        for (light, own) in (0..).zip(&world) {
            if own.mesh() == u32::MAX {
                continue;
            }
            let pmf = bvh.pmf(&point, light, own.mesh());
            assert!(
                !own.has_flux() || pmf > 0.0,
                "{name}: light {light} is lost at {point:?}"
            );
            sum += f64::from(pmf);
            let [mean, square] = sent(own, &point, random);
            expected += mean;
            squares += if square > 0.0 {
                square / f64::from(pmf)
            } else {
                0.0
            };
        }
        assert!((sum - 1.0).abs() < 1e-5, "{name}: pmfs sum to {sum} at {point:?}");
        // The estimate by samples: its mean is that of all lights within six of its standard deviations.
        const SAMPLES: u32 = 20_000;
        let mut mean = 0.0;
        for _ in 0..SAMPLES {
            random.0 = random.0.wrapping_add(1);
            let sampled = bvh.sample(&point, Random64::from(hash(random.0)));
            assert_eq!(
                sampled.pmf.to_bits(),
                bvh.pmf(&point, sampled.light, sampled.instance).to_bits(),
                "{name}"
            );
            let light = bvh.triangle(sampled.light, sampled.instance).expect("a light");
            let at = light.point_for(glam::Vec3::from_array(point.p), [random.unit(), random.unit()]);
            mean += luminance(at.irradiance(&point)) / f64::from(sampled.pmf) / f64::from(SAMPLES);
        }
        let deviation = (squares / f64::from(SAMPLES)).sqrt();
        // The sum over all lights is an estimate by 64 points of each.
        assert!(
            (mean - expected).abs() < 6.0 * deviation + 0.03 * expected,
            "{name}: {mean:e}, expected {expected:e} within {deviation:e} at {point:?}"
        );
    }
}

fn check(name: &str, light: fn(&mut Random) -> AnyLight) {
    let mut random = Random(11);
    let mut bvh = scene(&mut random, light);
    check_sampling(name, &bvh, &mut random);
    // Edits, rebuilds beside them, and the words of what is refitted against what is read from a file.
    let mut rebuilder = Rebuilder::default();
    for _ in 0..12 {
        rebuilder.begin_frame(&mut bvh).expect("no panic");
        let ids: Vec<_> = (0..bvh.instances().len() as u32)
            .filter_map(|k| bvh.instance_id(k))
            .collect();
        let id = ids[(random.unit() * ids.len() as f32) as usize];
        bvh.set_transform(id, place(&mut random)).expect("in the domain");
        let mesh = bvh.mesh_of(id).expect("a mesh");
        let new: Vec<AnyLight> = (0..PER_MESH).map(|_| light(&mut random)).collect();
        bvh.set_triangles(mesh, new).expect("as many");
        bvh.set_triangle_range(mesh, 3, vec![light(&mut random)])
            .expect("in the mesh");
        bvh.remove_instance(id).expect("it is there");
        bvh.add_instance(mesh, place(&mut random)).expect("in the domain");
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    check_sampling(name, &bvh, &mut random);
    let words = bvh.to_words();
    let read = Tree::from_words(&words).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(read.world_lights(), bvh.world_lights(), "{name}");
    assert!(read.to_words() == words, "{name}");
    let error = lightbvh::LightBvh::from_words(&words).expect_err("of another kind");
    assert!(error.to_string().contains("emissive triangle"), "{error}");
}

fn point(random: &mut Random) -> PointLight {
    PointLight {
        p: random.vector(1.0),
        intensity: random.shine(),
        range: 0.0,
        mesh: 0,
    }
}

fn spot(random: &mut Random) -> SpotLight {
    let outer = random.signed() * 0.95;
    SpotLight {
        p: random.vector(1.0),
        intensity: random.shine(),
        range: 0.0,
        axis: random.unit_vector(),
        cos_inner: outer + (1.0 - outer) * random.unit(),
        cos_outer: outer,
        mesh: 0,
    }
}

fn profile(random: &mut Random) -> ProfileLight {
    let axis = random.unit_vector();
    let across = loop {
        let other = random.unit_vector();
        let d: f32 = axis.iter().zip(other).map(|(a, b)| a * b).sum();
        if d.abs() < 0.9 {
            let v: [f32; 3] = core::array::from_fn(|k| other[k] - d * axis[k]);
            let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
            break v.map(|x| x / length);
        }
    };
    let outer = random.signed() * 0.95;
    ProfileLight {
        p: random.vector(1.0),
        intensity: random.shine(),
        axis,
        across,
        cos_outer: outer,
        whole: 0.1 + 0.9 * (1.0 - outer) * random.unit(),
        mean_cosine: outer + (1.0 - outer) * random.unit(),
        mesh: 0,
        flags: 2 * u32::from(random.unit() < 0.3),
    }
}

fn sphere(random: &mut Random) -> SphereLight {
    SphereLight {
        p: random.vector(1.0),
        radius: 0.01 + 0.2 * random.unit(),
        radiance: random.shine(),
        mesh: 0,
    }
}

fn rectangle(random: &mut Random) -> RectangleLight {
    RectangleLight {
        p: random.vector(1.0),
        half: [random.vector(0.3), random.vector(0.3)],
        radiance: random.shine(),
        mesh: 0,
        flags: u32::from(random.unit() < 0.3),
    }
}

fn disc(random: &mut Random) -> DiscLight {
    DiscLight {
        p: random.vector(1.0),
        half: [random.vector(0.3), random.vector(0.3)],
        radiance: random.shine(),
        mesh: 0,
        flags: u32::from(random.unit() < 0.3),
    }
}

fn glow(random: &mut Random) -> BoxLight {
    BoxLight {
        p: random.vector(1.0),
        half: [random.vector(0.3), random.vector(0.3), random.vector(0.3)],
        radiance: random.shine(),
        mesh: 0,
    }
}

fn triangle(random: &mut Random) -> EmissiveTriangle {
    EmissiveTriangle {
        p: core::array::from_fn(|_| random.vector(0.5)),
        radiance: random.shine(),
        mesh: 0,
        flags: u32::from(random.unit() < 0.3),
    }
}

fn any(random: &mut Random) -> AnyLight {
    match (random.unit() * 8.0) as u32 {
        0 => triangle(random).into(),
        1 => point(random).into(),
        2 => spot(random).into(),
        3 => sphere(random).into(),
        4 => rectangle(random).into(),
        5 => disc(random).into(),
        6 => profile(random).into(),
        _ => glow(random).into(),
    }
}

#[test]
fn each_kind_alone_and_all_in_one_tree() {
    type Kind = (&'static str, fn(&mut Random) -> AnyLight);
    let kinds: [Kind; 9] = [
        ("points", |random| point(random).into()),
        ("spots", |random| spot(random).into()),
        ("profiles", |random| profile(random).into()),
        ("spheres", |random| sphere(random).into()),
        ("rectangles", |random| rectangle(random).into()),
        ("discs", |random| disc(random).into()),
        ("boxes", |random| glow(random).into()),
        ("triangles", |random| triangle(random).into()),
        ("all", any),
    ];
    for (name, light) in kinds {
        check(name, light);
    }
}

/// A light of any kind is what it was made of.
#[test]
fn any_light_is_its_kind() {
    fn same<L: Light + Into<AnyLight> + TryFrom<AnyLight, Error = AnyLight>>(
        own: L,
        instance: &Transform,
        random: &mut Random,
    ) {
        let any: AnyLight = own.into();
        assert_eq!(L::try_from(any), Ok(own));
        assert_eq!(
            any.checked().map(|any| L::try_from(any).ok()),
            own.checked().map(Some)
        );
        assert_eq!((any.moments(), any.bounds()), (own.moments(), own.bounds()));
        assert_eq!(
            (any.centroid(), any.reach(), any.has_flux()),
            (own.centroid(), own.reach(), own.has_flux())
        );
        let from = glam::Vec3::from_array(random.vector(3.0));
        let uv = [random.unit(), random.unit()];
        assert_eq!(any.point_for(from, uv), own.point_for(from, uv));
        let mut bvh = Tree::default();
        let mesh = bvh.add_mesh(vec![any]).expect("in the domain");
        bvh.add_instance(mesh, *instance).expect("in the domain");
        let world = any.in_world(&bvh.instances()[0], 5);
        assert_eq!(L::try_from(world), Ok(own.in_world(&bvh.instances()[0], 5)));
    }
    let mut random = Random(3);
    for _ in 0..200 {
        let at = place(&mut random);
        same(triangle(&mut random), &at, &mut random);
        same(point(&mut random), &at, &mut random);
        same(spot(&mut random), &at, &mut random);
        same(profile(&mut random), &at, &mut random);
        same(sphere(&mut random), &at, &mut random);
        same(rectangle(&mut random), &at, &mut random);
        same(disc(&mut random), &at, &mut random);
        same(glow(&mut random), &at, &mut random);
    }
    // Words of no kind, and flags of kinds without sides, are refused.
    let words: &mut [u32] = &mut [0; 17];
    for kind in [8, 255, 1 | (1 << 8), 6 | (1 << 8), 4 | (2 << 8), 7 | (1 << 8)] {
        words[16] = kind;
        let any: AnyLight = *bytemuck::from_bytes(bytemuck::cast_slice(words));
        any.checked().expect_err("of no kind");
    }
}
