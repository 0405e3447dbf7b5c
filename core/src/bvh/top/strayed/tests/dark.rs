//! Lamps and meshes that went elsewhere while they were dark, or dim: a sample beside them is as good as in a new tree once
//! they rest.

use super::*;

/// Such lamps were put in by a summary without flux, anywhere: 3 to 19 times.
#[test]
fn what_came_in_dark_is_looked_at_once_it_shines() {
    let to = [35.0, 30.0, 20.0];
    let (dark, lit) = (eight(to, 0.0), eight(to, 25.0));
    for was_lit in [false, true] {
        let (mut bvh, _) = scene(8);
        let own = &mut rebuilder();
        let first = if was_lit { &lit } else { &dark };
        let mesh = bvh.add_mesh(first.clone()).expect("a mesh");
        bvh.refit();
        bvh.set_triangles(mesh, dark.clone()).expect("as many");
        bvh.refit();
        walker(&mut bvh, mesh, 1.0, [0.0; 3]);
        (0..20).for_each(|_| frame(&mut bvh, own, Vec::new()));
        frame(&mut bvh, own, halves(mesh, &lit).to_vec());
        rest(&mut bvh, own);
        let found = over_new(&bvh, to);
        assert!(found < 1.6, "lit before {was_lit}: {found}");
    }
}

/// Meshes that blinked were never looked at again where they are dim: 2 to 19 times.
#[test]
fn a_mesh_that_flashed_is_looked_at_where_it_rests() {
    let to = [35.0, 30.0, 20.0];
    let (mut bvh, mesh) = scene(8);
    let own = &mut rebuilder();
    for radiance in [25.0, 2500.0, 25.0, 2500.0, 25.0] {
        let triangles = eight([-40.0; 3], radiance);
        frame(&mut bvh, own, [Edit::SetTriangles { mesh, triangles }].to_vec());
    }
    (0..60).for_each(|_| frame(&mut bvh, own, Vec::new()));
    frame(&mut bvh, own, halves(mesh, &eight(to, 25.0)).to_vec());
    rest(&mut bvh, own);
    let found = over_new(&bvh, to);
    assert!(found < 1.6, "{found}");
}

/// Another instance came in while the mesh was dark, and where the first one had been put was forgotten: 6 to 144 times.
#[test]
fn an_instance_is_not_forgotten_as_another_comes_in_dark() {
    let to = [35.0, 30.0, 20.0];
    for comes in [false, true] {
        let (mut bvh, mesh) = scene(8);
        let own = &mut rebuilder();
        let of = |at: [f32; 3], radiance: f32| halves(mesh, &eight(at, radiance));
        frame(&mut bvh, own, of([-40.0; 3], 0.0).to_vec());
        if comes {
            walker(&mut bvh, mesh, 1.0, [400.0, 0.0, 0.0]);
        }
        frame(&mut bvh, own, Vec::new());
        frame(&mut bvh, own, of(to, 3.0).to_vec());
        assert!(bvh.top.strayed.contains(&500), "another {comes}");
        rest(&mut bvh, own);
        let found = over_new(&bvh, to);
        assert!(found < 1.6, "{comes}: {found}");
    }
}

/// Dark ones that move are nowhere: they were taken out and put in again, two in each frame.
#[test]
fn what_moves_in_the_dark_stays() {
    let (mut bvh, _) = scene(8);
    let mesh = bvh.add_mesh(eight([0.0; 3], 0.0)).expect("a mesh");
    let ids: Vec<_> = (0..20)
        .map(|k| walker(&mut bvh, mesh, 1.0, [f32::from(k as u16), 0.0, 0.0]))
        .collect();
    let own = &mut rebuilder();
    let stamp = bvh.epoch;
    for k in 1..60_u16 {
        let edits = ids.iter().map(|&instance| {
            place(
                instance,
                [3.0 * f32::from(k), f32::from(instance.index() as u16), 0.0],
            )
        });
        frame(&mut bvh, own, edits.collect());
        assert!(bvh.top.strayed.is_empty());
    }
    let put = ids
        .iter()
        .filter(|id| bvh.placed[id.index() as usize].hung > stamp);
    assert_eq!(put.count(), 0);
}

/// Off, moved, and on again as bright as before, each in a call of its own: nobody looked, and it rested at 9 to 50 times.
#[test]
fn a_lamp_that_moves_while_it_is_off_is_where_it_shines() {
    let to = [35.0, 30.0, 20.0];
    for (steps, count, refits) in [(1_u16, 8, true), (44, 8, true), (1, 8, false), (1, 3000, true)] {
        let (mut bvh, _) = scene(8);
        let mesh = bvh.add_mesh(cloud(count, [0.0; 3], 0)).expect("a mesh");
        let id = walker(&mut bvh, mesh, 25.0, [-40.0; 3]);
        let own = &mut rebuilder();
        frame(&mut bvh, own, Vec::new());
        let mut step = |bvh: &mut LightBvh, edits: Vec<Edit>| {
            if refits {
                frame(bvh, own, edits);
            } else {
                bvh.apply(edits).expect("sound edits");
            }
        };
        step(&mut bvh, [shine(id, 0.0)].to_vec());
        for k in 1..=steps {
            let part = f32::from(k) / f32::from(steps);
            let at = to.map(|x| (x + 40.0) * part - 40.0);
            step(&mut bvh, [place(id, at)].to_vec());
        }
        step(&mut bvh, [shine(id, 25.0)].to_vec());
        bvh.refit();
        rest(&mut bvh, own);
        let found = over_new(&bvh, to);
        assert!(
            found < 1.5,
            "{steps} steps, {count} lights, refits {refits}: {found}"
        );
    }
}

/// One that blinks in its place is not put in anew, though it swayed while it was dark.
#[test]
fn what_blinks_and_sways_stays() {
    let (mut bvh, _) = scene(8);
    let mesh = bvh.add_mesh(cloud(8, [0.0; 3], 0)).expect("a mesh");
    let id = walker(&mut bvh, mesh, 1.0, [0.0; 3]);
    let own = &mut rebuilder();
    (0..20).for_each(|_| frame(&mut bvh, own, Vec::new()));
    let stamp = bvh.epoch;
    for k in 1..40_u16 {
        let at = [0.01 * f32::from(k % 3), 0.0, 0.0];
        for (radiance, is_moved) in [(0.0, false), (0.0, true), (1.0, false)] {
            let edit = match is_moved {
                true => place(id, at),
                false => shine(id, radiance),
            };
            frame(&mut bvh, own, [edit].to_vec());
        }
    }
    assert!(bvh.placed[id.index() as usize].hung <= stamp);
}

/// Dark by its triangles, moved, and lit again a few triangles at a time: no centre of the mesh changed.
#[test]
fn a_mesh_that_is_moved_while_its_triangles_are_dark_is_looked_at() {
    let to = [35.0, 30.0, 20.0];
    for blinks in [0, 3] {
        for radiance_first in [None, Some(true), Some(false)] {
            let (mut bvh, _) = scene(8);
            let mesh = bvh.add_mesh(cloud(8, [0.0; 3], 0)).expect("a mesh");
            let id = walker(&mut bvh, mesh, 25.0, [-40.0; 3]);
            let own = &mut rebuilder();
            let set = |radiance: f32| halves(mesh, &eight([0.0; 3], radiance));
            for _ in 0..blinks {
                frame(&mut bvh, own, set(0.0).to_vec());
                frame(&mut bvh, own, set(1.0).to_vec());
            }
            frame(&mut bvh, own, set(0.0).to_vec());
            if radiance_first.is_some() {
                frame(&mut bvh, own, [shine(id, 0.0)].to_vec());
            }
            frame(&mut bvh, own, [place(id, to)].to_vec());
            if radiance_first == Some(true) {
                frame(&mut bvh, own, [shine(id, 25.0)].to_vec());
            }
            set(1.0)
                .into_iter()
                .for_each(|half| frame(&mut bvh, own, [half].to_vec()));
            if radiance_first == Some(false) {
                frame(&mut bvh, own, [shine(id, 25.0)].to_vec());
            }
            rest(&mut bvh, own);
            let found = over_new(&bvh, to);
            assert!(found < 1.5, "{blinks} {radiance_first:?}: {found}");
        }
    }
}

/// More than are noted sway beside a lamp that comes on elsewhere.
#[test]
fn what_comes_on_is_noted_beside_many_that_move() {
    let to = [35.0, 30.0, 20.0];
    let (mut bvh, _) = scene(8);
    let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
    let random = &mut Random(5);
    let at: Vec<_> = (0..2000).map(|_| (random.vector() * 50.0).to_array()).collect();
    let add = at.iter().map(|&at| Edit::AddInstance {
        mesh: lamp,
        transform: Transform::at(at),
        radiance: 0.01,
    });
    let all = bvh.apply(add.collect()).expect("instances").instances;
    let mesh = bvh.add_mesh(cloud(8, [0.0; 3], 0)).expect("a mesh");
    let id = walker(&mut bvh, mesh, 25.0, [-40.0; 3]);
    let own = &mut rebuilder();
    for k in 0..8_u16 {
        let mut edits: Vec<Edit> = all
            .iter()
            .zip(&at)
            .map(|(&instance, p)| place(instance, [p[0] + 0.1 * f32::from(k % 2), p[1], p[2]]))
            .collect();
        match k {
            2 => edits.push(shine(id, 0.0)),
            6 => edits.push(shine(id, 25.0)),
            4 => edits.push(place(id, to)),
            _ => {}
        }
        frame(&mut bvh, own, edits);
    }
    assert!(bvh.top.strayed.contains(&id.index()));
    (0..400).for_each(|_| frame(&mut bvh, own, Vec::new()));
    assert!(bvh.top.strayed.is_empty());
    let found = over_new(&bvh, to);
    assert!(found < 1.5, "{found}");
}

/// A top level of up to 1024 instances is built as a whole, and lamps that were off then had a place anywhere in it: to 3.5
/// times once they come on. Off by radiance, or hidden by a map of scale 0.
#[test]
fn what_was_off_as_the_whole_top_level_was_built_is_looked_at() {
    let mut beyond = [0; 2];
    for seed in 0..16 {
        let is_hidden = seed % 2 == 1;
        let random = &mut Random(160 + seed / 2);
        let side = 35.0;
        let mut bvh = LightBvh::default();
        let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
        let mut at: Vec<_> = (0..900).map(|_| (random.vector() * side).to_array()).collect();
        // The first are neighbours, and brighter than the others.
        let middle = glam::Vec3::from(at[0]);
        at.sort_by(|a, b| {
            let [a, b] = [a, b].map(|&own| crate::vector::length_squared(glam::Vec3::from(own) - middle));
            a.total_cmp(&b)
        });
        let ids = put_in(&mut bvh, lamp, &at);
        let bright = ids.iter().take(40).map(|&id| shine(id, 10.0)).collect();
        bvh.apply(bright).expect("there");
        bvh.refit();
        let own = &mut rebuilder();
        let set = |is_on: bool| {
            let some = ids.iter().zip(&at).take(40);
            let edits = some.map(|(&instance, &at)| match (is_hidden, is_on) {
                (false, _) => shine(instance, if is_on { 10.0 } else { 0.0 }),
                (true, true) => place(instance, at),
                (true, false) => Edit::SetTransform {
                    instance,
                    transform: Transform {
                        columns: [[0.0; 3]; 3],
                        translation: at,
                    },
                },
            });
            edits.collect::<Vec<_>>()
        };
        frame(&mut bvh, own, set(false));
        let mut walks = at.clone();
        for k in 0..100 {
            let moves = (0..100).map(|other| {
                let other = 40 + (7 * k + 131 * other) % 860;
                let step = random.vector() * 4.0;
                walks[other] = (glam::Vec3::from(walks[other]) + step).to_array();
                place(ids[other], walks[other])
            });
            let moves = moves.collect();
            frame(&mut bvh, own, moves);
        }
        (0..REST).for_each(|_| frame(&mut bvh, own, Vec::new()));
        frame(&mut bvh, own, set(true));
        rest(&mut bvh, own);
        beyond[usize::from(is_hidden)] += at.iter().take(40).filter(|&&at| over_new(&bvh, at) > 1.4).count();
        assert!(bvh.top.lit.is_empty());
    }
    // 44 and 46 before.
    assert!(beyond.iter().all(|&count| count <= 16), "{beyond:?} of 320");
}

/// Of hardly any flux by its mesh, its radiance or both: it is off, and asks for no work at rest. A mesh of 1e-26 W was put in
/// elsewhere in every frame.
#[test]
fn what_hardly_shines_rests() {
    for (by_mesh, by_radiance) in [
        (1e-26, 1.0),
        (1e-25, 1.0),
        (8e-25, 1.0),
        (1e-14, 1e-12),
        (1e-28, 1e18),
    ] {
        let random = &mut Random(180);
        let mut bvh = LightBvh::default();
        let [lamp, dim] = [(); 2].map(|()| bvh.add_mesh(eight([0.0; 3], 1.0)).expect("a lamp"));
        let at: Vec<_> = (0..1500).map(|_| (random.vector() * 45.0).to_array()).collect();
        let mut ids = put_in(&mut bvh, dim, &at[..400]);
        ids.extend(put_in(&mut bvh, lamp, &at[400..]));
        let own = &mut rebuilder();
        let mut edits: Vec<Edit> = ids.iter().take(400).map(|&id| shine(id, by_radiance)).collect();
        edits.push(Edit::SetTriangles {
            mesh: dim,
            triangles: eight([0.0; 3], by_mesh),
        });
        frame(&mut bvh, own, edits);
        for k in 0..60 {
            let moves = (0..100).map(|other| {
                let other = 400 + (7 * k + 131 * other) % 1100;
                place(ids[other], (random.vector() * 45.0).to_array())
            });
            let moves = moves.collect();
            frame(&mut bvh, own, moves);
        }
        (0..3).for_each(|_| rest(&mut bvh, own));
        let stamp = bvh.epoch;
        rest(&mut bvh, own);
        assert_eq!(bvh.epoch, stamp, "{by_mesh} {by_radiance}");
    }
}

/// In a file both lists are one, told apart by what an instance says of where it was put: what was placed stayed in the wrong
/// one, and what was read went on otherwise.
#[test]
fn what_comes_on_goes_on_from_a_file() {
    let random = &mut Random(190);
    let mut bvh = LightBvh::default();
    let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
    let at: Vec<_> = (0..900).map(|_| (random.vector() * 35.0).to_array()).collect();
    let ids = put_in(&mut bvh, lamp, &at);
    let own = &mut rebuilder();
    let lamps = |from: usize, radiance: f32| (from..from + 40).map(move |k| (k, radiance));
    let told = |bvh: &LightBvh, all: &[(usize, f32)]| -> Vec<Edit> {
        let of = |&(k, radiance): &(usize, f32)| {
            let id = bvh.instance_id(ids[k].index()).expect("there");
            shine(id, radiance)
        };
        all.iter().map(of).collect()
    };
    let off: Vec<_> = (0..400).map(|k| (k, 0.0)).collect();
    let edits = told(&bvh, &off);
    frame(&mut bvh, own, edits);
    for k in 0..30 {
        let moves = (0..100).map(|other| {
            let other = 400 + (7 * k + 131 * other) % 500;
            place(ids[other], (random.vector() * 35.0).to_array())
        });
        let moves = moves.collect();
        frame(&mut bvh, own, moves);
    }
    rest(&mut bvh, own);
    // They come on a few at a time, while trees are adopted and files are written.
    for k in 0..10 {
        let edits = told(&bvh, &lamps(40 * k, 1.0).collect::<Vec<_>>());
        frame(&mut bvh, own, edits);
        let mut twins = [
            bvh.clone(),
            LightBvh::from_words(&bvh.to_words()).expect("its own"),
        ];
        let mut rebuilders = [rebuilder(), rebuilder()];
        for turn in 0..6 {
            let all: Vec<_> = lamps(40 * ((k + turn) % 10), (turn % 2) as f32).collect();
            for (bvh, own) in twins.iter_mut().zip(&mut rebuilders) {
                let edits = told(bvh, &all);
                frame(bvh, own, edits);
            }
            assert!(twins[0].to_words() == twins[1].to_words(), "{k}, {turn}");
        }
    }
}

/// Off as what a tree is built from is copied, and on before it comes in: it hangs anywhere in it, and no edit tells of it any
/// more.
#[test]
fn what_comes_on_while_a_tree_is_built_is_looked_at() {
    let random = &mut Random(210);
    let mut bvh = LightBvh::default();
    let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
    let ids = put_in(&mut bvh, lamp, &batches::somewhere(300, 30.0, random));
    let set = |bvh: &mut LightBvh, radiance: f32| {
        let edits = ids.iter().take(20).map(|&id| shine(id, radiance)).collect();
        bvh.apply(edits).expect("there");
        bvh.refit();
    };
    set(&mut bvh, 0.0);
    let copy = bvh.rebuild(&crate::bvh::RebuildParams::eager());
    assert!(!copy.is_empty());
    set(&mut bvh, 1.0);
    bvh.install(copy.run()).expect("its own");
    let noted: Vec<u32> = bvh.top.lit.iter().copied().collect();
    assert_eq!(
        noted,
        ids.iter().take(20).map(|id| id.index()).collect::<Vec<_>>()
    );
    rest(&mut bvh, &mut rebuilder());
    assert!(bvh.top.lit.is_empty());
}
