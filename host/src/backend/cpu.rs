//! The passes on the CPU, over all cores of the current rayon pool.

use lightbvh::SampledLight;
use lightbvh_kernels::bvh::{Compiled, TreeOf, Triangles, WIDTH};
use lightbvh_kernels::query::{Query, pmf_query, sample_query};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::emitters::Emitters;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::Scene;
use rayon::prelude::*;

use super::batches::in_batches;
use super::{Backend, BackendError, Bvh, Follow, Held, Integrator, Sampler, SceneArrays, Timed};
use crate::render::{render, render_path};
use crate::scene::SceneLight;

/// The CPU as a backend: the reference that devices are compared with.
pub struct CpuBackend<C: Compiled<W> = Triangles, const W: usize = WIDTH> {
    bvh: Bvh<C, W>,
}

impl<C: Compiled<W>, const W: usize> CpuBackend<C, W> {
    /// Takes a BVH.
    pub fn new(bvh: Bvh<C, W>) -> Self {
        Self { bvh }
    }

    /// The BVH as last refitted.
    pub fn bvh(&self) -> &Bvh<C, W> {
        &self.bvh
    }

    /// The BVH, to bring it to another frame; it must be refitted before the next pass.
    pub fn bvh_mut(&mut self) -> &mut Bvh<C, W> {
        &mut self.bvh
    }
}

impl<C: Compiled<W, Light: SceneLight>, const W: usize> Backend<C::Light> for CpuBackend<C, W> {
    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        Ok(self.query(queries, |tree, query| sample_query::<C, W>(tree, query)))
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        Ok(self.query(queries, |tree, query| pmf_query::<C, W>(tree, query)))
    }

    fn render(
        &mut self,
        scene: &SceneArrays<C::Light>,
        params: &RenderParams,
        sampler: Sampler,
        integrator: Integrator,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let view = self.view(scene, sampler);
        let camera = &scene.camera;
        in_batches(params, integrator, |params| {
            Ok(Timed::of(|| match sampler {
                Sampler::Uniform => {
                    let count = scene.lights.all().len() as u32;
                    image(&view, camera, params, integrator, &Uniform { count })
                }
                Sampler::Power => {
                    let thresholds = &scene.thresholds;
                    image(&view, camera, params, integrator, &Power { thresholds })
                }
                Sampler::SingleLevel | Sampler::TwoLevel => {
                    image(&view, camera, params, integrator, &self.bvh.tree())
                }
            }))
        })
    }
}

fn image<L: SceneLight, P: PickLight + Sync>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    integrator: Integrator,
    picker: &P,
) -> Vec<[f32; 3]> {
    match integrator {
        Integrator::Direct => render(scene, camera, params, picker),
        Integrator::Path { bounces } => render_path(scene, camera, params, bounces, picker),
    }
}

impl<C: Compiled<W, Light: SceneLight>, const W: usize> Follow<C, W> for CpuBackend<C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        let mut own = bvh.clone();
        let refitted = Timed::of(|| own.refit());
        self.bvh = own;
        Ok(refitted)
    }

    fn held(&mut self, _: &Bvh<C, W>) -> Result<Vec<Held>, BackendError> {
        Ok(super::held(&self.bvh))
    }
}

impl<C: Compiled<W, Light: SceneLight>, const W: usize> CpuBackend<C, W> {
    /// A scene with the lights that `sampler` chooses among: a light BVH knows where its own are.
    fn view<'a>(&'a self, scene: &'a SceneArrays<C::Light>, sampler: Sampler) -> Scene<'a, C::Light> {
        scene.lit_by(match sampler.needs_bvh() {
            true => Emitters {
                lights: self.bvh.view().lights(),
                instances: self.bvh.tree().instances,
            },
            false => scene.emitters(),
        })
    }

    /// The `answer` to each query.
    fn query<T: Send>(
        &self,
        queries: &[Query],
        answer: impl Fn(&TreeOf<'_, C, W>, &Query) -> T + Sync,
    ) -> Timed<Vec<T>> {
        let tree = self.bvh.tree();
        Timed::of(|| {
            let queries = queries.par_iter().with_min_len(256);
            queries.map(|query| answer(&tree, query)).collect()
        })
    }
}
