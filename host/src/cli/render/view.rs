//! The shown part of a scene, and the camera.

use crate::error::HostError;
use crate::scene::Scene;

/// The scene as the camera of this number sees it.
pub(super) fn seen_by(scene: Scene, camera: usize) -> Result<Scene, HostError> {
    let cameras = scene.data().cameras.len();
    if camera == 0 {
        return Ok(scene);
    }
    if camera >= cameras {
        return Err(HostError::Refused {
            option: "--camera",
            value: camera.to_string(),
            problem: format!(
                "is out of range: expected 0 to {}: the scene has {cameras}",
                cameras - 1
            ),
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
