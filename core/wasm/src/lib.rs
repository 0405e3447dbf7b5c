//! Builds, edits, refits, rebuilds, samples, writes and reads a light BVH; every frame gives one word of all that came out.

use lightbvh::bvh::Swap;
use lightbvh::exact::{hash, unit_f32};
use lightbvh::tree::Model;
use lightbvh::{
    Bvh, CompactNode, Edit, EmissiveTriangle, Eq4, ImportanceModel, MomentNode, Moments, Rebuilder,
    RebuilderParams, ShadingPoint, Transform,
};

/// Number of frames.
pub const FRAMES: u32 = 40;

/// The digest of the first `frames` frames with the default layout.
#[unsafe(no_mangle)]
pub extern "C" fn moments(frames: u32) -> u32 {
    run::<(MomentNode<8>, Moments), 8>(frames)
}

/// The same with the paper's.
#[unsafe(no_mangle)]
pub extern "C" fn eq4(frames: u32) -> u32 {
    run::<(CompactNode<4>, Eq4), 4>(frames)
}

struct Random(u32);

impl Random {
    fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        hash(self.0)
    }

    fn vector(&mut self, reach: f32) -> [f32; 3] {
        [(); 3].map(|()| (2.0 * unit_f32(self.bits()) - 1.0) * reach)
    }
}

fn run<M: Model<W, Light = EmissiveTriangle>, const W: usize>(frames: u32) -> u32
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    let random = &mut Random(1);
    let mut digest = 0;
    let mut bvh = Bvh::<M, W>::default();
    let mut rebuilder = Rebuilder::<M, W>::new(RebuilderParams {
        after: 2,
        swap: Swap::Deterministic,
        idle: 0.0,
        ..RebuilderParams::default()
    });
    for frame in 0..frames {
        let start = rebuilder.begin_frame(&mut bvh).expect("its own");
        let is_swapped = start.swapped || start.meshes > 0;
        assert_eq!(is_swapped, frame >= 2 && frame % 2 == 0);
        let mesh = bvh.add_mesh(triangles(random, 1 + frame)).expect("in the domain");
        for _ in 0..3 {
            let transform = Transform::at(random.vector(9.0));
            bvh.add_instance(mesh, transform).expect("in the domain");
        }
        let index = random.bits() % bvh.view().instances().len() as u32;
        if let Some(instance) = bvh.view().instance_id(index) {
            let mut transform = Transform::at(random.vector(9.0));
            transform.columns[0] = random.vector(1.0);
            let edit = Edit::SetTransform { instance, transform };
            bvh.apply(vec![edit]).expect("in the domain");
            if frame % 5 == 0 {
                bvh.remove(instance).expect("it is there");
            }
        }
        if let Some(mesh) = bvh.view().mesh_id(frame / 2) {
            let bent = triangles(random, 1 + frame / 2);
            bvh.apply(vec![Edit::SetLights { mesh, lights: bent }]).expect("as many");
        }
        bvh.refit();
        rebuilder.end_frame(&bvh);
        digest = queries(&bvh, random, digest);
    }
    let words = bvh.to_words();
    digest = words.iter().fold(digest, |all, &word| hash(all ^ word));
    let again = Bvh::<M, W>::from_words(&words).expect("the words just written");
    queries(&again, random, digest)
}

fn triangles(random: &mut Random, count: u32) -> Vec<EmissiveTriangle> {
    let triangle = |_| {
        let at = random.vector(1.0);
        let mut corner = || {
            let by = random.vector(0.3);
            [at[0] + by[0], at[1] + by[1], at[2] + by[2]]
        };
        EmissiveTriangle {
            p: [at, corner(), corner()],
            radiance: [1.0 + unit_f32(random.bits()); 3],
            mesh: 0,
            flags: random.bits() & 1,
        }
    };
    (0..count).map(triangle).collect()
}

/// Samples, with their pmfs.
fn queries<M: Model<W, Light = EmissiveTriangle>, const W: usize>(
    bvh: &Bvh<M, W>,
    random: &mut Random,
    mut digest: u32,
) -> u32
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    for _ in 0..100 {
        let point = ShadingPoint {
            p: random.vector(10.0),
            n: [0.0, 1.0, 0.0],
        };
        let sampled = bvh.tree().sample(&point, random.bits());
        let pmf = bvh.tree().pmf(&point, sampled.light, sampled.instance);
        for word in [sampled.light, sampled.instance, sampled.pmf.to_bits(), pmf.to_bits()] {
            digest = hash(digest ^ word);
        }
    }
    digest
}
