//! Models with less in them: nodes without mean normals. That those nodes have the bits of others, the tests of
//! moments in `core/src` show.

use lightbvh::{BuildParams, Bvh, EmissiveTriangle, Moments, TwoSidedMomentNode};

use crate::kit::{Random, room};

/// Lights that shine from one side lose nothing but variance.
#[test]
fn two_sided_moments_lose_no_light() {
    let random = &mut Random(3);
    let lights = room(random);
    let bvh = Bvh::<(TwoSidedMomentNode<8>, Moments)>::two_level(&lights, &BuildParams::default());
    bvh.view().validate().expect("nodes are what refit makes");
    for _ in 0..100 {
        let point = random.point(8.0);
        let of = |(light, own): (u32, &EmissiveTriangle)| bvh.tree().pmf(&point, light, own.mesh);
        let pmfs: Vec<f32> = (0..).zip(lights.all()).map(of).collect();
        assert!(pmfs.iter().all(|&pmf| pmf > 0.0), "{point:?}");
        let sum: f64 = pmfs.into_iter().map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-6, "{sum} at {point:?}");
    }
}
