//! Receivers that say more than a point: lights with masks, surfaces with two sides, pieces of rays.

use bytemuck::{Pod, bytes_of, cast_slice};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{LinkedPoint, RaySegment, TransmissivePoint};
use lightbvh::light::LinkedTriangle;
use lightbvh::node::Node;
use lightbvh::{Bvh, Edit, LightBvh, Lights, Random64, SampledLight, ShadingPoint, Transform};
use lightbvh_gpu::{Kernel, KernelSet, LinkedQuery, SegmentQuery, TransmissiveQuery, query_push};
use lightbvh_kernels::receivers::{LinkedImportance, LinkedNode, SegmentImportance, TransmissiveImportance};

use super::tally::{Kind, Tallies};
use crate::backend::{Mirrored, PMF_RECORD, SAMPLED_RECORD, node_record};
use crate::cli::devices::Opened;
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{arrays_at, lights_at, queries};

/// What is asked of one tree: a tree, and where its words come from.
struct Asked<'a, N: Node<8>, I> {
    what: String,
    bvh: &'a Bvh<N, I, 8>,
    kernels: KernelSet,
}

/// Compares all three over the triangles of a scene, `count` receivers of each.
pub(super) fn compare(
    scene: &Scene,
    (count, seed): (u32, u32),
    opened: &[Opened],
    tallies: &mut Tallies,
) -> Result<(), HostError> {
    let arrays = arrays_at(scene, 0, 64, 64)?;
    let asked = queries(&arrays, hash(seed ^ 0x6d61_736b), 0, count);
    let points: Vec<ShadingPoint> = asked.iter().map(|query| query.point).collect();
    let numbers: Vec<Random64> = asked
        .iter()
        .map(|query| Random64 {
            high: query.words[0],
            low: query.words[1],
        })
        .collect();
    let of = |k: usize| hash(seed ^ hash(k as u32));
    let lights = lights_at(scene, 0)?;

    let own = lights.triangles().iter().map(|&light| LinkedTriangle {
        light,
        mask: 1 << (hash(light.mesh) % 5),
    });
    let own = Lights::new(own.collect()).map_err(|error| HostError::in_frame(scene.name(), 0, error))?;
    let mut bvh = Bvh::<LinkedNode, LinkedImportance, 8>::two_level(&own, &lightbvh::BuildParams::default());
    let mut held = mirrors(opened, KernelSet::LINKED)?;
    let told = Asked {
        what: format!("{} two-level moments with masks", scene.name()),
        bvh: moved(scene, &mut bvh, &mut held)?,
        kernels: KernelSet::LINKED,
    };
    told.nodes(&held, tallies)?;
    let receivers: Vec<_> = (0..points.len())
        .map(|k| LinkedPoint {
            point: points[k],
            mask: of(k) & 31,
        })
        .collect();
    told.receivers(
        &held,
        tallies,
        &|k| LinkedQuery::sample(receivers[k], numbers[k]),
        &|k| told.bvh.sample_for(&receivers[k], numbers[k]),
        &|k, light, instance| LinkedQuery::pmf(receivers[k], light, instance),
        points.len(),
    )?;

    let mut bvh = LightBvh::two_level(&lights, &lightbvh::BuildParams::default());
    let mut held = mirrors(opened, KernelSet::TRANSMISSIVE)?;
    let bvh = moved(scene, &mut bvh, &mut held)?;
    let told = Asked {
        what: format!("{} two-level moments, two sides", scene.name()),
        bvh,
        kernels: KernelSet::TRANSMISSIVE,
    };
    told.nodes(&held, tallies)?;
    let parts = |k: usize| [unit_f32(of(k)), unit_f32(of(k + points.len()))];
    let leaves: Vec<_> = (0..points.len())
        .map(|k| TransmissivePoint {
            point: points[k],
            front: parts(k)[0],
            back: parts(k)[1],
        })
        .collect();
    let by = bvh.by::<TransmissiveImportance>();
    told.receivers(
        &held,
        tallies,
        &|k| TransmissiveQuery::sample(leaves[k], numbers[k]),
        &|k| by.sample_for(&leaves[k], numbers[k]),
        &|k, light, instance| TransmissiveQuery::pmf(leaves[k], light, instance),
        points.len(),
    )?;

    let told = Asked {
        what: format!("{} two-level moments, pieces of rays", scene.name()),
        bvh,
        kernels: KernelSet::SEGMENT,
    };
    let rays: Vec<_> = (0..points.len())
        .map(|k| RaySegment {
            from: points[k].p,
            to: points[(k + 1) % points.len()].p,
        })
        .collect();
    let by = bvh.by::<SegmentImportance>();
    told.receivers(
        &held,
        tallies,
        &|k| SegmentQuery::sample(rays[k], numbers[k]),
        &|k| by.sample_for(&rays[k], numbers[k]),
        &|k, light, instance| SegmentQuery::pmf(rays[k], light, instance),
        points.len(),
    )
}

fn mirrors<N: Node<8>>(opened: &[Opened], kernels: KernelSet) -> Result<Vec<Mirrored<'_, N, 8>>, HostError> {
    let each = opened.iter().map(|o| Mirrored::new(&o.device, kernels));
    Ok(each.collect::<Result<_, _>>()?)
}

/// A tree whose instances have moved since the devices had it first, so that they have something to refit.
fn moved<'a, N: Node<8>, I>(
    scene: &Scene,
    bvh: &'a mut Bvh<N, I, 8>,
    held: &mut [Mirrored<'_, N, 8>],
) -> Result<&'a Bvh<N, I, 8>, HostError> {
    bvh.plan();
    for mirror in &mut *held {
        mirror.follow(bvh)?;
    }
    let ids = (0..bvh.tree().instances.len() as u32).filter_map(|index| bvh.instance_id(index));
    let moves: Vec<_> = ids
        .map(|instance| Edit::SetTransform {
            instance,
            transform: Transform::at([0.25, -0.125, 0.0625]),
        })
        .collect();
    bvh.apply(moves)
        .map_err(|error| HostError::in_frame(scene.name(), 0, error))?;
    bvh.plan();
    for mirror in held {
        mirror.follow(bvh)?;
    }
    bvh.refit();
    Ok(bvh)
}

impl<N: Node<8>, I> Asked<'_, N, I> {
    fn nodes(&self, held: &[Mirrored<'_, N, 8>], tallies: &mut Tallies) -> Result<(), HostError> {
        let what = format!("{} refit", self.what);
        let expected = self.bvh.tree().nodes;
        let used = self.bvh.plan_of_everything();
        let listed = |nodes: &[N]| -> Vec<u32> {
            let used = used.bottom.nodes().iter().chain(used.top.nodes());
            used.flat_map(|&node| cast_slice::<_, u32>(&nodes[node as usize..][..1]).to_vec())
                .collect()
        };
        for (mirror, tally) in held.iter().zip(&mut tallies.devices) {
            let (cpu, device) = (listed(expected), listed(&mirror.nodes()?));
            tally.take(Kind::Nodes, &what, &node_record::<N, 8>(), &cpu, &device)?;
        }
        Ok(())
    }

    /// Samples of so many receivers, then the pmfs of what was sampled; those again on the CPU too.
    fn receivers<Q: Pod>(
        &self,
        held: &[Mirrored<'_, N, 8>],
        tallies: &mut Tallies,
        ask: &dyn Fn(usize) -> Q,
        sample: &dyn Fn(usize) -> SampledLight,
        ask_pmf: &dyn Fn(usize, u32, u32) -> Q,
        count: usize,
    ) -> Result<(), HostError> {
        let sampled: Vec<SampledLight> = (0..count).map(sample).collect();
        let asked: Vec<Q> = (0..count).map(ask).collect();
        let which: Vec<Q> = (0..count)
            .map(|k| ask_pmf(k, sampled[k].light, sampled[k].instance))
            .collect();
        let pmfs: Vec<u32> = sampled.iter().map(|sample| sample.pmf.to_bits()).collect();
        for (mirror, tally) in held.iter().zip(&mut tallies.devices) {
            let found: Vec<SampledLight> = self.answers(mirror, self.kernels.sample, &asked)?;
            let what = format!("{} sample", self.what);
            let (cpu, device) = (cast_slice(&sampled), cast_slice(&found));
            tally.take(Kind::Samples, &what, &SAMPLED_RECORD, cpu, device)?;
            let found: Vec<f32> = self.answers(mirror, self.kernels.pmf, &which)?;
            let what = format!("{} pmf", self.what);
            tally.take(Kind::Pmfs, &what, &PMF_RECORD, &pmfs, cast_slice(&found))?;
        }
        Ok(())
    }

    fn answers<Q: Pod, A: Pod>(
        &self,
        mirror: &Mirrored<'_, N, 8>,
        kernel: &Kernel,
        queries: &[Q],
    ) -> Result<Vec<A>, HostError> {
        let asked = mirror.device().upload(queries)?;
        let push = query_push(queries.len() as u32, &self.bvh.tree());
        let others = [("queries", asked.bind())];
        Ok(mirror.ask(kernel, queries.len(), bytes_of(&push), &others)?)
    }
}
