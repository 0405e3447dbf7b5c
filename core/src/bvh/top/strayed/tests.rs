//! Meshes that go elsewhere in pieces.

extern crate std;

use std::vec::Vec;

use super::looked::{FARTHER, Guard};
use super::{FEW, Looked, distance};
use crate::bvh::{RebuildParams, RebuilderParams, Swap};
use crate::kit::{Random, cross, dot, minus};
use crate::node::{Node, kind};
use crate::rebuilder::Rebuilder;
use crate::summary::Summary;
use crate::{Edit, EmissiveTriangle, InstanceId, LightBvh, MeshId, MomentNode, ShadingPoint, Transform};

mod batches;
mod blinks;
mod dark;
mod elsewhere;
mod fades;
mod files;
mod paths;

type Own = Rebuilder<MomentNode<8>, 8>;

/// Frames after which nothing is looked at any more.
const REST: u32 = 200;

/// Small lights of a cloud about `at`, shining to both sides, every `dark`th one off.
fn cloud(count: u32, at: [f32; 3], dark: u32) -> Vec<EmissiveTriangle> {
    let random = &mut Random(3);
    let lamp = |k: u32| {
        let [x, y, z] = (random.vector() + glam::Vec3::from(at)).to_array();
        let is_dark = dark > 0 && k % dark == 0;
        EmissiveTriangle {
            p: [[x, y, z], [x + 0.1, y, z], [x, y, z + 0.1]],
            radiance: [if is_dark { 0.0 } else { 1.0 }; 3],
            mesh: 0,
            flags: EmissiveTriangle::TWO_SIDED,
        }
    };
    (0..count).map(lamp).collect()
}

/// Eight lights of one radiance about a place.
fn eight(at: [f32; 3], radiance: f32) -> Vec<EmissiveTriangle> {
    let mut all = cloud(8, at, 0);
    all.iter_mut().for_each(|light| light.radiance = [radiance; 3]);
    all
}

/// All triangles of a mesh in two ranges: neither is the mesh as a whole.
fn halves(mesh: MeshId, all: &[EmissiveTriangle]) -> [Edit; 2] {
    let half = all.len() / 2;
    [0, half].map(|first| Edit::SetTriangleRange {
        mesh,
        first: first as u32,
        triangles: all[first..first + half].to_vec(),
    })
}

fn place(instance: InstanceId, at: [f32; 3]) -> Edit {
    Edit::SetTransform {
        instance,
        transform: Transform::at(at),
    }
}

fn shine(instance: InstanceId, radiance: f32) -> Edit {
    Edit::SetRadiance { instance, radiance }
}

/// A mesh of `count` lights at one corner of 500 lamps.
fn scene(count: u32) -> (LightBvh, MeshId) {
    let mut bvh = LightBvh::default();
    let random = &mut Random(11);
    let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
    let mesh = bvh.add_mesh(cloud(count, [-40.0; 3], 0)).expect("a mesh");
    let mut add: Vec<Edit> = (0..500)
        .map(|_| Edit::AddInstance {
            mesh: lamp,
            transform: Transform::at((random.vector() * 50.0).to_array()),
            radiance: 1.0,
        })
        .collect();
    add.push(Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    });
    bvh.apply(add).expect("instances");
    bvh.refit();
    (bvh, mesh)
}

fn rebuilder() -> Own {
    Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    })
}

fn frame(bvh: &mut LightBvh, own: &mut Own, edits: Vec<Edit>) {
    own.begin_frame(bvh).expect("no panic");
    bvh.apply(edits).expect("sound edits");
    bvh.refit();
    own.end_frame(bvh);
}

fn rest(bvh: &mut LightBvh, own: &mut Own) {
    (0..REST).for_each(|_| frame(bvh, own, Vec::new()));
    bvh.validate().expect("valid");
    assert!(bvh.top.strayed.is_empty());
}

/// Instances that were put in since an epoch.
fn put_since(bvh: &LightBvh, stamp: u64) -> usize {
    let placed = bvh.placed.iter();
    placed.filter(|placed| placed.live && placed.hung > stamp).count()
}

/// Instances of a mesh, of radiance 1.
fn put_in(bvh: &mut LightBvh, mesh: MeshId, at: &[[f32; 3]]) -> Vec<InstanceId> {
    let add = at.iter().map(|&at| Edit::AddInstance {
        mesh,
        transform: Transform::at(at),
        radiance: 1.0,
    });
    let ids = bvh.apply(add.collect()).expect("instances").instances;
    bvh.refit();
    ids
}

fn walker(bvh: &mut LightBvh, mesh: MeshId, radiance: f32, at: [f32; 3]) -> InstanceId {
    let add = Edit::AddInstance {
        mesh,
        transform: Transform::at(at),
        radiance,
    };
    let id = bvh.apply([add].to_vec()).expect("an instance").instances[0];
    bvh.refit();
    id
}

/// The second moment of a sample at points around `at`, over that of a new light BVH of the same lights: the geometric mean.
fn over_new(bvh: &LightBvh, at: [f32; 3]) -> f64 {
    let mut new = LightBvh::default();
    let mut meshes = std::collections::BTreeMap::new();
    let ids: Vec<_> = (0..bvh.instances().len() as u32)
        .filter_map(|k| bvh.instance_id(k))
        .collect();
    let mut add = Vec::new();
    for &id in &ids {
        let mesh = bvh.mesh_of(id).expect("there");
        let own = *meshes.entry(mesh).or_insert_with(|| {
            let own = bvh.mesh_triangles(mesh).expect("there").to_vec();
            new.add_mesh(own).expect("a mesh")
        });
        let record = &bvh.instances()[id.index() as usize];
        add.push(Edit::AddInstance {
            mesh: own,
            transform: Transform {
                columns: record.columns,
                translation: record.translation,
            },
            radiance: record.radiance,
        });
    }
    let others = new.apply(add).expect("instances").instances;
    new.refit();
    let moment = |bvh: &LightBvh, ids: &[InstanceId], p: [f32; 3]| {
        let point = ShadingPoint { p, n: [0.0; 3] };
        let mut sum = 0.0;
        for &id in ids {
            for light in bvh.lights_of(id).expect("there") {
                let own = bvh.triangle(light, id.index()).expect("there");
                let q = own.p.map(|v| v.map(f64::from));
                let n = cross(minus(q[1], q[0]), minus(q[2], q[0]));
                let away = minus(p.map(f64::from), q[0]);
                let squared = dot(away, away);
                let f = f64::from(own.radiance[0]) * dot(n, away).abs() / (squared * squared.sqrt());
                sum += f * f / f64::from(bvh.pmf(&point, light, id.index()));
            }
        }
        sum
    };
    let random = &mut Random(17);
    let mut logs = 0.0;
    for _ in 0..6 {
        let p = (random.vector() * 2.0 + glam::Vec3::from(at)).to_array();
        logs += (moment(bvh, &ids, p) / moment(&new, &others, p)).ln();
    }
    (logs / 6.0).exp()
}

/// In two ranges of one call, one light in each frame, or set as a whole where every second one is dark: beside it a sample is
/// as good as in a new tree, where it had 2 to 15 times the variance.
#[test]
fn what_goes_elsewhere_in_pieces_is_put_in_elsewhere() {
    let to = [35.0, 30.0, 20.0];
    for (count, calls, dark) in [(8, 8, 0), (40, 2, 0), (200, 1, 0), (200, 200, 0), (2048, 0, 2)] {
        let (mut bvh, mesh) = scene(count);
        let own = &mut rebuilder();
        let there = cloud(count, to, dark);
        let range = |first: u32, length: u32| Edit::SetTriangleRange {
            mesh,
            first,
            triangles: there[first as usize..(first + length) as usize].to_vec(),
        };
        match calls {
            0 => frame(
                &mut bvh,
                own,
                [Edit::SetTriangles {
                    mesh,
                    triangles: there.clone(),
                }]
                .to_vec(),
            ),
            1 => frame(
                &mut bvh,
                own,
                [range(0, count / 2), range(count / 2, count / 2)].to_vec(),
            ),
            _ => (0..calls)
                .for_each(|k| frame(&mut bvh, own, [range(k * count / calls, count / calls)].to_vec())),
        }
        (0..120).for_each(|_| frame(&mut bvh, own, Vec::new()));
        bvh.validate().expect("valid");
        let found = over_new(&bvh, to);
        assert!(found < 1.5, "{count} in {calls}: {found}");
        assert!(bvh.top.strayed.is_empty());
    }
}

/// A mesh that is dimmer than it was, and changes in every frame, may be as bright again in the next: it is put in elsewhere
/// once it rests.
#[test]
fn what_blinks_waits_until_it_rests() {
    let (mut bvh, mesh) = scene(8);
    // A tree that is built anew would have it where it belongs.
    let own = &mut Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..RebuildParams::default()
        },
        ..RebuilderParams::default()
    });
    let of = |at: [f32; 3], radiance: f32| halves(mesh, &eight(at, radiance));
    for radiance in [100.0, 1.0, 100.0] {
        frame(&mut bvh, own, of([-40.0; 3], radiance).to_vec());
    }
    let stamp = bvh.epoch;
    for k in 0..12_u16 {
        let at = [35.0, 30.0 + 0.1 * f32::from(k % 2), 20.0];
        frame(&mut bvh, own, of(at, 1.0).to_vec());
        assert!(bvh.placed[500].hung <= stamp, "{k}");
    }
    (0..4).for_each(|_| frame(&mut bvh, own, Vec::new()));
    assert!(bvh.placed[500].hung > stamp, "it rests");
}

/// A frame puts in a few, whatever there are; those of a mesh of many are left to parts that are built anew.
#[test]
fn each_frame_puts_in_a_few() {
    for (count, noted) in [(FEW as u32, FEW), (FEW as u32 + 1, 0)] {
        let (mut bvh, mesh) = scene(20);
        let random = &mut Random(2);
        let add = (1..count).map(|_| Edit::AddInstance {
            mesh,
            transform: Transform::at((random.vector() * 10.0).to_array()),
            radiance: 0.001,
        });
        bvh.apply(add.collect()).expect("instances");
        bvh.refit();
        let stirred = |bvh: &LightBvh| bvh.top.stirred.iter().sum::<u32>();
        let before = stirred(&bvh);
        let half = Edit::SetTriangleRange {
            mesh,
            first: 0,
            triangles: cloud(10, [70.0; 3], 0),
        };
        bvh.apply([half].to_vec()).expect("in the mesh");
        bvh.refit();
        assert_eq!(bvh.top.strayed.len(), noted);
        assert_eq!(stirred(&bvh) > before, noted == 0);
        let looked = &mut Looked::default();
        while !bvh.top.strayed.is_empty() {
            let (left, stamp) = (bvh.top.strayed.len(), bvh.epoch);
            bvh.put_strayed_elsewhere(2, looked);
            assert!(left - bvh.top.strayed.len() <= 16);
            let hung = put_since(&bvh, stamp);
            assert!(hung <= 2, "{hung}");
            bvh.refit();
        }
        bvh.validate().expect("valid");
    }
}

/// The parts of an opened one are put in elsewhere too.
#[test]
fn opened_ones_go_with_their_parts() {
    let (mut bvh, mesh) = scene(3000);
    assert!(bvh.of_mesh(1).opened == 1, "it outshines all");
    let parts = bvh.placed[500].parts.clone();
    bvh.set_triangles(mesh, cloud(3000, [40.0; 3], 0))
        .expect("as many");
    bvh.refit();
    assert!(bvh.top.strayed.contains(&500));
    let stamp = bvh.epoch;
    bvh.put_strayed_elsewhere(2, &mut Looked::default());
    assert!(parts.clone().all(|part| bvh.placed[part as usize].hung > stamp));
    bvh.refit();
    bvh.validate().expect("valid");
}

/// Lights that go out and come on again where they were did not go anywhere, and a mesh is known to be where it is before the
/// first refit.
#[test]
fn what_was_dark_for_a_while_did_not_stray() {
    let (mut bvh, mesh) = scene(20);
    let other = bvh.add_mesh(cloud(20, [10.0; 3], 0)).expect("a mesh");
    let known = bvh.of_mesh(other.index()).center;
    assert!(known.iter().all(|x| (8.0..12.0).contains(x)), "{known:?}");
    let lit = cloud(20, [-40.0; 3], 0);
    let mut dark = lit.clone();
    dark.iter_mut().for_each(|light| light.radiance = [0.0; 3]);
    let before = bvh.of_mesh(mesh.index()).center;
    for triangles in [dark, lit] {
        for (first, half) in [(0, 0..10), (10, 10..20)] {
            bvh.set_triangle_range(mesh, first, triangles[half].to_vec())
                .expect("its own");
        }
        bvh.refit();
        assert!(bvh.top.strayed.is_empty());
        assert_eq!(bvh.of_mesh(mesh.index()).center, before);
    }
}
