//! Calls of any BVH, whatever it holds.

use lightbvh::{BuildParams, LightBvh, Lights, Random64};
use lightbvh_gpu::Mirror;

use crate::measure::{Scene, nothing, row};

/// What is asked of any BVH.
pub fn queries(scene: &mut Scene, size: u32) {
    row(
        scene,
        "sample",
        size,
        |scene| (scene.point(), Random64::from(scene.random())),
        |scene, (point, random)| scene.bvh.sample(&point, random),
    );
    row(
        scene,
        "pmf",
        size,
        |scene| {
            let (point, random) = (scene.point(), scene.random());
            (point, scene.bvh.sample(&point, Random64::from(random)))
        },
        |scene, (point, at)| scene.bvh.pmf(&point, at.light, at.instance),
    );
    row(
        scene,
        "triangle, instance_id, lights_of",
        size,
        |scene| {
            let (point, random) = (scene.point(), scene.random());
            scene.bvh.sample(&point, Random64::from(random))
        },
        |scene, at| {
            let id = scene.bvh.instance_id(at.instance).expect("sampled");
            (scene.bvh.triangle(at.light, at.instance), scene.bvh.lights_of(id))
        },
    );
}

/// What works on all of it, by its name.
pub fn wholes(scene: &mut Scene, size: u32) {
    row(scene, "clone", size, nothing, |scene, ()| scene.bvh.clone());
    row(scene, "validate", size, nothing, |scene, ()| {
        scene.bvh.validate().is_ok()
    });
    row(scene, "to_words", size, nothing, |scene, ()| scene.bvh.to_words());
    let words = scene.bvh.to_words();
    row(scene, "from_words", size, nothing, |_, ()| {
        LightBvh::from_words(&words)
    });
    let all = scene.bvh.world_lights();
    let lights = Lights::new(all.clone()).expect("lights");
    row(
        scene,
        "Lights::new",
        size,
        |_| all.clone(),
        |_, all| Lights::new(all).is_ok(),
    );
    let params = BuildParams::default();
    row(scene, "single_level", size, nothing, |_, ()| {
        LightBvh::single_level(&lights, &params)
    });
    row(scene, "two_level", size, nothing, |_, ()| {
        LightBvh::two_level(&lights, &params)
    });
    let mut same = LightBvh::single_level(&lights, &params);
    row(scene, "follow", size, nothing, |_, ()| {
        same.follow(&lights).is_ok()
    });
    row(scene, "world_lights", size, nothing, |scene, ()| {
        scene.bvh.world_lights()
    });
    row(scene, "plan_of_everything", size, nothing, |scene, ()| {
        scene.bvh.plan_of_everything()
    });
    row(scene, "Mirror::frame of all", size, nothing, |scene, ()| {
        Mirror::default().frame(&scene.bvh)
    });
    row(scene, "mesh_triangles", size, nothing, |scene, ()| {
        scene.bvh.mesh_triangles(scene.mesh).map(<[_]>::len)
    });
}
