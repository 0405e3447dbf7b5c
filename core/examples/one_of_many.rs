//! One shadow ray for a glossy surface: to a light as sampled, to one of eight candidates resampled, to one that an importance
//! chose which knows the lobe.
//!
//! `cargo run --release -p lightbvh --example one_of_many` (seconds). Prints the squared error of each before visibility, and
//! checks that the means are right. A ray into the lobe that finds a light shares it with these by the balance heuristic (E.
//! Veach and L. Guibas, 1995): the density of a light's point over solid angle is `pmf · density · d² / cos`, with the pmf of
//! [`LightBvh::pmf`] or `LightTree::pmf`.

use lightbvh::exact::hash;
use lightbvh::importance::Glossy;
use lightbvh::reservoir::{Resampling, target};
use lightbvh::{
    Defensive, EmissiveTriangle, GlossyPoint, LightBvh, Moments, SampledLight, ShadingPoint, Transform,
};

/// What [`LightBvh`] chooses by, told of the lobe. The tree is the same.
type Told = Defensive<Glossy<Moments>, 6>;

const TRIALS: u32 = 200_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 400 instances of a lamp that shines down, 3 m above a floor.
    let lamp = EmissiveTriangle {
        p: [[0.0, 3.0, 0.0], [0.1, 3.0, 0.0], [0.0, 3.0, 0.1]],
        radiance: [9.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp])?;
    for k in 0..400_u16 {
        bvh.add_instance(mesh, Transform::at([f32::from(k % 20), 0.0, f32::from(k / 20)]))?;
    }
    bvh.refit();

    // The floor, seen from the side: half diffuse, half a lobe about the direction of the mirror.
    let receiver = GlossyPoint {
        point: ShadingPoint {
            p: [5.3, 0.0, 7.1],
            n: [0.0, 1.0, 0.0],
        },
        mirror: [0.6, 0.8, 0.0],
        diffuse: 0.5,
        specular: 0.5,
        exponent: 64.0,
    }
    .checked()?;

    // What all of them send: the middles of small lamps stand for them.
    let all = bvh.view().world_lights();
    let right: f64 = all.iter().map(|light| contribution(light, &receiver)).sum();
    let told = bvh.tree().by::<Told>();
    let weighted = |sampled: SampledLight| {
        contribution(&all[sampled.light as usize], &receiver) / f64::from(sampled.pmf)
    };
    report("a light as sampled", right, |number| {
        weighted(bvh.tree().sample(&receiver.point, number))
    });
    report("one of eight", right, |number| {
        one_of_eight(&bvh, &all, &receiver, number)
    });
    report("by an importance that knows the lobe", right, |number| {
        weighted(told.sample(&receiver, number))
    });
    Ok(())
}

/// Eight candidates by one number, and one of them in proportion to what it sends over its probability: its shadow ray carries all.
fn one_of_eight(bvh: &LightBvh, all: &[EmissiveTriangle], receiver: &GlossyPoint, number: u32) -> f64 {
    let mut stream = Resampling::EMPTY;
    let mut chosen = 0.0;
    for (k, sampled) in (0..).zip(bvh.tree().sample_many::<_, 8>(&receiver.point, number)) {
        let sent = contribution(&all[sampled.light as usize], receiver);
        let random = hash(hash(number).wrapping_add(k));
        if stream.candidate(target(sent as f32), sampled.pmf, random) {
            chosen = sent;
        }
    }
    // A renderer keeps the light and its point too, and traces the one shadow ray here.
    chosen * f64::from(stream.weight())
}

/// What the middle of a light sends to the viewer, without shadow, over its density.
fn contribution(light: &EmissiveTriangle, receiver: &GlossyPoint) -> f64 {
    let on = light.point([0.5; 2]);
    let wide = |v: [f32; 3]| v.map(f64::from);
    let [at, p, n, mirror] = [on.p, receiver.point.p, receiver.point.n, receiver.mirror].map(wide);
    let to = unit([0, 1, 2].map(|k| at[k] - p[k]));
    let half = unit([0, 1, 2].map(|k| to[k] + 2.0 * dot(n, mirror) * n[k] - mirror[k]));
    let [diffuse, specular, k] = [receiver.diffuse, receiver.specular, receiver.exponent].map(f64::from);
    let lobe = (k + 6.0) / 8.0 * dot(n, half).max(0.0).powf(k);
    let reflected = (diffuse + specular * lobe) / std::f64::consts::PI;
    f64::from(on.irradiance(&receiver.point)[0]) * reflected
}

fn report(name: &str, right: f64, estimate: impl Fn(u32) -> f64) {
    let (mut sum, mut squares) = (0.0, 0.0);
    for trial in 0..TRIALS {
        let value = estimate(hash(trial)) / right;
        sum += value;
        squares += (value - 1.0).powi(2);
    }
    let [mean, square] = [sum, squares].map(|of| of / f64::from(TRIALS));
    let sure = 5.0 * (square / f64::from(TRIALS)).sqrt() + 1e-3;
    println!("{name}: squared error {square:.4}, mean {mean:.4} ± {sure:.4}");
    assert!((mean - 1.0).abs() < sure, "biased");
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    v.map(|x| x / dot(v, v).sqrt())
}
