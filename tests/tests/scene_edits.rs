//! Single edits of scenes: what they cost and what they leave. Refusals are in `messages.rs`, batches of any edits in the fuzz
//! target `edits`.

use lightbvh::bvh::Cursor;
use lightbvh::{Bvh, CompactNode, Edit, EmissiveTriangle, InstanceId, Transform};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::placing::{self, Kind};

type Tree = Bvh<(CompactNode<4>, ()), 4>;

fn lamps() -> Vec<EmissiveTriangle> {
    generate::small_triangles(7, 7, 2.0, 0.4, false, 5)
}

/// For every kind of map.
#[test]
fn motion_costs_two_paths_at_most_and_no_bottom_level() {
    let random = &mut Random::new(5);
    let mut scene = Tree::default();
    let mesh = scene.add_mesh(lamps()).expect("a mesh");
    let add = |random: &mut Random| Edit::AddInstance {
        mesh,
        transform: placing::transform(random, Kind::Similar, 50.0),
        radiance: [1.0; 3],
        mask: u32::MAX,
    };
    let batch = (0..1000).map(|_| add(random)).collect();
    let ids = scene.apply(batch).expect("instances").instances;
    scene.refit();
    scene.view().validate().expect("valid");
    assert_eq!(scene.view().roots().len(), 1, "one bottom level serves all");

    let mut cursor = Cursor::default();
    assert!(cursor.plan(&scene).everything);
    scene.apply(Vec::new()).expect("nothing");
    scene.refit();
    let plan = cursor.plan(&scene);
    assert_eq!((plan.computed(), plan.written_instances.len()), (0, 0));

    let instance = ids[123];
    let far = Kind::ALL.map(|kind| Some(placing::transform(random, kind, 50.0)));
    for place in far.into_iter().chain([None; 6]) {
        // `None` is a step that leaves it among its siblings.
        let transform = place.unwrap_or_else(|| {
            let mut transform = scene_transform(&scene, instance);
            transform.translation[0] += 0.001;
            transform
        });
        let depth = scene.view().depth() as usize;
        scene
            .apply(vec![Edit::SetTransform { instance, transform }])
            .expect("moved");
        scene.refit();
        let plan = cursor.plan(&scene);
        assert!(plan.bottom.nodes().is_empty() && plan.written_nodes.is_empty());
        assert!(plan.written_lights.is_empty() && plan.written_trails.is_empty());
        assert!(
            plan.written_instances
                .iter()
                .cloned()
                .flatten()
                .eq([instance.index()])
        );
        // Far from where it was: the paths from there and to where it is put in.
        let paths = if place.is_some() { 2 } else { 1 };
        assert!(plan.top.nodes().len() <= paths * (depth + 1), "{transform:?}");
        assert!(place.is_some() || plan.written_top.is_empty());
        scene.view().validate().expect("valid");
    }
}

/// The map of an instance, as its record has it.
fn scene_transform(scene: &Tree, instance: InstanceId) -> Transform {
    let own = &scene.view().instances()[instance.index() as usize];
    Transform {
        columns: own.columns,
        translation: own.translation,
    }
}

/// Who never takes the numbers of removed lights neither runs out of numbers nor misses one.
#[test]
fn numbers_that_nobody_takes_come_back_and_are_still_told() {
    let mut scene = Tree::default();
    let count = lamps().len() as u32;
    let mesh = scene.add_mesh(lamps()).expect("a mesh");
    let add = |scene: &mut Tree| scene.add_instance(mesh, Transform::IDENTITY).expect("a place");
    let mut one = add(&mut scene);
    let mut forgot = 0;
    for _ in 0..300_000 / count {
        scene.apply(vec![Edit::RemoveInstance(one)]).expect("there");
        let told = scene.view().removed_lights();
        let gone = told
            .iter()
            .any(|range| range.contains(&(scene.view().light_end() - 1)));
        forgot += u32::from(gone && told.len() == 1);
        assert!(told.len() as u32 <= 65_536 / count + 2);
        one = add(&mut scene);
        let own = scene.view().lights_of(one).expect("there");
        assert!(scene.view().light_end() <= 65_536 + 2 * count, "{own:?}");
        if !told_all(scene.view().removed_lights()) {
            let given_again = scene
                .view()
                .removed_lights()
                .iter()
                .any(|gone| gone.contains(&own.start));
            assert!(!given_again, "{own:?} was not taken yet");
        }
    }
    assert!(forgot >= 3, "{forgot}");
    let told = scene.take_removed_lights();
    assert!(told_all(&told) && told[0].end >= 65_536, "{told:?}");
    assert!(scene.take_removed_lights().is_empty());
    // No number was lost: what is live and what comes next fill the numbers from 0.
    let all = (0..scene.view().light_end() / count).map(|_| add(&mut scene));
    let greatest = all
        .collect::<Vec<_>>()
        .into_iter()
        .map(|id| scene.view().lights_of(id).expect("there").end)
        .max();
    assert_eq!(greatest, Some(scene.view().light_end()));
    assert_eq!(scene.view().light_count() as u32, scene.view().light_end());
}

/// Whether all numbers were given back unasked.
fn told_all(told: &[std::ops::Range<u32>]) -> bool {
    told.first()
        .is_some_and(|range| range.start == 0 && range.end > 60_000)
}
