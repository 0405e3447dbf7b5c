//! That a wrong word is found and named, whatever it is of: the CPU stands in for a device, with one bit of it turned.

use lightbvh::{BuildParams, Heuristic, SampledLight};
use lightbvh_kernels::bvh::Paper;
use lightbvh_kernels::render::RenderParams;

use super::*;
use crate::backend::{Backend, BackendError, Bvh, CpuBackend, Integrator, Timed};
use crate::cli::verify::tally::Tally;
use crate::method::UpdateTimes;
use crate::workload::arrays_at;
use crate::workload::build;

/// A method whose results are right at its first frame, and then but for one bit of the middle word of what is `wrong`.
struct Corrupt {
    inner: Box<dyn Runner>,
    /// What `inner` has, but corrupt; for light BVHs that are refitted.
    backend: CorruptBackend,
    then: Option<Kind>,
    wrong: Option<Kind>,
}

struct CorruptBackend {
    inner: CpuBackend<Paper, 4>,
    wrong: Option<Kind>,
}

/// Turns a bit, if what the records are of is wrong.
fn turn<T: bytemuck::Pod>(kind: Kind, wrong: Option<Kind>, records: &mut [T]) {
    if wrong == Some(kind) {
        let words: &mut [u32] = bytemuck::cast_slice_mut(records);
        words[words.len() / 2] ^= 1;
    }
}

impl Runner for Corrupt {
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError> {
        self.wrong = self.then;
        self.backend.wrong = self.then;
        let bvh = self.backend.inner.bvh_mut();
        bvh.follow(step.lights).map_err(BackendError::from)?;
        self.inner.advance(step)
    }

    fn image(
        &mut self,
        step: &Step<'_>,
        arrays: &SceneArrays,
        params: &RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let mut image = self.inner.image(step, arrays, params)?;
        turn(Kind::Pixels, self.wrong, &mut image.value);
        Ok(image)
    }

    fn backend(&mut self) -> &mut dyn Backend {
        &mut self.backend
    }

    fn words_in_use(&self, nodes: Vec<u32>) -> Vec<u32> {
        self.inner.words_in_use(nodes)
    }

    fn may_skip(&self) -> bool {
        self.inner.may_skip()
    }
}

impl Backend for CorruptBackend {
    fn node_record(&self) -> Record {
        self.inner.node_record()
    }

    fn nodes(&mut self) -> Result<Vec<u32>, BackendError> {
        let mut nodes = self.inner.nodes()?;
        turn(Kind::Nodes, self.wrong, &mut nodes);
        Ok(nodes)
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        let mut sampled = self.inner.sample(queries)?;
        turn(Kind::Samples, self.wrong, &mut sampled.value);
        Ok(sampled)
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        let mut pmfs = self.inner.pmf(queries)?;
        turn(Kind::Pmfs, self.wrong, &mut pmfs.value);
        Ok(pmfs)
    }

    fn render(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
        integrator: Integrator,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        self.inner.render(scene, params, sampler, integrator)
    }
}

const METHOD: Method = Method::SingleLevelRefit;

/// What is found in two frames of the method, the second of which is corrupt where `wrong` says.
fn found(wrong: Option<Kind>) -> Tally {
    let scene = Scene::open("street").expect("built in");
    let mut tallies = Tallies {
        devices: vec![Tally::default()],
        cpu: Tally::default(),
        trees: Vec::new(),
    };
    let mut lane = None;
    for frame in [0, 1] {
        let arrays = arrays_at(&scene, frame, SIZE.0, SIZE.1).expect("a frame");
        let step = Step::new(&scene, frame, &arrays.lights);
        let lane = match &mut lane {
            None => {
                let params = BuildParams::paper(Heuristic::Saoh);
                let bvh: Bvh<Paper, 4> = build(step.lights, Sampler::SingleLevel, &params);
                let corrupt = Corrupt {
                    inner: METHOD.recipe().runner(&step, Target::Cpu).expect("a runner"),
                    backend: CorruptBackend {
                        inner: CpuBackend::new(bvh),
                        wrong: None,
                    },
                    then: wrong,
                    wrong: None,
                };
                lane.insert(Lane {
                    recipe: METHOD.recipe(),
                    cpu: METHOD.recipe().runner(&step, Target::Cpu).expect("a runner"),
                    devices: vec![Box::new(corrupt)],
                })
            }
            Some(lane) => {
                lane.advance(&step).expect("an update");
                lane
            }
        };
        let asked = queries(&arrays, 1, 0, 64);
        lane.compare(&step, &arrays, &asked, 1, &mut tallies)
            .expect("words that can be compared");
    }
    assert_eq!(tallies.cpu.different, 0);
    tallies.devices.remove(0)
}

#[test]
fn equal_results_are_equal() {
    let tally = found(None);
    assert_eq!(tally.different, 0, "{:?}", tally.first_difference);
    let words: u64 = tally.words.values().map(|words| words.compared).sum();
    assert_eq!(words, tally.compared);
    assert!(tally.pixels >= 2 * u64::from(SIZE.0 * SIZE.1));
}

#[test]
fn a_wrong_bit_of_anything_is_found_and_named() {
    for (kind, said) in [
        (Kind::Nodes, "refit: node "),
        (Kind::Samples, "sample: sampled light 32, light: "),
        (Kind::Pmfs, "pmf: pmf 32, pmf: "),
        (Kind::Pixels, "render: pixel 72, radiance[0]: "),
    ] {
        let tally = found(Some(kind));
        assert_eq!(
            (tally.different, tally.words[&kind].different),
            (1, 1),
            "{kind:?}"
        );
        let first = tally.first_difference.expect("a difference");
        let begins = format!("street {} frame 1 {said}", METHOD.name());
        assert!(first.starts_with(&begins), "{first}");
        assert!(
            first.contains("expected 0x") && first.contains("got 0x"),
            "{first}"
        );
    }
}
