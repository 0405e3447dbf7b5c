//! Lights of any words, refused or built into valid trees.

use arbitrary::{Result, Unstructured};
use lightbvh::{BuildParams, Bvh, CompactNode, LightNode, Lights, MomentNode};

use crate::{Forms, input};

/// Any lights at all, refused or built into valid trees of each width.
pub fn build_validate(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let params = input::params(u)?;
        let triangles = if u.ratio(1, 4)? {
            input::any_triangles(u)?
        } else {
            input::triangles(u)?
        };
        if let Ok(lights) = Lights::new(triangles) {
            for form in forms.of(data, 8) {
                match form / 2 {
                    0 => valid::<CompactNode<2>, 2>(&lights, &params, form),
                    1 => valid::<CompactNode<4>, 4>(&lights, &params, form),
                    2 => valid::<MomentNode<8>, 8>(&lights, &params, form),
                    _ => valid::<CompactNode<16>, 16>(&lights, &params, form),
                }
            }
        }
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

/// Even forms have two levels, odd ones one.
fn valid<N: LightNode<W>, const W: usize>(lights: &Lights, params: &BuildParams, form: u32) {
    let bvh = if form % 2 == 0 {
        Bvh::<N, (), W>::two_level(lights, params)
    } else {
        Bvh::<N, (), W>::single_level(lights, params)
    };
    let stats = bvh.validate().unwrap_or_else(|violation| panic!("{violation}"));
    assert!(bvh.bytes() > 0 && stats.depth > 0);
}
