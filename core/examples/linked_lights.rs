//! Lights that light some things alone: masks of instances and of receivers.
//!
//! `cargo run -p lightbvh --example linked_lights` (seconds). A stage: bit 0 is its floor, bit 1 the actors, bit 2 the
//! audience. Prints how likely each lamp is for each of them, and checks that it is zero for what the lamp does not light.

use lightbvh::bvh::Edit;
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
        (FLOOR | ACTORS, 50.0),
        (ACTORS, 400.0),
        (u32::MAX, 1.0),
        (u32::MAX, 0.0),
    ];
    let mut edits = Vec::new();
    for (z, (mask, radiance)) in (0_u8..).zip(kinds) {
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
            let [flood, key, house, off] = shares;
            println!("{name:8}: flood {flood:.4}, key {key:.4}, house {house:.4}, off {off:.4}");
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
