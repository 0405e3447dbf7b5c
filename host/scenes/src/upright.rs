//! Files whose z axis points up.

use super::error::SceneError;
use super::model::Scene;
use super::transform::Transform;

impl Scene {
    /// The scene of a file whose +Z is up, turned so that +Y is: (x, y, z) lies at (x, z, −y) then. For scenes whose roots are
    /// not animated, as OBJ's and PLY's are.
    ///
    /// # Errors
    /// As [`Scene::new`].
    pub fn from_z_up(self) -> Result<Self, SceneError> {
        let mut data = self.into_data();
        for node in data.nodes.iter_mut().filter(|node| node.parent.is_none()) {
            let columns = node.transform.affine().columns;
            node.transform = Transform::Matrix(columns.map(|[x, y, z]| [x as f32, z as f32, -y as f32]));
        }
        Self::new(data)
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::{Mesh, Node, Primitive, SceneData};
    use super::super::{Material, Scene, Transform};

    #[test]
    fn what_was_up_is_up() {
        let scene = Scene::new(SceneData {
            name: String::from("test"),
            nodes: vec![Node {
                mesh: Some(0),
                transform: Transform::at([0.0, 0.0, 10.0]),
                ..Node::default()
            }],
            meshes: vec![Mesh {
                name: String::new(),
                primitives: vec![Primitive {
                    // Its front towards +Z.
                    positions: vec![[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 2.0, 1.0]],
                    triangles: vec![[0, 1, 2]],
                    ..Primitive::default()
                }],
            }],
            materials: vec![Material::default()],
            ..SceneData::default()
        });
        let turned = scene.and_then(Scene::from_z_up).expect("a sound scene").frame(0);
        assert_eq!(
            turned.triangles[0].p,
            [[0.0, 11.0, 0.0], [3.0, 11.0, 0.0], [0.0, 11.0, -2.0]]
        );
        let n = crate::vector::normal(turned.triangles[0].p);
        assert_eq!(n, [0.0, 6.0, 0.0], "the front is above");
    }
}
