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
    use super::super::builder::SceneBuilder;
    use super::super::shapes::Shape;
    use crate::Scene;

    #[test]
    fn what_was_up_is_up() {
        let mut b = SceneBuilder::new("test", [0.0; 3]);
        let grey = b.matte("grey", [0.5; 3], 1.0);
        // Its front towards +Z.
        let mut flat = Shape::new();
        flat.quad([[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [3.0, 2.0, 1.0], [0.0, 2.0, 1.0]]);
        let mesh = b.mesh("flat", &[(&flat, grey)]);
        b.put("flat", None, [0.0, 0.0, 10.0], mesh);
        let turned = b
            .finish()
            .and_then(Scene::from_z_up)
            .expect("a sound scene")
            .frame(0);
        let first = turned.triangles[0].p;
        assert_eq!(first, [[0.0, 11.0, 0.0], [3.0, 11.0, 0.0], [3.0, 11.0, -2.0]]);
        assert_eq!(
            crate::vector::normal(first),
            [0.0, 6.0, 0.0],
            "the front is above"
        );
    }
}
