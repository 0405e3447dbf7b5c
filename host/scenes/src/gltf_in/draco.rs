//! `KHR_draco_mesh_compression`: the triangles and attributes of a primitive in one stream.
//!
//! The decoder is a crate's, without `unsafe`. It takes memory for what a stream really holds, and is told how much is left.

use std::collections::HashMap;

use gltf::json;
use serde::Deserialize;

use super::super::error::SceneError;
use super::Document;
use super::accessor::beyond;

const NAME: &str = "KHR_draco_mesh_compression";

/// The extension's object.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer_view: u32,
    /// The stream's numbers of attributes, by glTF's names.
    attributes: HashMap<String, u32>,
}

/// A decoded stream.
pub(super) struct Unpacked {
    /// Vertex indices, three for each triangle.
    pub indices: Vec<u32>,
    /// Number of vertices.
    pub vertices: usize,
    /// By glTF's names: numbers for each vertex, and all of them; or the number of an attribute that is not there.
    attributes: HashMap<String, Result<(usize, Vec<f32>), u32>>,
}

impl Document<'_> {
    /// What a primitive's stream holds; `None` for a primitive without one.
    pub(super) fn draco(
        &self,
        primitive: &json::mesh::Primitive,
        element: &str,
    ) -> Result<Option<Unpacked>, SceneError> {
        let Some(extensions) = &primitive.extensions else {
            return Ok(None);
        };
        let found: Option<Compressed> = self.extension(&extensions.others, NAME, element)?;
        found
            .map(|compressed| self.unpack_draco(compressed, element))
            .transpose()
    }

    #[cfg(not(feature = "formats"))]
    fn unpack_draco(&self, _: Compressed, element: &str) -> Result<Unpacked, SceneError> {
        let what = format!("{element} ({NAME})");
        Err(super::super::error::not_compiled(self.path, &what))
    }

    #[cfg(feature = "formats")]
    fn unpack_draco(&self, compressed: Compressed, element: &str) -> Result<Unpacked, SceneError> {
        use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
        let (bytes, _) = self.view(json::Index::new(compressed.buffer_view), element)?;
        let limits = DecodeLimits::default().with_max_decoded_bytes(self.load.left());
        let mut mesh = Mesh::new();
        MeshDecoder::new()
            .decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh)
            .map_err(|error| {
                let problem = format!("its Draco stream cannot be decoded: {error}");
                self.malformed(element, problem, super::UNPACK)
            })?;
        // A file may give one attribute many names.
        let named = compressed.attributes.values();
        let attributes = named.filter_map(|&number| mesh.attribute_by_unique_id(number));
        let components: u64 = attributes.map(|own| u64::from(own.num_components())).sum();
        let bytes = 4 * (3 * mesh.num_faces() as u64 + components * mesh.num_points() as u64);
        self.load.take(element, "what a Draco stream holds", bytes)?;
        let values = |(name, number)| {
            let attribute = mesh.attribute_by_unique_id(number).ok_or(number);
            let values = attribute.map(|attribute| {
                let count = usize::from(attribute.num_components());
                (count, attribute.read_f32s(mesh.num_points(), count))
            });
            (name, values)
        };
        Ok(Unpacked {
            vertices: mesh.num_points(),
            indices: mesh.faces().iter().flatten().map(|point| point.0).collect(),
            attributes: compressed.attributes.into_iter().map(values).collect(),
        })
    }
}

impl Unpacked {
    /// The values of an attribute for these vertices; `None` where the stream has no such attribute.
    pub(super) fn floats<const N: usize>(
        &self,
        name: &str,
        rows: &[u32],
    ) -> Option<Result<Vec<[f32; N]>, String>> {
        Some(match self.attributes.get(name)? {
            Ok((found, values)) if *found == N => {
                let values = values.as_chunks::<N>().0;
                let own = |()| rows.iter().map(|&row| values[row as usize]).collect();
                beyond(Some(rows), values.len()).map(own)
            }
            Ok((found, _)) => Err(format!("has {found} numbers for each vertex, expected {N}")),
            Err(number) => Err(format!("attribute {number} is not in the stream")),
        })
    }
}
