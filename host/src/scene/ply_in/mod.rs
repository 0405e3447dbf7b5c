//! PLY in: triangle meshes, in text or binary of either byte order, as they are or by gzip.
//!
//! Read are positions, normals, texture coordinates and faces; polygons are cut into triangles, also concave ones. Other
//! properties and elements are read past. A PLY file has no material: as a scene of its own it is a grey surface that an
//! environment map or suns can light. A count is believed once there are as many bytes as it needs.

mod body;
mod header;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::error::SceneError;
use super::model::{Material, Mesh, Node, Primitive, Scene, SceneData};
use super::read_file::{read_file, read_unpacked, unpacked};

/// Triangles of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PlyMesh {
    pub positions: Vec<[f32; 3]>,
    /// One for each position, or none.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates of each position, or none.
    pub coordinates: Vec<[f32; 2]>,
    /// Indices below the number of positions.
    pub triangles: Vec<[u32; 3]>,
}

impl PlyMesh {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        Self::parse(&path.display().to_string(), &read_unpacked(path)?)
    }

    fn parse(path: &str, bytes: &[u8]) -> Result<Self, SceneError> {
        let (header, body) = header::read(path, bytes)?;
        body::read(path, &header, body)
    }
}

impl Scene {
    /// Reads a `.ply` file and checks it. No file of this kind says what emits.
    ///
    /// # Errors
    /// What [`Scene::new`] refuses, and unreadable, truncated or malformed files.
    pub fn read_ply(path: &Path) -> Result<Self, SceneError> {
        Self::read_ply_slice(&path.display().to_string(), &read_file(path)?)
    }

    /// The same for a file in memory; `name` stands for the path in messages.
    ///
    /// # Errors
    /// As [`Scene::read_ply`].
    pub fn read_ply_slice(name: &str, bytes: &[u8]) -> Result<Self, SceneError> {
        let unpacked = unpacked(name, bytes)?;
        let mesh = PlyMesh::parse(name, &unpacked)?;
        Self::new(SceneData {
            name: name.to_owned(),
            nodes: vec![Node {
                name: String::from("ply"),
                mesh: Some(0),
                ..Node::default()
            }],
            meshes: vec![Mesh {
                name: String::from("ply"),
                primitives: vec![Primitive {
                    positions: mesh.positions,
                    triangles: mesh.triangles,
                    ..Primitive::default()
                }],
            }],
            materials: vec![Material {
                base_color: [0.5; 3],
                ..Material::default()
            }],
            ..SceneData::default()
        })
    }
}

/// What is wrong with an element of a file.
fn malformed(
    path: &str,
    element: impl Into<String>,
    problem: impl Into<String>,
    advice: &'static str,
) -> SceneError {
    SceneError::Malformed {
        path: path.to_owned(),
        element: element.into(),
        problem: problem.into(),
        advice,
    }
}
