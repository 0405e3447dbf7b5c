//! Arrays of a tree that hold any words.

use std::cell::Cell;

use std::marker::PhantomData;

use arbitrary::{Result, Unstructured};
use lightbvh::device::trail::max_levels;
use lightbvh::importance::Space;
use lightbvh::light::Light;
use lightbvh::{
    CompactNode, Eq4, INVALID, ImportanceModel, Instance, LightNode, LightTree, MomentNode, Moments,
    SampledLight, ShadingPoint, TreeWords, refit,
};

use crate::{Forms, input};

thread_local! {
    static NODES: Cell<u32> = const { Cell::new(0) };
}

/// An importance that counts how many nodes it is asked about, with a share of 1/4 of uniform choice.
struct Counting<I>(PhantomData<I>);

impl<N, I: ImportanceModel<N, W>, const W: usize> ImportanceModel<N, W> for Counting<I> {
    const UNIFORM_HALVINGS: u32 = 2;

    fn weights_in(node: &N, point: &ShadingPoint, _: Space) -> [f32; W] {
        NODES.set(NODES.get() + 1);
        I::weights(node, point)
    }
}

/// Bytes as the arrays of a tree: whatever they are, sampling, pmf, refit and maps of instances return, after no more steps than the
/// tree is said to be deep; no point is mapped to infinity.
pub fn node_words(data: &[u8], forms: Forms) {
    fn run<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        u: &mut Unstructured<'_>,
    ) -> Result<()> {
        let point = input::any_point(u)?;
        let triangles = input::any_triangles(u)?;
        let (random, light, instance): (u32, u32, u32) = u.arbitrary()?;
        let instances: Vec<Instance> = (0..u.int_in_range(0..=3)?)
            .map(|_| Ok(bytemuck::cast(u.arbitrary::<[u32; 34]>()?)))
            .collect::<Result<_>>()?;
        let trails: Vec<u32> = (0..u.int_in_range(0..=8)?)
            .map(|_| u.arbitrary())
            .collect::<Result<_>>()?;
        let bits: u32 = u.arbitrary()?;
        let (live, lights): (u32, u32) = u.arbitrary()?;
        let depth = u.arbitrary::<u8>()?;
        let nodes: Vec<N> = (0..u.int_in_range(1..=8)?)
            .map(|_| input::node(u))
            .collect::<Result<_>>()?;

        // The layout of a device, or one with a separate top level.
        let words = TreeWords {
            root: bits >> 2 & 7,
            trail_words: bits & 3,
            live,
            lights,
            depth: u32::from(depth),
            top: bits >> 5 & 7,
            above: bits >> 8 & 7,
            places: bits >> 11 & 7,
            parts: bits >> 14 & 7,
        };
        let mut tree: LightTree<'_, N, Counting<I>, W> = words.tree(&nodes, &instances, &trails);
        if bits >> 17 & 1 != 0 {
            tree.top = &nodes[..1 + nodes.len() / 2];
        }
        let counted = |pmf: f32| {
            assert!(NODES.take() <= u32::from(depth).min(2 * max_levels(W)));
            assert!((0.0..=1.0).contains(&pmf), "{pmf}");
        };
        NODES.set(0);
        let sampled = tree.sample(&point, random);
        counted(sampled.pmf);
        let numbers = [0, 1, 2].map(|k: u32| random.wrapping_add(k.wrapping_mul(0x9e37_79b9)).into());
        let mut many = [SampledLight::NONE; 3];
        tree.sample_batch(&[point; 3], &numbers, &mut many);
        for (many, number) in many.iter().zip(numbers) {
            let one = tree.sample(&point, number);
            assert_eq!((many.light, many.pmf.to_bits()), (one.light, one.pmf.to_bits()));
        }
        NODES.set(0);
        for (light, instance) in [
            (sampled.light, instance),
            (light, instance),
            (light & 7, instance & 3),
            (sampled.light, INVALID),
        ] {
            counted(tree.pmf(&point, light, instance));
        }
        for instance in &instances {
            let local = instance.to_local(&point);
            assert!(
                local.p.iter().all(|x| !x.is_infinite()),
                "{local:?} of {instance:?}"
            );
            let _ = (
                instance.vertex([1.0; 3]),
                instance.light_of(light),
                instance.triangle_of(light),
            );
            triangles.iter().for_each(|own| _ = own.in_world(instance, light));
        }
        for i in 0..nodes.len() as u32 {
            let _ = refit::bottom(&nodes, &triangles, i);
            let _ = refit::top(&nodes, words.top, &triangles, &instances, i);
        }
        Ok(())
    }
    for form in forms.of(data, 2) {
        let u = &mut Unstructured::new(data);
        let _ = match form {
            0 => run::<CompactNode<2>, Eq4, 2>(u),
            _ => run::<MomentNode<4>, Moments, 4>(u),
        };
    }
}
