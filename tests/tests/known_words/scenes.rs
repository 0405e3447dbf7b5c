//! Scenes of moving lights: plans, refits, rebuilds and picks, frame after frame.

use lightbvh::bvh::Cursor;
use lightbvh::{Bvh, CompactNode, Edit, Eq4, ImportanceModel, LightNode, MomentNode, Moments};
use lightbvh_tests::generate::{self, Random};

use super::digest::Digest;
use super::place;

fn scene<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(known: u64) {
    let mut random = Random::new(43);
    let mut digest = Digest::new();
    let mut scene = Bvh::<(N, ()), W>::default();
    let mut meshes = Vec::new();
    for i in 0..6 {
        let triangles = generate::small_triangles(30 + i, 100, 2.0, 0.3, i % 2 == 0, i);
        meshes.push((
            scene
                .apply(vec![Edit::AddMesh { lights: triangles }])
                .expect("a mesh")
                .meshes[0],
            30 + i,
        ));
    }
    let (mut ids, mut cursor) = (Vec::new(), Cursor::default());
    for frame in 0..30 {
        let mut batch: Vec<Edit> = (0..random.below(12))
            .map(|_| Edit::AddInstance {
                mesh: meshes[random.below(6) as usize].0,
                transform: place(&mut random),
                radiance: [[0.0, 1.0, 0.25, 1000.0][random.below(4) as usize]; 3],
                mask: u32::MAX,
            })
            .collect();
        for &instance in &ids {
            match random.below(12) {
                0 => batch.push(Edit::SetRadiance {
                    instance,
                    radiance: [0; 3].map(|_| random.unit() + 0.5),
                }),
                1..=3 => batch.push(Edit::SetTransform {
                    instance,
                    transform: place(&mut random),
                }),
                _ => {}
            }
        }
        if frame % 3 == 1 {
            let (mesh, count) = meshes[random.below(6) as usize];
            let size = random.between(1.0, 9.0);
            let triangles = generate::small_triangles(count, 100, size, 0.5, false, frame);
            batch.push(Edit::SetLights {
                mesh,
                lights: triangles,
            });
        }
        if ids.len() > 10 {
            for _ in 0..random.below(6) {
                batch.push(Edit::RemoveInstance(
                    ids.swap_remove(random.below(ids.len() as u32) as usize),
                ));
            }
        }
        // What is removed was perhaps moved before in the batch; the other way round it would be unknown.
        ids.extend(scene.apply(batch).expect("sound edits").instances);
        if frame % 4 == 3 {
            scene.rebuild();
        }
        scene.refit();
        let work = cursor.plan(&scene);
        for list in [
            &work.written_nodes,
            &work.written_lights,
            &work.written_trails,
            &work.written_instances,
            &work.written_top,
            &work.written_above,
            &work.written_places,
            &work.written_parts,
        ] {
            digest.word(list.len() as u32);
            list.iter()
                .for_each(|range| (digest.word(range.start), digest.word(range.end)).0);
        }
        for levels in [&work.bottom, &work.top] {
            digest.words(levels.nodes());
            levels.ranges().for_each(|range| digest.word(range.end as u32));
        }
        digest.word(work.computed() as u32);
        digest.words(scene.view().nodes());
        digest.words(scene.view().top_nodes());
        digest.words(scene.tree().links.above);
        digest.words(scene.tree().links.places);
        digest.words(scene.view().roots());
        digest.words(scene.view().instances());
        digest.words(scene.view().lights());
        digest.words(scene.tree().trails);
        digest.words(&scene.view().world_lights());
        for range in scene.view().removed_lights() {
            digest.word(range.start);
            digest.word(range.end);
        }
        [
            scene.tree().root,
            scene.view().light_end(),
            scene.view().light_count() as u32,
            scene.view().bytes() as u32,
        ]
        .into_iter()
        .for_each(|word| digest.word(word));
        for _ in 0..30 {
            let point = generate::point(&mut random, 20.0);
            let sampled = scene.tree().by::<I>().sample(&point, random.bits());
            digest.word(sampled.light);
            digest.float(sampled.pmf);
        }
        let world = scene.view().world_lights();
        for &id in &ids {
            for light in scene.view().lights_of(id).expect("it is there") {
                assert_eq!(scene.view().light(light, id.index()), Some(world[light as usize]));
            }
        }
        for &id in &ids {
            let lights = scene.view().lights_of(id).expect("it is there");
            let point = generate::point(&mut random, 20.0);
            let tree = scene.tree().by::<I>();
            digest.float(tree.pmf(&point, lights.start + frame % 30, id.index()));
        }
    }
    digest.is(known, N::NAME);
}

#[test]
fn scenes() {
    scene::<CompactNode<4>, Eq4, 4>(0xdd62_91b1_af24_e877);
    scene::<MomentNode<8>, Moments, 8>(0xf6b7_af7d_8a82_ded6);
}
