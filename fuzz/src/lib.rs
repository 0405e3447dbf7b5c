//! What the fuzz targets do, as plain functions of bytes: the fuzzer calls them, and so does the test that replays the
//! inputs in `regressions/`.
//!
//! A function panics where the crate is wrong, and returns where the bytes are too few or the input is refused.

mod input;

use arbitrary::{Result, Unstructured};
use lightbvh::{
    BuildParams, CompactNode, Eq4, FullNode, INVALID, Instance, LightBvh, LightNode, LightTree, Lights,
    ShadingPoint, refit, traverse,
};

/// A target's name and body.
pub type Target = (&'static str, fn(&[u8]));

/// All targets.
pub const TARGETS: [Target; 4] = [
    ("build_validate", build_validate),
    ("refit_equals_rebuild", refit_equals_rebuild),
    ("sample_pmf", sample_pmf),
    ("node_words", node_words),
];

/// Any lights at all, refused or built into valid trees of each width.
pub fn build_validate(data: &[u8]) {
    fn run(u: &mut Unstructured<'_>) -> Result<()> {
        let params = input::params(u)?;
        let triangles = if u.ratio(1, 4)? {
            input::any_triangles(u)?
        } else {
            input::triangles(u)?
        };
        if let Ok(lights) = Lights::new(triangles) {
            valid::<CompactNode<2>, 2>(&lights, &params);
            valid::<CompactNode<4>, 4>(&lights, &params);
            valid::<FullNode<16>, 16>(&lights, &params);
        }
        Ok(())
    }
    let _ = run(&mut Unstructured::new(data));
}

fn valid<N: LightNode<W>, const W: usize>(lights: &Lights, params: &BuildParams) {
    for bvh in [
        LightBvh::<N, W>::two_level(lights, params),
        LightBvh::<N, W>::single_level(lights, params),
    ] {
        let stats = bvh
            .validate(lights)
            .unwrap_or_else(|violation| panic!("{violation}"));
        assert!(stats.bytes > 0 && stats.depth > 0);
    }
}

/// Lights that move: a refitted tree is valid for the new lights, comes back to its first words with the first lights,
/// and bounds the same as a tree built anew.
pub fn refit_equals_rebuild(data: &[u8]) {
    fn run(u: &mut Unstructured<'_>) -> Result<()> {
        let params = input::params(u)?;
        let lights = input::lights(u)?;
        let moved = input::moved(u, &lights)?;
        refitted::<CompactNode<4>, 4>(&lights, &moved, &params);

        let mut full = LightBvh::<FullNode<2>, 2>::single_level(&lights, &params);
        full.refit(&moved);
        let anew = LightBvh::<FullNode<2>, 2>::single_level(&moved, &params);
        // Without quantisation boxes do not depend on the order of merges; flux does, by its rounding.
        let (a, b) = (full.bounds(), anew.bounds());
        assert_eq!((a.min, a.max), (b.min, b.max));
        assert!((a.phi - b.phi).abs() <= a.phi * 1e-4, "{} {}", a.phi, b.phi);
        Ok(())
    }
    let _ = run(&mut Unstructured::new(data));
}

fn refitted<N: LightNode<W>, const W: usize>(lights: &Lights, moved: &Lights, params: &BuildParams) {
    let mut bvh = LightBvh::<N, W>::two_level(lights, params);
    let first = bvh.nodes().to_vec();
    bvh.refit(moved);
    bvh.validate(moved)
        .unwrap_or_else(|violation| panic!("{violation}"));
    bvh.refit(lights);
    let words = |nodes: &[N]| bytemuck::cast_slice::<N, u32>(nodes).to_vec();
    assert_eq!(words(&first), words(bvh.nodes()));
}

/// Lights and points: probabilities sum to one, and samples come with them.
pub fn sample_pmf(data: &[u8]) {
    fn run(u: &mut Unstructured<'_>) -> Result<()> {
        let params = input::params(u)?;
        let lights = input::lights(u)?;
        let points = [input::point(u, &lights)?, input::point(u, &lights)?];
        let random: u32 = u.arbitrary()?;
        for point in &points {
            distribution::<CompactNode<2>, 2>(&LightBvh::two_level(&lights, &params), &lights, point, random);
            distribution::<CompactNode<4>, 4>(
                &LightBvh::single_level(&lights, &params),
                &lights,
                point,
                random,
            );
        }
        Ok(())
    }
    let _ = run(&mut Unstructured::new(data));
}

fn distribution<N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
    point: &ShadingPoint,
    random: u32,
) {
    let count = lights.triangles().len() as u32;
    let pmfs: Vec<f32> = (0..count)
        .map(|light| bvh.pmf::<Eq4>(lights, point, light))
        .collect();
    let sum: f64 = pmfs.iter().map(|&p| f64::from(p)).sum();
    let reachable = pmfs.iter().any(|&p| p > 0.0);
    // As in the property tests: a few roundings of 2^-24 for each level.
    let tolerance = f64::from(bvh.depth() * 4 + 8) / 16_777_216.0;
    assert!(!reachable || (sum - 1.0).abs() <= tolerance, "sum {sum}");
    for i in 0..8_u32 {
        let sampled = bvh.sample::<Eq4>(point, random.wrapping_add(i.wrapping_mul(0x9e37_79b9)));
        if reachable {
            assert!(sampled.light < count, "{sampled:?}");
            assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
        } else {
            assert_eq!(sampled.light, INVALID);
        }
    }
}

/// Bytes as the arrays of a tree: whatever they are, sampling, pmf and refit return.
pub fn node_words(data: &[u8]) {
    fn run(u: &mut Unstructured<'_>) -> Result<()> {
        let point = input::any_point(u)?;
        let triangles = input::any_triangles(u)?;
        let (random, light, mesh): (u32, u32, u32) = u.arbitrary()?;
        let meshes: Vec<Instance> = (0..u.int_in_range(0..=3)?)
            .map(|_| Ok(bytemuck::cast(u.arbitrary::<[u32; 24]>()?)))
            .collect::<Result<_>>()?;
        let roots: Vec<refit::BlasRoot> = (0..u.int_in_range(0..=3)?)
            .map(|_| Ok(bytemuck::cast(u.arbitrary::<[u32; 13]>()?)))
            .collect::<Result<_>>()?;
        let trails: Vec<u32> = (0..u.int_in_range(0..=8)?)
            .map(|_| u.arbitrary())
            .collect::<Result<_>>()?;
        let trail_words = u.arbitrary::<u32>()? & 3;
        let root = u.arbitrary::<u32>()? & 7;
        let nodes: Vec<CompactNode<2>> = (0..u.int_in_range(1..=8)?)
            .map(|_| input::node(u))
            .collect::<Result<_>>()?;

        let tree = LightTree {
            nodes: &nodes,
            root,
            meshes: &meshes,
            trails: &trails,
            trail_words,
        };
        let sampled = traverse::sample::<_, Eq4, _, 2>(&tree, &point, random);
        for (light, mesh) in [
            (sampled.light, mesh),
            (light, mesh),
            (light & 7, mesh & 3),
            (sampled.light, INVALID),
        ] {
            let _ = traverse::pmf::<_, Eq4, _, 2>(&tree, &point, light, mesh);
        }
        for i in 0..nodes.len() as u32 {
            let _ = refit::leaves(&nodes, &triangles, i);
            let _ = refit::level(&nodes, i);
            let _ = refit::mesh_leaves(&nodes, &meshes, &roots, i);
            let _ = refit::root(&nodes, i);
        }
        Ok(())
    }
    let _ = run(&mut Unstructured::new(data));
}
