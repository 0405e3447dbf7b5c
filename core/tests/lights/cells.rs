//! Cells of points: every light has its exact probability, wherever its instance is.

use glam::Vec3;
use lightbvh::exact::pow2;
use lightbvh::importance::{Cell, ImportanceModel, Receiver};
use lightbvh::light::{AnyLight, Light, SpotLight};
use lightbvh::tree::Model;
use lightbvh::{
    AnyLights, Bvh, EmissiveTriangle, LightBvh, LightMoments, Moments, Random64, SampledLight, ShadingPoint,
    Transform,
};

use crate::kit::{Random, dot, room, wide};
use crate::receivers::{node, refused};

const ORIGIN: [f32; 3] = [0.0; 3];

impl Random {
    /// Within about `reach` of the origin, sides up to `size`; a flat one, and one in a volume now and then.
    fn cell(&mut self, reach: f32, size: f32) -> Cell {
        let flat = self.below(3) == 0;
        let length = [0.0, 0.3, 1.0][self.below(3) as usize];
        Cell {
            center: self.within(reach),
            half: [1.0, if flat { 0.0 } else { 1.0 }, 1.0].map(|x| x * size * self.unit()),
            n: self.unit_vector().map(|x| x * length),
        }
    }

    /// Turned, sheared, flattened, or stretched far.
    fn affine(&mut self) -> Transform {
        let mut map = self.similarity(20.0, 1.0);
        match self.below(4) {
            0 => map.columns[0][1] += 3.0 * self.signed(),
            1 => map.columns[1] = ORIGIN,
            2 => map.columns[2] = map.columns[2].map(|x| x * 1e4),
            _ => {}
        }
        map
    }
}

/// A mesh of a few lights in many places.
fn places(random: &mut Random, count: u32) -> LightBvh {
    let mut mesh = room(random).all()[..6].to_vec();
    mesh.iter_mut().for_each(|triangle| triangle.mesh = 0);
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(mesh).expect("within the domain");
    for _ in 0..count {
        bvh.add_instance(mesh, random.affine()).expect("an instance");
    }
    bvh.refit();
    bvh
}

fn pmfs<P: Receiver>(bvh: &LightBvh, receiver: &P) -> Vec<f64>
where
    Moments: ImportanceModel<lightbvh::MomentNode<8>, 8, P>,
{
    let tree = bvh.tree().by::<Moments>();
    let all = (0..).zip(bvh.view().instances());
    all.flat_map(|(id, own)| (own.first..own.first + own.count).map(move |light| (light, id)))
        .map(|(light, id)| f64::from(tree.pmf(receiver, light, id)))
        .collect()
}

/// Under any map, no light is lost, probabilities sum to one, and the share of numbers that choose a light is its probability: each has one
/// range of them.
#[test]
fn every_light_has_its_share_of_numbers() {
    let mut chosen = 0;
    for seed in 0..40 {
        let random = &mut Random(seed);
        let bvh = places(random, 12);
        let cell = random.cell(15.0, 8.0);
        let found = pmfs(&bvh, &cell);
        let sum: f64 = found.iter().sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        let volume = ShadingPoint { p: ORIGIN, n: ORIGIN };
        for (own, any) in found.iter().zip(pmfs(&bvh, &volume)) {
            assert_eq!(*own > 0.0, any > 0.0, "{cell:?}");
        }
        let mut counts = vec![0; found.len()];
        for high in (0..1 << 14).map(|k| k << 18) {
            let random = Random64 { high, low: 0 };
            let sampled = bvh.tree().by::<Moments>().sample(&cell, random);
            let light = sampled.light as usize;
            assert_eq!(f64::from(sampled.pmf), found[light]);
            counts[light] += 1;
        }
        for (count, pmf) in counts.into_iter().zip(found) {
            assert!((f64::from(count) - pmf * f64::from(1 << 14)).abs() <= 1.0);
            chosen += u32::from(count > 0);
        }
    }
    assert!(chosen > 500, "{chosen}");
}

/// The default, with its share of uniform choice: many at once are those of one at a time.
#[test]
fn many_candidates_are_single_ones() {
    let random = &mut Random(7);
    let bvh = places(random, 30);
    for _ in 0..50 {
        let (cell, number) = (random.cell(15.0, 3.0), random.word());
        let many: [SampledLight; 32] = bvh.tree().sample_many(&cell, number);
        for (k, own) in (0..).zip(many) {
            let one = Random64::from(number).spaced(k, 32);
            assert_eq!(bvh.sample(&cell, one), Some(own));
            let pmf = bvh.tree().pmf(&cell, own.light, own.instance);
            assert_eq!(pmf.to_bits(), own.pmf.to_bits());
        }
    }
}

/// A scene scaled by a power of two keeps each bit.
#[test]
fn scale_changes_nothing() {
    let random = &mut Random(3);
    let lights = room(random).all()[..40].to_vec();
    let of = |scale: f32| {
        let mut bvh = LightBvh::default();
        let scaled = |light: &EmissiveTriangle| EmissiveTriangle {
            p: light.p.map(|p| p.map(|x| x * scale)),
            mesh: 0,
            ..*light
        };
        let mesh = bvh.add_mesh(lights.iter().map(scaled).collect()).expect("lights");
        bvh.add_instance(mesh, Transform::IDENTITY).expect("an instance");
        bvh.refit();
        bvh
    };
    let cells: Vec<Cell> = (0..20).map(|_| random.cell(5.0, 3.0)).collect();
    let [one, far, small] = [0, 30, -20].map(|e| {
        let bvh = of(pow2(e));
        let scaled = cells.iter().map(|cell| Cell {
            center: cell.center.map(|x| x * pow2(e)),
            half: cell.half.map(|x| x * pow2(e)),
            n: cell.n,
        });
        scaled.map(|cell| pmfs(&bvh, &cell)).collect::<Vec<_>>()
    });
    assert!(one == far && one == small);
}

/// Extremes of size, distance and flux, of a cell far greater than the lights and far smaller.
#[test]
fn weights_are_positive_everywhere() {
    let random = &mut Random(2);
    for (trial, scale) in [-90, -40, 0, 20, 39].repeat(200).into_iter().enumerate() {
        let size = pow2([scale, -100, 40, scale - 30][trial % 4]);
        let cell = random.cell(pow2(scale), size).checked().expect("in the domain");
        let sets: [LightMoments; 4] = core::array::from_fn(|slot| {
            let across = [0.0, random.unit() * pow2(scale)][trial % 2];
            let c = [cell.center, random.within(pow2(scale))][slot % 2];
            LightMoments {
                phi: pow2(random.below(60) as i32 - 30),
                c: Vec3::from_array(c),
                across,
                along: across,
                m: Vec3::from_array(random.unit_vector()),
                h: Vec3::splat(across),
            }
        });
        for weight in Moments::weights(&node(&sets), &cell) {
            assert!(
                (pow2(-120)..=pow2(120)).contains(&weight),
                "{weight} at {cell:?} of {sets:?}"
            );
        }
    }
}

/// The mapped box holds the mapped corners. A unit normal maps as a point's does.
#[test]
fn a_mapped_cell_holds_its_points() {
    let random = &mut Random(4);
    let mut held = 0;
    for _ in 0..300 {
        let bvh = places(random, 1);
        let instance = bvh.view().instances()[0];
        let cell = random.cell(15.0, 5.0);
        let local = cell.to_local(&instance);
        for k in 0..8 {
            let n = random.unit_vector();
            let p = core::array::from_fn(|axis| {
                let side = if k >> axis & 1 == 0 { 1.0 } else { -1.0 };
                cell.center[axis] + side * cell.half[axis]
            });
            let point = ShadingPoint { p, n }.to_local(&instance);
            for axis in 0..3 {
                let away = (point.p[axis] - local.center[axis]).abs();
                let size = point.p[axis].abs() + local.half[axis];
                // A map without volume has no inverse: coordinates end at 2^60.
                held += u32::from(local.half[axis] < pow2(60));
                assert!(
                    local.half[axis] == pow2(60) || away <= local.half[axis] + 1e-4 * size,
                    "{cell:?} by {instance:?}"
                );
            }
            let alike = Cell { n, ..cell }.to_local(&instance);
            assert!((Vec3::from_array(alike.n) - point.normal()).length() < 1e-5);
        }
        let length = |n| Vec3::from_array(n).length();
        assert!(length(local.n) <= length(cell.n) * 1.001);
    }
    assert!(held > 5_000, "{held}");
}

/// The geometric mean, over points of 40 cells of these half sides and this length of the mean normal, of the second moment of one candidate
/// by what arrives from its light, to the square of its mean.
fn moment_at_points<M: Model<8>>(
    bvh: &Bvh<M>,
    half: [f32; 3],
    length: f32,
    arrives: impl Fn(&M::Light, &ShadingPoint) -> f32,
) -> f64
where
    Moments: ImportanceModel<M::Node, 8, Cell>,
{
    let random = &mut Random(9);
    let (tree, view) = (bvh.tree().by::<Moments>(), bvh.view());
    let all = (0..).zip(view.instances());
    let ids: Vec<[u32; 2]> = all
        .flat_map(|(id, own)| (own.first..own.first + own.count).map(move |light| [light, id]))
        .collect();
    let lights = ids.iter().map(|&[light, id]| view.light(light, id));
    let lights: Vec<M::Light> = lights.map(|own| own.expect("a light")).collect();
    let mut logarithms = Vec::new();
    for _ in 0..40 {
        let up = random.unit_vector();
        let cell = Cell {
            center: random.within(4.0),
            half,
            n: up.map(|x| x * length),
        };
        let pmfs: Vec<f64> = ids
            .iter()
            .map(|&[light, id]| f64::from(tree.pmf(&cell, light, id)))
            .collect();
        for _ in 0..4 {
            // Anywhere above for normals that spread by half.
            let other = random.unit_vector();
            let side = if dot(wide(other), wide(up)) > 0.0 {
                1.0
            } else {
                -1.0
            };
            let n = match length {
                0.0 => ORIGIN,
                0.5 => other.map(|x| x * side),
                _ => up,
            };
            let p = core::array::from_fn(|axis| cell.center[axis] + half[axis] * random.signed());
            let point = ShadingPoint { p, n };
            let own = lights.iter().map(|light| f64::from(arrives(light, &point)));
            let own: Vec<f64> = own.collect();
            let sum: f64 = own.iter().sum();
            let seen = own.iter().zip(&pmfs).filter(|(own, _)| **own > 0.0);
            let moment: f64 = seen.map(|(own, pmf)| own * own / pmf).sum();
            if sum > 0.0 {
                logarithms.push((moment / (sum * sum)).ln());
            }
        }
    }
    (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp()
}

/// Dropping any term of the weight raises one of these moments above its bound, which is 3 % above its value.
#[test]
fn weights_suit_all_points_of_a_cell() {
    let mut mesh = room(&mut Random(1)).all().to_vec();
    mesh.iter_mut().for_each(|triangle| triangle.mesh = 0);
    let mut triangles = LightBvh::default();
    let mesh = triangles.add_mesh(mesh).expect("within the domain");
    triangles
        .add_instance(mesh, Transform::IDENTITY)
        .expect("an instance");
    triangles.refit();
    let arrives = |light: &EmissiveTriangle, point: &ShadingPoint| light.point([0.5; 2]).irradiance(point)[0];
    for (half, length, most) in [
        (ORIGIN, 0.5, 3.45),
        ([2.0; 3], 1.0, 4.68),
        ([3.0, 0.1, 0.1], 1.0, 3.33),
    ] {
        let found = moment_at_points(&triangles, half, length, arrives);
        assert!(found <= most, "{half:?} {length}: {found}");
    }
    let random = &mut Random(5);
    let spots = (0..200).map(|_| {
        AnyLight::from(SpotLight {
            p: random.within(5.0),
            intensity: [1.0; 3],
            range: 0.0,
            axis: random.unit_vector(),
            cos_inner: 0.95,
            cos_outer: 0.9,
            mesh: 0,
        })
    });
    let mut bvh = AnyLights::default();
    let mesh = bvh.add_mesh(spots.collect()).expect("within the domain");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("an instance");
    bvh.refit();
    let arrives = |light: &AnyLight, point: &ShadingPoint| {
        let at = light.point_for(Vec3::from_array(point.p), [0.5; 2]);
        at.irradiance(point)[0]
    };
    let found = moment_at_points(&bvh, [1.0; 3], 0.0, arrives);
    assert!(found <= 17.98, "spots: {found}");
}

/// A cell of one point is that point; a cell of several is around them.
#[test]
fn cells_are_made_of_points() {
    let random = &mut Random(5);
    assert_eq!(Cell::around(&[]), None);
    let bvh = places(random, 20);
    let mut off = 0.0;
    for _ in 0..100 {
        let (p, n) = (random.within(15.0), random.unit_vector());
        let point = ShadingPoint { p, n };
        // As long as `checked` takes it.
        let length = 1.0 + 0.0035 * random.signed();
        let long = n.map(|x| x * length);
        let one = Cell::around(&[ShadingPoint { p, n: long }.checked().expect("a point")]).expect("a cell");
        assert_eq!((one.center, one.half), (p, ORIGIN));
        let off_by = (Vec3::from_array(one.n) - point.normal()).length();
        assert!(off_by < 1e-6, "{off_by}");
        let differences = pmfs(&bvh, &one).into_iter().zip(pmfs(&bvh, &point));
        off += differences.map(|(a, b)| (a - b).abs()).sum::<f64>();
    }
    // The spread of normals counts as at least 2^-9.
    assert!(off < 0.02 * 100.0, "{off}");
    // However many there are.
    let n = random.unit_vector();
    let many = vec![ShadingPoint { p: ORIGIN, n }; 200_000];
    let all = Cell::around(&many).expect("points");
    assert!((Vec3::from_array(all.n) - Vec3::from_array(n)).length() < 1e-6);
    // A point in a volume has no normal to agree with.
    let mixed = [n, ORIGIN].map(|n| ShadingPoint { p: ORIGIN, n });
    let mixed = Vec3::from_array(Cell::around(&mixed).expect("points").n);
    assert!((mixed - 0.5 * Vec3::from_array(n)).length() < 1e-6);
    let [a, b] = [[-1.0, 0.0, 2.0], [3.0, 0.5, 2.0]];
    let of = |p, n| ShadingPoint { p, n };
    let cell = Cell::around(&[of(a, [0.0, 1.0, 0.0]), of(b, [1.0, 0.0, 0.0])]);
    let half = [2.0, 0.25, 0.0];
    let (center, n) = ([1.0, 0.25, 2.0], [0.5, 0.5, 0.0]);
    assert_eq!(cell, Some(Cell { center, half, n }));
    let volume = Cell {
        center,
        half,
        n: ORIGIN,
    };
    assert_eq!([Cell::volume(a, b), Cell::volume(b, a)], [volume; 2]);
}

#[test]
fn cells_are_checked() {
    let sound = Cell::volume([-1.0; 3], [f32::from_bits(1), 2.0, 3.0]);
    assert!(sound.checked().is_ok_and(|cell| cell.half == [0.5, 1.5, 2.0]));
    let n = [1e-35, 0.0, 1.0];
    assert!(
        Cell { n, ..sound }
            .checked()
            .is_ok_and(|cell| cell.n == [0.0, 0.0, 1.0])
    );
    assert!(
        !Cell {
            center: [0.0, f32::NAN, 0.0],
            ..sound
        }
        .is_within_reach()
    );
    for wrong in [f32::NAN, f32::INFINITY, 2e12] {
        let center = [0.0, wrong, 0.0];
        refused(
            Cell { center, ..sound }.checked(),
            "coordinate y of the middle of a cell",
        );
    }
    for wrong in [f32::NAN, f32::INFINITY, pow2(40).next_up(), -1.0] {
        let cell = Cell {
            half: [1.0, wrong, 1.0],
            ..sound
        };
        refused(cell.checked(), "half the sides of a cell is (1, ");
    }
    for wrong in [f32::NAN, f32::INFINITY, -1.0] {
        let cell = Cell {
            half: [wrong; 3],
            ..sound
        };
        assert_eq!(places(&mut Random(1), 1).sample(&cell, 7_u32), None);
    }
    for wrong in [[1.0; 3], [f32::NAN; 3], [0.0, 1.01, 0.0]] {
        refused(
            Cell { n: wrong, ..sound }.checked(),
            "the mean normal of a cell is (",
        );
        assert_eq!(
            places(&mut Random(1), 1).sample(&Cell { n: wrong, ..sound }, 7_u32),
            None
        );
    }
}
