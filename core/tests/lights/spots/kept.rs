//! What edits, rebuilds and files keep, and what is as it was without beams or with masks.

use super::*;
use lightbvh::bvh::{RebuilderParams, Swap};
use lightbvh::exact::hash;
use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::{AnyLight, LinkedAny};
use lightbvh::node::{LinkedSpotMomentNode, Lit};
use lightbvh::{BuildParams, Bvh, Lights, Moments, Rebuilder};

/// Probabilities sum to one, and a sample has the one that is told.
fn check_pmf(bvh: &Tree<AnyLight>, random: &mut Random, points: u32) {
    let tree = bvh.tree();
    for _ in 0..points {
        let p = random.vector(8.0);
        let point = random.point(p);
        let all = told(bvh, &point);
        let sum: f64 = all
            .iter()
            .map(|own| f64::from(tree.pmf_for(&point, own.light, own.instance)))
            .sum();
        assert!((sum - 1.0).abs() < 1.0e-5, "{sum}");
        for _ in 0..20 {
            let sampled = bvh.sample(&point, random.word());
            let pmf = tree.pmf_for(&point, sampled.light, sampled.instance);
            assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
            assert!(pmf > 0.0);
        }
    }
}

#[test]
fn edits_and_rebuilds_keep_beams_and_probabilities() {
    for opens in [false, true] {
        let random = &mut Random(71 + u32::from(opens));
        let mut bvh = Tree::<AnyLight>::new(BuildParams {
            opens,
            ..BuildParams::default()
        });
        let mut ids = Vec::new();
        let mut meshes = Vec::new();
        for _ in 0..60 {
            let count = [1, 2, 30][random.below(3) as usize];
            let mut own = any(spots(random, count, 0.5));
            if random.below(2) == 0 {
                own.push(other(random));
            }
            meshes.push((
                bvh.add_mesh(own.clone()).expect("in the domain"),
                own.len() as u32,
            ));
        }
        for k in 0..2500 {
            let (mesh, _) = meshes[k % meshes.len()];
            ids.push(
                bvh.add_instance(mesh, even(random, 60.0, 1.0))
                    .expect("in the domain"),
            );
        }
        bvh.refit();
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            idle: 0.0,
            ..RebuilderParams::default()
        });
        for frame in 0..40 {
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            for _ in 0..30 {
                let at = random.below(ids.len() as u32) as usize;
                match random.below(4) {
                    0 => {
                        bvh.remove_instance(ids.swap_remove(at)).expect("it is there");
                        let (mesh, _) = meshes[random.below(60) as usize];
                        ids.push(
                            bvh.add_instance(mesh, even(random, 60.0, 1.0))
                                .expect("in the domain"),
                        );
                    }
                    1 => bvh
                        .set_radiance(ids[at], random.below(3) as f32)
                        .expect("a factor"),
                    _ => bvh
                        .set_transform(ids[at], even(random, 60.0, 1.0))
                        .expect("in the domain"),
                }
            }
            let (mesh, count) = meshes[random.below(60) as usize];
            let first = random.below(count);
            let some = 1 + random.below(count - first);
            let own = any(spots(random, some, 0.5));
            bvh.set_triangle_range(mesh, first, own).expect("in the mesh");
            bvh.refit();
            rebuilder.end_frame(&bvh);
            bvh.validate().expect("nodes are what refit makes");
            if frame % 10 == 9 {
                check_pmf(&bvh, random, 2);
            }
        }
        let words = bvh.to_words();
        let read = Tree::<AnyLight>::from_words(&words).expect("what was written");
        assert!(read.to_words() == words);
        check_pmf(&read, random, 2);
    }
}

/// Without spots, all bits are those of the layout without beams.
#[test]
fn other_lights_are_what_they_were() {
    let random = &mut Random(5);
    let own: Vec<AnyLight> = (0..300).map(|_| other(random)).collect();
    let lights = Lights::new(own).expect("in the domain");
    let with = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
    let without = Plain::<AnyLight>::single_level(&lights, &BuildParams::default());
    for k in 0..4000_u32 {
        let p = random.vector(8.0);
        let point = random.point(p);
        assert_eq!(with.sample(&point, hash(k)), without.sample(&point, hash(k)));
    }
}

/// Masks and beams together: a light has a probability just where it has a bit in common.
#[test]
fn masks_stand_beside_beams() {
    type Both = Bvh<Lit<LinkedSpotMomentNode<8>, LinkedAny>, Linked<Leveled<Moments, 9>>, 8>;
    let random = &mut Random(25);
    let own: Vec<LinkedAny> = any(spots(random, 200, 4.0))
        .into_iter()
        .map(|light| LinkedAny {
            light,
            mask: 1 << random.below(8),
        })
        .collect();
    let bvh = Both::single_level(
        &Lights::new(own.clone()).expect("in the domain"),
        &BuildParams::default(),
    );
    for _ in 0..200 {
        let p = random.vector(8.0);
        let receiver = LinkedPoint {
            point: random.point(p),
            mask: random.below(256),
        };
        let mut sum = 0.0;
        for (k, own) in own.iter().enumerate() {
            let pmf = bvh.tree().pmf_for(&receiver, k as u32, u32::MAX);
            assert_eq!(pmf > 0.0, own.mask & receiver.mask != 0);
            sum += f64::from(pmf);
        }
        let expected = f64::from(u8::from(receiver.mask != 0));
        assert!((sum - expected).abs() < 1.0e-5, "{sum} for {:#x}", receiver.mask);
    }
}
