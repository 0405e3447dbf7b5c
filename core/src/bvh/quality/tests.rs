//! Quality falls with the order of the lights, and with nothing else.

extern crate std;

use std::vec::Vec;

use crate::exact::hash;
use crate::kit::Random;
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::{Bvh, CompactNode, EmissiveTriangle, Eq4, LightBvh, LightNode, MeshId, Transform};

const COUNT: u32 = 3000;

/// Lamps anywhere in a cube of 10 m.
fn lamps() -> Vec<EmissiveTriangle> {
    let random = &mut Random(7);
    let lamp = |_| {
        let [x, y, z] = [0; 3].map(|_| 10.0 * random.unit());
        EmissiveTriangle {
            p: [[x, y, z], [x + 0.02, y, z], [x, y + 0.02, z]],
            radiance: [0.5 + random.unit(); 3],
            mesh: 0,
            flags: 0,
        }
    };
    (0..COUNT).map(lamp).collect()
}

fn scene<N: LightNode<W>, I, const W: usize>() -> (Bvh<N, I, W>, MeshId) {
    let mut bvh = Bvh::default();
    let mesh = bvh.add_mesh(lamps()).expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    (bvh, mesh)
}

/// The factor once the mesh is of `triangles`.
fn drift<N: LightNode<W>, I, const W: usize>(triangles: Vec<EmissiveTriangle>) -> f64 {
    let (mut bvh, mesh) = scene::<N, I, W>();
    bvh.set_triangles(mesh, triangles).expect("as many");
    bvh.refit();
    bvh.drift(0)
}

fn mapped(map: impl Fn(u32, [f32; 3]) -> [f32; 3]) -> Vec<EmissiveTriangle> {
    let mut all = lamps();
    for (k, lamp) in (0..).zip(&mut all) {
        lamp.p = lamp.p.map(|p| map(k, p));
    }
    all
}

fn scrambled() -> Vec<EmissiveTriangle> {
    let mut all = lamps();
    for k in (1..COUNT).rev() {
        all.swap(k as usize, (hash(k) % (k + 1)) as usize);
    }
    all
}

fn of_layout<N: LightNode<W>, I, const W: usize>(least: f64) {
    let unchanged: [Vec<EmissiveTriangle>; 5] = [
        lamps(),
        mapped(|_, [x, y, z]| [3.0 - y, x + 40.0, z - 7.0]),
        mapped(|_, p| p.map(|x| 1e-3 * x)),
        mapped(|_, p| p.map(|x| 1e3 * x)),
        mapped(|_, p| p.map(|x| x + 0.05 * (3.0 * x / 7.0))),
    ];
    for (k, triangles) in unchanged.into_iter().enumerate() {
        let found = drift::<N, I, W>(triangles);
        assert!((1.0..1.02).contains(&found), "{k}: {found}");
    }
    // One flies to 300 m, and hides nothing; the unit is of no account.
    let far = |mut all: Vec<EmissiveTriangle>| {
        all[5].p = all[5].p.map(|[x, y, z]| [x + 300.0, y, z]);
        all
    };
    let all = drift::<N, I, W>(scrambled());
    let hidden = drift::<N, I, W>(far(scrambled()));
    let mut large = far(scrambled());
    for lamp in &mut large {
        lamp.p = lamp.p.map(|p| p.map(|x| 1e3 * x));
    }
    let large = drift::<N, I, W>(large);
    for found in [all, hidden, large] {
        assert!((least..10.0).contains(&found), "{all} {hidden} {large}");
    }
    assert!((hidden / all - 1.0).abs() < 0.25 && (large / hidden - 1.0).abs() < 0.05);
    // Less disorder is less.
    let mut some = lamps();
    for k in 0..COUNT as usize / 20 {
        some.swap(20 * k, (hash(k as u32) % COUNT) as usize);
    }
    let some = drift::<N, I, W>(some);
    assert!(1.05 < some && some < 0.8 * all, "{some} of {all}");
    let away = mapped(|k, [x, y, z]| [x + if hash(k) % 10 == 0 { 20.0 } else { 0.0 }, y, z]);
    assert!(drift::<N, I, W>(away) > 1.2);
}

#[test]
fn what_counts_is_the_order_of_the_lights() {
    of_layout::<crate::MomentNode<8>, crate::Moments, 8>(2.5);
    // Boxes of four children part less from the start.
    of_layout::<CompactNode<4>, Eq4, 4>(1.5);
}

/// Step by step or at once, in part or as a whole, and after a file: the same words give the same factor.
#[test]
fn the_way_there_does_not_show() {
    let (mut whole, mesh) = scene::<crate::MomentNode<8>, _, 8>();
    let (mut parts, own): (LightBvh, MeshId) = scene();
    let target = scrambled();
    whole.set_triangles(mesh, target.clone()).expect("as many");
    whole.refit();
    parts
        .set_triangles(own, mapped(|_, p| [1e3 * p[2], p[0], -p[1]]))
        .expect("as many");
    parts.refit();
    for first in (0..COUNT).step_by(100) {
        let some = target[first as usize..first as usize + 100].to_vec();
        parts.set_triangle_range(own, first, some).expect("its own");
        if first % 3 == 0 {
            parts.refit();
        }
    }
    parts.refit();
    assert!(whole.quality == parts.quality);
    let read = LightBvh::from_words(&parts.to_words()).expect("its words");
    assert!(read.quality[..] == parts.quality[..read.quality.len()]);
    assert_eq!(read.drift(0), whole.drift(0));
    let whole: LightBvh = whole;
    assert_eq!(read.refitted_since(0), whole.refitted_since(0));
    // Nothing is kept of what was on the way.
    parts.set_triangles(own, lamps()).expect("as many");
    parts.refit();
    assert!(parts.drift(0) < 1.001);
}

/// However many refits come, the list of them stays as long as the bottom levels are many.
#[test]
fn refits_are_listed_once() {
    let mut bvh = LightBvh::default();
    let lamp = lamps()[0];
    let meshes: Vec<MeshId> = (0..50)
        .map(|_| bvh.add_mesh(std::vec![lamp; 3]).expect("a mesh"))
        .collect();
    for round in 0..100_u32 {
        let since = bvh.epoch;
        for k in [round % 50, (7 * round + 3) % 50] {
            bvh.set_triangles(meshes[k as usize], std::vec![lamp; 3])
                .expect("as many");
        }
        bvh.refit();
        let mut recent = std::vec![round % 50, (7 * round + 3) % 50];
        recent.sort_unstable();
        recent.dedup();
        assert_eq!(bvh.refitted_since(since), recent);
        assert!(bvh.refitted.len() <= 50);
    }
    assert_eq!(bvh.refitted_since(0).len(), 50);
    bvh.remove_mesh(meshes[9]).expect("unused");
    assert!(!bvh.refitted_since(0).contains(&9));
}

/// Lights that go out and on again are no reason, nor is a mesh that never shone.
#[test]
fn without_flux_nothing_is_lost() {
    let dark = || {
        let mut all = lamps();
        all.iter_mut().for_each(|lamp| lamp.radiance = [0.0; 3]);
        all
    };
    assert_eq!(drift::<crate::MomentNode<8>, crate::Moments, 8>(dark()), 1.0);
    let (mut bvh, mesh): (LightBvh, MeshId) = scene();
    bvh.set_triangles(mesh, dark()).expect("as many");
    bvh.refit();
    bvh.set_triangles(mesh, lamps()).expect("as many");
    bvh.refit();
    assert!(bvh.drift(0) < 1.001);
}

/// Lamps that start at one point have all to lose: no tree tells them apart there, and any order is as good as another.
/// Scattered, as they are in no order, they are told apart as badly as shuffled ones.
#[test]
fn lamps_that_start_at_one_point_lose_their_order() {
    let at_one = || {
        let mut all = lamps();
        for lamp in &mut all {
            let [first, ..] = lamp.p;
            lamp.p = lamp.p.map(|p| [0, 1, 2].map(|k| p[k] - first[k] + 5.0));
        }
        all
    };
    for scale in [1.0, 1e-3, 1e3] {
        let scaled = |mut all: Vec<EmissiveTriangle>| {
            all.iter_mut()
                .for_each(|lamp| lamp.p = lamp.p.map(|p| p.map(|x| scale * x)));
            all
        };
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(scaled(at_one())).expect("a mesh");
        bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
        bvh.refit();
        assert!(bvh.drift(0) < 1.001, "{}", bvh.drift(0));
        bvh.set_triangles(mesh, scaled(lamps())).expect("as many");
        bvh.refit();
        assert!(bvh.drift(0) > 3.0, "{}", bvh.drift(0));
        bvh.set_triangles(mesh, scaled(at_one())).expect("as many");
        bvh.refit();
        assert!(bvh.drift(0) < 1.001, "{}", bvh.drift(0));
    }
}

/// The lights below a node: flux, and by flux their centers' sum and squares, and their own extents.
fn walked(bvh: &LightBvh, node: u32) -> [f64; 6] {
    let own = bvh.nodes[node as usize];
    let mut sum = [0.0; 6];
    for slot in 0..8 {
        let set = own.summary(slot);
        let phi = f64::from(set.phi());
        let c = set.center().to_array().map(f64::from);
        let one = match own.kind(slot) {
            kind::EMPTY => continue,
            kind::INNER => walked(bvh, own.link(slot)),
            _ => {
                let squared = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
                [
                    phi,
                    phi * c[0],
                    phi * c[1],
                    phi * c[2],
                    phi * squared,
                    phi * f64::from(set.spread()),
                ]
            }
        };
        (0..6).for_each(|k| sum[k] += one[k]);
    }
    sum
}

/// Flux times variance of the centers.
fn scatter([phi, x, y, z, squared, _]: [f64; 6]) -> f64 {
    squared - (x * x + y * y + z * z) / phi
}

/// What a node cannot tell apart is the share of its lights' variance, their own extents in the whole, that lies between the
/// centers of the lights within its inner children. Extents in the share, or a variance that is not about the mean, would make
/// large lights, or those far from the first child, look as lost.
#[test]
fn what_is_noted_is_the_share_within() {
    let mut large = lamps();
    for lamp in &mut large {
        let [x, y, z] = lamp.p[0];
        lamp.p = [[x, y, z], [x + 3.0, y, z], [x, y + 3.0, z]];
    }
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(large).expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    let mut seen = 0;
    for node in bvh.blases[0].nodes.clone() {
        let own = bvh.nodes[node as usize];
        let inner = (0..8).filter(|&slot| own.kind(slot) == kind::INNER);
        let within: Vec<f64> = inner.map(|slot| scatter(walked(&bvh, own.link(slot)))).collect();
        let all = walked(&bvh, node);
        let found = bvh.quality[node as usize];
        let apart = scatter(all) / all[0];
        assert!(
            (f64::from(found.apart) - apart).abs() < 0.01 * apart + 1e-3,
            "{node}: {found:?}, {apart}"
        );
        if !within.is_empty() {
            // Spreads are kept rounded.
            let share = within.iter().sum::<f64>() / (scatter(all) + all[5]);
            assert!(
                (f64::from(found.built) - share).abs() < 0.03,
                "{node}: {found:?}, {share}"
            );
            seen += 1;
        }
    }
    assert!(seen > 50, "{seen}");
}
