//! Measurements of all commands: turns, medians with their intervals, points, the light that arrives at them, references.

pub(super) mod interval;
pub(super) mod irradiance;
pub(super) mod points;
pub(super) mod reference;
pub(super) mod times;

pub(super) use crate::metrics::variance;

use crate::metrics::mean;

/// Said where no figure is known.
pub(super) const NOT_MEASURED: &str =
    "no point receives light of a light that a tree would hold, and nothing is measured";

/// The mean; `None` of no values.
pub(super) fn mean_of(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| mean(values))
}

#[cfg(test)]
pub(super) mod tests {
    use crate::scene::{Material, Mesh, Node, Primitive, Scene, SceneData};

    /// A floor that faces +z below a lamp, which shines down on the floor, or up, where nothing is.
    pub fn room(is_lit: bool) -> Scene {
        let triangle = |positions: [[f32; 3]; 3], material| Primitive {
            positions: positions.to_vec(),
            triangles: vec![[0, 1, 2]],
            material,
            ..Primitive::default()
        };
        let floor = triangle([[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]], 0);
        let mut lamp = triangle([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]], 1);
        if is_lit {
            lamp.positions.swap(0, 1);
        }
        Scene::new(SceneData {
            name: String::from("room"),
            nodes: vec![Node {
                mesh: Some(0),
                ..Node::default()
            }],
            meshes: vec![Mesh {
                name: String::new(),
                primitives: vec![floor, lamp],
            }],
            materials: [0.0, 1.0]
                .map(|radiance| Material {
                    radiance: [radiance; 3],
                    ..Material::default()
                })
                .to_vec(),
            ..SceneData::default()
        })
        .expect("valid")
    }
}
