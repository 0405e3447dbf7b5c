//! The camera of a frame, from a node or looking at a place, and which way is up.

use glam::DAffine3;

use super::error::SceneError;
use super::model::{Camera, Node, Scene};
use super::transform::{Transform, unit_or};
use crate::vector::{cross, sub};

/// Where an image is seen from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Position, metres.
    pub eye: [f32; 3],
    /// Unit vector to the right of the image.
    pub right: [f32; 3],
    /// Unit vector to the top of the image.
    pub up: [f32; 3],
    /// Unit vector into the image.
    pub forward: [f32; 3],
    /// Vertical field of view, radians, above 0 and below pi.
    pub yfov: f32,
}

impl Scene {
    /// Where the frames are seen from of a scene that brings no camera, once a frame has been made: eye, a place that it looks
    /// at, both metres, and the vertical field of view in radians; what [`seen_from`](Self::seen_from) takes.
    pub fn chosen_camera(&self) -> Option<([f32; 3], [f32; 3], f32)> {
        let view = self.default_camera.get()?;
        // As far away as keeps the direction where the eye is far from the origin.
        let far = view.eye.iter().fold(1.0_f32, |far, x| far.max(x.abs()));
        let target = [0, 1, 2].map(|axis| view.eye[axis] + far * view.forward[axis]);
        Some((view.eye, target, view.yfov))
    }

    /// The scene as a camera at `eye` sees it that looks at `target`, both metres, with a vertical field of view of `yfov`
    /// radians; +Y is up. Its own cameras are gone. Where both are one place it looks along −Z.
    ///
    /// # Errors
    /// As [`Scene::new`]: places beyond 2^40 m, fields of view that are none.
    pub fn seen_from(self, eye: [f32; 3], target: [f32; 3], yfov: f32) -> Result<Self, SceneError> {
        let mut data = self.into_data();
        let [from, to] = [eye, target].map(|p| p.map(f64::from));
        let forward = unit_or(sub(to, from), [0.0, 0.0, -1.0]);
        let view = looking(from, forward, [0.0, 1.0, 0.0], yfov);
        let columns = [view.right, view.up, view.forward.map(|x| -x), eye];
        data.cameras = vec![Camera {
            node: data.nodes.len() as u32,
            yfov,
        }];
        data.nodes.push(Node {
            name: String::from("camera"),
            transform: Transform::Matrix(columns),
            ..Node::default()
        });
        Self::new(data)
    }

    /// The scene of a file whose +Z is up, turned so that +Y is: (x, y, z) lies at (x, z, −y) then. For scenes whose roots are
    /// not animated, as OBJ's and PLY's are.
    ///
    /// # Errors
    /// As [`Scene::new`].
    pub fn from_z_up(self) -> Result<Self, SceneError> {
        let mut data = self.into_data();
        for node in data.nodes.iter_mut().filter(|node| node.parent.is_none()) {
            let columns = node.transform.affine().to_cols_array_2d();
            node.transform = Transform::Matrix(columns.map(|[x, y, z]| [x as f32, z as f32, -y as f32]));
        }
        Self::new(data)
    }
}

/// The camera of a node: looks along -Z, +Y up; the node's scale does not matter.
pub(super) fn view_of_node(world: &DAffine3, yfov: f32) -> View {
    let [_, up, back, eye] = world.to_cols_array_2d();
    looking(eye, unit_or(back.map(|x| -x), [0.0, 0.0, -1.0]), up, yfov)
}

/// `forward` is a unit vector; `up` is made orthogonal to it.
pub(super) fn looking(eye: [f64; 3], forward: [f64; 3], up: [f64; 3], yfov: f32) -> View {
    // A camera that looks straight up or down takes -Z as its up direction.
    let beside = unit_or(cross(forward, [0.0, 0.0, -1.0]), [1.0, 0.0, 0.0]);
    let up = unit_or(up, [0.0, 1.0, 0.0]);
    let right = cross(forward, up);
    let right = if right.iter().all(|x| x.abs() < 1e-9) {
        beside
    } else {
        unit_or(right, beside)
    };
    let up = cross(right, forward);
    let narrow = |v: [f64; 3]| v.map(|x| x as f32);
    View {
        eye: narrow(eye),
        right: narrow(right),
        up: narrow(up),
        forward: narrow(forward),
        yfov,
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
