//! Cameras.

use super::super::transform::Affine;
use super::params::Params;
use super::state::Loader;
use super::{matrix, shown};

/// How many times as far away as half the image is high a camera stands that stands in for an orthographic one: lines that are
/// parallel meet at less than 2 degrees.
const FAR: f64 = 32.0;

/// What a camera shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lens {
    /// Of the image's shorter side, radians.
    Perspective(f64),
    /// Parallel lines stay so. Another one stands in for it, far behind it.
    Orthographic,
    /// Nothing that we have: only its handedness counts.
    Unknown,
}

/// Where frames are seen from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Camera {
    /// From the camera, which looks along its +z, +x right and +y up, to the world.
    pub to_world: Affine,
    pub lens: Lens,
    /// Least and greatest x, then y, in the plane where the shorter side goes from −1 to 1.
    pub window: Option<[f64; 4]>,
    /// Columns over rows, where the file says so.
    pub aspect: Option<f64>,
}

impl Camera {
    /// Vertical field of view, radians, and how far behind it the camera stands, in its own space, for a picture of that many
    /// columns and rows. None of a camera that is left out.
    pub fn field(&self, [columns, rows]: [f64; 2]) -> Option<(f64, f64)> {
        let aspect = self.aspect.unwrap_or(columns / rows);
        let half = match self.window {
            Some([_, _, low, high]) => 0.5 * (high - low).abs(),
            None if aspect < 1.0 => 1.0 / aspect,
            None => 1.0,
        };
        match self.lens {
            Lens::Perspective(fov) => Some((2.0 * libm::atan(half * libm::tan(0.5 * fov)), 0.0)),
            Lens::Orthographic => Some((2.0 * libm::atan(1.0 / FAR), FAR * half)),
            Lens::Unknown => None,
        }
    }
}

impl Loader<'_> {
    /// `Camera "kind"`.
    pub fn camera(&mut self, kind: &str, params: &Params) {
        let Some(to_world) = matrix::inverse(&self.graphics.ctm) else {
            self.note(
                &params.place,
                "the camera's transform flattens space; the scene is seen from elsewhere",
            );
            return;
        };
        self.spaces.insert(String::from("camera"), to_world);
        let mut degrees = params.number("fov").unwrap_or(90.0);
        match kind {
            "perspective" => {}
            "orthographic" => self.note(
                &params.place,
                "an orthographic camera is replaced by one in perspective, 32 times as far behind it as half the image is high",
            ),
            _ => {
                if kind == "realistic" {
                    // A lens of 50 mm in front of film of 24 mm.
                    degrees = 27.0;
                }
                let kind = format!(
                    "a camera of kind `{}` is taken as one in perspective",
                    shown(kind)
                );
                self.note(&params.place, kind);
            }
        }
        if params.number("lensradius").is_some_and(|radius| radius > 0.0) {
            self.note(&params.place, "the camera's lens is left out; all is sharp");
        }
        if let Some(half) = params.number("halffov") {
            degrees = 2.0 * half;
        }
        let is_angle = degrees > 0.0 && degrees < 180.0;
        let lens = match (kind, is_angle) {
            ("orthographic", _) => Lens::Orthographic,
            (_, true) => Lens::Perspective(degrees.to_radians()),
            (_, false) => Lens::Unknown,
        };
        if lens == Lens::Unknown {
            self.note(
                &params.place,
                format!("a camera whose `fov` is {degrees}, not between 0 and 180 degrees, is left out; the scene is seen from elsewhere"),
            );
        }
        let window = params.numbers("screenwindow").first_chunk().copied();
        let is_window = |[left, right, low, high]: &[f64; 4]| left != right && low != high;
        self.camera = Some(Camera {
            to_world,
            lens,
            window: window.filter(is_window),
            aspect: params.number("frameaspectratio").filter(|&aspect| aspect > 0.0),
        });
    }

    /// `Film`.
    pub fn film(&mut self, params: &Params) {
        let size = |name: &str, default: f64| {
            params
                .number(name)
                .filter(|&pixels| pixels >= 1.0)
                .unwrap_or(default)
        };
        self.film = [size("xresolution", 1280.0), size("yresolution", 720.0)];
    }
}
