//! Lamps are added, moved and removed. A rebuilder builds the top level in the background; the frame in which its tree is
//! swapped in depends on the machine, unless [`Swap::Deterministic`](lightbvh::bvh::Swap) is chosen.
//!
//! `cargo run -p lightbvh --example moving_lights` (seconds)

use lightbvh::{Edit, EmissiveTriangle, LightBvh, Rebuilder, ShadingPoint, Transform};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lamp = EmissiveTriangle {
        p: [[0.0, 3.0, 0.0], [0.03, 3.0, 0.0], [0.0, 3.0, 0.03]],
        radiance: [900.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp])?;
    let mut lamps = Vec::new();
    let mut rebuilder = Rebuilder::default();
    let point = ShadingPoint {
        p: [10.0, 0.0, 0.0],
        n: [0.0, 1.0, 0.0],
    };
    let mut rebuilds = 0;
    for frame in 0..60_u16 {
        rebuilds += u32::from(rebuilder.begin_frame(&mut bvh)?.swapped);
        let at = |x: u16| Transform::at([f32::from(x), 0.0, f32::from(frame) * 0.1]);
        // A batch is done whole or not at all.
        let mut edits: Vec<Edit> = (0..)
            .zip(&lamps)
            .map(|(k, &instance)| Edit::SetTransform {
                instance,
                transform: at(k),
            })
            .collect();
        edits.push(Edit::AddInstance {
            mesh,
            transform: at(frame),
            radiance: [1.0; 3],
            mask: u32::MAX,
        });
        if lamps.len() > 20 {
            edits.push(Edit::RemoveInstance(lamps.remove(0)));
        }
        lamps.extend(bvh.apply(edits)?.instances);
        bvh.refit();
        rebuilder.end_frame(&bvh);

        let sampled = bvh.sample(&point, u32::from(frame) * 0x0431_bde8);
        // A ray that the surface's material chose has hit the lamp added last: multiple importance sampling asks how likely a
        // light sample of this point would have been to choose it.
        let met = lamps.last().and_then(|&lamp| bvh.pmf_of(&point, lamp, 0));
        // A temporal method forgets these before it resamples.
        let gone = bvh.take_removed_lights();
        if frame % 20 == 19 {
            println!(
                "frame {frame}: {} lamps, rebuilt {rebuilds} times, {} gone in it, light {} with probability {:.3}, the last lamp's {:.4}",
                bvh.light_count(),
                gone.len(),
                sampled.light,
                sampled.pmf,
                met.unwrap_or(0.0)
            );
        }
    }
    bvh.validate()?;
    Ok(())
}
