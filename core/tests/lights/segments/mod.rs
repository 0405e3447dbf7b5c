//! A piece of a ray through a volume, against integrals along it in `f64`.

mod places;
mod weights;

use crate::kit::{self, Random, Wide, cross, dot, length, minus, rooms, wide};
use lightbvh::EmissiveTriangle;
use lightbvh::importance::RaySegment;

impl Random {
    /// About `length` long, within about `reach` of the origin.
    fn segment(&mut self, reach: f32, length: f32) -> RaySegment {
        let (from, along) = (self.vector(reach), self.unit_vector());
        RaySegment {
            from,
            to: core::array::from_fn(|k| from[k] + along[k] * length),
        }
    }
}

fn at(segment: &RaySegment, part: f64) -> Wide {
    let (from, to) = (wide(segment.from), wide(segment.to));
    core::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
}

/// The mean of `f` over the segment, steps even in the angle that `center` sees: parts of the segment, by the tangent.
fn mean_along(segment: &RaySegment, center: Wide, steps: u32, f: impl Fn(Wide) -> f64) -> f64 {
    let (from, to) = (wide(segment.from), wide(segment.to));
    let chord = minus(to, from);
    let len = length(chord);
    let along = chord.map(|x| x / len);
    let foot = dot(minus(center, from), along);
    let across: Wide = core::array::from_fn(|k| center[k] - from[k] - along[k] * foot);
    let d = length(across).max(1e-6 * len);
    let (first, last) = ((-foot / d).atan(), ((len - foot) / d).atan());
    let step = (last - first) / f64::from(steps);
    let mut sum = 0.0;
    for k in 0..steps {
        let t = (first + step * (f64::from(k) + 0.5)).tan();
        let part = (t * d + foot) / len;
        sum += f(at(segment, part)) * d * (1.0 + t * t) * step / len;
    }
    sum
}

/// What the segment receives of a triangle, W/m: the fluence over all directions along it, from `N`² pieces of the triangle.
fn received<const N: usize>(triangle: &EmissiveTriangle, segment: &RaySegment, steps: u32) -> f64 {
    let (across, places) = kit::pieces::<N>(triangle);
    let mut sum = 0.0;
    for place in places {
        sum += mean_along(segment, place, steps, |p| {
            let to = minus(p, place);
            let d2 = dot(to, to);
            let emitted = kit::emitted(triangle, 0.5 * dot(across, to) / d2.sqrt());
            f64::from(triangle.radiance[0]) * emitted / d2
        });
    }
    sum / (N * N) as f64 * length(minus(wide(segment.to), wide(segment.from)))
}
