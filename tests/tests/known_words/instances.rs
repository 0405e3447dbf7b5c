//! Instances: bounds brought into the world, receivers brought into their space, and importances there.

use glam::Vec3;
use lightbvh::cone::normalized;
use lightbvh::importance::Cluster;
use lightbvh::{Eq4, FluxOverDistance, ImportanceModel, Instance, LightBounds, MeshLeaf, Receiver, exact};
use lightbvh_tests::generate::{self, Random, extreme_triangle};

use super::digest::Digest;
use super::place;

/// Instances of every scale and brightness, and receivers brought into their space.
#[test]
fn instances() {
    let mut random = Random::new(53);
    let mut digest = Digest::new();
    for i in 0..4000 {
        let transform = place(&mut random);
        let scale = exact::pow2(random.below(38) as i32 - 19);
        let instance = Instance {
            first: random.below(100),
            first_triangle: random.below(100),
            columns: transform.columns.map(|column| column.map(|x| x * scale)),
            translation: transform.translation,
            per_scale: 1.0 / scale,
            flux: generate::log_uniform(&mut random, -100, 98),
            radiance: [0.0, 1.0, 1e-3, 1e9][random.below(4) as usize],
            error: [0.0, 1e-6, 1e-3][random.below(3) as usize] * scale,
            tilt: [1e-5, 1e-3, 0.1][random.below(3) as usize],
            mirrored: random.below(2),
            ..Instance::world(1, 2)
        };
        let triangle = extreme_triangle(&mut random);
        let mut local = LightBounds::of_triangle(&triangle);
        if i % 2 == 0 {
            local.phi = generate::log_uniform(&mut random, -100, 125);
        }
        digest.bounds(&instance.to_world(&local));
        let small = generate::small_triangles(1, 1, 2.0, 0.4, false, i)[0];
        digest.words(&[instance.triangle(&small, i)]);
        digest.words(&instance.vertex(triangle.p[0]));
        digest.word(instance.light_of(i));
        digest.word(instance.triangle_of(i));
        let reach = exact::pow2(random.below(60) as i32 - 20);
        let point = generate::point(&mut random, reach);
        for receiver in [instance.inside(&point), Instance::outside(&point)] {
            digest.vector(receiver.position());
            digest.vector(receiver.normal());
            [receiver.slack(), receiver.near_squared(), receiver.tilt()]
                .into_iter()
                .for_each(|x| digest.float(x));
            importances(&mut digest, &mut random, &receiver);
        }
        importances(&mut digest, &mut random, &point);
    }
    digest.is(0x9291_451f_2130_4b09, "instances");
}

/// Of a set of lights about as far from the receiver as it is large.
fn importances<R: Receiver>(digest: &mut Digest, random: &mut Random, receiver: &R) {
    let size = generate::log_uniform(random, -30, 30);
    let distance = size * generate::log_uniform(random, -2, 4);
    let away = Vec3::from(random.direction()) * distance;
    let half_sine = [0.0, random.unit(), 1.0][random.below(3) as usize];
    let extent = Vec3::new(random.unit(), random.unit(), random.unit()) * size;
    let cluster = Cluster {
        center: receiver.position() + away,
        extent,
        radius_squared: (extent.x * extent.x + extent.y * extent.y) + extent.z * extent.z,
        axis: normalized(Vec3::from(random.direction())),
        cos_theta_o: 1.0 - 2.0 * half_sine * half_sine,
        sin_theta_o: 2.0 * half_sine * exact::sqrt(1.0 - half_sine * half_sine),
        cos_theta_e: 0.0,
        phi: [0.0, 1.0, generate::log_uniform(random, -100, 125)][random.below(3) as usize],
    };
    for importance in [
        Eq4::importance(&cluster, receiver),
        FluxOverDistance::importance(&cluster, receiver),
    ] {
        digest.float(importance.significand);
        digest.word(importance.exponent as u32);
    }
    digest.word(u32::from(Eq4::reaches(&cluster, receiver)));
}
