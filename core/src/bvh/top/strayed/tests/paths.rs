//! Lamps that walk, and those that wait beside others: a sample beside them is as good as in a new tree once they rest.

use super::super::NOTED;
use super::*;

/// From corner to corner of a cube, the `k`-th of 44 steps of 2 m along each of some ways.
fn way(turn: usize, k: u16) -> [f32; 3] {
    let along = 2.0 * f32::from(k) - 44.0;
    let signs = [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, 0.3],
        [-1.0, 0.2, 1.0],
        [0.4, 1.0, -1.0],
    ][turn];
    signs.map(|sign| sign * along * 0.8)
}

/// No step is far from the one before, and the last of them that had it put in elsewhere decided: 4 to 13 times the variance,
/// nothing due.
#[test]
fn a_lamp_that_walks_by_its_transform_is_where_it_stops() {
    for turn in 0..4 {
        for radiance in [25.0, 200.0] {
            let (mut bvh, _) = scene(8);
            let mesh = bvh.add_mesh(cloud(8, [0.0; 3], 0)).expect("a mesh");
            let id = walker(&mut bvh, mesh, radiance, way(turn, 0));
            let own = &mut rebuilder();
            for k in 1..=44 {
                let step = place(id, way(turn, k));
                frame(&mut bvh, own, [step].to_vec());
            }
            rest(&mut bvh, own);
            let found = over_new(&bvh, way(turn, 44));
            assert!(found < 1.1, "{turn} {radiance}: {found}");
        }
    }
}

/// Where all move as one, all stay beside each other, and no more are noted than a bound.
#[test]
fn those_that_move_together_stay_together() {
    let (mut bvh, _) = scene(8);
    let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
    let random = &mut Random(5);
    let add = (0..1500).map(|_| Edit::AddInstance {
        mesh: lamp,
        transform: Transform::at((random.vector() * 50.0).to_array()),
        radiance: 1.0,
    });
    bvh.apply(add.collect()).expect("instances");
    bvh.refit();
    let own = &mut rebuilder();
    let all: Vec<_> = (0..bvh.instances().len() as u32)
        .filter_map(|k| bvh.instance_id(k))
        .collect();
    let at: Vec<_> = all
        .iter()
        .map(|id| bvh.instances()[id.index() as usize].translation)
        .collect();
    let stamp = bvh.epoch;
    for k in 1..=60_u16 {
        let to = |p: &[f32; 3]| [p[0] + 3.0 * f32::from(k), p[1], p[2]];
        let edits = all.iter().zip(&at).map(|(&instance, p)| place(instance, to(p)));
        frame(&mut bvh, own, edits.collect());
        assert!(bvh.top.strayed.len() <= NOTED, "{}", bvh.top.strayed.len());
    }
    let hung = put_since(&bvh, stamp);
    // Two in each frame, 120, but for that; those at the edge of what is beside them are put in anew while they have not gone
    // farther.
    assert!(hung <= 60, "{hung}");
    let stamp = bvh.epoch;
    rest(&mut bvh, own);
    assert_eq!(put_since(&bvh, stamp), 0, "at rest");
}

/// Twenty meshes go round and round; one of a higher index jumps once, and waited for all of them to rest.
#[test]
fn nobody_waits_for_those_that_never_rest() {
    let to = [35.0, 30.0, 20.0];
    let (mut bvh, _) = scene(8);
    let ring = |k: u16, step: u16| {
        let angle = 0.3 * f64::from(step) + f64::from(k);
        let r = 20.0 + f64::from(k);
        [
            (r * angle.cos()) as f32,
            2.0 * f32::from(k) - 20.0,
            (r * angle.sin()) as f32,
        ]
    };
    let movers: Vec<MeshId> = (0..20)
        .map(|k| bvh.add_mesh(cloud(8, ring(k, 0), 0)).expect("a mesh"))
        .collect();
    for &mesh in &movers {
        walker(&mut bvh, mesh, 1.0, [0.0; 3]);
    }
    let last = bvh.add_mesh(cloud(8, [-40.0; 3], 0)).expect("a mesh");
    let last_one = walker(&mut bvh, last, 25.0, [0.0; 3]);
    let own = &mut rebuilder();
    let mut waited = 0;
    for step in 1..80_u16 {
        let mut edits: Vec<Edit> = (0..)
            .zip(&movers)
            .flat_map(|(k, &mesh)| halves(mesh, &cloud(8, ring(k, step), 0)))
            .collect();
        if step == 20 {
            edits.extend(halves(last, &cloud(8, to, 0)));
        }
        frame(&mut bvh, own, edits);
        waited += u32::from(bvh.top.strayed.contains(&last_one.index()));
    }
    // Two of 21 are put in by a frame.
    assert!((1..=12).contains(&waited), "{waited}");
    let found = over_new(&bvh, to);
    assert!(found < 1.8, "{found}");
}

/// One of two instances of a mesh jumps in each step, the other one stays, for each step is shorter than its neighbours lie
/// apart: it was forgotten, and rested at up to 7 times.
#[test]
fn an_instance_that_stays_while_another_jumps_is_not_forgotten() {
    for turn in 0..4 {
        let mut bvh = LightBvh::default();
        let random = &mut Random(11 + turn as u32);
        let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
        // Dense here, sparse there.
        let place = |k: u32, random: &mut Random| match k % 10 {
            0 => (random.vector() * 50.0).to_array(),
            _ => (random.vector() * 8.0 + glam::Vec3::new(200.0, 0.0, 0.0)).to_array(),
        };
        let add = (0..600).map(|k| Edit::AddInstance {
            mesh: lamp,
            transform: Transform::at(place(k, random)),
            radiance: 1.0,
        });
        bvh.apply(add.collect()).expect("instances");
        let at = |k: u16| way(turn, 2 * k).map(|x| 0.5 * x);
        let of = |k: u16| eight(at(k), 25.0);
        let mesh = bvh.add_mesh(of(0)).expect("a mesh");
        walker(&mut bvh, mesh, 1.0, [0.0; 3]);
        walker(&mut bvh, mesh, 1.0, [200.0, 0.0, 0.0]);
        let own = &mut rebuilder();
        for k in 1..=22 {
            let triangles = of(k);
            frame(&mut bvh, own, [Edit::SetTriangles { mesh, triangles }].to_vec());
        }
        rest(&mut bvh, own);
        let found = over_new(&bvh, at(22));
        assert!(found < 1.7, "{turn}: {found}");
    }
}

/// Engines send all their transforms in every frame: what is set as it was rests, and the list of what moved drains.
#[test]
fn what_is_set_as_it_was_rests() {
    let (mut bvh, _) = scene(8);
    let mesh = bvh.add_mesh(cloud(8, [0.0; 3], 0)).expect("a mesh");
    let id = walker(&mut bvh, mesh, 25.0, way(1, 0));
    let own = &mut rebuilder();
    let at = |k: u16| [place(id, way(1, k))].to_vec();
    (1..=44).for_each(|k| frame(&mut bvh, own, at(k)));
    (0..REST).for_each(|_| frame(&mut bvh, own, at(44)));
    assert!(bvh.top.strayed.is_empty());
    // Nor is there anything to refit or to copy.
    let epoch = bvh.epoch;
    bvh.apply([at(44), [shine(id, 25.0)].to_vec()].concat())
        .expect("its own");
    assert!(bvh.changes.new.is_empty() && bvh.epoch == epoch);
    let found = over_new(&bvh, way(1, 44));
    assert!(found < 1.1, "{found}");
}
