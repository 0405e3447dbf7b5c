//! Which configuration within a budget, measured here: importances and layouts are types, the rest values.
//!
//! `cargo run --release -p lightbvh --example tune` (seconds)

use std::time::Instant;

use lightbvh::build::tune::{Budget, Diffuse, Tuning};
use lightbvh::{BuildParams, Bvh, CompactNode, EmissiveTriangle, Eq4, LightBvh, Lights, ShadingPoint};

/// What a shadow ray takes in this engine, ns.
const SHADOW_RAY_NS: f64 = 800.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Lamps of four triangles each over a floor of 40 m by 40 m, every seventh ten times as bright.
    let lamp = |k: u16| {
        let (x, z) = (f32::from(k % 20) * 2.0, f32::from(k / 20 % 20) * 2.0);
        let radiance = [if k % 7 == 0 { 50.0 } else { 5.0 }; 3];
        (0..4_u8).map(move |part| {
            let x = x + 0.1 * f32::from(part);
            EmissiveTriangle {
                p: [[x, 3.0, z], [x + 0.1, 3.0, z], [x, 3.0, z + 0.3]],
                radiance,
                mesh: u32::from(k),
                flags: 0,
            }
        })
    };
    let lights = Lights::new((0..400).flat_map(lamp).collect())?;
    let points: Vec<ShadingPoint> = (0..64_u8)
        .map(|k| ShadingPoint {
            p: [f32::from(k % 8) * 5.0, 0.0, f32::from(k / 8) * 5.0],
            n: [0.0, 1.0, 0.0],
        })
        .collect();

    let usual = LightBvh::two_level(&lights, &BuildParams::BALANCED);
    let one_level = LightBvh::single_level(&lights, &BuildParams::BALANCED);
    let paper = Bvh::<CompactNode<4>, Eq4, 4>::two_level(&lights, &BuildParams::BALANCED);
    let mut tuning = Tuning::new(&points, &Diffuse, SHADOW_RAY_NS)?;
    tuning.add("paper", &paper, 1)?.add("one level", &one_level, 1)?;
    for candidates in [1, 4, 8, 16] {
        tuning.add(format!("1 of {candidates}"), &usual, candidates)?;
    }
    let start = Instant::now();
    let measured = tuning.measure(|| start.elapsed())?;
    for of in &measured {
        println!(
            "{:10} {:6.0} ns with its ray, relative variance {:.4}",
            of.name, of.time_ns, of.variance
        );
    }
    // Four times what the fastest takes here: a slow machine has a larger budget.
    let fastest = measured.iter().map(|of| of.time_ns).fold(f64::INFINITY, f64::min);
    let time = Budget::Time {
        ns: (4.0 * fastest).round(),
    };
    for budget in [time, Budget::Error { relative: 0.1 }] {
        let pick = budget.pick(&measured)?;
        println!(
            "{budget:?}: {}, {} samples, {:.0} ns, standard deviation {:.3}",
            measured[pick.index].name,
            pick.samples,
            pick.time_ns,
            pick.variance.sqrt()
        );
    }
    let within = BuildParams::within(time, &lights, &points, &Diffuse, SHADOW_RAY_NS, || {
        start.elapsed()
    })?;
    println!(
        "built by {:?}, 1 of {} candidates",
        within.params, within.candidates
    );
    Ok(())
}
