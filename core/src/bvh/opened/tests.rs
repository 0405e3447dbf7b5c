//! What opened meshes leave as it is: names, numbers, probabilities; and when meshes are opened.

extern crate std;

use crate::node::{LightNode, Node};
use std::vec::Vec;

use super::*;
use crate::bvh::{InstanceId, MeshId, RebuildParams};
use crate::exact::hash;
use crate::kit::Random;
use crate::{
    BuildParams, CompactNode, Edit, EmissiveTriangle, Eq4, ImportanceModel, LightBvh, MomentNode, Moments,
    ShadingPoint, Transform,
};

mod decided;

/// `count` small lamps on a circle.
fn ring(count: u32, radius: f32, shift: f32) -> Vec<EmissiveTriangle> {
    let at = |k: u32| {
        let t = (k as f32 + shift) / count as f32;
        // Round enough: a square's corners cut.
        let tent = |t: f32| 4.0 * (crate::exact::abs(t - (t + 0.5) as u32 as f32) - 0.25);
        [radius * tent(t), 0.0, radius * tent(t + 0.25)]
    };
    (0..count)
        .map(|k| {
            let p = at(k);
            EmissiveTriangle {
                p: [p, [p[0] + 0.1, p[1], p[2]], [p[0], p[1], p[2] + 0.1]],
                radiance: [1.0 + (k % 5) as f32; 3],
                mesh: 0,
                flags: 0,
            }
        })
        .collect()
}

fn below(random: &mut Random, count: u32) -> u32 {
    random.0 = random.0.wrapping_add(1);
    hash(random.0) % count
}

fn place(random: &mut Random) -> Transform {
    Transform::at((random.vector() * 3.0).to_array())
}

/// Rings within each other and lamps among them, refitted.
fn rides<N: LightNode<W>, I, const W: usize>(
    random: &mut Random,
) -> (Bvh<N, I, W>, Vec<MeshId>, Vec<InstanceId>) {
    let mut bvh = Bvh::default();
    let mut meshes = Vec::new();
    for (count, radius) in [(300, 5.0), (200, 4.0), (90, 2.0), (1, 0.1), (20, 0.1)] {
        meshes.push(bvh.add_mesh(ring(count, radius, 0.0)).expect("a mesh"));
    }
    let add = (0..40).map(|k| Edit::AddInstance {
        mesh: meshes[if k < 6 { k % 3 } else { 3 + k % 2 }],
        transform: place(random),
        radiance: 1.0,
    });
    let ids = bvh.apply(add.collect()).expect("instances").instances;
    bvh.refit();
    (bvh, meshes, ids)
}

fn opened<N: LightNode<W>, I, const W: usize>(bvh: &Bvh<N, I, W>) -> usize {
    bvh.placed
        .iter()
        .filter(|placed| placed.live && !placed.parts.is_empty())
        .count()
}

/// Probabilities of all lights sum to one, samples have theirs, and no part is ever named.
#[track_caller]
fn is_exact<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, I, W>,
    random: &mut Random,
) {
    bvh.validate().unwrap_or_else(|violation| panic!("{violation}"));
    let mut n = random.vector();
    n *= crate::exact::rsqrt(crate::exact::max(crate::vector::length_squared(n), 1e-6));
    let point = ShadingPoint {
        p: (random.vector() * 6.0).to_array(),
        n: n.to_array(),
    };
    let mut sum = 0.0;
    for (index, placed) in (0..).zip(&bvh.placed) {
        if placed.live {
            let id = bvh.instance_id(index).expect("in use");
            for light in bvh.lights_of(id).expect("in use") {
                sum += f64::from(bvh.pmf(&point, light, index));
            }
        } else {
            // A part, or a place not in use.
            assert!(bvh.instance_id(index).is_none());
            assert_eq!(bvh.pmf(&point, bvh.instances[index as usize].first, index), 0.0);
            let light = bvh
                .tree()
                .triangle(&bvh.triangles, bvh.instances[index as usize].first, index);
            assert_eq!(light.radiance, [0.0; 3]);
        }
    }
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    let numbers = (0..32).map(|k| hash(k + below(random, 1 << 30)));
    for number in numbers {
        let sampled = bvh.sample(&point, number);
        let pmf = bvh.pmf(&point, sampled.light, sampled.instance);
        assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
        let id = bvh.instance_id(sampled.instance).expect("an instance");
        assert!(bvh.lights_of(id).expect("in use").contains(&sampled.light));
    }
    let many = bvh.sample_many::<16>(&point, hash(7));
    for sampled in many {
        let pmf = bvh.pmf(&point, sampled.light, sampled.instance);
        assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
    }
}

fn whatever_changes<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(seed: u32) {
    let random = &mut Random(seed);
    let (mut bvh, meshes, mut ids) = rides::<N, I, W>(random);
    assert!((6..20).contains(&opened(&bvh)), "{}", opened(&bvh));
    is_exact(&bvh, random);
    let mut rebuilds = Vec::new();
    for round in 0..120 {
        let at = below(random, ids.len() as u32) as usize;
        match below(random, 8) {
            0 => bvh.set_transform(ids[at], place(random)).expect("there"),
            1 => bvh.remove_instance(ids.swap_remove(at)).expect("there"),
            2 => {
                let mesh = meshes[below(random, 5) as usize];
                ids.push(bvh.add_instance(mesh, place(random)).expect("one more"));
            }
            3 => bvh
                .set_radiance(ids[at], [0.0, 0.1, 1.0, 3.0][below(random, 4) as usize])
                .expect("there"),
            4 => bvh
                .set_triangles(meshes[0], ring(300, 1.0 + random.unit() * 5.0, random.unit()))
                .expect("as many"),
            5 => rebuilds.push(bvh.rebuild(&RebuildParams { top: 1.0, drift: 1.0 })),
            6 if !rebuilds.is_empty() => {
                let one = rebuilds.swap_remove(below(random, rebuilds.len() as u32) as usize);
                bvh.install(one.run()).expect("its own");
            }
            _ => {
                let mesh = bvh
                    .add_mesh(ring(40 + below(random, 200), 2.0, 0.0))
                    .expect("a mesh");
                ids.push(bvh.add_instance(mesh, place(random)).expect("one more"));
            }
        }
        if round % 5 == 0 {
            bvh.refit();
            is_exact(&bvh, random);
            let again = Bvh::<N, I, W>::from_words(&bvh.to_words()).unwrap_or_else(|error| panic!("{error}"));
            again.validate().expect("valid");
            assert!(again.to_words() == bvh.to_words());
            assert_eq!(opened(&again), opened(&bvh));
        }
    }
    for id in ids {
        bvh.remove_instance(id).expect("there");
    }
    bvh.refit();
    bvh.validate().expect("valid");
    assert_eq!(opened(&bvh), 0);
    assert!(
        bvh.blases
            .iter()
            .all(|blas| blas.parts.is_empty() && blas.opened == 0)
    );
}

#[test]
fn opened_meshes_stay_exact_whatever_changes() {
    for seed in 0..3 {
        whatever_changes::<MomentNode<8>, Moments, 8>(seed);
        whatever_changes::<MomentNode<8>, crate::importance::DefaultImportance, 8>(seed);
        whatever_changes::<CompactNode<4>, Eq4, 4>(seed);
    }
}

/// The first light of each slot below the root: that of the part in the slot, wherever its leaf is.
#[test]
fn parts_are_those_of_the_root() {
    let (bvh, ..) = rides::<MomentNode<8>, Moments, 8>(&mut Random(5));
    let mut seen = 0;
    for (index, placed) in (0..)
        .zip(&bvh.placed)
        .filter(|(_, placed)| placed.live && !placed.parts.is_empty())
    {
        let blas = bvh.blas_of(placed);
        let root = &bvh.nodes[blas.nodes.start as usize];
        assert_eq!(placed.parts.len(), blas.parts.len());
        for (slot, part) in placed.parts.clone().enumerate() {
            let record = &bvh.instances[part as usize];
            assert_eq!(
                (record.root, record.part, record.count),
                (root.link(slot), index, 0)
            );
            assert_eq!(record.columns, bvh.instances[index as usize].columns);
            seen += 1;
        }
    }
    assert!(seen >= 12, "{seen}");
}

/// Not opened: lights of the paper's trees, one mesh alone, what is small against the whole.
#[test]
fn what_is_small_stays_whole() {
    let add = |bvh: &mut LightBvh, count: u32, apart: f32| {
        let mesh = bvh.add_mesh(ring(300, 1.0, 0.0)).expect("a mesh");
        let all = (0..count).map(|k| Edit::AddInstance {
            mesh,
            transform: Transform::at([(k % 8) as f32 * apart, 0.0, (k / 8) as f32 * apart]),
            radiance: 1.0,
        });
        bvh.apply(all.collect()).expect("instances");
        bvh.refit();
        opened(bvh)
    };
    assert_eq!(add(&mut LightBvh::default(), 64, 1.0), 64);
    assert_eq!(add(&mut LightBvh::default(), 64, 100.0), 0);
    assert_eq!(add(&mut LightBvh::default(), 1, 1.0), 0);
    let whole = BuildParams {
        opens: false,
        ..BuildParams::default()
    };
    assert_eq!(add(&mut LightBvh::new(whole), 64, 1.0), 0);
    assert_eq!(
        add(
            &mut LightBvh::new(BuildParams::paper(crate::Heuristic::Saoh)),
            64,
            1.0
        ),
        0
    );
}

/// A mesh that grows is opened by a rebuild of the top level, and closed only once it is well below what opens it.
#[test]
fn what_grows_is_opened_and_not_closed_at_once() {
    let mut bvh = LightBvh::default();
    let small = bvh.add_mesh(ring(8, 0.1, 0.0)).expect("a mesh");
    let large = bvh.add_mesh(ring(300, 1.0, 0.0)).expect("a mesh");
    let all = (0..64).map(|k| Edit::AddInstance {
        mesh: small,
        transform: Transform::at([(k % 8) as f32 * 10.0, 0.0, (k / 8) as f32 * 10.0]),
        radiance: 100.0,
    });
    bvh.apply(all.collect()).expect("instances");
    let one = bvh
        .add_instance(large, Transform::at([30.0; 3]))
        .expect("one more");
    let mut frame = |scale: f32| {
        let mut transform = Transform::at([30.0; 3]);
        for k in 0..3 {
            transform.columns[k][k] = scale;
        }
        bvh.set_transform(one, transform).expect("there");
        bvh.refit();
        let rebuilt = bvh.rebuild(&RebuildParams::eager()).run();
        bvh.install(rebuilt).expect("its own");
        bvh.refit();
        bvh.validate().expect("valid");
        opened(&bvh)
    };
    // Costs grow by the fourth power: flux by area, times variance of position.
    let mut scale = 0.1;
    while frame(scale) == 0 {
        scale *= 1.05;
        assert!(scale < 100.0, "never opened");
    }
    let opened_at = scale;
    while frame(scale) == 1 {
        scale *= 0.95;
    }
    let hysteresis = opened_at / scale;
    assert!(
        (1.3..1.7).contains(&hysteresis),
        "{hysteresis}, about the fourth root of 4"
    );
}

/// A file tells where the parts of an opened instance were when they were hung: edits after it is read do what they would have
/// done.
#[test]
fn opened_instances_that_moved_are_read_as_they_were() {
    let random = &mut Random(11);
    let (mut bvh, _, ids) = rides::<MomentNode<8>, Moments, 8>(random);
    let opened: Vec<u32> = ids.iter().map(|id| id.index()).collect();
    let opened: Vec<u32> = opened
        .into_iter()
        .filter(|&index| !bvh.placed[index as usize].parts.is_empty())
        .collect();
    assert!(!opened.is_empty());
    for step in [0.5, 40.0, 3.0] {
        let mut again = Bvh::<MomentNode<8>, Moments, 8>::from_words(&bvh.to_words()).expect("its own");
        assert!(again.to_words() == bvh.to_words(), "{step}");
        for bvh in [&mut bvh, &mut again] {
            for &index in &opened {
                let id = bvh.instance_id(index).expect("there");
                let mut to = bvh.placed[index as usize].transform;
                to.translation[0] += step;
                bvh.set_transform(id, to).expect("moved");
            }
            bvh.refit();
        }
        assert!(again.to_words() == bvh.to_words(), "{step}");
    }
}

/// Whatever became of an opened instance's radiance, it is as it was once that is sent again.
#[test]
fn the_radiance_of_an_opened_instance_sent_again_is_no_change() {
    let random = &mut Random(11);
    let (mut bvh, _, ids) = rides::<MomentNode<8>, Moments, 8>(random);
    let is_opened = |bvh: &Bvh<_, _, 8>, id: &InstanceId| !bvh.placed[id.index as usize].parts.is_empty();
    for radiance in [3.0, 1.0, 0.1, 0.0, 0.1, 20.0] {
        let some: Vec<InstanceId> = ids.iter().copied().filter(|id| is_opened(&bvh, id)).collect();
        assert!(!some.is_empty(), "{radiance}");
        for &id in &some {
            bvh.set_radiance(id, radiance).expect("there");
        }
        bvh.refit();
        let epoch = bvh.epoch;
        for &id in &some {
            bvh.set_radiance(id, radiance).expect("there");
        }
        assert!(bvh.epoch == epoch, "{radiance}");
    }
}

/// An instance that is opened among so few others that the top level is built anew, which closes it again: nothing is asked of
/// what it was.
#[test]
fn what_is_closed_as_it_is_opened_is_left_alone() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(ring(300, 5.0, 0.0)).expect("a mesh");
    let ids = [1.0, 1e-9].map(|radiance| {
        bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
        let id = bvh.instance_id(bvh.live.len() as u32 - 1).expect("there");
        bvh.set_radiance(id, radiance).expect("there");
        id
    });
    bvh.refit();
    let dim = ids[1].index();
    assert!(bvh.placed[dim as usize].parts.is_empty());
    bvh.reopen(&[dim], &[]);
    bvh.refit();
    bvh.validate().expect("valid");
    assert!(bvh.placed[dim as usize].parts.is_empty(), "closed again");
}
