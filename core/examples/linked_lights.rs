//! Lights that light some things alone: masks of lights and of receivers.
//!
//! `cargo run -p lightbvh --example linked_lights` (seconds). A stage: bit 0 is its floor, bit 1 the actors, bit 2 the
//! audience. Prints how likely each lamp is for each of them, and checks that it is zero for what the lamp does not light.

use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::LinkedTriangle;
use lightbvh::node::{LinkedMomentNode, Lit};
use lightbvh::{Bvh, EmissiveTriangle, Moments, ShadingPoint, Transform};

const FLOOR: u32 = 1;
const ACTORS: u32 = 2;
const AUDIENCE: u32 = 4;

/// Nodes that know masks, over triangles that have them; an importance over what a receiver may take. In place of a share of
/// uniform choice each child keeps 1/512 of its node's weight.
type Stage = Bvh<Lit<LinkedMomentNode<8>, LinkedTriangle>, Linked<Leveled<Moments, 9>>, 8>;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lamp = |mask: u32, radiance: f32| LinkedTriangle {
        light: EmissiveTriangle {
            p: [[0.0, 4.0, 0.0], [0.2, 4.0, 0.0], [0.0, 4.0, 0.2]],
            radiance: [radiance; 3],
            mesh: 0,
            flags: 0,
        },
        mask,
    };
    let mut stage = Stage::default();
    // A flood for floor and actors, a key light for the actors, a dim one for all, one that is off.
    let kinds = [
        lamp(FLOOR | ACTORS, 50.0),
        lamp(ACTORS, 400.0),
        lamp(u32::MAX, 1.0),
        lamp(u32::MAX, 0.0),
    ];
    let mut meshes = Vec::new();
    for (k, lamp) in (0_u8..).zip(kinds) {
        let mesh = stage.add_mesh(vec![lamp])?;
        for x in 0..5_u8 {
            stage.add_instance(mesh, Transform::at([f32::from(x), 0.0, f32::from(k)]))?;
        }
        meshes.push(mesh);
    }
    stage.refit();

    let receivers = [
        ("floor", FLOOR),
        ("actors", ACTORS),
        ("audience", AUDIENCE),
        ("nothing", 0),
    ];
    let report = |stage: &Stage| {
        for (name, mask) in receivers {
            let receiver = LinkedPoint {
                point: ShadingPoint {
                    p: [2.3, 0.0, 1.1],
                    n: [0.0, 1.0, 0.0],
                },
                mask,
            };
            let mut shares = [0.0; 4];
            for (light, own) in (0..).zip(stage.world_lights()) {
                let pmf = stage.tree().pmf(&receiver, light, own.light.mesh);
                assert!(pmf == 0.0 || own.mask & mask != 0);
                shares[own.light.mesh as usize / 5] += pmf;
            }
            let [flood, key, house, off] = shares;
            println!("{name:8}: flood {flood:.4}, key {key:.4}, house {house:.4}, off {off:.4}");
        }
    };
    report(&stage);

    // The key light is to light the audience too: new words of a light, then a refit.
    println!("with the key light on the audience:");
    stage.set_triangles(meshes[1], vec![lamp(ACTORS | AUDIENCE, 400.0)])?;
    stage.refit();
    report(&stage);
    Ok(())
}
