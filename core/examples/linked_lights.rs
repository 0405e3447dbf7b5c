//! Lights that light some things alone: masks of instances and of receivers.
//!
//! `cargo run -p lightbvh --example linked_lights` (seconds). A stage: bit 0 is its floor, bit 1 the actors, bit 2 the
//! audience. Prints how likely each lamp is for each of them, and checks that no lamp is chosen for what it does not light.

use lightbvh::bvh::Edit;
use lightbvh::exact::hash;
use lightbvh::importance::LinkedPoint;
use lightbvh::{EmissiveTriangle, MaskedLights, ShadingPoint, Transform};

const FLOOR: u32 = 1;
const ACTORS: u32 = 2;
const AUDIENCE: u32 = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lamp = EmissiveTriangle {
        p: [[0.0, 4.0, 0.0], [0.2, 4.0, 0.0], [0.0, 4.0, 0.2]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut stage = MaskedLights::default();
    let mesh = stage.add_mesh(vec![lamp.into()])?;
    // A flood for floor and actors, a key light for the actors, a dim one for all, one that is off.
    let kinds = [
        ("flood", FLOOR | ACTORS, 50.0),
        ("key", ACTORS, 400.0),
        ("house", u32::MAX, 1.0),
        ("off", u32::MAX, 0.0),
    ];
    let mut edits = Vec::new();
    for (z, (_, mask, radiance)) in (0_u8..).zip(kinds) {
        edits.extend((0..5_u8).map(|x| Edit::AddInstance {
            mesh,
            transform: Transform::at([f32::from(x), 0.0, f32::from(z)]),
            radiance: [radiance; 3],
            mask,
        }));
    }
    let lamps = stage.apply(edits)?.instances;
    stage.refit();

    let receivers = [
        ("floor", FLOOR),
        ("actors", ACTORS),
        ("audience", AUDIENCE),
        ("nothing", 0),
    ];
    let report = |stage: &MaskedLights| {
        for (name, mask) in receivers {
            let receiver = LinkedPoint {
                point: ShadingPoint {
                    p: [2.3, 0.0, 1.1],
                    n: [0.0, 1.0, 0.0],
                },
                mask,
            };
            let mut shares = [0.0; 4];
            for &lamp in &lamps {
                let own = stage.instances()[lamp.index() as usize];
                let pmf = stage.pmf_of(&receiver, lamp, 0).expect("a lamp");
                assert!(pmf == 0.0 || own.mask & mask != 0);
                shares[lamp.index() as usize / 5] += pmf;
            }
            let shares = kinds.iter().zip(shares);
            let shares: Vec<_> = shares
                .map(|((kind, ..), share)| format!("{kind} {share:.4}"))
                .collect();
            println!("{name:8}: {}", shares.join(", "));
            for k in 0..1000 {
                let sampled = stage.sample_light(&receiver, hash(k), [0.5; 2]);
                let own = sampled.map(|sampled| stage.instances()[sampled.instance.index() as usize]);
                assert!(own.is_none_or(|own| own.mask & mask != 0));
                assert_eq!(own.is_none(), mask == 0, "no lamp lights what has no bit");
            }
        }
    };
    report(&stage);

    println!("with the key light on the audience:");
    for &lamp in &lamps[5..10] {
        stage.set_mask(lamp, ACTORS | AUDIENCE)?;
    }
    stage.refit();
    report(&stage);
    Ok(())
}
