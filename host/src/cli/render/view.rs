//! The shown part of a scene, and the camera.

use crate::error::HostError;
use crate::scene::Scene;

/// An axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Up {
    Y,
    Z,
}

impl Up {
    /// The scene of a file whose axis this is.
    pub(super) fn turn(self, scene: Scene) -> Result<Scene, HostError> {
        let name = scene.name().to_ascii_lowercase();
        match self {
            Self::Y => Ok(scene),
            Self::Z if name.ends_with(".obj") || name.ends_with(".ply") => Ok(scene.from_z_up()?),
            Self::Z => Err(HostError::Usage {
                option: "--up z",
                needs: "a .obj or .ply file; in others it is known which way is up",
            }),
        }
    }
}

/// A camera of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) enum CameraName {
    /// By its number.
    Own(usize),
    /// Chosen by what there is to see.
    Auto,
}

pub(super) fn camera(word: &str) -> Result<CameraName, String> {
    match word {
        "auto" => Ok(CameraName::Auto),
        _ => word
            .parse()
            .map(CameraName::Own)
            .map_err(|_| String::from("give a number from 0, or auto")),
    }
}

/// The scene as that camera sees it.
pub(super) fn seen_by(scene: Scene, camera: CameraName) -> Result<Scene, HostError> {
    let cameras = scene.data().cameras.len();
    let camera = match camera {
        CameraName::Own(0) => return Ok(scene),
        CameraName::Own(number) => number,
        CameraName::Auto => {
            let mut data = scene.into_data();
            data.cameras.clear();
            return Ok(Scene::new(data)?);
        }
    };
    if camera >= cameras {
        let expected = match cameras {
            0 => String::from(
                "a scene with cameras, and it has none; leave the option out, or give --look-from and --look-at",
            ),
            _ => format!("0 to {}: the scene has {cameras}", cameras - 1),
        };
        return Err(HostError::Refused {
            option: "--camera",
            value: camera.to_string(),
            problem: format!("is out of range: expected {expected}"),
        });
    }
    let mut data = scene.into_data();
    data.cameras.swap(0, camera);
    Ok(Scene::new(data)?)
}

/// Refuses a view of the place that the eye is at.
pub(super) fn check_places(from: [f32; 3], at: [f32; 3]) -> Result<(), HostError> {
    if from == at {
        return Err(HostError::Usage {
            option: "--look-at",
            needs: "another place than --look-from",
        });
    }
    Ok(())
}

/// The options that stand for the camera that was chosen for a scene without one.
pub(super) fn camera_words(scene: &Scene) -> Option<String> {
    let (from, at, yfov) = scene.chosen_camera()?;
    let place = |p: [f32; 3]| p.map(|x| x.to_string()).join(",");
    let fov = yfov.to_degrees().round();
    Some(format!(
        "--look-from {} --look-at {} --fov {fov}",
        place(from),
        place(at)
    ))
}
