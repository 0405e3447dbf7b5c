//! What lights cost together, and which instances are opened by it.

use super::*;

/// Scattered lamps of different flux and extent, refitted.
fn lamps() -> LightBvh {
    let random = &mut Random(4);
    let mut bvh = LightBvh::new(BuildParams {
        opens: false,
        ..BuildParams::default()
    });
    let mesh = bvh.add_mesh(ring(300, 2.0, 0.0)).expect("a mesh");
    for k in 0..100_u16 {
        let id = bvh.add_instance(mesh, place(random)).expect("one");
        bvh.set_radiance(id, 1.0 + f32::from(k * 37 % 100))
            .expect("there");
    }
    bvh.refit();
    bvh
}

/// Flux times variance, over all lights: the sum of what each set costs by itself and of its flux times squared distance from
/// the mean. Any other measure would open what is not worth it.
#[test]
fn sets_cost_their_flux_times_variance() {
    let bvh = lamps();
    let sets: Vec<_> = (0..100).map(|index| bvh.in_world(index)).collect();
    let of = |k: usize| {
        sets.iter()
            .map(move |set| (f64::from(set.phi()), f64::from(set.center().to_array()[k])))
    };
    let phi: f64 = of(0).map(|(phi, _)| phi).sum();
    let mut expected: f64 = sets.iter().map(cost).sum();
    for k in 0..3 {
        let mean = of(k).map(|(phi, x)| phi * x).sum::<f64>() / phi;
        expected += of(k).map(|(phi, x)| phi * (x - mean) * (x - mean)).sum::<f64>();
    }
    let found = cost_of(&sets);
    assert!((found / expected - 1.0).abs() < 1e-6, "{found}, {expected}");
    // Of one set it is its own.
    assert!((cost_of(&sets[..1]) / cost(&sets[0]) - 1.0).abs() < 1e-6);
}

/// What is added is measured against what there is with it: against either alone a small mesh in a large scene would be opened, or
/// two small ones far apart.
#[test]
fn what_is_added_is_measured_against_all() {
    for apart_before in [1e5, 0.0] {
        let mut bvh = LightBvh::default();
        let lamp = bvh.add_mesh(ring(1, 0.0, 0.0)).expect("a mesh");
        let mesh = bvh.add_mesh(ring(300, 1.0, 0.0)).expect("a mesh");
        let add = |mesh: MeshId, x: f32| Edit::AddInstance {
            mesh,
            transform: Transform::at([x, 0.0, 0.0]),
            radiance: 1.0,
        };
        bvh.apply((0..20).map(|k| add(lamp, apart_before * k as f32)).collect())
            .expect("instances");
        bvh.refit();
        let x = if apart_before > 0.0 {
            [0.0, 1.0]
        } else {
            [0.0, 1e4]
        };
        bvh.apply(x.map(|x| add(mesh, x)).to_vec()).expect("instances");
        assert_eq!(opened(&bvh), 0, "{apart_before}");
    }
}

/// The costliest first, and 64 at most, or a frame that adopts them would have more to do than it has time for.
#[test]
fn the_costliest_are_opened_first_and_64_at_most() {
    let mut bvh = lamps();
    bvh.params.opens = true;
    let mut all = bvh.openable(0..100);
    assert_eq!(all.len(), 100);
    let mut order: Vec<u32> = (0..100).collect();
    let own = |index: &u32| cost(&bvh.in_world(*index));
    order.sort_by(|a, b| own(b).total_cmp(&own(a)).then(a.cmp(b)));
    order.truncate(64);
    assert_eq!(wanted::<MomentNode<8>, 8>(0.0, &all), [order.clone(), Vec::new()]);
    all.iter_mut().for_each(|own| own.instance.part = 0);
    let closed = wanted::<MomentNode<8>, 8>(f64::INFINITY, &all);
    assert_eq!(closed, [Vec::new(), order]);
}

/// A tree was built for what was whole or open as it was copied: nodes above what is opened or closed as it comes in are to be
/// tried, and once more when they rest.
#[test]
fn what_is_above_reopened_ones_is_to_be_tried() {
    let (mut bvh, _, ids) = rides::<MomentNode<8>, Moments, 8>(&mut Random(5));
    let is_open = |id: &&InstanceId| !bvh.placed[id.index() as usize].parts.is_empty();
    let index = ids.iter().find(is_open).expect("one").index();
    for opens in [false, true] {
        for list in [&mut bvh.top.stirred, &mut bvh.top.changes] {
            list.fill(0);
        }
        let (one, none) = (&[index][..], &[][..]);
        let (open, close) = if opens { (one, none) } else { (none, one) };
        bvh.reopen(open, close);
        assert_eq!(!bvh.placed[index as usize].parts.is_empty(), opens);
        for leaf in bvh.leaves_of(index) {
            let mut node = bvh.placed[leaf as usize].node;
            while node != INVALID {
                let number = bvh.top.number(node) as usize;
                assert!(bvh.top.stirred[number] > 0 && bvh.top.changes[number] > 0);
                node = bvh.parents[node as usize];
            }
        }
    }
}
