//! Scenes under any edits, with trees that are built in the background.

mod batch;
mod model;
mod placing;

use arbitrary::{Result, Unstructured};
use lightbvh::bvh::{Cursor, Swap};
use lightbvh::{
    Bvh, CompactNode, Eq4, INVALID, ImportanceModel, LightNode, MomentNode, Moments, Rebuilder,
    RebuilderParams, ShadingPoint,
};

use self::model::Model;
use crate::{Forms, input};

/// Adds, moves, dims, deforms and removes meshes and instances, in batches that may hold refused edits, while trees are
/// built in the background. A refused batch changes nothing and names an edit that is wrong. Until the refit no sample names a
/// removed light. After every frame the scene is valid, its lights are where the edits put them, and its words are read as they were
/// written.
pub fn edits(data: &[u8], forms: Forms) {
    for form in forms.of(data, 4) {
        let u = &mut Unstructured::new(data);
        let _ = match form {
            0 => frames::<CompactNode<4>, Eq4, 4>(u, forms),
            1 => frames::<CompactNode<2>, Eq4, 2>(u, forms),
            2 => frames::<MomentNode<4>, Moments, 4>(u, forms),
            _ => frames::<MomentNode<8>, Moments, 8>(u, forms),
        };
    }
}

fn frames<N: LightNode<W> + std::fmt::Debug, I: ImportanceModel<N, W>, const W: usize>(
    u: &mut Unstructured<'_>,
    forms: Forms,
) -> Result<()> {
    let mut scene = Bvh::<(N, ()), W>::new(input::params(u)?);
    let mut model = Model::default();
    let mut cursor = Cursor::default();
    let mut rebuilder: Option<Rebuilder<(N, ()), W>> = None;
    let count = 1 + u.arbitrary::<u8>()? % 8;
    for frame in 0..count {
        let bits: u8 = u.arbitrary()?;
        // Comparing all that a scene is takes its time.
        let thorough = forms == Forms::All || bits & 0xf0 == 0;
        let mut is_swapped = bits & 1 != 0 && begin(&mut rebuilder, &mut scene);
        let is_done = batch::edit(u, &mut model, &mut scene, frame == 0, thorough)?;
        is_swapped |= bits & 2 != 0 && begin(&mut rebuilder, &mut scene);
        let point = place(u, &scene)?;
        let random: u32 = u.arbitrary()?;
        before_refit::<N, I, W>(&model, &scene, &point, random);
        let is_rebuilt = bits & 12 == 12;
        match is_rebuilt {
            true => scene.rebuild(),
            false => scene.refit(),
        }
        check(&model, &scene);
        let plan = cursor.plan(&scene);
        if !is_done && !is_swapped && !is_rebuilt && frame > 0 {
            let written = plan.written_nodes.len() + plan.written_top.len() + plan.written_instances.len();
            assert_eq!((plan.computed(), written), (0, 0), "nothing changed");
        }
        if bits & 32 != 0 {
            let bits: u8 = u.arbitrary()?;
            let own = rebuilder.get_or_insert_with(|| {
                Rebuilder::new(RebuilderParams {
                    after: u32::from(bits & 3),
                    swap: Swap::Deterministic,
                    idle: f64::from(bits >> 2 & 1),
                    bytes: if bits & 8 == 0 { usize::MAX } else { 200 },
                })
            });
            own.end_frame(&scene);
        }
        if bits & 64 != 0 {
            let words = scene.to_words();
            let read = Bvh::<(N, ()), W>::from_words(&words).unwrap_or_else(|error| panic!("{error}"));
            assert!(read.to_words() == words);
        }
    }
    for _ in 0..3 {
        begin(&mut rebuilder, &mut scene);
        scene.refit();
        check(&model, &scene);
    }
    sampled::<N, I, W>(u, &model, &scene)
}

/// Begins a frame of the rebuilder; returns whether anything was swapped in.
fn begin<N: LightNode<W>, const W: usize>(
    rebuilder: &mut Option<Rebuilder<(N, ()), W>>,
    scene: &mut Bvh<(N, ()), W>,
) -> bool {
    rebuilder.as_mut().is_some_and(|rebuilder| {
        let start = rebuilder.begin_frame(scene).expect("its own");
        start.swapped || start.meshes > 0
    })
}

/// A point for samples.
fn place<N: LightNode<W>, const W: usize>(
    u: &mut Unstructured<'_>,
    scene: &Bvh<(N, ()), W>,
) -> Result<ShadingPoint> {
    let mut world = scene.view().world_lights();
    if world.is_empty() {
        world.push(lightbvh::EmissiveTriangle {
            p: [[0.0; 3]; 3],
            radiance: [0.0; 3],
            mesh: INVALID,
            flags: 0,
        });
    }
    input::point(u, &world)
}

/// Samples between edits, or a swap, and the refit: of lights that are there, with their probabilities.
fn before_refit<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    model: &Model,
    scene: &Bvh<(N, ()), W>,
    point: &ShadingPoint,
    random: u32,
) {
    let tree = scene.tree().by::<I>();
    for i in 0..4_u32 {
        let sampled = tree.sample(point, random.wrapping_add(i.wrapping_mul(0x9e37_79b9)));
        if sampled.light != INVALID {
            let id = scene.view().instance_id(sampled.instance);
            let own = model.instances.iter().find(|placed| Some(placed.id) == id);
            assert!(own.expect("it is there").lights.contains(&sampled.light));
            let pmf = tree.pmf(point, sampled.light, sampled.instance);
            assert_eq!(pmf.to_bits(), sampled.pmf.to_bits());
        }
    }
}

/// Every invariant, and every light against the model.
fn check<N: LightNode<W>, const W: usize>(model: &Model, scene: &Bvh<(N, ()), W>) {
    scene.view().validate().expect("valid");
    assert_eq!(scene.tree().live as usize, model.instances.len());
    model.check_lights(scene);
}

/// Every light that shines in its mesh and is not turned off has a probability, under any map and at any point; they sum to one,
/// and samples come with them.
fn sampled<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    u: &mut Unstructured<'_>,
    model: &Model,
    scene: &Bvh<(N, ()), W>,
) -> Result<()> {
    let point = place(u, scene)?;
    let random: u32 = u.arbitrary()?;
    let mut pmfs = vec![0f32; scene.view().light_end() as usize];
    let mut any = false;
    for instance in &model.instances {
        for (light, local) in instance.lights.clone().zip(model.triangles(instance.mesh)) {
            let pmf = scene.tree().by::<I>().pmf(&point, light, instance.id.index());
            let shines = instance.radiance.iter().any(|&x| x > 0.0) && input::shines::<N, W>(local);
            assert_eq!(pmf > 0.0, shines, "light {light} at {point:?}");
            any |= shines;
            pmfs[light as usize] = pmf;
        }
    }
    for &gone in &model.gone_instances {
        assert_eq!(scene.view().lights_of(gone), None);
        assert_ne!(scene.view().instance_id(gone.index()), Some(gone));
    }
    if any {
        input::sum_is_one(&pmfs, 0, &point);
    }
    for i in 0..4_u32 {
        let sampled = scene
            .tree().by::<I>()
            .sample(&point, random.wrapping_add(i.wrapping_mul(0x9e37_79b9)));
        assert_eq!(sampled.light != INVALID, any, "{point:?}");
        if any {
            let pmf = pmfs[sampled.light as usize];
            assert_eq!(sampled.pmf.to_bits(), pmf.to_bits(), "{point:?}");
        }
    }
    Ok(())
}
