//! Lights that move: a refitted tree against a tree built anew.

use arbitrary::{Result, Unstructured};
use lightbvh::{BuildParams, Bvh, CompactNode, FullNode, LightNode, Lights, MomentNode};

use crate::{Forms, input};

/// Lights that move: a refitted tree is valid for the new lights, comes back to its first words with the first lights,
/// and bounds the same as a tree built anew.
pub fn refit_equals_rebuild(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let params = input::params(u)?;
        let lights = input::lights(u)?;
        let moved = input::moved(u, &lights)?;
        for form in forms.of(data, 3) {
            match form {
                0 => refitted::<CompactNode<4>, 4>(&lights, &moved, &params),
                1 => refitted::<MomentNode<8>, 8>(&lights, &moved, &params),
                _ => bounded_alike(&lights, &moved, &params),
            }
        }
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

fn refitted<N: LightNode<W>, const W: usize>(lights: &Lights, moved: &Lights, params: &BuildParams) {
    let mut bvh = Bvh::<N, (), W>::two_level(lights, params);
    let first = bvh.nodes().to_vec();
    bvh.follow(moved).expect("as many lights");
    bvh.validate().unwrap_or_else(|violation| panic!("{violation}"));
    bvh.follow(lights).expect("as many lights");
    let words = |nodes: &[N]| bytemuck::cast_slice::<N, u32>(nodes).to_vec();
    assert_eq!(words(&first), words(bvh.nodes()));
}

fn bounded_alike(lights: &Lights, moved: &Lights, params: &BuildParams) {
    let mut full = Bvh::<FullNode<2>, (), 2>::single_level(lights, params);
    full.follow(moved).expect("as many lights");
    let anew = Bvh::<FullNode<2>, (), 2>::single_level(moved, params);
    // Without quantisation boxes do not depend on the order of merges; flux does, by its rounding.
    let (a, b) = (full.summary(), anew.summary());
    assert_eq!((a.min, a.max), (b.min, b.max));
    assert!((a.phi - b.phi).abs() <= a.phi * 1e-4, "{} {}", a.phi, b.phi);
}
