//! What moves, comes on or goes dim is put in elsewhere.

use alloc::vec;

use super::*;

/// Whether an instance is put in elsewhere by what `edit` does: links of nodes are written then.
fn is_put_elsewhere(scene: &LightBvh, edit: impl FnOnce(&mut LightBvh)) -> bool {
    let mut scene = scene.clone();
    scene.plan();
    edit(&mut scene);
    !scene.plan().written_nodes.is_empty()
}

/// On each side of what decides it.
#[test]
fn what_is_misplaced_is_put_in_elsewhere() {
    let (scene, ids) = grid(10);
    let id = |scene: &LightBvh, k: usize| scene.instance_id(ids[k].index()).expect("there");
    for k in [0, 99, 500, 555, 999] {
        let from = scene.placed[ids[k].index() as usize].transform;
        let moved = |by: f32| {
            is_put_elsewhere(&scene, |scene| {
                let mut to = from;
                to.translation[0] += by;
                scene.set_transform(id(scene, k), to).expect("there");
            })
        };
        assert!(!moved(0.5) && !moved(-0.5), "{k}: nearby");
        assert!(moved(200.0) && moved(-200.0), "{k}: far off");
        let dimmed = |to: f32| {
            is_put_elsewhere(&scene, |scene| {
                scene.set_radiance(id(scene, k), to).expect("there")
            })
        };
        assert!(!dimmed(1.9) && !dimmed(0.6), "{k}: about as bright");
        assert!(dimmed(2.5) && dimmed(0.3), "{k}: another brightness");
    }
}

/// As many as one call may put in elsewhere, and no more, however many are misplaced.
#[test]
fn no_call_puts_all_in_elsewhere() {
    let (mut scene, ids) = grid(20);
    let stamp = scene.epoch;
    let brighter = ids.iter().map(|&instance| Edit::SetRadiance {
        instance,
        radiance: 8.0,
    });
    scene.apply(brighter.collect()).expect("there");
    let put = scene.placed.iter().filter(|placed| placed.hung > stamp).count();
    assert_eq!(put, 64 + ids.len() / 64);
    scene.refit();
    scene.validate().expect("valid");
}

/// A lamp that goes dim and bright again is put in elsewhere twice, and then no more.
#[test]
fn a_lamp_that_flickers_stays_where_its_light_belongs() {
    let (mut scene, ids) = grid(10);
    for k in [0, 555] {
        let mut put = 0;
        for frame in 0..20 {
            scene.plan();
            let radiance = if frame % 2 == 0 { 0.01 } else { 1.0 };
            scene.set_radiance(ids[k], radiance).expect("there");
            put += u32::from(!scene.plan().written_nodes.is_empty());
            scene.refit();
        }
        assert_eq!(put, 2, "{k}");
        // Brighter than it ever was is another matter.
        scene.plan();
        scene.set_radiance(ids[k], 3.0).expect("there");
        assert!(!scene.plan().written_nodes.is_empty(), "{k}");
        // What is read again flickers on.
        let mut again = LightBvh::from_words(&scene.to_words()).expect("its own");
        let id = again.instance_id(ids[k].index()).expect("there");
        again.refit();
        again.plan();
        again.set_radiance(id, 0.01).expect("there");
        assert!(again.plan().written_nodes.is_empty(), "{k}");
    }
    scene.refit();
    scene.validate().expect("valid");
}

/// Edits between a batch that builds the top level and the first refit find nodes that know what is below them, and count as
/// edits of a built tree.
#[test]
fn edits_before_the_first_refit_are_put_where_they_belong() {
    let random = &mut Random(21);
    let mut trees = vec![];
    for refits in [true, false] {
        let mut scene = LightBvh::default();
        let mesh = lamp(&mut scene);
        random.0 = 21;
        let place = |random: &mut Random| Transform::at((random.vector() * 50.0).to_array());
        let add = (0..2000).map(|_| Edit::AddInstance {
            mesh,
            transform: place(random),
            radiance: 1.0,
        });
        let add: vec::Vec<_> = add.collect();
        let ids = scene.apply(add).expect("instances").instances;
        if refits {
            scene.refit();
        }
        for _ in 0..200 {
            scene.add_instance(mesh, place(random)).expect("one more");
        }
        scene.refit();
        trees.push(scene.depth());
        // All moved in the frame that added them: the tree is worse than as built, and due.
        if !refits {
            let moves = ids.iter().map(|&instance| Edit::SetTransform {
                instance,
                transform: place(random),
            });
            let moves: vec::Vec<_> = moves.collect();
            let mut scene = LightBvh::default();
            let mesh = lamp(&mut scene);
            let add = (0..2000).map(|k| Edit::AddInstance {
                mesh,
                transform: Transform::at([k as f32, 0.0, 0.0]),
                radiance: 1.0,
            });
            let ids = scene.apply(add.collect()).expect("instances").instances;
            let there = ids.iter().zip(moves).map(|(&instance, edit)| match edit {
                Edit::SetTransform { transform, .. } => Edit::SetTransform { instance, transform },
                other => other,
            });
            scene.apply(there.collect()).expect("moves");
            scene.refit();
            let root = scene.top.root;
            assert!(
                scene.quality(root).drift() > 1.1,
                "{}",
                scene.quality(root).drift()
            );
        }
    }
    assert_eq!(trees[0], trees[1]);
}

/// Lights whose vertices are set anew are where those are: a lamp that jumps so is put in elsewhere as one that is moved, one
/// that sways stays.
#[test]
fn meshes_whose_vertices_jump_are_put_in_elsewhere() {
    let mut scene = LightBvh::default();
    let at = |k: u16, by: f32| {
        let [x, y, z] = [k % 10, k / 10 % 10, k / 100].map(|k| 4.0 * f32::from(k));
        triangle([[x + by, y, z], [x + by + 1.0, y, z], [x + by, y + 1.0, z]])
    };
    let add: vec::Vec<_> = (0..1000_u16)
        .map(|k| Edit::AddMesh {
            triangles: vec![at(k, 0.0)],
        })
        .collect();
    let meshes = scene.apply(add).expect("meshes").meshes;
    let add = meshes.iter().map(|&mesh| Edit::AddInstance {
        mesh,
        transform: Transform::at([0.0; 3]),
        radiance: 1.0,
    });
    let add = add.collect();
    let ids = scene.apply(add).expect("instances").instances;
    scene.refit();
    for k in [0_u16, 99, 500, 999] {
        let set = |by: f32| {
            is_put_elsewhere(&scene, |scene| {
                let mesh = scene.mesh_of(scene.instance_id(ids[usize::from(k)].index()).expect("there"));
                scene
                    .set_triangles(mesh.expect("there"), vec![at(k, by)])
                    .expect("as many");
            })
        };
        assert!(!set(0.5) && !set(-0.5), "{k}: it sways");
        assert!(set(200.0) && set(-200.0), "{k}: it jumps");
    }
    // By a range of all of its triangles too.
    assert!(is_put_elsewhere(&scene, |scene| {
        let mesh = scene.mesh_id(meshes[7].index()).expect("there");
        scene
            .set_triangle_range(mesh, 0, vec![at(7, 200.0)])
            .expect("in the mesh");
    }));
    // Words are those of a refit, and where it went it is among its neighbours.
    scene
        .set_triangles(meshes[0], vec![at(999, 0.5)])
        .expect("as many");
    scene.refit();
    scene.validate().expect("valid");
    let mut above = scene.placed[ids[0].index() as usize].node;
    above = scene.parents[above as usize];
    let is_near = (0..1000).filter(|&k| {
        let mut node = scene.placed[ids[k].index() as usize].node;
        while node != INVALID && node != above {
            node = scene.parents[node as usize];
        }
        node == above
    });
    let near: vec::Vec<_> = is_near.collect();
    assert!(near.contains(&999) && !near.contains(&1), "{near:?}");
}

/// A large mesh too, of which some triangles are looked at, from all over it: the first one stays.
#[test]
fn large_meshes_that_jump_are_put_in_elsewhere() {
    let (mut scene, _) = grid(10);
    let all = |x: f32| -> vec::Vec<_> {
        (0..3000_u16)
            .map(|k| {
                let x = if k == 0 { 0.0 } else { x + 0.001 * f32::from(k) };
                triangle([[x, 0.0, 0.0], [x + 0.001, 0.0, 0.0], [x, 0.001, 0.0]])
            })
            .collect()
    };
    let mesh = scene.add_mesh(all(0.0)).expect("a mesh");
    scene.add_instance(mesh, Transform::IDENTITY).expect("added");
    scene.refit();
    let index = mesh.index();
    for (x, expected) in [(0.5, false), (300.0, true)] {
        let found = is_put_elsewhere(&scene, |scene| {
            let mesh = scene.mesh_id(index).expect("there");
            scene.set_triangles(mesh, all(x)).expect("as many");
        });
        assert_eq!(found, expected, "{x}");
    }
}

/// A lamp whose triangles are set before its first instance comes in, in one call or in two, is put in where it is then, by the
/// whole or by a range.
#[test]
fn instances_come_in_where_their_meshes_are() {
    for (is_range, is_one_call) in [(false, false), (false, true), (true, false), (true, true)] {
        let (mut scene, _) = grid(10);
        let far = |x: f32| triangle([[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0]]);
        let mesh = scene.add_mesh(vec![far(-500.0)]).expect("a mesh");
        let there = scene.add_mesh(vec![far(500.0)]).expect("a mesh");
        let add = |mesh| Edit::AddInstance {
            mesh,
            transform: Transform::IDENTITY,
            radiance: 1.0,
        };
        let beside = scene
            .apply([add(there), add(there)].to_vec())
            .expect("added")
            .instances;
        scene.refit();
        let triangles = vec![far(500.5)];
        let set = match is_range {
            true => Edit::SetTriangleRange {
                mesh,
                first: 0,
                triangles,
            },
            false => Edit::SetTriangles { mesh, triangles },
        };
        let added = if is_one_call {
            scene.apply([set, add(mesh)].to_vec())
        } else {
            scene.apply([set].to_vec()).expect("as many");
            scene.apply([add(mesh)].to_vec())
        };
        let id = added.expect("added").instances[0];
        let node = |id: crate::InstanceId| scene.placed[id.index() as usize].node;
        assert!(
            beside.iter().any(|&other| node(other) == node(id)),
            "{is_range} {is_one_call}"
        );
    }
}

/// Lamps that come on among dim ones are as new to the tree around them as lamps that are added.
#[test]
fn lamps_that_come_on_are_bright_ones() {
    let (mut scene, ids) = grid(10);
    let root = scene.top.number(scene.top.root) as usize;
    scene.set_radiance(ids[500], 1e4).expect("there");
    // It outshines all: all of the tree is to be tried.
    assert!(scene.top.changes[root] >= 500, "{}", scene.top.changes[root]);
    let (mut scene, ids) = grid(10);
    scene.set_radiance(ids[500], 10.0).expect("there");
    assert_eq!(scene.top.changes[root], 0, "the others outshine it");
}

/// Of lamps that come on in one call more than it puts in elsewhere the rest keeps its place, and no node has lost its order.
/// The tree is tried for that at once, and not when all has come to rest.
#[cfg(feature = "std")]
#[test]
fn what_stays_misplaced_is_tried_at_once() {
    for (count, expected) in [(64 + 1728 / 64, false), (1728, true)] {
        let (mut scene, ids) = grid(12);
        let brighter = ids.iter().take(count).map(|&instance| Edit::SetRadiance {
            instance,
            radiance: 8.0,
        });
        scene.apply(brighter.collect()).expect("there");
        scene.refit();
        let mut search = Search::default();
        scene.search_again(&mut search);
        let mut is_tried = false;
        while !search.is_done() && !is_tried {
            is_tried = !scene.copy_worn_parts(1.5, 0, &mut search).is_empty();
        }
        assert_eq!(is_tried, expected, "{count}");
    }
}

/// What lies far from those around it in a tree as it was built stays there when it moves a little: put in elsewhere, it would
/// come to lie as far from others, frame after frame.
#[test]
fn what_was_built_far_off_stays() {
    let mut scene = Bvh::<crate::FullNode<2>, crate::Eq4, 2>::default();
    let mesh = lamp(&mut scene);
    // Pairs of crowds, each with one bright lamp nearly as far off as the other crowd is.
    let mut places = Vec::new();
    for pair in 0..8_u8 {
        for (crowd, alone) in [(0.0, -100.0), (150.0, 250.0)] {
            let at = |x: f32, y: f32| [2000.0 * f32::from(pair) + x, y, 0.0];
            places.extend((0..8_u8).map(|k| at(crowd, f32::from(k))));
            places.push(at(alone, 0.0));
        }
    }
    let add = places.iter().enumerate().map(|(k, &at)| Edit::AddInstance {
        mesh,
        transform: Transform::at(at),
        radiance: if k % 9 == 8 { 16.0 } else { 1.0 },
    });
    let ids = scene.apply(add.collect()).expect("instances").instances;
    scene.refit();
    let stamp = scene.epoch;
    let alone = ids.iter().zip(&places).skip(8).step_by(9);
    let moves = alone.map(|(&instance, &[x, y, z])| Edit::SetTransform {
        instance,
        transform: Transform::at([x, y + 0.25, z]),
    });
    scene.apply(moves.collect()).expect("there");
    assert!(scene.placed.iter().all(|placed| placed.hung <= stamp));
}

/// Lamps that are off cost nothing, wherever they hang. They hang among those around them nevertheless: for they may come on.
#[test]
fn lamps_that_are_off_hang_among_those_around_them() {
    let (mut scene, ids) = grid(9);
    let mesh = scene.mesh_of(ids[0]).expect("there");
    let random = &mut Random(2);
    for _ in 0..60 {
        let at = (random.vector() * 16.0).to_array().map(|x| x + 16.0);
        let add = Edit::AddInstance {
            mesh,
            transform: Transform::at(at),
            radiance: 0.0,
        };
        let id = scene.apply(vec![add]).expect("one more").instances[0];
        scene.refit();
        let around = scene.below(scene.placed[id.index() as usize].node).1;
        let squared = around.iter().map(|&(index, _)| {
            let to = scene.placed[index as usize].transform.translation;
            (0..3).map(|k| f64::from(at[k] - to[k]).powi(2)).sum::<f64>()
        });
        let farthest = squared.fold(0.0, f64::max).sqrt();
        assert!(farthest < 20.0, "{farthest} m");
    }
}
