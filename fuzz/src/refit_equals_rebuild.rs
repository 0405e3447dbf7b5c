//! Lights that move: a refitted tree against its lights.

use arbitrary::{Result, Unstructured};
use lightbvh::{BuildParams, Bvh, CompactNode, LightNode, Lights, MomentNode};

use crate::{Forms, input};

/// Lights that move: a refitted tree is valid for the new lights, and comes back to its first words with the first lights.
pub fn refit_equals_rebuild(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let params = input::params(u)?;
        let lights = input::lights(u)?;
        let moved = input::moved(u, &lights)?;
        for form in forms.of(data, 3) {
            match form {
                0 => refitted(Bvh::<CompactNode<4>, (), 4>::two_level, &lights, &moved, &params),
                1 => refitted(Bvh::<MomentNode<8>, (), 8>::two_level, &lights, &moved, &params),
                _ => refitted(
                    Bvh::<CompactNode<2>, (), 2>::single_level,
                    &lights,
                    &moved,
                    &params,
                ),
            }
        }
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

fn refitted<N: LightNode<W>, const W: usize>(
    build: fn(&Lights, &BuildParams) -> Bvh<N, (), W>,
    lights: &Lights,
    moved: &Lights,
    params: &BuildParams,
) {
    let mut bvh = build(lights, params);
    let first = bvh.nodes().to_vec();
    bvh.follow(moved).expect("as many lights");
    bvh.validate().unwrap_or_else(|violation| panic!("{violation}"));
    bvh.follow(lights).expect("as many lights");
    let words = |nodes: &[N]| bytemuck::cast_slice::<N, u32>(nodes).to_vec();
    assert_eq!(words(&first), words(bvh.nodes()));
}
