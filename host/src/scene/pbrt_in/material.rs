//! Materials of pbrt as base colour, metal, roughness and what goes through.

use super::super::model::Material;
use super::super::paint::{Opacity, Paint};
use super::params::Params;
use super::shown;
use super::state::Loader;

impl Loader<'_> {
    /// `Material "kind"`; gives its index.
    pub fn material(&mut self, name: &str, kind: &str, params: &Params) -> u32 {
        let mut material = match kind {
            "diffuse" | "matte" => self.base(params, &["reflectance", "Kd"], 0.5),
            "coateddiffuse" | "plastic" | "substrate" => {
                let base = self.base(params, &["reflectance", "Kd"], 0.5);
                self.glossy(params, base, &["roughness", "uroughness"], 0.0)
            }
            "uber" | "translucent" => {
                let base = self.base(params, &["Kd"], 0.25);
                self.glossy(params, base, &["roughness", "uroughness"], 0.1)
            }
            "disney" | "principled" => {
                let mut base = self.base(params, &["color", "basecolor"], 0.5);
                base.metallic = self.surface_number(params, &["metallic"]).unwrap_or(0.0) as f32;
                base.roughness = self.surface_number(params, &["roughness"]).unwrap_or(0.5) as f32;
                base.transmission = self.surface_number(params, &["spectrans"]).unwrap_or(0.0) as f32;
                base
            }
            "conductor" | "metal" => {
                self.conductor(params, ["reflectance", "eta", "k"], &["roughness", "uroughness"])
            }
            "coatedconductor" => {
                let names = ["reflectance", "conductor.eta", "conductor.k"];
                let own = ["conductor.roughness", "conductor.uroughness"];
                self.conductor(params, names, &own)
            }
            "mirror" => {
                let mut base = self.base(params, &["Kr"], 0.9);
                (base.metallic, base.roughness) = (1.0, 0.0);
                base
            }
            "diffusetransmission" => {
                let mut base = self.base(params, &["reflectance"], 0.25);
                let scale = params.number("scale").unwrap_or(1.0);
                base.base_color = base.base_color.map(|x| (x * scale as f32).clamp(0.0, 1.0));
                base.paint = base.paint.filter(|_| scale == 1.0);
                self.note(
                    &params.place,
                    "what diffuse surfaces let through is left out; they reflect",
                );
                base
            }
            "dielectric" | "thindielectric" | "glass" => Material {
                base_color: [1.0; 3],
                roughness: 0.0,
                transmission: 1.0,
                ..Material::default()
            },
            "interface" | "none" | "" => Material {
                transmission: 1.0,
                ..Material::default()
            },
            "mix" => self.mixed(params),
            "subsurface" | "kdsubsurface" => {
                self.note(
                    &params.place,
                    format!("material `{kind}` is taken as a glossy surface of its colour"),
                );
                let base = self.base(params, &["reflectance", "Kd"], 0.5);
                self.glossy(params, base, &["roughness", "uroughness"], 0.0)
            }
            "hair" => {
                self.note(&params.place, "material `hair` is taken as a diffuse surface");
                let mut base = self.base(params, &["reflectance", "color"], 0.1);
                base.roughness = 0.5;
                base
            }
            _ => {
                self.note(
                    &params.place,
                    format!("material `{}` is taken as diffuse grey", shown(kind)),
                );
                Material {
                    base_color: [0.5; 3],
                    ..Material::default()
                }
            }
        };
        for (what, map) in [
            ("displacement", "bumps"),
            ("bumpmap", "bumps"),
            ("normalmap", "normals"),
        ] {
            if params.find(what).is_some() {
                self.note(&params.place, format!("textures of {map} are left out"));
            }
        }
        if material.is_clear() {
            self.note(
                &params.place,
                format!("surfaces of material `{kind}` are left out unless they emit"),
            );
        }
        if let Some(paint) = &mut material.paint {
            (paint.metallic, paint.roughness) = (material.metallic, material.roughness);
        }
        if material.is_clear() {
            material.paint = None;
        }
        // The same words in every order of materials.
        material.name = if name.is_empty() {
            kind.to_owned()
        } else {
            name.to_owned()
        };
        self.add_material(material)
    }

    /// A diffuse surface, with the picture that it may have.
    fn base(&mut self, params: &Params, names: &[&str], default: f32) -> Material {
        let rgb = self.surface_color(params, names);
        Material {
            base_color: rgb.map_or([default; 3], |rgb| rgb.map(|x| x as f32)),
            paint: self.picture_of(params, names),
            ..Material::default()
        }
    }

    /// The picture of a surface's colour. [`material`](Self::material) brings the rest to what the material is.
    fn picture_of(&mut self, params: &Params, names: &[&str]) -> Option<Paint> {
        let param = params.find_any(names).filter(|param| param.kind == "texture")?;
        let (texture, factor) = self.textures.get(param.words.first()?)?.shown?;
        let is_factor = factor.iter().all(|x| (0.0..=1.0).contains(x));
        if !is_factor {
            self.note(
                &params.place,
                "textures that are made brighter are replaced by their mean colours",
            );
            return None;
        }
        let [r, g, b] = factor.map(|x| x as f32);
        Some(Paint {
            base: [r, g, b, 1.0],
            metallic: 0.0,
            roughness: 1.0,
            bump: 0.0,
            radiance: [0.0; 3],
            base_texture: Some(texture),
            rough_texture: None,
            bump_texture: None,
            glow_texture: None,
            opacity: Opacity::Opaque,
            transmission: 0.0,
        })
    }

    /// With the roughness that pbrt's α has.
    fn glossy(&mut self, params: &Params, mut base: Material, names: &[&str], default: f64) -> Material {
        let roughness = self.surface_number(params, names).unwrap_or(default).max(0.0);
        let is_remapped = params.string("remaproughness") != Some("false");
        // pbrt's `RoughnessToAlpha` is a square root, and so is ours of α.
        let alpha = if is_remapped { roughness.sqrt() } else { roughness };
        base.roughness = alpha.sqrt().min(1.0) as f32;
        base
    }

    fn conductor(
        &mut self,
        params: &Params,
        [reflectance, eta, k]: [&str; 3],
        roughness: &[&str],
    ) -> Material {
        let rgb = match self.surface_color(params, &[reflectance]) {
            Some(rgb) => rgb,
            None => self.metal(params, [eta, k]),
        };
        let base = Material {
            base_color: rgb.map(|x| x as f32),
            metallic: 1.0,
            paint: self.picture_of(params, &[reflectance]),
            ..Material::default()
        };
        self.glossy(params, base, roughness, 0.0)
    }

    /// The mean of two materials.
    fn mixed(&mut self, params: &Params) -> Material {
        let names: Vec<String> = match params.find("materials") {
            Some(param) => param.words.clone(),
            None => ["namedmaterial1", "namedmaterial2"]
                .iter()
                .filter_map(|name| params.string(name).map(str::to_owned))
                .collect(),
        };
        let found: Vec<Material> = names
            .iter()
            .filter_map(|name| self.materials.get(name))
            .map(|&index| self.data.materials[index as usize].clone())
            .collect();
        let [a, b] = &found[..] else {
            self.note(
                &params.place,
                "a mixed material whose parts are not defined is taken as grey",
            );
            return Material {
                base_color: [0.5; 3],
                ..Material::default()
            };
        };
        self.note(
            &params.place,
            "mixed materials are replaced by the means of what they mix",
        );
        let t = self.surface_number(params, &["amount"]).unwrap_or(0.5) as f32;
        let mix = |x: f32, y: f32| (1.0 - t) * x + t * y;
        Material {
            base_color: [0, 1, 2].map(|i| mix(a.base_color[i], b.base_color[i]).clamp(0.0, 1.0)),
            metallic: mix(a.metallic, b.metallic).clamp(0.0, 1.0),
            roughness: mix(a.roughness, b.roughness).clamp(0.0, 1.0),
            transmission: mix(a.transmission, b.transmission).clamp(0.0, 1.0),
            ..Material::default()
        }
    }
}
