//! From what a file said to a scene.

use lightbvh_kernels::shading::sky::MAX_SUNS;

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::error::SceneError;
use super::super::model::{Camera, Node, Scene};
use super::super::notes::Place;
use super::super::transform::{Affine, Transform, unit_or};
use super::light::Small;
use super::matrix;
use super::state::Loader;
use crate::vector::{cross, dot};

impl Loader<'_> {
    /// The scene, checked.
    pub fn finish(mut self) -> Result<Scene, SceneError> {
        let place = Place {
            file: self.data.name.as_str().into(),
            line: 0,
        };
        if !self.stack.is_empty() {
            self.note(&place, "the file ends within attributes or an object");
        }
        // The picture of a camera is seen as pbrt shows it if the space of its view is left-handed; ours are right-handed.
        let is_mirrored = self
            .camera
            .as_ref()
            .is_none_or(|camera| !camera.to_world.mirrors());
        let to_scene = matrix::scaling([1.0, 1.0, if is_mirrored { -1.0 } else { 1.0 }]);
        for placed in std::mem::take(&mut self.placed) {
            self.data.nodes.push(Node {
                name: placed.name.to_string(),
                transform: narrowed(&to_scene.then_after(&placed.map)),
                mesh: Some(placed.mesh),
                ..Node::default()
            });
        }
        let mut suns = 0;
        for light in std::mem::take(&mut self.small) {
            if light.emission.iter().all(|&x| x <= 0.0) {
                continue;
            }
            if light.kind == AnalyticKind::Directional {
                suns += 1;
                if suns > MAX_SUNS {
                    self.note(&place, format!("distant lights are left out after {MAX_SUNS}"));
                    continue;
                }
            }
            let node = self.data.nodes.len() as u32;
            self.data.nodes.push(Node {
                name: light.name.to_owned(),
                transform: narrowed(&stand(&light, &to_scene)),
                ..Node::default()
            });
            self.data.analytic.push(AnalyticLight {
                name: light.name.to_owned(),
                node,
                kind: light.kind,
                color: light.emission.map(|x| x as f32),
                intensity: 1.0,
                range: None,
            });
        }
        // A mirror is its own inverse.
        self.data.environment = self.environment(&to_scene);
        let camera = self.camera.take();
        let field = camera.as_ref().and_then(|camera| camera.field(self.film));
        if let (Some(camera), Some((yfov, behind))) = (camera, field) {
            let yfov = yfov as f32;
            let to_scene = to_scene.then_after(&camera.to_world);
            let [right, up, forward, _] = to_scene.columns;
            let eye = to_scene.point([0.0, 0.0, -behind]);
            let unit = |v: [f64; 3]| unit_or(v, [0.0; 3]);
            let view = Affine {
                columns: [unit(right), unit(up), unit(forward).map(|x| -x), eye],
            };
            let node = self.data.nodes.len() as u32;
            self.data.nodes.push(Node {
                name: String::from("camera"),
                transform: narrowed(&view),
                ..Node::default()
            });
            self.data.cameras.push(Camera { node, yfov });
        }
        self.data.pictures = self.pictures.into_kept();
        self.data.warnings = self.notes.into_warnings();
        Scene::new(self.data)
    }
}

/// The place of a light whose front is its −Z.
fn stand(light: &Small, to_scene: &Affine) -> Affine {
    let back = unit_or(to_scene.vector(light.towards).map(|x| -x), [0.0, 0.0, 1.0]);
    let across = to_scene.vector(light.across);
    // Any axis will do for what is round.
    let least = (0..3).min_by(|&a, &b| back[a].abs().total_cmp(&back[b].abs()));
    let mut any = [0.0; 3];
    any[least.unwrap_or(0)] = 1.0;
    let across = if dot(across, across) > 0.0 {
        across
    } else {
        cross(any, back)
    };
    let x = unit_or(across, [1.0, 0.0, 0.0]);
    let y = unit_or(cross(back, x), [0.0, 1.0, 0.0]);
    Affine {
        columns: [x, y, back, to_scene.point(light.at)],
    }
}

fn narrowed(map: &Affine) -> Transform {
    Transform::Matrix(map.columns.map(|column| column.map(|x| x as f32)))
}
