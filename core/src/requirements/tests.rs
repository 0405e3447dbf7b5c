//! Each fact of random scenes against a plain count of its own.

extern crate std;

mod models;

use std::vec::Vec;

use super::{Declared, Layout, Orientation, Requirements, TransformKind};
use crate::bvh::LightBvh;
use crate::exact::pow2;
use crate::kit::Random;
use crate::{Edit, EmissiveTriangle, LightBounds, Lights, MeshId, Transform};

/// A number from 0 to `count` − 1.
pub(super) fn below(random: &mut Random, count: u32) -> u32 {
    ((random.unit() * count as f32) as u32).min(count - 1)
}

/// Triangles on a grid of quarters, some without area or radiance, `two_sided` of 8 of them shining from both sides.
pub(super) fn mesh(random: &mut Random, count: u32, two_sided: u32) -> Vec<EmissiveTriangle> {
    let triangle = |_| {
        let vertex = |random: &mut Random| [0; 3].map(|_| 0.25 * below(random, 9) as f32 - 1.0);
        let (a, b) = (vertex(random), vertex(random));
        let c = if below(random, 10) == 0 { b } else { vertex(random) };
        EmissiveTriangle {
            p: [a, b, c],
            radiance: [[0.0, 1.0, 2.0, 2.0][below(random, 4) as usize]; 3],
            mesh: 0,
            flags: u32::from(below(random, 8) < two_sided),
        }
    };
    (0..count).map(triangle).collect()
}

/// Lights of one or more meshes that stand in the world.
fn lights(random: &mut Random, meshes: u32, two_sided: u32) -> Lights {
    let all = (0..meshes).flat_map(|index| {
        let count = 1 + below(random, 6);
        let own = mesh(random, count, two_sided);
        own.into_iter().map(move |triangle| EmissiveTriangle {
            mesh: index,
            ..triangle
        })
    });
    Lights::new(all.collect()).expect("within the domain")
}

/// Twice the area, of coordinates that are quarters: exact.
fn has_area(p: &[[f32; 3]; 3]) -> bool {
    let edge = |k: usize| [0, 1, 2].map(|i| f64::from(p[k][i]) - f64::from(p[0][i]));
    crate::kit::cross(edge(1), edge(2)) != [0.0; 3]
}

#[test]
fn counts_are_those_of_the_lights() {
    let mut seen = [[0; 2]; 4];
    for seed in 0..300 {
        let random = &mut Random(seed * 1000);
        let (meshes, two_sided) = (1 + below(random, 3), [0, 4, 8][below(random, 3) as usize]);
        let lights = lights(random, meshes, two_sided);
        let found = Requirements::of(&lights, Declared::STATIC);
        let all = lights.triangles();
        let shines = |t: &&EmissiveTriangle| t.radiance[0] > 0.0 && has_area(&t.p);
        let shining: Vec<_> = all.iter().filter(shines).collect();
        assert_eq!((found.lights, found.triangles), (all.len(), all.len()));
        assert_eq!(found.dark, all.len() - shining.len());
        assert_eq!(
            (found.meshes, found.instances),
            (meshes as usize, meshes as usize)
        );
        assert_eq!(found.two_sided, shining.iter().filter(|t| t.flags == 1).count());
        assert_eq!(found.needles, 0);
        let unlit = all.iter().filter(|t| t.flags == 0 && !shines(t)).count();
        assert_eq!(found.unlit, unlit);
        assert_eq!((found.most_instances, found.dimmed, found.mirrored), (1, 0, 0));
        let sizes = (0..lights.mesh_count()).map(|index| lights.mesh(index).len());
        assert_eq!(found.most_triangles, sizes.max().unwrap_or(0));
        // One-sided lights have normals, however few they are; whether pairs of them cancel is asked below.
        let one_sided = shining.iter().any(|t| t.flags == 0);
        assert_eq!(found.orientation != Orientation::Absent, one_sided);
        let of_one_side = shining.iter().filter(|t| t.flags == 0).count();
        assert_eq!(found.one_sided, of_one_side);
        let mixed = one_sided && found.two_sided > 0;
        for (k, is) in [one_sided, mixed, found.dark > 0, found.is_one_mesh()]
            .into_iter()
            .enumerate()
        {
            seen[k][usize::from(is)] += 1;
        }
    }
    assert!(seen.iter().flatten().all(|&count| count > 3), "{seen:?}");
}

/// A needle's normal is unknown below a cross product of 2^-60 of its edge squared.
#[test]
fn needles_have_no_normal() {
    for (thin, needles) in [(pow2(-50), 0), (pow2(-70), 1)] {
        let needle = EmissiveTriangle {
            p: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, thin, 0.0]],
            radiance: [1.0; 3],
            mesh: 0,
            flags: 0,
        };
        let lights = Lights::new(std::vec![needle]).expect("within the domain");
        let found = Requirements::of(&lights, Declared::STATIC);
        assert_eq!((found.needles, found.dark), (needles, 0));
        let expected = [Orientation::Present, Orientation::Absent][needles];
        assert_eq!(found.orientation, expected);
    }
}

/// What has no normal in its mesh has one in the world where the map widens it, and a tree over the world knows it.
#[test]
fn widened_needles_keep_their_normals() {
    let needle = EmissiveTriangle {
        p: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, pow2(-70), 0.0]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut wide = Transform::IDENTITY;
    wide.columns[1] = [0.0, pow2(40), 0.0];
    for (transform, layout) in [
        (Transform::IDENTITY, Layout::TwoSidedMoments),
        (wide, Layout::Moments),
    ] {
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(std::vec![needle]).expect("a mesh");
        let add = Edit::AddInstance {
            mesh,
            transform,
            radiance: 1.0,
        };
        bvh.apply(std::vec![add]).expect("an instance");
        bvh.refit();
        let found = Requirements::of(&bvh, Declared::STATIC);
        assert_eq!((found.needles, found.orientation), (1, Orientation::Absent));
        assert_eq!(found.model().layout, layout);
    }
}

/// Sheets of two triangles back to back cancel; one more triangle, or one more watt, is left over.
#[test]
fn normals_cancel_in_pairs() {
    for seed in 0..100 {
        let random = &mut Random(seed * 77);
        let mut own = mesh(random, 4, 0);
        own.retain(|t| t.radiance[0] > 0.0 && has_area(&t.p));
        if own.is_empty() {
            continue;
        }
        let turned = |t: &EmissiveTriangle| EmissiveTriangle {
            p: [t.p[0], t.p[2], t.p[1]],
            ..*t
        };
        let backs: Vec<_> = own.iter().map(turned).collect();
        let of = |triangles: &[EmissiveTriangle]| {
            let lights = Lights::new(triangles.to_vec()).expect("within the domain");
            Requirements::of(&lights, Declared::STATIC).orientation
        };
        let both = [&own[..], &backs[..]].concat();
        assert_eq!(of(&both), Orientation::Cancelling, "{both:?}");
        assert_eq!(of(&both[1..]), Orientation::Present);
        let mut brighter = both.clone();
        brighter[0].radiance = [3.0; 3];
        assert_eq!(of(&brighter), Orientation::Present);
        // Of two meshes, each has to cancel by itself.
        let apart: Vec<_> = both
            .iter()
            .enumerate()
            .map(|(k, t)| EmissiveTriangle {
                mesh: u32::from(k >= own.len()),
                ..*t
            })
            .collect();
        assert_eq!(of(&apart), Orientation::Present);
    }
}

/// Rotations about axes, scaled, and with one column stretched.
#[test]
fn transforms_are_of_their_kind() {
    let random = &mut Random(5);
    for _ in 0..2000 {
        let angle = f64::from(random.unit()) * 6.0 + 0.1;
        let (sine, cosine) = (angle.sin(), angle.cos());
        let axis = below(random, 3) as usize;
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut columns = [[0.0; 3]; 3];
        columns[axis][axis] = [1.0, -1.0][below(random, 2) as usize];
        (columns[i][i], columns[i][j], columns[j][i], columns[j][j]) = (cosine, sine, -sine, cosine);
        let scaled = |by: f64| columns.map(|column: [f64; 3]| column.map(|x| (x * by) as f32));
        let of = |columns| {
            let translation = random.vector().to_array();
            TransformKind::of(&Transform { columns, translation })
        };
        let of = &mut { of };
        assert_eq!(of(scaled(1.0)), TransformKind::Rigid);
        assert_eq!(of(scaled(1.5)), TransformKind::Uniform);
        assert_eq!(of(scaled(1.0e-9)), TransformKind::Uniform);
        // 1.00001 squared is beyond the tolerance.
        assert_eq!(of(scaled(1.000_01)), TransformKind::Uniform);
        let mut stretched = scaled(1.0);
        stretched[axis] = stretched[axis].map(|x| x * 1.000_01);
        assert_eq!(of(stretched), TransformKind::NonUniform);
        let mut sheared = scaled(2.0);
        sheared[i][axis] += 0.001;
        assert_eq!(of(sheared), TransformKind::NonUniform);
    }
    assert_eq!(TransformKind::of(&Transform::IDENTITY), TransformKind::Identity);
    assert_eq!(
        TransformKind::of(&Transform::at([1.0, 0.0, 0.0])),
        TransformKind::Translation
    );
    let nothing = Transform {
        columns: [[0.0; 3]; 3],
        translation: [0.0; 3],
    };
    assert_eq!(TransformKind::of(&nothing), TransformKind::NonUniform);
}

/// A light BVH of several meshes, some shared, some off, some removed again.
#[test]
fn instances_are_counted_as_they_stand() {
    for seed in 0..100 {
        let random = &mut Random(seed * 131 + 7);
        let mut bvh = LightBvh::default();
        let meshes: Vec<MeshId> = (0..1 + below(random, 3))
            .map(|_| bvh.add_mesh(mesh(random, 3, 4)).expect("within the domain"))
            .collect();
        let mut kinds = [0; 5];
        let (mut dimmed, mut mirrored, mut off) = (0, 0, 0);
        let mut users = std::vec![0; meshes.len()];
        for _ in 0..below(random, 6) {
            let at = below(random, meshes.len() as u32) as usize;
            let kind = below(random, 5) as usize;
            let mirrors = kind > 1 && below(random, 2) == 1;
            let s = if mirrors { -1.0 } else { 1.0 };
            let columns = [
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                [[0.0, s, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
                [[2.0, 0.0, 0.0], [0.0, 2.0 * s, 0.0], [0.0, 0.0, 2.0]],
                [[2.0, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, 1.0]],
            ][kind];
            let translation = if kind == 0 { [0.0; 3] } else { [1.0, 2.0, 3.0] };
            let radiance = [1.0, 0.5, 0.0][below(random, 3) as usize];
            let edit = Edit::AddInstance {
                mesh: meshes[at],
                transform: Transform { columns, translation },
                radiance,
            };
            let added = bvh.apply(std::vec![edit]).expect("an instance").instances[0];
            if below(random, 4) == 0 {
                bvh.remove_instance(added).expect("it is there");
                continue;
            }
            kinds[kind] += 1;
            users[at] += 1;
            dimmed += usize::from(radiance != 1.0);
            mirrored += usize::from(mirrors);
            off += if radiance == 0.0 { 3 } else { 0 };
        }
        bvh.refit();
        let found = Requirements::of(&bvh, Declared::ANYTHING);
        let instances: usize = kinds.iter().sum();
        assert_eq!((found.meshes, found.instances), (meshes.len(), instances));
        assert_eq!(
            (found.transforms, found.dimmed, found.mirrored),
            (kinds, dimmed, mirrored)
        );
        assert_eq!(found.most_instances, users.iter().copied().max().unwrap_or(0));
        let world = bvh.world_lights();
        let shining = world
            .iter()
            .filter(|t| LightBounds::of_triangle(t).phi > 0.0)
            .count();
        assert_eq!(
            (found.lights, found.dark),
            (3 * instances, 3 * instances - shining)
        );
        assert!(found.dark >= off);
        let expected = kinds.iter().rposition(|&count| count > 0).unwrap_or(0);
        assert_eq!(found.transform() as usize, expected);
    }
}

/// Every fact has its reason, and the words change with it.
#[test]
fn facts_are_said() {
    let random = &mut Random(9);
    let both = lights(random, 2, 8);
    let said = |lights: &Lights, declared| {
        let facts = Requirements::of(lights, declared).facts();
        assert!(
            facts
                .iter()
                .all(|fact| !fact.found.is_empty() && fact.reason.len() > 8)
        );
        facts
    };
    let of = |facts: &[super::Fact], name: &str| {
        facts
            .iter()
            .find(|fact| fact.name == name)
            .map(|fact| fact.found.clone())
    };
    let facts = said(&both, Declared::STATIC);
    assert_eq!(of(&facts, "orientation").as_deref(), Some("absent"));
    assert_eq!(of(&facts, "two-sided only").as_deref(), Some("yes"));
    assert_eq!(of(&facts, "changes").as_deref(), Some("no"));
    let facts = said(&lights(random, 2, 0), Declared::ANYTHING);
    assert_eq!(of(&facts, "orientation").as_deref(), Some("present"));
    assert_eq!(of(&facts, "two-sided only").as_deref(), Some("no"));
    assert_eq!(of(&facts, "changes").as_deref(), Some("yes"));
}
