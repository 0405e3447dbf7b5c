//! `KHR_draco_mesh_compression`: the triangles and attributes of a primitive in one stream.
//!
//! The decoder is a crate's, without `unsafe`. It takes memory for what a stream really holds, and is told how much is left.

use std::collections::HashMap;

#[cfg(feature = "draco")]
use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use gltf::json::{self, Index};
use serde::Deserialize;

use super::super::error::SceneError;
use super::Document;

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
#[cfg(feature = "draco")]
pub(super) struct Unpacked {
    mesh: Mesh,
    attributes: HashMap<String, u32>,
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
        let Some(compressed) = found else { return Ok(None) };
        match self.unpack_draco(compressed, element) {
            Ok(unpacked) => Ok(Some(unpacked)),
            Err(error) if self.requires(NAME) => Err(error),
            // The file brings the same data as they are, or accessors will say that it does not.
            Err(error) => {
                self.warn(format!("its plain data are taken, as {error}"));
                Ok(None)
            }
        }
    }

    #[cfg(not(feature = "draco"))]
    fn unpack_draco(&self, _: Compressed, element: &str) -> Result<Unpacked, SceneError> {
        Err(super::super::error::not_compiled(
            self.path,
            format!("{element} ({NAME})"),
            "draco",
        ))
    }

    #[cfg(feature = "draco")]
    fn unpack_draco(&self, compressed: Compressed, element: &str) -> Result<Unpacked, SceneError> {
        let view = Index::new(compressed.buffer_view);
        let (bytes, _) = self.view(view, element)?;
        let limits = DecodeLimits::default().with_max_decoded_bytes(self.load.left());
        let mut mesh = Mesh::new();
        MeshDecoder::new()
            .decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh)
            .map_err(|error| {
                let problem = format!("its Draco stream cannot be decoded: {error}");
                let advice = "unpack the file, for example with `gltf-transform copy`, or export it again";
                self.malformed(element, problem, advice)
            })?;
        let attributes = (0..mesh.num_attributes()).map(|k| u64::from(mesh.attribute(k).num_components()));
        let bytes = 4 * (3 * mesh.num_faces() as u64 + attributes.sum::<u64>() * mesh.num_points() as u64);
        self.load.take(element, "what a Draco stream holds", bytes)?;
        Ok(Unpacked {
            mesh,
            attributes: compressed.attributes,
        })
    }
}

/// There is none.
#[cfg(not(feature = "draco"))]
pub(super) enum Unpacked {}

#[cfg(not(feature = "draco"))]
impl Unpacked {
    pub(super) fn indices(&self) -> Vec<u32> {
        match *self {}
    }

    pub(super) fn floats<const N: usize>(&self, _: &str) -> Option<Result<Vec<[f32; N]>, String>> {
        match *self {}
    }
}

#[cfg(feature = "draco")]
impl Unpacked {
    /// Vertex indices, three for each triangle.
    pub(super) fn indices(&self) -> Vec<u32> {
        let corners = self.mesh.faces().iter().flatten();
        corners.map(|point| point.0).collect()
    }

    /// The values of an attribute, one for each vertex; `None` where the stream has no such attribute.
    pub(super) fn floats<const N: usize>(&self, name: &str) -> Option<Result<Vec<[f32; N]>, String>> {
        let number = *self.attributes.get(name)?;
        let Some(attribute) = self.mesh.attribute_by_unique_id(number) else {
            return Some(Err(format!("attribute {number} is not in the stream")));
        };
        let found = usize::from(attribute.num_components());
        if found != N {
            return Some(Err(format!("has {found} numbers for each vertex, expected {N}")));
        }
        let values = attribute.read_f32s(self.mesh.num_points(), N);
        Some(Ok(values.as_chunks::<N>().0.to_vec()))
    }
}
