//! However a pixel's samples are shared out among images, all lights are picked by numbers at equal distances.

use std::cell::RefCell;

use glam::Vec3;
use lightbvh::{EmissiveTriangle, Random64, SampledLight, ShadingPoint};
use lightbvh_host::render::RayBvh;
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::numbers::Part;
use lightbvh_kernels::shading::pick::PickLight;
use lightbvh_kernels::shading::pixel::{Samples, Scene, Seen, reflected};
use lightbvh_kernels::shading::skin::Spot;
use lightbvh_kernels::shading::sky::NoSky;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

/// Picks the only light, and remembers by which numbers.
struct Listens(RefCell<Vec<u32>>);

impl PickLight for Listens {
    fn pick(&self, _: &ShadingPoint, random: Random64) -> SampledLight {
        self.0.borrow_mut().push(random.high);
        SampledLight {
            light: 0,
            instance: 0,
            pmf: 1.0,
        }
    }

    fn pmf(&self, _: &ShadingPoint, _: u32, _: u32) -> f32 {
        1.0
    }
}

#[test]
fn samples_of_all_images_have_a_stratum_each() {
    let light = EmissiveTriangle {
        p: [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 1.0]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 1,
    };
    let floor = SurfaceTriangle {
        p: [[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]],
        material: 0,
        light: u32::MAX,
        instance: u32::MAX,
    };
    let rays = RayBvh::build(&[floor]).expect("a ray BVH");
    let white = Material {
        albedo: [1.0; 3],
        specular: 0.0,
        exponent_log2: 0,
    };
    let instances = listed(1);
    let scene = Scene {
        sky: NoSky,
        surfaces: rays.surfaces(),
        materials: &[white],
        emitters: Emitters {
            triangles: &[light],
            instances: &instances,
        },
    };
    let seen = Seen {
        point: ShadingPoint {
            p: [0.25, 0.001, 0.25],
            n: [0.0, 1.0, 0.0],
        },
        wo: Vec3::Y,
        material: 0,
        direct: Vec3::ZERO,
        spot: Spot {
            triangle: NONE,
            at: [0.0; 2],
        },
        tint: Vec3::ONE,
    };
    for candidates in [1, 2, 8] {
        // Images after one another of uneven sizes, each in parts between each other.
        for (sizes, of) in [(&[6, 7][..], 1), (&[1], 8), (&[3, 2], 4), (&[8], 3)] {
            for scattered in [0, u32::from(candidates > 1)] {
                let picker = Listens(RefCell::default());
                let all: u32 = sizes.iter().sum();
                for index in 0..of {
                    let mut first = 0;
                    for &count in sizes {
                        let samples = Samples {
                            count,
                            first,
                            all,
                            candidates,
                            scattered,
                            part: Part { index, of },
                        };
                        let _ = reflected(&scene, &seen, &picker, samples, 77);
                        first += count;
                    }
                }
                let mut numbers = picker.0.into_inner();
                let expected = all * of * candidates;
                assert_eq!(numbers.len() as u32, expected);
                // Cyclic: the gaps are all alike, but for the rounding of the steps.
                numbers.sort_unstable();
                let next = numbers.iter().cycle().skip(1);
                let gap = u32::MAX / expected;
                let even = |(a, b): (&u32, &u32)| b.wrapping_sub(*a).abs_diff(gap) <= expected;
                assert!(
                    numbers.iter().zip(next).all(even),
                    "{sizes:?} in {of} parts, {candidates} candidates: {numbers:?}"
                );
            }
        }
    }
}
