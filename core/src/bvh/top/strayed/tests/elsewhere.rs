//! What lies elsewhere, by its definition, and what stays.

use super::*;

/// What sways within its own extent is not noted, what stays among its neighbours is not put in elsewhere, and none is known
/// that is gone.
#[test]
fn what_stays_where_it_belongs_stays() {
    let (mut bvh, mesh) = scene(200);
    let id = bvh.instance_id(500).expect("there");
    let half = |at: [f32; 3]| Edit::SetTriangleRange {
        mesh,
        first: 0,
        triangles: cloud(100, at, 0),
    };
    bvh.apply([half([-39.5, -40.0, -40.0])].to_vec())
        .expect("in the mesh");
    bvh.refit();
    assert!(bvh.top.strayed.is_empty(), "it sways");
    bvh.apply([half([-36.0, -40.0, -40.0])].to_vec())
        .expect("in the mesh");
    bvh.refit();
    assert!(bvh.top.strayed.contains(&500), "beyond its extent");
    let stamp = bvh.epoch;
    let looked = &mut Looked::default();
    for is_left in [true, false] {
        bvh.put_strayed_elsewhere(2, looked);
        assert_eq!(bvh.top.strayed.contains(&500), is_left, "until it rests");
        assert!(bvh.placed[500].hung <= stamp, "as near as before");
    }
    bvh.apply([half([60.0, 40.0, 40.0])].to_vec())
        .expect("in the mesh");
    bvh.refit();
    assert!(bvh.top.strayed.contains(&500));
    let mut other = bvh.clone();
    other.put_strayed_elsewhere(2, &mut Looked::default());
    assert!(other.placed[500].hung > stamp, "far off");
    bvh.remove_instance(id).expect("there");
    assert!(bvh.top.strayed.is_empty());
}

/// What moves must be twice as far from the others as where it was, in squared distance; once it rests, it need not.
#[test]
fn what_rests_is_put_in_elsewhere_sooner_than_what_moves() {
    let (still, _) = scene(8);
    let id = still.instance_id(3).expect("there");
    let at = still.instances()[3].translation;
    let moved = |k: u16| {
        let mut bvh = still.clone();
        let away = [at[0] + 0.25 * f32::from(k), at[1], at[2]];
        let id = bvh.instance_id(id.index()).expect("there");
        bvh.set_transform(id, Transform::at(away)).expect("its own");
        bvh.refit();
        bvh
    };
    let between = (1..200).map(moved).find(|bvh| {
        bvh.top.strayed.contains(&3)
            && bvh.lies_elsewhere(3, Guard::RestsAlone)
            && !bvh.lies_elsewhere(3, Guard::Moves)
    });
    let mut bvh = between.expect("a place where its node is looser, and not by much");
    let stamp = bvh.epoch;
    let looked = &mut Looked {
        next: [0; 2],
        epoch: Some(still.epoch),
        ..Looked::default()
    };
    bvh.put_strayed_elsewhere(2, looked);
    assert!(
        bvh.top.strayed.contains(&3) && bvh.placed[3].hung <= stamp,
        "it moves"
    );
    bvh.put_strayed_elsewhere(2, looked);
    assert!(
        !bvh.top.strayed.contains(&3) && bvh.placed[3].hung > stamp,
        "it rests"
    );
    bvh.validate().expect("valid");
}

/// [`lies_elsewhere`](LightBvh) by its definition: farther from where it was than its node was wide, itself there, about the
/// mean of all; and as the guard says: while it moves twice as far from the mean of the others, in squared distance; at rest
/// farther than where it was.
fn lies_elsewhere_by_definition(bvh: &LightBvh, index: usize, guard: Guard) -> bool {
    let placed = &bvh.placed[index];
    let own = bvh.in_world(index as u32);
    let was = placed.hung_center.map(f64::from);
    let is = own.center().to_array().map(f64::from);
    let node = &bvh.nodes[placed.node as usize];
    let others: Vec<(f64, [f64; 3], f64)> = (0..8)
        .filter(|&slot| slot != placed.slot as usize && node.kind(slot) != kind::EMPTY)
        .map(|slot| node.summary(slot))
        .map(|other| {
            (
                f64::from(other.phi()),
                other.center().to_array().map(f64::from),
                f64::from(other.spread()),
            )
        })
        .collect();
    let mean = |of: &[(f64, [f64; 3], f64)]| {
        let phi: f64 = of.iter().map(|one| one.0).sum();
        [0, 1, 2].map(|k| of.iter().map(|one| one.0 * one.1[k]).sum::<f64>() / phi)
    };
    let mut all = others.clone();
    all.push((f64::from(own.phi()), was, f64::from(own.spread())));
    let (middle, phi) = (mean(&all), all.iter().map(|one| one.0).sum::<f64>());
    let wide: f64 = all
        .iter()
        .map(|one| one.0 * (one.2 + distance(one.1, middle)))
        .sum();
    let beside = mean(&others);
    let is_farther = |by: f64| distance(is, beside) > by * distance(was, beside);
    distance(is, was) > wide / phi
        && match guard {
            Guard::Moves => is_farther(FARTHER),
            Guard::Rests => is_farther(1.0),
            // It alone moved.
            Guard::RestsAlone => true,
        }
}

#[test]
fn what_lies_elsewhere_does_so_by_its_definition() {
    let (still, _) = scene(8);
    let mut found = [0, 0];
    for index in 0..60_u32 {
        let at = still.instances()[index as usize].translation;
        for k in 1..24_u16 {
            let mut bvh = still.clone();
            let id = bvh.instance_id(index).expect("there");
            let way = [[1.0, 0.3, -0.2], [-0.4, 1.0, 0.1], [0.2, -0.5, -1.0]][index as usize % 3];
            let away = [0, 1, 2].map(|axis| at[axis] + 0.8 * f32::from(k) * way[axis]);
            bvh.set_transform(id, Transform::at(away)).expect("its own");
            bvh.refit();
            if !bvh.top.strayed.contains(&index) {
                continue;
            }
            for guard in [Guard::Moves, Guard::Rests, Guard::RestsAlone] {
                let is = bvh.lies_elsewhere(index, guard);
                assert_eq!(
                    is,
                    lies_elsewhere_by_definition(&bvh, index as usize, guard),
                    "{index} {k}"
                );
                found[usize::from(is)] += 1;
            }
        }
    }
    assert!(found.iter().all(|&count| count > 50), "{found:?}");
}
