//! A mirror that knows the lists of plans alone holds what a refit leaves, whatever came between.

extern crate std;

use std::vec::Vec;

use crate::bvh::stage::{Builder, MeshJob, MeshTree, StageId};
use crate::bvh::{Rebuild, RebuildParams, RefitPlan};
use crate::exact::{hash, pow2};
use crate::node::Holds;
use crate::refit::{self, BlasRoot, Instance};
use crate::{Bvh, CompactNode, Edit, EmissiveTriangle, Eq4, LightNode, MomentNode, Moments, Transform};

struct Random(u32);

impl Random {
    fn below(&mut self, count: u32) -> u32 {
        self.0 = self.0.wrapping_add(1);
        hash(self.0) % count
    }

    fn coordinate(&mut self) -> f32 {
        self.below(1000) as f32 * 0.05
    }
}

/// The arrays of a device.
struct Mirror<N, const W: usize> {
    nodes: Vec<N>,
    triangles: Vec<EmissiveTriangle>,
    trails: Vec<u32>,
    instances: Vec<Instance>,
    roots: Vec<BlasRoot>,
}

fn copy<T: Copy>(to: &mut Vec<T>, from: &[T], ranges: &[core::ops::Range<u32>], words: usize) {
    // What is not copied is anything.
    if let Some(&any) = from.first() {
        to.resize(from.len(), any);
    }
    for range in ranges {
        let own = range.start as usize * words..range.end as usize * words;
        to[own.clone()].copy_from_slice(&from[own]);
    }
}

impl<N: LightNode<W>, const W: usize> Mirror<N, W> {
    fn empty() -> Self {
        Self {
            nodes: Vec::new(),
            triangles: Vec::new(),
            trails: Vec::new(),
            instances: Vec::new(),
            roots: Vec::new(),
        }
    }

    fn follow<I>(&mut self, bvh: &Bvh<N, I, W>, plan: &RefitPlan) {
        copy(&mut self.nodes, bvh.nodes(), &plan.written_nodes, 1);
        copy(&mut self.triangles, bvh.triangles(), &plan.written_triangles, 1);
        copy(
            &mut self.trails,
            bvh.tree().trails,
            &plan.written_trails,
            bvh.tree().trail_words as usize,
        );
        copy(&mut self.instances, bvh.instances(), &plan.written_instances, 1);
        copy(&mut self.roots, bvh.roots(), &[], 1);
        for range in plan.bottom.ranges() {
            for &node in &plan.bottom.nodes()[range] {
                self.nodes[node as usize] = refit::bottom(&self.nodes, &self.triangles, node);
            }
        }
        for &root in &plan.roots {
            let node = bvh.roots()[root as usize].node;
            self.roots[root as usize] = refit::root(&self.nodes, node);
        }
        for range in plan.top.ranges() {
            for &node in &plan.top.nodes()[range] {
                self.nodes[node as usize] = refit::top(&self.nodes, &self.instances, &self.roots, node);
            }
        }
    }

    #[track_caller]
    fn assert_is<I: Clone>(&self, bvh: &Bvh<N, I, W>) {
        let mut twin = bvh.clone();
        twin.refit();
        twin.validate().expect("valid");
        let used = twin.plan_of_everything();
        for list in [used.bottom.nodes(), used.top.nodes()] {
            for &node in list {
                let nodes = [&self.nodes[node as usize], &twin.nodes()[node as usize]];
                assert!(
                    bytemuck::bytes_of(nodes[0]) == bytemuck::bytes_of(nodes[1]),
                    "node {node}"
                );
            }
        }
        // What is in use; a piece that no tree has yet may be anything.
        for used in twin.blases.iter().map(|blas| &blas.triangles) {
            let own = used.start as usize..used.end as usize;
            assert!(
                bytemuck::cast_slice::<_, u32>(&self.triangles[own.clone()])
                    == bytemuck::cast_slice::<_, u32>(&twin.triangles()[own.clone()])
            );
            let words = twin.trail_words as usize;
            let own = own.start * words..own.end * words;
            assert!(self.trails[own.clone()] == twin.trails[own]);
        }
        assert!(self.instances == twin.instances());
    }
}

/// Triangles of about the same size, or in the distances of a tree too deep for one word of a trail.
fn triangles(random: &mut Random, count: u32, deep: bool) -> Vec<EmissiveTriangle> {
    let one = |k: u32| {
        let size = if deep { pow2(k as i32 - 58) } else { 0.5 };
        let x = if deep { size } else { random.coordinate() };
        let y = if deep { 0.0 } else { random.coordinate() };
        EmissiveTriangle {
            p: [[x, y, 0.0], [x + 0.01 * size, y, 0.0], [x, y, 0.01 * size]],
            radiance: [1.0 + random.below(3) as f32; 3],
            mesh: 0,
            flags: 0,
        }
    };
    (0..count).map(one).collect()
}

fn edits<N: LightNode<W>, I, const W: usize>(bvh: &mut Bvh<N, I, W>, random: &mut Random) {
    let some = |bvh: &Bvh<N, I, W>, random: &mut Random| {
        let index = random.below(bvh.instances().len().max(1) as u32);
        bvh.instance_id(index)
    };
    let place =
        |random: &mut Random| Transform::at([random.coordinate(), random.coordinate(), random.coordinate()]);
    let mesh = bvh.mesh_id(random.below(12));
    // What it refuses, it leaves as it was.
    let _ = match random.below(13) {
        0 => {
            let deep = random.below(8) == 0;
            let count = if deep { 96 } else { 1 + random.below(40) };
            let triangles = triangles(random, count, deep);
            bvh.add_mesh(triangles).map(|_| ())
        }
        1..4 => {
            let adds = (0..1 + random.below(9)).filter_map(|_| {
                Some(Edit::AddInstance {
                    mesh: mesh?,
                    transform: place(random),
                    radiance: 1.0,
                })
            });
            let adds = adds.collect();
            bvh.apply(adds).map(|_| ()).map_err(|error| error.reason)
        }
        4..7 => some(bvh, random).map_or(Ok(()), |id| bvh.set_transform(id, place(random))),
        7 => some(bvh, random).map_or(Ok(()), |id| bvh.set_radiance(id, random.below(3) as f32)),
        8 => mesh.map_or(Ok(()), |mesh| {
            let count = bvh.mesh_len(mesh) as u32;
            bvh.set_triangles(mesh, triangles(random, count, false))
        }),
        12 => mesh.map_or(Ok(()), |mesh| {
            // At times all of them, at times beyond the end.
            let first = random.below(bvh.mesh_len(mesh) as u32);
            let count = random.below(4);
            bvh.set_triangle_range(mesh, first, triangles(random, count, false))
        }),
        9 => mesh.map_or(Ok(()), |mesh| bvh.remove_mesh(mesh)),
        _ => (0..random.below(6))
            .try_for_each(|_| some(bvh, random).map_or(Ok(()), |id| bvh.remove_instance(id))),
    };
}

/// How far a tree that is put in place piece by piece is.
enum Stage<N: Holds> {
    Copied(StageId, MeshJob<N>),
    Placed(StageId, MeshTree<N>),
    Settled(StageId),
    CopiedPart(StageId, MeshJob<N>),
    PlacedPart(StageId, MeshTree<N>),
}

/// Brings it on by a few nodes or triangles; `None` where it is over.
fn brought_on<N: LightNode<W>, I, const W: usize>(
    bvh: &mut Bvh<N, I, W>,
    stage: Stage<N>,
    random: &mut Random,
    parts: &mut usize,
) -> Option<Stage<N>> {
    let bytes = &mut (random.below(20_000) as usize);
    Some(match stage {
        Stage::Copied(id, mut job) => match bvh.copy_stage(id, &mut job, bytes)? {
            true => Stage::Placed(id, job.run::<W>()),
            false => Stage::Copied(id, job),
        },
        Stage::Placed(id, mut tree) => match bvh.place_stage(id, &mut tree, bytes)? {
            true => Stage::Settled(id),
            false => Stage::Placed(id, tree),
        },
        Stage::Settled(id) => match bvh.settle_stage(id, bytes)? {
            true => return None,
            false => Stage::Settled(id),
        },
        Stage::CopiedPart(id, mut job) => match bvh.copy_stage(id, &mut job, bytes)? {
            true => Stage::PlacedPart(id, job.run::<W>()),
            false => Stage::CopiedPart(id, job),
        },
        Stage::PlacedPart(id, mut tree) => match bvh.settle_part(id, &mut tree, bytes)? {
            true => {
                *parts += 1;
                return None;
            }
            false => Stage::PlacedPart(id, tree),
        },
    })
}

/// Returns how many trees came in piece by piece, how many parts of trees, and how many meshes were handed over at a time.
fn random_frames<N: LightNode<W>, I: Clone, const W: usize>(seed: u32, refits: u32) -> [usize; 3] {
    let random = &mut Random(seed << 16);
    let mut bvh = Bvh::<N, I, W>::default();
    let mut mirror = Mirror::<N, W>::empty();
    let mut built: Vec<Rebuild<N, W>> = Vec::new();
    let mut stages: Vec<Stage<N>> = Vec::new();
    let builder = Builder::default();
    let mut parts = 0;
    bvh.plan();
    mirror.follow(&bvh, &plan_of_all(&bvh));
    if seed % 4 == 0 {
        // Too many instances for a new tree to be handed over at once.
        let mesh = bvh.add_mesh(triangles(random, 30, false)).expect("a mesh");
        let add = |k: u32| Edit::AddInstance {
            mesh,
            transform: Transform::at([k as f32, (k % 17) as f32, (k % 5) as f32]),
            radiance: 1.0,
        };
        bvh.apply((0..700).map(add).collect()).expect("instances");
    }
    let mut handed = 0;
    for _ in 0..400 {
        handed = handed.max(bvh.handing_over());
        for stage in core::mem::take(&mut stages) {
            stages.extend(brought_on(&mut bvh, stage, random, &mut parts));
        }
        if random.below(6) == 0 {
            let begun = bvh.begin_stage(random.below(12), &builder);
            stages.extend(begun.map(|(id, job)| Stage::Copied(id, job)));
        }
        if random.below(3) == 0 {
            let worn = RebuildParams {
                drift: 1.0,
                ..RebuildParams::default()
            };
            let begun = bvh.begin_part(random.below(12), &builder, &worn, 1 << 20);
            stages.extend(begun.map(|(id, job)| Stage::CopiedPart(id, job)));
        }
        bvh.hand_over_some(random.below(40) as usize);
        match random.below(10) {
            0 => built.push(bvh.rebuild(&RebuildParams {
                top: if random.below(3) > 0 { 1.0 } else { f64::INFINITY },
                drift: 1.1,
            })),
            1 if !built.is_empty() => {
                let one = built.swap_remove(random.below(built.len() as u32) as usize);
                bvh.install(one.run()).expect("its own");
            }
            2 if random.below(4) < refits => bvh.refit(),
            3 | 4 => {
                let plan = bvh.plan().clone();
                mirror.follow(&bvh, &plan);
                mirror.assert_is(&bvh);
            }
            _ => edits(&mut bvh, random),
        }
    }
    bvh.refit();
    bvh.validate().expect("valid");
    let adopted = bvh.blases.iter().filter(|blas| blas.adopted > 0).count();
    [adopted, parts, handed]
}

/// As a mirror begins: by all that there is.
fn plan_of_all<N: LightNode<W>, I, const W: usize>(bvh: &Bvh<N, I, W>) -> RefitPlan {
    let all = |length: usize| std::vec![0..length as u32];
    RefitPlan {
        written_nodes: all(bvh.nodes().len()),
        written_triangles: all(bvh.triangles().len()),
        written_instances: all(bvh.instances().len()),
        ..bvh.plan_of_everything()
    }
}

/// A device that alone refits, one beside the CPU, and one that is asked now and then.
#[test]
fn a_mirror_follows_whatever_comes_between_plans() {
    let mut adopted = [0; 3];
    let mut count = |more: [usize; 3]| (0..3).for_each(|k| adopted[k] += more[k]);
    for seed in 0..12 {
        for refits in [0, 1, 4] {
            count(random_frames::<MomentNode<8>, Moments, 8>(3 * seed, refits));
            count(random_frames::<CompactNode<4>, Eq4, 4>(3 * seed + 1, refits));
        }
    }
    assert!(
        adopted[0] > 100 && adopted[1] > 40 && adopted[2] > 6,
        "{adopted:?}"
    );
}
