//! No light that reaches a point is told not to, at any scale, through instances, far from the origin.

use super::*;
use lightbvh::exact::hash;
use lightbvh::light::{AnyLight, SpotLight};
use lightbvh::refit::world_light;
use lightbvh::{ShadingPoint, Transform};

#[test]
fn no_light_that_reaches_a_point_is_told_not_to() {
    let mut seen = Seen::default();
    for seed in 0..40 {
        let random = &mut Random(1000 * seed + 3);
        let scale = 10.0_f32.powi(seed as i32 % 8 - 3);
        let mut bvh = Tree::<AnyLight>::default();
        for _ in 0..1 + random.below(6) {
            let count = [1, 3, 12, 90][random.below(4) as usize];
            let reach = scale * 0.01_f32.powf(random.unit());
            let mut own = any(spots(random, count, reach));
            if random.below(3) == 0 {
                own.push(other(random));
            }
            let mesh = bvh.add_mesh(own).expect("in the domain");
            for _ in 0..=random.below(4) {
                let place = even(random, 2.0 * scale, 1.0);
                bvh.add_instance(mesh, place).expect("in the domain");
            }
        }
        bvh.refit();
        check_beams(&bvh, scale, random, 300, &mut seen);
    }
    println!("{seen:?}");
    assert!(seen.lit > 20_000 && seen.dark > 100_000, "{seen:?}");
    assert_eq!(seen.wrong, 0, "{seen:?}");
    assert!(seen.outside > seen.dark / 100 * 98, "beams say little: {seen:?}");
}

/// Among meshes of one spot each, turned by their instances, a point beside the cones of most chooses those that light it: by
/// the beams of the top level.
#[test]
fn the_top_level_chooses_by_cones() {
    let random = &mut Random(37);
    let mut bvh = Tree::<AnyLight>::default();
    for _ in 0..300 {
        let spot = SpotLight {
            p: random.vector(0.5),
            axis: [0.0, 0.0, 1.0],
            intensity: [1.0; 3],
            range: 0.0,
            cos_inner: 0.97,
            cos_outer: 0.96,
            mesh: 0,
        };
        let mesh = bvh.add_mesh(any([spot].to_vec())).expect("in the domain");
        let [x, y, _] = random.vector(8.0);
        // Half a turn about x: they shine down.
        let place = Transform {
            columns: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]],
            translation: [x, y, 3.0],
        };
        bvh.add_instance(mesh, place).expect("in the domain");
    }
    bvh.refit();
    let (mut lit, mut total, mut points) = (0.0, 0.0, 0);
    while points < 200 {
        let [x, y, _] = random.vector(6.0);
        let point = ShadingPoint {
            p: [x, y, 0.0],
            n: [0.0, 0.0, 1.0],
        };
        let all = told(&bvh, &point);
        let is_lit = |own: &Told| {
            let light = world_light(bvh.triangles(), bvh.instances(), own.light, own.instance);
            sent(&light, point.p) > 0.0
        };
        if !all.iter().any(is_lit) {
            continue;
        }
        points += 1;
        for own in &all {
            let pmf = f64::from(bvh.pmf(&point, own.light, own.instance));
            total += pmf;
            lit += if is_lit(own) { pmf } else { 0.0 };
        }
    }
    println!("{lit} of {total}");
    // 0.45; without cones at the top level, or with cones that do not turn, 0.10.
    assert!(
        (total / 200.0 - 1.0).abs() < 1.0e-4 && lit > 0.35 * total,
        "{lit} of {total}"
    );
}

/// Far from the world's origin coordinates are rounded by more than a narrow cone is wide near its lamp: a point in it is in it
/// still.
#[test]
fn far_from_the_origin_no_light_is_told_not_to_reach_a_point() {
    for (far, least) in [(100.0_f32, 0.99), (1.0e4, 0.97), (3.0e5, 0.8)] {
        let random = &mut Random(77);
        let mut seen = Seen::default();
        for turn in 0..30 {
            let mut bvh = Tree::<AnyLight>::default();
            let about = random.vector(far);
            // By instances of any scale, or in a mesh that stands there itself.
            let scale = [1.0, 0.02, 50.0][turn % 3];
            for _ in 0..1 + random.below(6) {
                let count = [1, 1, 3, 12][random.below(4) as usize];
                let mut own = spots(random, count, 0.3 / scale);
                if turn % 2 == 1 {
                    own.iter_mut()
                        .for_each(|spot| (0..3).for_each(|k| spot.p[k] += about[k]));
                    let mesh = bvh.add_mesh(any(own)).expect("in the domain");
                    bvh.add_instance(mesh, Transform::IDENTITY)
                        .expect("in the domain");
                    continue;
                }
                let mesh = bvh.add_mesh(any(own)).expect("in the domain");
                for _ in 0..=random.below(4) {
                    let mut place = even(random, 4.0, scale);
                    (0..3).for_each(|k| place.translation[k] += about[k]);
                    bvh.add_instance(mesh, place).expect("in the domain");
                }
            }
            bvh.refit();
            check_beams(&bvh, 1.0, random, 300, &mut seen);
        }
        println!("{far}: {seen:?}");
        assert!(seen.lit > 5_000 && seen.dark > 50_000, "{far}: {seen:?}");
        assert_eq!(seen.wrong, 0, "{far}: {seen:?}");
        let share = f64::from(seen.outside) / f64::from(seen.dark);
        assert!(share > least, "{far}: beams say little: {share}");
    }
}

/// Spots that stand apart and shine the same way in cones as narrow as may be: the apex of what holds them lies farther behind
/// than a node can say, or nearly so.
#[test]
fn wide_sets_of_narrow_cones_leave_no_light_out() {
    let random = &mut Random(41);
    let mut seen = Seen::default();
    for _ in 0..40 {
        let axis = random.unit_vector();
        let angle = (0.25_f32 * 20.0_f32.powf(random.unit())).to_radians();
        let own = (0..12 + random.below(40)).map(|_| SpotLight {
            p: random.vector(1.0),
            axis,
            intensity: [1.0; 3],
            range: 0.0,
            cos_inner: angle.cos(),
            cos_outer: angle.cos().min(1.0 - 2.0_f32.powi(-20)),
            mesh: 0,
        });
        let mut bvh = Tree::<AnyLight>::default();
        let mesh = bvh.add_mesh(any(own.collect())).expect("in the domain");
        bvh.add_instance(mesh, even(random, 3.0, 1.0))
            .expect("in the domain");
        bvh.refit();
        check_beams(&bvh, 3.0, random, 200, &mut seen);
    }
    println!("{seen:?}");
    assert!(seen.lit > 5_000 && seen.dark > 50_000, "{seen:?}");
    assert_eq!(seen.wrong, 0, "{seen:?}");
}

/// A map that is no similarity changes angles: beams do not count there, and probabilities are those without.
#[test]
fn uneven_maps_leave_beams_out() {
    let random = &mut Random(15);
    let mut with = Tree::<AnyLight>::default();
    let mut without = Plain::<AnyLight>::default();
    for _ in 0..12 {
        let own = any(spots(random, 5, 1.0));
        let mut place = even(random, 5.0, 1.0);
        place.columns[1] = place.columns[1].map(|x| x * 1.01);
        let mesh = with.add_mesh(own.clone()).expect("in the domain");
        with.add_instance(mesh, place).expect("in the domain");
        let mesh = without.add_mesh(own).expect("in the domain");
        without.add_instance(mesh, place).expect("in the domain");
    }
    with.refit();
    without.refit();
    for k in 0..4000_u32 {
        let p = random.vector(8.0);
        let point = random.point(p);
        assert_eq!(with.sample(&point, hash(k)), without.sample(&point, hash(k)));
    }
    assert!(
        with.instances()
            .iter()
            .filter(|own| own.count > 0)
            .all(|own| !own.is_even())
    );
}
