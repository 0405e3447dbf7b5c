//! What is beyond all surfaces of a scene: an environment map and suns.

use std::sync::Arc;

use lightbvh::light::infinite::{DistantLight, Environment};
use lightbvh_kernels::shading::sky::SkyView;

/// An environment map and suns, as the renderer's buffers hold them.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// [`SkyView::suns`]: the first stands for the map.
    suns: Vec<DistantLight>,
    environment: Option<Arc<Environment>>,
}

impl Default for Sky {
    fn default() -> Self {
        Self::new(None, Vec::new())
    }
}

impl Sky {
    /// Of a map, if there is one, and suns.
    pub fn new(environment: Option<Arc<Environment>>, suns: Vec<DistantLight>) -> Self {
        let mean = environment.as_ref().map_or(0.0, |map| map.mean_luminance());
        let map = DistantLight {
            direction: [0.0; 3],
            irradiance: [mean * std::f32::consts::PI; 3],
        };
        Self {
            suns: std::iter::once(map).chain(suns).collect(),
            environment,
        }
    }

    /// As the kernels' functions take it.
    pub fn view(&self) -> SkyView<'_> {
        let (counts, radiance) = match &self.environment {
            Some(environment) => (environment.map().counts, environment.map().radiance),
            None => (&[][..], &[][..]),
        };
        SkyView {
            suns: &self.suns,
            counts,
            radiance,
        }
    }
}
