//! How every call of a BVH and its mirror grows: time (median, and 99.9 %), bytes allocated, and bytes that the mirror copies,
//! from 10³ to 10⁶ instances or triangles.
//!
//! `cargo bench -p lightbvh-gpu --bench growth [-- LARGEST]` (4 min; 1 min up to 100000)

mod any;
mod measure;

use lightbvh::{Edit, EmissiveTriangle};

use any::{queries, wholes};
use measure::{Scene, at, gone, lamp, nothing, row};

/// Frames in which one of many instances changes.
fn instances(size: u32) {
    println!(
        "\n| one of many instances | instances | calls | µs | 99.9 % | bytes allocated | 99.9 % | bytes for a mirror | 99.9 % |\n|---|---|---|---|---|---|---|---|---|"
    );
    let scene = &mut Scene::new(size, 2);
    queries(scene, size);
    row(
        scene,
        "set_transform",
        size,
        |scene| (scene.some(), at(scene.turn)),
        |scene, (id, to)| scene.bvh.set_transform(id, to),
    );
    row(scene, "set_radiance", size, Scene::some, |scene, id| {
        scene.bvh.set_radiance(id, 2.0)
    });
    scene.bvh.refit();
    let moved = |scene: &mut Scene| {
        scene.bvh.refit();
        scene.mirror.frame(&scene.bvh);
        let id = scene.some();
        scene.bvh.set_transform(id, at(scene.turn)).expect("its own");
    };
    row(scene, "refit after one moved", size, moved, |scene, ()| {
        scene.bvh.refit()
    });
    row(
        scene,
        "Mirror::frame after one moved",
        size,
        moved,
        |scene, ()| scene.mirror.frame(&scene.bvh),
    );
    row(scene, "remove_instance", size, Scene::one_more, |scene, ()| {
        let id = scene.one_less();
        scene.bvh.remove_instance(id)
    });
    let removed = |scene: &mut Scene| {
        let id = scene.one_less();
        scene.bvh.remove_instance(id).expect("its own");
    };
    row(scene, "take_removed_lights", size, nothing, |scene, ()| {
        scene.bvh.take_removed_lights()
    });
    row(scene, "add_instance", size, removed, |scene, ()| scene.one_more());
    let refitted = |scene: &mut Scene| {
        removed(scene);
        scene.bvh.refit();
    };
    row(
        scene,
        "add_instance after a refit",
        size,
        refitted,
        |scene, ()| scene.one_more(),
    );
    row(
        scene,
        "refit after one came and one went",
        size,
        |scene| {
            refitted(scene);
            scene.one_more();
        },
        |scene, ()| scene.bvh.refit(),
    );
    let other = |scene: &mut Scene| scene.last = scene.bvh.add_mesh(vec![lamp(7, 0)]).ok();
    row(scene, "add_mesh, of one triangle", size, gone, |scene, ()| {
        other(scene)
    });
    row(
        scene,
        "set_triangles, of one",
        size,
        |_| vec![lamp(8, 0)],
        |scene, triangles| {
            let mesh = scene.last.expect("added");
            scene.bvh.set_triangles(mesh, triangles)
        },
    );
    row(scene, "remove_mesh, of one triangle", size, other, |scene, ()| {
        gone(scene)
    });
    let scene = &mut Scene::new(size, 2);
    wholes(scene, size);
    let all = |scene: &mut Scene| -> Vec<Edit> {
        let turn = scene.random();
        let ids = scene.instances.iter().copied().zip(turn % 1000..);
        ids.map(|(instance, k)| Edit::SetTransform {
            instance,
            transform: at(k),
        })
        .collect()
    };
    row(scene, "apply, all move", size, all, |scene, edits| {
        scene.bvh.apply(edits).expect("its own")
    });
    row(
        scene,
        "refit after all moved",
        size,
        |scene| {
            let edits = all(scene);
            scene.bvh.apply(edits).expect("its own");
        },
        |scene, ()| scene.bvh.refit(),
    );
    row(
        scene,
        "Mirror::frame after all moved",
        size,
        |scene| {
            let edits = all(scene);
            scene.bvh.apply(edits).expect("its own");
            scene.bvh.refit();
        },
        |scene, ()| scene.mirror.frame(&scene.bvh),
    );
    row(scene, "rebuild", size, nothing, |scene, ()| scene.bvh.rebuild());
    row(
        scene,
        "begin_frame, refit, end_frame; one moves",
        size,
        |scene| (scene.some(), at(scene.turn)),
        |scene, (id, to)| {
            scene.rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
            scene.bvh.set_transform(id, to).expect("its own");
            scene.bvh.refit();
            scene.rebuilder.end_frame(&scene.bvh);
        },
    );
}

/// Frames in which one mesh deforms.
fn triangles(size: u32) {
    println!(
        "\n| one mesh | triangles | calls | µs | 99.9 % | bytes allocated | 99.9 % | bytes for a mirror | 99.9 % |\n|---|---|---|---|---|---|---|---|---|"
    );
    let scene = &mut Scene::new(1, size);
    queries(scene, size);
    wholes(scene, size);
    let deformed = |scene: &mut Scene| -> Vec<EmissiveTriangle> {
        let shift = scene.random();
        (0..scene.triangles.len() as u32)
            .map(|k| lamp(k, shift % 16))
            .collect()
    };
    row(scene, "set_triangles", size, deformed, |scene, triangles| {
        scene.bvh.set_triangles(scene.mesh, triangles)
    });
    let set = |scene: &mut Scene| {
        scene.bvh.refit();
        scene.mirror.frame(&scene.bvh);
        let triangles = deformed(scene);
        scene.bvh.set_triangles(scene.mesh, triangles).expect("as many");
    };
    row(scene, "refit after it deformed", size, set, |scene, ()| {
        scene.bvh.refit()
    });
    row(
        scene,
        "Mirror::frame after it deformed",
        size,
        set,
        |scene, ()| scene.mirror.frame(&scene.bvh),
    );
    row(
        scene,
        "add_mesh",
        size,
        |scene| {
            gone(scene);
            scene.triangles.clone()
        },
        |scene, triangles| scene.last = scene.bvh.add_mesh(triangles).ok(),
    );
    row(
        scene,
        "remove_mesh",
        size,
        |scene| {
            gone(scene);
            scene.last = scene.bvh.add_mesh(scene.triangles.clone()).ok();
        },
        |scene, ()| gone(scene),
    );
    row(
        scene,
        "rebuild of the mesh",
        size,
        |scene| {
            let triangles = deformed(scene);
            scene.bvh.set_triangles(scene.mesh, triangles).expect("as many");
            scene.bvh.refit();
        },
        |scene, ()| scene.bvh.rebuild(),
    );
}

fn main() {
    // Cargo says `--bench` too.
    let largest = std::env::args()
        .skip(1)
        .find(|word| !word.starts_with('-'))
        .map_or(1_000_000, |text| text.parse().expect("a number"));
    for size in [1000, 10_000, 100_000, 1_000_000]
        .into_iter()
        .filter(|&size| size <= largest)
    {
        instances(size);
        triangles(size);
    }
}
