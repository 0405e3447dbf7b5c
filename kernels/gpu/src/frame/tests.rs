//! Steps of a frame. `tests/tests/device_words.rs` compares what devices then hold, frame after frame.

use alloc::vec;
use bytemuck::bytes_of;
use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightNode, MomentNode, Transform};

use super::*;

type Tree = Bvh<(MomentNode<8>, ())>;

fn lamp(x: f32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.1]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

/// Twenty instances of each of two meshes, refitted.
pub(crate) fn scene<N: LightNode<W>, const W: usize>() -> (Bvh<(N, ()), W>, Vec<InstanceId>) {
    let mut scene = Bvh::default();
    let mut all = Vec::new();
    for count in [3_u16, 300] {
        let lamps = (0..count).map(|k| lamp(f32::from(k)));
        let mesh = scene.add_mesh(lamps.collect()).expect("a mesh");
        for k in 0..20_u8 {
            let at = Transform::at([0.0, f32::from(k), f32::from(count)]);
            all.push(scene.add_instance(mesh, at).expect("an instance"));
        }
    }
    scene.refit();
    (scene, all)
}

/// Does a frame to buffers that stand for the device's; a dispatch takes the CPU's word for what it computes. Returns how many
/// steps there were.
fn follow(held: &mut [Vec<u8>], scene: &Tree, mirror: &mut Mirror) -> usize {
    let (frame, view) = (mirror.frame(scene), scene.view());
    let top = mirror.top::<MomentNode<8>>();
    for step in frame.steps() {
        match step {
            Step::Resize { buffer, bytes } => held[buffer as usize] = vec![0xff; bytes as usize],
            Step::Upload { buffer, at, bytes } => {
                held[buffer as usize][at as usize..][..bytes.len()].copy_from_slice(bytes);
            }
            Step::Dispatch {
                pass: Pass::Bottom | Pass::Top,
                ..
            } => {}
            Step::Dispatch {
                pass: Pass::Nodes,
                push: [first, ..],
                count,
            } => {
                let list = held[DeviceBuffer::List as usize].clone();
                let list: &[u32] = cast_slice(&list);
                for &entry in &list[first as usize..][..count as usize] {
                    let computed = match entry.checked_sub(top) {
                        None => bytes_of(&view.nodes()[entry as usize]),
                        Some(above) => bytes_of(&view.top_nodes()[above as usize]),
                    };
                    let at = entry as usize * computed.len();
                    held[DeviceBuffer::Nodes as usize][at..][..computed.len()].copy_from_slice(computed);
                }
            }
        }
    }
    frame.steps().count()
}

/// Buffers that follow frames hold what a new device gets, whatever grew on the way, and a frame without changes has no steps.
#[test]
fn buffers_that_follow_are_those_of_a_new_device() {
    let (mut scene, mut all): (Tree, _) = scene();
    let mesh = scene.view().mesh_id(0).expect("a mesh");
    let mut mirror = Mirror::default();
    let mut held = vec![Vec::new(); DeviceBuffer::ALL.len()];
    for k in 0..40_u8 {
        let edits = match k % 4 {
            0 => vec![Edit::AddMesh {
                lights: vec![lamp(f32::from(k)); 10 * usize::from(k)],
            }],
            1 => vec![Edit::RemoveInstance(all.remove(3))],
            _ => Vec::new(),
        };
        let added = (0..k).map(|x| Edit::AddInstance {
            mesh,
            transform: Transform::at([f32::from(x), 7.0, f32::from(k)]),
            radiance: [1.0; 3],
            mask: u32::MAX,
        });
        scene
            .apply(edits.into_iter().chain(added).skip(usize::from(k == 0)).collect())
            .expect("edits");
        scene.refit();
        follow(&mut held, &scene, &mut mirror);
        assert_eq!(follow(&mut held, &scene, &mut mirror), 0, "nothing changed");

        let arrays = arrays(&scene);
        // The last array is that of parts, whose places of removed instances no walk reads.
        for (array, (bytes, _)) in arrays
            .into_iter()
            .enumerate()
            .filter(|(array, _)| (TOP + 1..LIST - 1).contains(array))
        {
            let own = &held[BUFFERS[array] as usize][mirror.start(array) as usize..][..bytes.len()];
            assert!(own == bytes, "frame {k}, array {array}");
        }
        for (buffer, at, bytes) in mirror.in_use(&scene) {
            let own = &held[buffer as usize][at as usize..][..bytes.len()];
            assert!(own == bytes, "frame {k}, {buffer:?} from byte {at}");
        }
    }
}
