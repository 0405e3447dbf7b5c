//! Lights without area: points, spots, distant lights.

use super::super::analytic::AnalyticKind;
use super::super::transform::unit_or;
use super::params::Params;
use super::shown;
use super::state::Loader;
use crate::vector::sub;

/// A light that stands in the world by itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Small {
    pub name: &'static str,
    pub kind: AnalyticKind,
    /// Where it stands; of no meaning for distant lights.
    pub at: [f64; 3],
    /// Where it shines to, of any length.
    pub towards: [f64; 3],
    /// The first axis of a disc; zero of what has none.
    pub across: [f64; 3],
    /// As [`super::super::AnalyticLight::color`] times its intensity.
    pub emission: [f64; 3],
}

impl Loader<'_> {
    /// `LightSource "kind"`.
    pub fn light(&mut self, kind: &str, params: &Params) {
        match kind {
            "point" | "goniometric" => self.point(kind, params),
            "spot" => self.spot(params),
            "distant" => self.distant(params),
            "infinite" | "exinfinite" => self.infinite_light(params),
            _ => self.note(
                &params.place,
                format!("lights of kind `{}` are left out", shown(kind)),
            ),
        }
    }

    /// Colour times scale, and to the power where one is given: `whole` is the solid angle that holds all the light, sr.
    fn intensity(&mut self, params: &Params, whole: f64) -> [f64; 3] {
        let color = self.light_color(params, &["I"]);
        let scale = self.scale(params);
        let power = self.positive(params, "power");
        let by = power.map_or(1.0, |power| power / whole);
        [0, 1, 2].map(|i| color[i] * scale[i] * by)
    }

    /// A quantity of light, where one is given; what is not above zero is left out.
    pub fn positive(&mut self, params: &Params, name: &str) -> Option<f64> {
        let given = params.number(name)?;
        if given <= 0.0 {
            self.note(
                &params.place,
                format!("`{name}` of a light is {given}, not above 0, and left out"),
            );
        }
        Some(given).filter(|&given| given > 0.0)
    }

    fn point(&mut self, kind: &str, params: &Params) {
        if kind == "goniometric" {
            self.note(
                &params.place,
                "goniometric lights shine in all directions alike, without their pictures",
            );
        }
        let emission = self.intensity(params, 4.0 * std::f64::consts::PI);
        let at = params.point("from").unwrap_or([0.0; 3]);
        self.small.push(Small {
            name: "point",
            kind: AnalyticKind::Point,
            at: self.graphics.ctm.point(at),
            towards: [0.0, 0.0, -1.0],
            across: [0.0; 3],
            emission,
        });
    }

    fn spot(&mut self, params: &Params) {
        let angle = |name: &str, default: f64| params.number(name).unwrap_or(default);
        let outer = angle("coneangle", 30.0);
        let inner = outer - angle("conedeltaangle", angle("conedelta", 5.0));
        let [inner, outer] = [inner, outer].map(|degrees| degrees.to_radians());
        let [start, end] = [inner.max(0.0), outer].map(libm::cos);
        let whole = std::f64::consts::TAU * ((1.0 - start) + 0.5 * (start - end));
        if !(outer > 0.0 && whole > 0.0) {
            self.note(&params.place, "spots whose cone is none are left out");
            return;
        }
        if outer > std::f64::consts::FRAC_PI_2 {
            self.note(&params.place, "spots wider than a right angle are cut there");
        }
        let Some(towards) = self.towards(params) else {
            return;
        };
        let emission = self.intensity(params, whole);
        let outer = outer.min(std::f64::consts::FRAC_PI_2);
        let from = params.point("from").unwrap_or([0.0; 3]);
        self.small.push(Small {
            name: "spot",
            kind: AnalyticKind::Spot {
                inner: inner.clamp(0.0, outer) as f32,
                // Rounded to no more than a right angle.
                outer: (outer as f32).min(std::f32::consts::FRAC_PI_2),
            },
            at: self.graphics.ctm.point(from),
            towards,
            across: [0.0; 3],
            emission,
        });
    }

    /// Where a light shines to in the world; `None` where that is nowhere.
    fn towards(&mut self, params: &Params) -> Option<[f64; 3]> {
        let from = params.point("from").unwrap_or([0.0; 3]);
        let to = params.point("to").unwrap_or([0.0, 0.0, 1.0]);
        let towards = self.graphics.ctm.vector(sub(to, from));
        if unit_or(towards, [0.0; 3]) == [0.0; 3] {
            self.note(
                &params.place,
                "spots and distant lights whose `from` is at their `to` shine nowhere, and are left out; move one of the two",
            );
            return None;
        }
        Some(towards)
    }

    fn distant(&mut self, params: &Params) {
        let Some(towards) = self.towards(params) else {
            return;
        };
        let color = self.light_color(params, &["L"]);
        let scale = self.scale(params);
        let given = self.positive(params, "illuminance");
        let by = given.unwrap_or(1.0);
        self.small.push(Small {
            name: "distant",
            kind: AnalyticKind::Directional,
            at: [0.0; 3],
            towards,
            across: [0.0; 3],
            emission: [0, 1, 2].map(|i| color[i] * scale[i] * by),
        });
    }
}
