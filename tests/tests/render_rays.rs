//! Rays: the walk through the ray BVH finds what brute force finds, and ends whatever the buffers hold.

use glam::Vec3;
use lightbvh_host::render::{RayBvh, RayBvhError};
use lightbvh_kernels::shading::grid::{MAX_COORDINATE, snap};
use lightbvh_kernels::shading::ray::{FAR, MISS, Ray};
use lightbvh_kernels::shading::textures::NoTextures;
use lightbvh_kernels::shading::trace::{Hit, LANES, NONE, RayNode, Surfaces, WIDTH, any_hit, closest_hit};
use lightbvh_tests::generate::Random;
use lightbvh_tests::soup::{in_cube, soup};
use rayon::prelude::*;

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

#[test]
fn the_walk_finds_what_brute_force_finds() {
    (0..200).into_par_iter().for_each(|seed| {
        let random = &mut Random::new(seed);
        let grid = random.below(2) == 0;
        let (count, edge) = (random.below(300) as usize, random.between(0.01, 1.0));
        let size = if grid {
            4.0
        } else {
            2f32.powi(random.below(40) as i32 - 20)
        };
        let triangles = soup(random, count, size, size * edge, grid);
        let bvh = RayBvh::build(&triangles).unwrap();
        assert_eq!(bvh.triangles().count(), count);
        for _ in 0..100 {
            let ray = random_ray(random, size);
            let expected = brute_force(&bvh, &ray);
            let found = closest_hit(&bvh.surfaces(), &ray);
            // Coincident triangles are equally near: the first tested wins, and both test in the same order.
            assert_eq!(found, expected, "{ray:?}");
            assert_eq!(any_hit(&bvh.surfaces(), &ray, NONE), expected.triangle != NONE);
        }
    });
}

#[test]
fn hostile_words_end_in_bounded_steps() {
    for seed in 0..200 {
        let random = &mut Random::new(seed);
        // Any words, or boxes that most rays hit and children that are nodes.
        let near = seed % 2 == 0;
        let node = |random: &mut Random| {
            let mut plane = |near_to: f32| {
                [0; WIDTH].map(|_| {
                    if near {
                        near_to
                    } else {
                        f32::from_bits(random.bits())
                    }
                })
            };
            RayNode {
                min: [0; 3].map(|_| plane(-2.0)),
                max: [0; 3].map(|_| plane(2.0)),
                children: [0; WIDTH].map(|_| match near {
                    true => RayNode::inner(random.below(40)),
                    false => random.below(1024),
                }),
            }
        };
        let nodes: Vec<RayNode> = (0..random.below(36)).map(|_| node(random)).collect();
        let blocks = RayBvh::build(&soup(random, 5, 1.0, 1.0, false)).unwrap().blocks;
        let surfaces = Surfaces {
            nodes: &nodes,
            blocks: &blocks,
            textures: NoTextures,
        };
        for _ in 0..20 {
            let hit = closest_hit(&surfaces, &random_ray(random, 1.0));
            assert!(hit.triangle == NONE || hit.triangle < (LANES * blocks.len()) as u32);
        }
    }
}

#[test]
fn snapping_is_idempotent_and_moves_by_less_than_a_step() {
    let random = &mut Random::new(1);
    for _ in 0..100_000 {
        let x = f32::from_bits(random.bits());
        if x.abs() < MAX_COORDINATE {
            let s = snap(x);
            assert!((f64::from(s) - f64::from(x)).abs() < 2f64.powi(-40));
            assert_eq!(snap(s).to_bits(), s.to_bits());
            assert_eq!((f64::from(s) * 2f64.powi(40)).fract(), 0.0);
        }
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
    // A balanced tree takes the place of one that is deeper than the walk remembers.
    assert_eq!(depth(&bvh, 0), 4);
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
