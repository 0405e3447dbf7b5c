//! Variance of one sample on a small scene, exactly: all lights with their pmfs.

extern crate std;

use std::vec::Vec;

use super::Bvh;
use crate::build::{BuildParams, Heuristic};
use crate::importance::{Eq4, ImportanceModel, Moments};
use crate::kit::scenes::sent;
use crate::kit::{Random, narrow, normalize, triangle, wide};
use crate::node::{CompactNode, LightNode, MomentNode};
use crate::{EmissiveTriangle, INVALID, Lights, ShadingPoint};

/// 300 triangles of up to half a metre in a room of 10 m, 20 points among them with normals of any direction.
fn scene() -> (Lights, Vec<ShadingPoint>) {
    let random = &mut Random(1);
    let light = |_| {
        let at = random.vector() * 5.0;
        let [b, c] = [0; 2].map(|_| at + random.vector() * 0.5);
        EmissiveTriangle {
            radiance: [1.1 + random.signed(); 3],
            ..triangle([at, b, c].map(|v| v.to_array()))
        }
    };
    let lights = Lights::new((0..300).map(light).collect()).expect("within the domain");
    let point = |_| {
        let n = narrow(normalize(wide(random.vector()))).to_array();
        let p = (random.vector() * 5.0).to_array();
        ShadingPoint { p, n }
    };
    (lights, (0..20).map(point).collect())
}

/// Relative variance of one sample, Σ f²/p / (Σ f)² − 1: the mean over the points.
fn variance<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(params: &BuildParams) -> f64 {
    let (lights, points) = scene();
    let bvh = Bvh::<N, I, W>::single_level(&lights, params);
    points
        .iter()
        .map(|point| relative(&bvh, &lights, point))
        .sum::<f64>()
        / points.len() as f64
}

/// That at one point; 0 where nothing arrives.
fn relative<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, I, W>,
    lights: &Lights,
    point: &ShadingPoint,
) -> f64 {
    let (mut sum, mut squares, mut pmfs) = (0.0, 0.0, 0.0);
    for (light, triangle) in (0..).zip(lights.triangles()) {
        let f = sent(triangle, point);
        let pmf = f64::from(bvh.pmf(point, light, INVALID));
        sum += f;
        squares += if f > 0.0 { f * f / pmf } else { 0.0 };
        pmfs += pmf;
    }
    assert!((pmfs - 1.0).abs() < 1e-5, "{pmfs} at {point:?}");
    if sum > 0.0 {
        squares / (sum * sum) - 1.0
    } else {
        0.0
    }
}

#[track_caller]
fn about(found: f64, known: f64) {
    assert!((found / known - 1.0).abs() < 0.1, "{found}, known {known}");
}

/// What was seen, with a tenth either way: less is a better importance or tree, whose variance is then the one to state.
#[test]
fn variance_of_moments() {
    about(
        variance::<MomentNode<8>, Moments, 8>(&BuildParams::BALANCED),
        0.728,
    );
}

#[test]
fn variance_of_eq_4() {
    let params = BuildParams::paper(Heuristic::Saoh);
    about(variance::<CompactNode<4>, Eq4, 4>(&params), 2.436);
}

/// Lights at the ends of the domain may be followed there.
#[test]
fn the_whole_domain_is_followed() {
    let far = crate::exact::pow2(40);
    let lamp = triangle([[-far, -far, -far], [far, far, -far], [far, -far, far]]);
    let lights = Lights::new(std::vec![lamp]).expect("within the domain");
    for mut bvh in [
        crate::LightBvh::single_level(&lights, &BuildParams::BALANCED),
        crate::LightBvh::two_level(&lights, &BuildParams::BALANCED),
    ] {
        bvh.follow(&lights).expect("the same lights");
        bvh.validate().expect("valid");
    }
}
