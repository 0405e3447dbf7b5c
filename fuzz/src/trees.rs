//! Built trees, refitted trees, and probabilities against samples.

use arbitrary::{Result, Unstructured};
use bytemuck::cast_slice;
use lightbvh::device::bvh::follow;
use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, Eq4, INVALID, ImportanceModel, LightNode, Lights, MomentNode,
    Moments, Random64, ShadingPoint,
};

use crate::{Forms, input};

/// Lights to follow, and points with a number. Both are read from the bytes behind the lights.
struct Rest {
    moved: Option<Lights>,
    points: Option<([ShadingPoint; 2], u32)>,
}

/// Any lights at all, refused or built into valid trees of each width. A refit of unchanged lights changes no word; a
/// refitted tree is valid for the new lights, and comes back to its first words with the first lights. Every light with flux has a probability, they sum to one, and samples come with them.
pub fn trees(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let params = input::params(u)?;
        let triangles = if u.ratio(1, 4)? {
            input::any_triangles(u)?
        } else {
            input::triangles(u)?
        };
        let Ok(lights) = Lights::new(triangles) else {
            return Ok(());
        };
        let bytes = u.peek_bytes(u.len()).unwrap_or_default();
        let rest = Rest {
            moved: input::moved(&mut Unstructured::new(bytes), &lights).ok(),
            points: points(&mut Unstructured::new(bytes), &lights).ok(),
        };
        for form in forms.of(data, 8) {
            match form / 2 {
                0 => tree::<CompactNode<2>, Eq4, 2>(&lights, &params, &rest, form),
                1 => tree::<CompactNode<4>, Eq4, 4>(&lights, &params, &rest, form),
                2 => tree::<MomentNode<8>, Defensive<Moments, 6>, 8>(&lights, &params, &rest, form),
                _ => tree::<CompactNode<16>, Eq4, 16>(&lights, &params, &rest, form),
            }
        }
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

fn points(u: &mut Unstructured<'_>, lights: &Lights) -> Result<([ShadingPoint; 2], u32)> {
    let lights = lights.all();
    Ok((
        [input::point(u, lights)?, input::point(u, lights)?],
        u.arbitrary()?,
    ))
}

/// Even forms have two levels, odd ones one.
fn tree<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    lights: &Lights,
    params: &BuildParams,
    rest: &Rest,
    form: u32,
) {
    let mut bvh = match form % 2 {
        0 => Bvh::<(N, ()), W>::two_level(lights, params),
        _ => Bvh::single_level(lights, params),
    };
    bvh.view().validate().expect("valid");
    assert!(bvh.view().bytes() > 0 && bvh.view().depth() > 0);
    if let Some((points, random)) = &rest.points {
        distributions::<N, I, W>(&bvh, lights, points, *random);
    }
    if let Some(moved) = &rest.moved {
        let first = words(&bvh);
        follow(&mut bvh, lights).expect("as many lights");
        assert!(first == words(&bvh), "refit of unchanged lights changes a word");
        let first = bvh.view().nodes().to_vec();
        follow(&mut bvh, moved).expect("as many lights");
        bvh.view().validate().expect("valid");
        follow(&mut bvh, lights).expect("as many lights");
        // The top level may differ: instances that moved far were inserted elsewhere.
        assert!(
            cast_slice::<N, u8>(&first) == cast_slice::<N, u8>(bvh.view().nodes()),
            "there and back"
        );
    }
}

/// All words that a device holds.
fn words<N: LightNode<W>, const W: usize>(bvh: &Bvh<(N, ()), W>) -> Vec<u8> {
    let (tree, links) = (bvh.tree(), bvh.tree().links);
    [
        cast_slice(bvh.view().nodes()),
        cast_slice(bvh.view().top_nodes()),
        cast_slice(tree.instances),
        cast_slice(tree.trails),
        cast_slice(links.above),
        cast_slice(links.places),
        cast_slice::<_, u8>(links.parts),
    ]
    .concat()
}

fn distributions<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<(N, ()), W>,
    lights: &Lights,
    points: &[ShadingPoint],
    random: u32,
) {
    let shines: Vec<bool> = lights.all().iter().map(input::shines::<N, W>).collect();
    for point in points {
        let count = lights.all().len() as u32;
        let pmfs: Vec<f32> = (0..count)
            .map(|light| input::pmf_of::<_, I, _>(bvh, lights, point, light))
            .collect();
        for (pmf, shines) in pmfs.iter().zip(&shines) {
            assert!((0.0..=1.0).contains(pmf));
            assert_eq!(*pmf > 0.0, *shines || I::UNIFORM_HALVINGS > 0);
        }
        let sampled = |number: Random64| {
            let sampled = bvh.tree().by::<I>().sample(point, number);
            if sampled.light == INVALID {
                assert!(!shines.contains(&true) && sampled.pmf == 0.0, "{sampled:?}");
            } else {
                assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
            }
        };
        if shines.contains(&true) {
            input::sum_is_one(&pmfs, I::UNIFORM_HALVINGS, point);
        }
        for i in 0..8_u32 {
            sampled(random.wrapping_add(i.wrapping_mul(0x9e37_79b9)).into());
        }
        // The ends of the range, which no rounding may carry beyond.
        for bits in [
            0,
            u64::MAX,
            u64::MAX << 32,
            u64::MAX >> 32,
            1 << 63,
            (1 << 63) - 1,
        ] {
            sampled(bits.into());
        }
    }
}
