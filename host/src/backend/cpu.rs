//! The passes on the CPU, over all cores of the current rayon pool.

use lightbvh::SampledLight;
use lightbvh_kernels::bvh::{Choice, Standard, TreeOf, WIDTH};
use lightbvh_kernels::query::{Query, pmf_query, sample_query};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::emitters::Emitters;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::Scene;
use rayon::prelude::*;

use super::batches::in_batches;
use super::{Backend, BackendError, Bvh, Follow, Integrator, Sampler, SceneArrays, Timed, node_record};
use crate::render::{render, render_path};
use crate::scene::SceneLight;
use crate::words::Record;

/// The CPU as a backend: the reference that devices are compared with.
pub struct CpuBackend<C: Choice<W> = Standard, const W: usize = WIDTH> {
    bvh: Bvh<C, W>,
}

impl<C: Choice<W>, const W: usize> CpuBackend<C, W> {
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

impl<C: Choice<W, Light: SceneLight>, const W: usize> Backend<C::Light> for CpuBackend<C, W> {
    fn node_record(&self) -> Record {
        node_record::<C::Node>()
    }

    fn nodes(&mut self) -> Result<Vec<u32>, BackendError> {
        Ok(self.words())
    }

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
        in_batches(params, integrator, |params| {
            let image = Image {
                scene: &view,
                camera: &scene.camera,
                params,
                integrator,
            };
            Ok(Timed::of(|| match sampler {
                Sampler::Uniform => image.by(&Uniform {
                    count: scene.lights.triangles().len() as u32,
                }),
                Sampler::Power => image.by(&Power {
                    thresholds: &scene.thresholds,
                }),
                Sampler::SingleLevel | Sampler::TwoLevel => image.by(&self.bvh.tree()),
            }))
        })
    }
}

/// An image, but for how its lights are chosen.
struct Image<'a, 's, L: SceneLight> {
    scene: &'a Scene<'s, L>,
    camera: &'a Camera,
    params: &'a RenderParams,
    integrator: Integrator,
}

impl<L: SceneLight> Image<'_, '_, L> {
    /// The image with lights from `picker`.
    fn by<P: PickLight + Sync>(&self, picker: &P) -> Vec<[f32; 3]> {
        match self.integrator {
            Integrator::Direct => render(self.scene, self.camera, self.params, picker),
            Integrator::Path { bounces } => {
                render_path(self.scene, self.camera, self.params, bounces, picker)
            }
        }
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Follow<C, W> for CpuBackend<C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        let mut own = bvh.clone();
        let refitted = Timed::of(|| own.refit());
        self.bvh = own;
        Ok(refitted)
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> CpuBackend<C, W> {
    /// A scene with the lights that `sampler` chooses among: a light BVH knows where its own are.
    fn view<'a>(&'a self, scene: &'a SceneArrays<C::Light>, sampler: Sampler) -> Scene<'a, C::Light> {
        scene.lit_by(match sampler.needs_bvh() {
            true => Emitters {
                triangles: self.bvh.triangles(),
                instances: self.bvh.tree().instances,
            },
            false => scene.emitters(),
        })
    }

    /// The words of all nodes.
    fn words(&self) -> Vec<u32> {
        super::node_words(&self.bvh)
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
