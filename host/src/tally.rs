//! Words compared, by what they are of.

use std::collections::BTreeMap;

use bytemuck::{NoUninit, cast_slice};
use lightbvh::INVALID;
use lightbvh::exact::hash;
use lightbvh_gpu::DeviceBuffer;
use lightbvh_kernels::query::Query;
use serde::Serialize;

use crate::backend::{Backend, Held, PMF_RECORD, SAMPLED_RECORD};
use crate::error::HostError;
use crate::scene::SceneLight;
use crate::words::{Record, compare_words};

/// The kind of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::IntoStaticStr, Serialize)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub(crate) enum Kind {
    /// What a refit computes.
    Nodes,
    /// The other arrays of a light BVH.
    Uploads,
    Samples,
    Pmfs,
    Pixels,
}

impl Kind {
    /// As in reports.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Words of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Words {
    pub compared: u64,
    pub different: u64,
}

/// Counts of one device.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Tally {
    pub compared: u64,
    pub different: u64,
    /// Records by kind.
    #[serde(flatten)]
    pub records: BTreeMap<Kind, u64>,
    /// Words by kind; together `compared` and `different`.
    pub words: BTreeMap<Kind, Words>,
    /// Scene, method, frame and kernel, then record, index, field and both words.
    pub first_difference: Option<String>,
}

/// Counts of each device, and of words that the CPU computes twice.
#[derive(Default)]
pub(crate) struct Tallies {
    pub devices: Vec<Tally>,
    pub cpu: Tally,
}

impl Tally {
    /// Compares a device's records with the CPU's; `what` says where they come from.
    pub fn take(
        &mut self,
        kind: Kind,
        what: &str,
        record: &Record,
        cpu: &[u32],
        device: &[u32],
    ) -> Result<(), HostError> {
        let comparison = compare_words(record, cpu, device)?;
        *self.records.entry(kind).or_default() += (cpu.len() / record.words.max(1)) as u64;
        self.compared += comparison.compared;
        self.different += comparison.different;
        let words = self.words.entry(kind).or_default();
        words.compared += comparison.compared;
        words.different += comparison.different;
        if let (None, Some(first)) = (&self.first_difference, comparison.first) {
            self.first_difference = Some(format!("{what}: {first}"));
        }
        Ok(())
    }

    /// Compares the buffers of a light BVH on a device with the CPU's.
    pub fn take_held(&mut self, what: &str, cpu: &[Held], device: &[Held]) -> Result<(), HostError> {
        cpu.iter().zip(device).try_for_each(|(own, found)| {
            self.take(kind_of(own.buffer), what, &own.record, &own.words, &found.words)
        })
    }
}

/// What a device, or the CPU, holds of a light BVH after a refit.
fn kind_of(buffer: DeviceBuffer) -> Kind {
    match buffer {
        DeviceBuffer::Nodes => Kind::Nodes,
        _ => Kind::Uploads,
    }
}

/// A backend, or a method, on the CPU and on each device.
pub(crate) struct Side<'a, B: ?Sized> {
    pub cpu: &'a mut B,
    pub devices: Vec<&'a mut B>,
}

impl<B: ?Sized> Side<'_, B> {
    /// Compares what `work` gives on each device with what it gives on the CPU, which is returned.
    pub fn compare<T: NoUninit>(
        &mut self,
        tallies: &mut Tallies,
        kind: Kind,
        what: &str,
        record: &Record,
        work: impl Fn(&mut B) -> Result<Vec<T>, HostError>,
    ) -> Result<Vec<T>, HostError> {
        let expected = work(self.cpu)?;
        for (device, tally) in self.devices.iter_mut().zip(&mut tallies.devices) {
            let found = work(&mut **device)?;
            tally.take(kind, what, record, cast_slice(&expected), cast_slice(&found))?;
        }
        Ok(expected)
    }

    /// Compares the words in use of each buffer.
    pub fn compare_held(
        &mut self,
        tallies: &mut Tallies,
        what: &str,
        held: impl Fn(&mut B) -> Result<Vec<Held>, HostError>,
    ) -> Result<(), HostError> {
        let expected = held(self.cpu)?;
        for (device, tally) in self.devices.iter_mut().zip(&mut tallies.devices) {
            tally.take_held(what, &expected, &held(&mut **device)?)?;
        }
        Ok(())
    }

    /// Sample, then pmf: of the light sampled for every query but each eighth, which asks for some of the `lights` in the
    /// world, of one level or two. What the CPU evaluates again must be what it sampled.
    pub fn compare_queries<L: SceneLight>(
        &mut self,
        tallies: &mut Tallies,
        what: &dyn Fn(&str) -> String,
        mut asked: Vec<Query>,
        (lights, single): (&[L], bool),
    ) -> Result<(), HostError>
    where
        B: Backend<L>,
    {
        let sampled = self.compare(
            tallies,
            Kind::Samples,
            &what("sample"),
            &SAMPLED_RECORD,
            |backend| Ok(backend.sample(&asked)?.value),
        )?;
        for (i, (query, sampled)) in asked.iter_mut().zip(&sampled).enumerate() {
            query.words = if i % 8 == 7 && !lights.is_empty() {
                let light = hash(i as u32) % lights.len() as u32;
                let mesh = lights[light as usize].mesh();
                [light, if single { INVALID } else { mesh }]
            } else {
                [sampled.light, sampled.instance]
            };
        }
        let pmfs = self.compare(tallies, Kind::Pmfs, &what("pmf"), &PMF_RECORD, |backend| {
            Ok(backend.pmf(&asked)?.value)
        })?;
        let again: (Vec<u32>, Vec<u32>) = asked
            .iter()
            .zip(sampled.iter().zip(&pmfs))
            .filter(|(query, (sampled, _))| query.words[0] == sampled.light)
            .map(|(_, (sampled, pmf))| (sampled.pmf.to_bits(), pmf.to_bits()))
            .unzip();
        let what = what("sample against pmf");
        tallies
            .cpu
            .take(Kind::Pmfs, &what, &PMF_RECORD, &again.0, &again.1)
    }
}

#[cfg(test)]
mod tests {
    use lightbvh::{BuildParams, Heuristic, SampledLight};
    use lightbvh_kernels::bvh::Paper;
    use lightbvh_kernels::render::RenderParams;

    use super::*;
    use crate::backend::{
        BackendError, Bvh, CpuBackend, Follow, Integrator, PIXEL_RECORD, Sampler, SceneArrays, Timed,
    };
    use crate::scene::Scene;
    use crate::workload::{arrays_at, build, queries, render_params};

    /// The CPU in the place of a device, with one bit of the middle word of what is `wrong` turned.
    struct Corrupt {
        inner: CpuBackend<Paper, 4>,
        wrong: Option<Kind>,
    }

    impl Corrupt {
        fn turned<T: bytemuck::Pod>(&self, kind: Kind, mut timed: Timed<Vec<T>>) -> Timed<Vec<T>> {
            if self.wrong == Some(kind) {
                let words: &mut [u32] = bytemuck::cast_slice_mut(&mut timed.value);
                words[words.len() / 2] ^= 1;
            }
            timed
        }
    }

    impl Backend for Corrupt {
        fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
            let sampled = self.inner.sample(queries)?;
            Ok(self.turned(Kind::Samples, sampled))
        }

        fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
            let pmfs = self.inner.pmf(queries)?;
            Ok(self.turned(Kind::Pmfs, pmfs))
        }

        fn render(
            &mut self,
            scene: &SceneArrays,
            params: &RenderParams,
            sampler: Sampler,
            integrator: Integrator,
        ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
            let image = self.inner.render(scene, params, sampler, integrator)?;
            Ok(self.turned(Kind::Pixels, image))
        }
    }

    impl Follow<Paper, 4> for Corrupt {
        fn follow(&mut self, bvh: &Bvh<Paper, 4>) -> Result<Timed<()>, BackendError> {
            self.inner.follow(bvh)
        }

        fn held(&mut self, bvh: &Bvh<Paper, 4>) -> Result<Vec<Held>, BackendError> {
            let mut held = self.inner.held(bvh)?;
            let wrong = held
                .iter_mut()
                .find(|own| Some(kind_of(own.buffer)) == self.wrong);
            wrong.into_iter().for_each(|own| own.words[7] ^= 1);
            Ok(held)
        }
    }

    #[test]
    fn a_wrong_bit_of_anything_is_found_and_named() {
        let scene = Scene::open("street").expect("built in");
        let arrays = arrays_at(&scene, 0, 16, 9).expect("a frame");
        let params = BuildParams::paper(Heuristic::Saoh);
        let bvh: Bvh<Paper, 4> = build(&arrays.lights, Sampler::SingleLevel, &params);
        for (wrong, said) in [
            (None, ""),
            (Some(Kind::Nodes), "street refit: nodes 0, word 7: "),
            (Some(Kind::Uploads), "street refit: lights 0, word 7: "),
            (Some(Kind::Samples), "street sample: sampled light 32, word 0: "),
            (Some(Kind::Pmfs), "street pmf: pmf 32, word 0: "),
            (Some(Kind::Pixels), "street render: pixel 72, word 0: "),
        ] {
            let mut cpu: CpuBackend<Paper, 4> = CpuBackend::new(bvh.clone());
            let mut device = Corrupt {
                inner: CpuBackend::new(bvh.clone()),
                wrong,
            };
            let mut tallies = Tallies {
                devices: vec![Tally::default()],
                ..Tallies::default()
            };
            let mut side: Side<'_, dyn Follow<Paper, 4>> = Side {
                cpu: &mut cpu,
                devices: vec![&mut device],
            };
            let what = |kernel: &str| format!("street {kernel}");
            side.compare_held(&mut tallies, &what("refit"), |backend| Ok(backend.held(&bvh)?))
                .expect("arrays");
            let lights = (arrays.lights.all(), true);
            side.compare_queries(&mut tallies, &what, queries(&arrays, 1, 0, 64), lights)
                .expect("answers");
            let params = render_params((16, 9), 1, 1, [0.0; 3]);
            side.compare(
                &mut tallies,
                Kind::Pixels,
                &what("render"),
                &PIXEL_RECORD,
                |backend| {
                    let image = backend.render(&arrays, &params, Sampler::SingleLevel, Integrator::Direct)?;
                    Ok(image.value)
                },
            )
            .expect("images");
            assert_eq!(tallies.cpu.different, 0);
            let tally = &tallies.devices[0];
            let words: u64 = tally.words.values().map(|words| words.compared).sum();
            assert_eq!((words, tally.records[&Kind::Pixels]), (tally.compared, 16 * 9));
            assert_eq!(tally.different, u64::from(wrong.is_some()), "{wrong:?}");
            if let Some(kind) = wrong {
                assert_eq!(tally.words[&kind].different, 1);
                let first = tally.first_difference.as_ref().expect("a difference");
                assert!(first.starts_with(said), "{first}");
                assert!(
                    first.contains("expected 0x") && first.contains("got 0x"),
                    "{first}"
                );
            }
        }
    }
}
