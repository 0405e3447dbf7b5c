//! Lights are added, removed and moved in every frame, and trees are built in the background: the number of a light that was sampled
//! means that light in each later frame, until it is reported as removed.

use std::collections::HashMap;

use lightbvh::bvh::Swap;
use lightbvh::{
    Edit, InstanceId, LightBvh, MeshId, Random64, Rebuilder, RebuilderParams, ShadingPoint, Transform,
};
use lightbvh_tests::generate::{Random, small_triangles};

/// An instance and a triangle of its mesh.
type Light = (InstanceId, u32);

/// What a sample's number says now.
fn named(bvh: &LightBvh, light: u32, instance: u32) -> Option<Light> {
    let id = bvh.instance_id(instance)?;
    let own = bvh.lights_of(id)?;
    own.contains(&light).then(|| (id, light - own.start))
}

fn add(bvh: &mut LightBvh, meshes: &[MeshId], lamps: &mut Vec<InstanceId>, random: &mut Random, count: u32) {
    for _ in 0..count {
        let edit = Edit::AddInstance {
            mesh: meshes[random.below(meshes.len() as u32) as usize],
            transform: place(random),
            radiance: 1.0,
        };
        lamps.extend(bvh.apply(vec![edit]).expect("within the domain").instances);
    }
}

fn place(random: &mut Random) -> Transform {
    Transform::at([0; 3].map(|_| 12.0 * random.unit()))
}

/// Sixty frames in which two lamps go, six move and two come. Returns how many kept numbers were looked up, how many were reported as
/// removed, and how many named another light or none; those reported are kept if not `forgets`.
fn frames(forgets: bool) -> [usize; 3] {
    let random = &mut Random::new(3);
    let mut bvh = LightBvh::default();
    let meshes = [1, 2, 2, 5].map(|count| {
        let triangles = small_triangles(count, count, 0.5, 0.5, false, count);
        bvh.add_mesh(triangles).expect("within the domain")
    });
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        idle: 0.0,
        ..RebuilderParams::default()
    });
    let mut lamps = Vec::new();
    add(&mut bvh, &meshes, &mut lamps, random, 24);
    let mut kept: HashMap<[u32; 2], Light> = HashMap::new();
    let [mut looked_up, mut removed, mut wrong] = [0; 3];
    for _ in 0..60 {
        rebuilder.begin_frame(&mut bvh).expect("no panic");
        for _ in 0..2 {
            let at = random.below(lamps.len() as u32) as usize;
            bvh.remove_instance(lamps.swap_remove(at)).expect("it is there");
        }
        for _ in 0..6 {
            let lamp = lamps[random.below(lamps.len() as u32) as usize];
            bvh.set_transform(lamp, place(random)).expect("a place");
        }
        let gone = bvh.take_removed_lights();
        let is_gone = |light: u32| gone.iter().any(|range| range.contains(&light));
        removed += kept.keys().filter(|name| is_gone(name[0])).count();
        kept.retain(|name, _| !(forgets && is_gone(name[0])));
        add(&mut bvh, &meshes, &mut lamps, random, 2);
        bvh.refit();
        rebuilder.end_frame(&bvh);
        for (&[light, instance], &then) in &kept {
            looked_up += 1;
            wrong += usize::from(named(&bvh, light, instance) != Some(then));
        }
        for k in 0..32 {
            let point = ShadingPoint {
                p: place(random).translation,
                n: [0.0, 1.0, 0.0],
            };
            let found = bvh.sample(&point, Random64::from(lightbvh::exact::hash(k)));
            let light = named(&bvh, found.light, found.instance).expect("sampled lights are there");
            kept.insert([found.light, found.instance], light);
        }
    }
    [looked_up, removed, wrong]
}

#[test]
fn a_number_stays_its_lights_until_it_is_reported() {
    let [looked_up, removed, wrong] = frames(true);
    assert_eq!(wrong, 0);
    assert!(looked_up > 1_000 && removed > 100, "{looked_up} {removed}");
}

/// The same count finds numbers that other lights have got.
#[test]
fn a_number_that_is_anothers_is_found() {
    let [.., wrong] = frames(false);
    assert!(wrong > 20, "{wrong}");
}
