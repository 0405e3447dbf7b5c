//! What metals reflect of light that meets them straight on.

use super::params::Params;
use super::shown;
use super::state::Loader;

/// Linear sRGB of metals by pbrt's names of their spectra: Fresnel's equations with the measured indices of refraction, rounded.
const METALS: [(&str, [f64; 3]); 7] = [
    ("CuZn", [0.91, 0.80, 0.44]),
    ("Cu", [0.93, 0.58, 0.44]),
    ("Au", [1.0, 0.76, 0.33]),
    ("Ag", [0.97, 0.96, 0.91]),
    ("Al", [0.91, 0.92, 0.92]),
    ("MgO", [0.07, 0.07, 0.08]),
    ("TiO2", [0.23, 0.23, 0.26]),
];

const COPPER: [f64; 3] = METALS[1].1;

impl Loader<'_> {
    /// The colour of a conductor by its indices of refraction, named `eta` and `k`; copper where there are none, as in pbrt.
    pub fn metal(&mut self, params: &Params, [eta, k]: [&str; 2]) -> [f64; 3] {
        let Some(param) = params.find(eta) else {
            return COPPER;
        };
        if let Some(name) = param.words.first() {
            if let Some((_, rgb)) = METALS.iter().find(|(symbol, _)| is_named(name, symbol)) {
                return *rgb;
            }
            let kind = format!("metal `{}` is not known, and taken as copper", shown(name));
            self.note(&params.place, kind);
            return COPPER;
        }
        let numbers = |name: &str| -> Option<[f64; 3]> {
            match *params.numbers(name) {
                [x] => Some([x; 3]),
                [r, g, b] => Some([r, g, b]),
                _ => None,
            }
        };
        let (Some(eta), Some(k)) = (numbers(eta), numbers(k)) else {
            self.note(&params.place, "metals by spectra in the file are taken as copper");
            return COPPER;
        };
        [0, 1, 2].map(|i| {
            let k2 = k[i] * k[i];
            let [low, high] = [eta[i] - 1.0, eta[i] + 1.0].map(|x| x * x + k2);
            if high > 0.0 {
                (low / high).clamp(0.0, 1.0)
            } else {
                0.0
            }
        })
    }
}

/// `metal-Au-eta`, or a file `metals/Au.eta.spd`.
fn is_named(name: &str, symbol: &str) -> bool {
    name.split(|c: char| !c.is_ascii_alphanumeric())
        .any(|part| part == symbol)
}
