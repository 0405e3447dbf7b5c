//! Scenes under any edits, with rebuilds that end at any time.

mod batch;
mod model;
mod placing;
mod work;

use arbitrary::{Result, Unstructured};
use lightbvh::bvh::{Rebuild, RebuildParams, Rebuilt};
use lightbvh::node::Holds;
use lightbvh::{
    Bvh, CompactNode, Eq4, FullNode, INVALID, ImportanceModel, InstanceId, LightNode, MomentNode, Moments,
};

use self::model::Model;
use crate::{Forms, input};

/// Most rebuilds that are under way at once.
const FLYING: usize = 2;

/// A scene whose meshes and instances come, move, shine, bend and go, in batches that may hold refused edits, while trees are
/// built anew: a refused batch changes nothing and names an edit that is wrong; a frame's work keeps its bound; after every
/// frame the scene is valid and its lights are where the edits put them; in the end a scene built from scratch holds the same.
pub fn edits(data: &[u8], forms: Forms) {
    for form in forms.of(data, 4) {
        let u = &mut Unstructured::new(data);
        let _ = match form {
            0 => frames::<CompactNode<4>, Eq4, 4>(u, forms),
            1 => frames::<CompactNode<2>, Eq4, 2>(u, forms),
            2 => frames::<FullNode<4>, Eq4, 4>(u, forms),
            _ => frames::<MomentNode<8>, Moments, 8>(u, forms),
        };
    }
}

/// A rebuild under way: not begun, or waiting to be swapped in.
enum Flying<N: Holds, const W: usize> {
    Planned(Rebuild<N, W>),
    Built(Rebuilt<N, W>),
}

fn frames<N: LightNode<W> + std::fmt::Debug, I: ImportanceModel<N, W>, const W: usize>(
    u: &mut Unstructured<'_>,
    forms: Forms,
) -> Result<()> {
    let mut scene = Bvh::<N, (), W>::new(input::params(u)?);
    let mut model = Model::default();
    let mut flying: Vec<Flying<N, W>> = Vec::new();
    let count = 1 + u.arbitrary::<u8>()? % 6;
    for frame in 0..count {
        let bits: u8 = u.arbitrary()?;
        let is_still = bits & 5 == 0 || flying.is_empty();
        if bits & 1 != 0 {
            land(&mut scene, &mut flying, bits & 2 != 0);
        }
        // Comparing all that a scene is takes its time.
        let thorough = forms == Forms::All || bits & 0xf0 == 0;
        let depth = scene.depth();
        let touched = batch::edit(u, &mut model, &mut scene, frame == 0, thorough)?;
        if bits & 4 != 0 {
            land(&mut scene, &mut flying, bits & 2 != 0);
        }
        scene.refit();
        check(&model, &scene);
        if is_still && frame > 0 {
            work::check(scene.work(), &touched, depth.max(scene.depth()));
        }
        if bits & 8 != 0 && flying.len() < FLYING {
            let bits: u8 = u.arbitrary()?;
            let params = RebuildParams {
                top: if bits & 3 != 0 { 1.0 } else { f64::INFINITY },
                drift: [1.0001, 1.5, 0.0, f64::INFINITY][usize::from(bits >> 2 & 3)],
            };
            let rebuild = scene.rebuild(&params);
            flying.push(if bits & 16 == 0 {
                Flying::Built(rebuild.run())
            } else {
                Flying::Planned(rebuild)
            });
        }
    }
    while !flying.is_empty() {
        land(&mut scene, &mut flying, false);
    }
    scene.refit();
    check(&model, &scene);
    sampled::<N, I, W>(u, &model, &scene)?;

    let (scratch, ids) = model.from_scratch::<N, W>();
    let mut anew = model.clone();
    anew.renamed(&ids, &scratch);
    check(&anew, &scratch);
    assert_eq!(scene.light_count(), scratch.light_count());
    sampled::<N, I, W>(u, &anew, &scratch)
}

/// Swaps in the first rebuild, or the last.
fn land<N: LightNode<W>, const W: usize>(
    scene: &mut Bvh<N, (), W>,
    flying: &mut Vec<Flying<N, W>>,
    last: bool,
) {
    if flying.is_empty() {
        return;
    }
    match flying.remove(if last { flying.len() - 1 } else { 0 }) {
        Flying::Planned(rebuild) => scene.install(rebuild.run()).expect("its own"),
        Flying::Built(rebuilt) => scene.install(rebuilt).expect("its own"),
    }
}

/// Every invariant, and every light against the model.
fn check<N: LightNode<W>, const W: usize>(model: &Model, scene: &Bvh<N, (), W>) {
    let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
    assert_eq!(stats.instances as usize, model.instances.len());
    assert_eq!(stats.lights as usize, scene.light_count());
    assert!(stats.depth <= scene.depth());
    model.check_lights(scene);
}

/// Every light that shines in its mesh and is not turned off has a probability, under any map and at any point; they sum to one,
/// and samples come with them.
fn sampled<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    u: &mut Unstructured<'_>,
    model: &Model,
    scene: &Bvh<N, (), W>,
) -> Result<()> {
    let mut world = scene.world_lights();
    if world.is_empty() {
        world.push(lightbvh::EmissiveTriangle {
            p: [[0.0; 3]; 3],
            radiance: [0.0; 3],
            mesh: INVALID,
            flags: 0,
        });
    }
    let point = input::point(u, &world)?;
    let random: u32 = u.arbitrary()?;
    let mut pmfs = vec![0f32; scene.light_end() as usize];
    let mut any = false;
    for instance in &model.instances {
        for (light, local) in instance.lights.clone().zip(model.triangles(instance.mesh)) {
            let pmf = scene.by::<I>().pmf(&point, light, instance.id.index());
            let shines = instance.radiance > 0.0 && input::shines::<N, W>(local);
            assert_eq!(pmf > 0.0, shines, "light {light} at {point:?}");
            any |= shines;
            pmfs[light as usize] = pmf;
        }
    }
    for &gone in &model.gone_instances {
        assert_eq!(scene.lights_of(gone), None);
        assert_ne!(scene.instance_id(gone.index()), Some(gone));
    }
    if any {
        input::sum_is_one(&pmfs, 0);
    }
    for i in 0..4_u32 {
        let sampled = scene
            .by::<I>()
            .sample(&point, random.wrapping_add(i.wrapping_mul(0x9e37_79b9)));
        if any {
            assert_ne!(sampled.light, INVALID, "{point:?}");
            assert_eq!(
                sampled.pmf.to_bits(),
                pmfs[sampled.light as usize].to_bits(),
                "{point:?}"
            );
        } else {
            assert_eq!(sampled.light, INVALID, "{point:?}");
        }
    }
    Ok(())
}

/// Ids of instances, for the model.
type Ids = Vec<InstanceId>;
