//! Rays: the walk through the ray BVH finds what brute force finds, and ends whatever the buffers hold.

use glam::Vec3;
use lightbvh_host::render::{RayBvh, RayBvhError};
use lightbvh_kernels::shading::grid::{MAX_COORDINATE, snap};
use lightbvh_kernels::shading::ray::{FAR, MISS, Ray};
use lightbvh_kernels::shading::skin::NoSkin;
use lightbvh_kernels::shading::trace::{
    Hit, LANES, MAX_DEPTH, NONE, RayNode, Surfaces, WIDTH, any_hit, closest_hit,
};
use lightbvh_tests::generate::Random;
use lightbvh_tests::soup::{in_cube, soup};
use proptest::prelude::*;

fn brute_force(bvh: &RayBvh, ray: &Ray) -> Hit {
    let mut hit = Hit {
        triangle: NONE,
        t: ray.t_max,
    };
    for (index, triangle) in bvh.triangles() {
        let [p0, p1, p2] = triangle.p.map(Vec3::from);
        let t = ray.meet(p0, p1, p2).before(hit.t);
        if t != MISS {
            hit = Hit { triangle: index, t };
        }
    }
    hit
}

/// Half of the rays go along an axis, a quarter start far outside.
fn random_ray(random: &mut Random, size: f32) -> Ray {
    let far = if random.bits() & 3 == 0 { 100.0 } else { 1.5 };
    let origin = Vec3::from(in_cube(random, size * far));
    let aim = Vec3::from(in_cube(random, size));
    let mut direction = aim - origin;
    if random.bits() & 1 == 0 {
        let keep = (random.bits() % 3) as usize;
        direction = Vec3::from([0, 1, 2].map(|i| if i == keep { direction[i] } else { 0.0 }));
    }
    let t_max = if random.bits() & 1 == 0 {
        FAR
    } else {
        2.0 * random.unit() + 1e-3
    };
    Ray::new(origin, direction, t_max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_walk_finds_what_brute_force_finds(
        seed: u32, count in 0_usize..300, scale in -20_i32..20, edge in 0.01_f32..1.0, grid: bool,
    ) {
        let mut random = Random::new(seed);
        let size = if grid { 4.0 } else { 2f32.powi(scale) };
        let triangles = soup(&mut random, count, size, size * edge, grid);
        let bvh = RayBvh::build(&triangles).unwrap();
        prop_assert_eq!(bvh.triangles().count(), count);
        for _ in 0..100 {
            let ray = random_ray(&mut random, size);
            let expected = brute_force(&bvh, &ray);
            let found = closest_hit(&bvh.surfaces(), &ray);
            // Coincident triangles are equally near: the first tested wins, and both test in the same order.
            prop_assert_eq!(found, expected, "{:?}", ray);
            prop_assert_eq!(any_hit(&bvh.surfaces(), &ray, NONE), expected.triangle != NONE);
        }
    }

    #[test]
    fn hostile_words_end_in_bounded_steps(
        words in prop::collection::vec(any::<u32>(), 0..2000), seed: u32, near: bool,
    ) {
        const WORDS: usize = 7 * WIDTH;
        let plane = |w: &[u32], k: usize| std::array::from_fn(|child| {
            // Any word, or boxes that most rays hit and children that are nodes.
            if near { if k < 3 { -2.0 } else { 2.0 } } else { f32::from_bits(w[k * WIDTH + child]) }
        });
        let nodes: Vec<RayNode> = words.chunks_exact(WORDS).map(|w| RayNode {
            min: [plane(w, 0), plane(w, 1), plane(w, 2)],
            max: [plane(w, 3), plane(w, 4), plane(w, 5)],
            children: std::array::from_fn(|child| {
                let word = w[6 * WIDTH + child];
                if near { RayNode::inner(word % 40) } else { word % 1024 }
            }),
        }).collect();
        let mut random = Random::new(seed);
        let blocks = RayBvh::build(&soup(&mut random, 5, 1.0, 1.0, false)).unwrap().blocks;
        let surfaces = Surfaces { nodes: &nodes, blocks: &blocks, skin: NoSkin };
        for _ in 0..20 {
            let hit = closest_hit(&surfaces, &random_ray(&mut random, 1.0));
            prop_assert!(hit.triangle == NONE || hit.triangle < (LANES * blocks.len()) as u32);
        }
    }

    #[test]
    fn snapping_is_idempotent_and_moves_by_less_than_a_step(bits: u32) {
        let x = f32::from_bits(bits);
        prop_assume!(x.abs() < MAX_COORDINATE);
        let s = snap(x);
        prop_assert!((f64::from(s) - f64::from(x)).abs() < 2f64.powi(-40));
        prop_assert_eq!(snap(s).to_bits(), s.to_bits());
        prop_assert_eq!((f64::from(s) * 2f64.powi(40)).fract(), 0.0);
    }
}

#[test]
fn the_excepted_light_casts_no_shadow_and_others_do() {
    let mut triangles = soup(&mut Random::new(7), 1, 0.0, 0.0, false);
    triangles[0].p = [[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [0.0, 1.0, 1.0]];
    triangles[0].light = 3;
    let bvh = RayBvh::build(&triangles).unwrap();
    let ray = Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 2.0), 1.0);
    assert!(any_hit(&bvh.surfaces(), &ray, NONE));
    assert!(any_hit(&bvh.surfaces(), &ray, 2));
    assert!(!any_hit(&bvh.surfaces(), &ray, 3));
    let short = Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 1.0), 0.999);
    assert!(!any_hit(&bvh.surfaces(), &short, NONE));
}

/// The longest path of nodes from this one on.
fn depth(bvh: &RayBvh, index: u32) -> usize {
    let below = |&child: &u32| {
        if child & 15 == 0 {
            depth(bvh, child >> 4)
        } else {
            0
        }
    };
    let children = bvh.nodes[index as usize].children;
    1 + children
        .iter()
        .filter(|&&child| child != 0)
        .map(below)
        .max()
        .unwrap_or(0)
}

/// Each triangle holds all before it, so that the binary tree is a list.
#[test]
fn no_path_is_longer_than_the_walk_remembers() {
    let mut triangles = soup(&mut Random::new(3), 3000, 1.0, 1.0, false);
    for (k, triangle) in triangles.iter_mut().enumerate() {
        let size = 1.005_f32.powi(k as i32);
        triangle.p = [[-size, -size, 0.0], [size, -size, 0.0], [0.0, size, size]];
    }
    let bvh = RayBvh::build(&triangles).unwrap();
    assert_eq!(
        depth(&bvh, 0),
        MAX_DEPTH,
        "the bound is not reached: no test of it"
    );
    let mut random = Random::new(4);
    for _ in 0..100 {
        let ray = random_ray(&mut random, 2.0);
        assert_eq!(closest_hit(&bvh.surfaces(), &ray), brute_force(&bvh, &ray));
    }
}

#[test]
fn an_empty_scene_has_no_hits_and_bad_coordinates_are_named() {
    let empty = RayBvh::build(&[]).unwrap();
    let ray = Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 1.0), FAR);
    assert_eq!(closest_hit(&empty.surfaces(), &ray).triangle, NONE);

    for bad in [f32::NAN, f32::INFINITY, -2.0 * MAX_COORDINATE] {
        let mut triangles = soup(&mut Random::new(2), 3, 1.0, 1.0, false);
        triangles[2].p[1][0] = bad;
        match RayBvh::build(&triangles).unwrap_err() {
            RayBvhError::Coordinate {
                triangle: 2,
                vertex: 1,
                axis: 0,
                ..
            } => {}
            other => panic!("{other}"),
        }
    }
}
