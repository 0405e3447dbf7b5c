//! Where a primitive's numbers come from: accessors, or a Draco stream.

use gltf::json::accessor::{Accessor, GenericComponentType};
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use gltf::json::{self, Index};

use super::super::error::SceneError;
use super::Document;
use super::accessor::normalized;
use super::draco::Unpacked;

/// The attributes of one primitive.
pub(super) struct Attributes<'d, 'a> {
    document: &'d Document<'a>,
    primitive: &'d json::mesh::Primitive,
    /// The primitive's place in the file.
    pub element: &'d str,
    pub draco: Option<Unpacked>,
}

impl<'d, 'a> Attributes<'d, 'a> {
    pub(super) fn new(
        document: &'d Document<'a>,
        primitive: &'d json::mesh::Primitive,
        element: &'d str,
    ) -> Result<Self, SceneError> {
        Ok(Self {
            document,
            primitive,
            element,
            draco: document.draco(primitive, element)?,
        })
    }

    /// The accessor of an attribute.
    pub(super) fn accessor(&self, semantic: Semantic) -> Option<Index<Accessor>> {
        let attributes = &self.primitive.attributes;
        attributes.get(&Checked::Valid(semantic)).copied()
    }

    /// The values of an attribute for these vertices, `N` numbers each; `None` where there is none.
    pub(super) fn floats<const N: usize>(
        &self,
        semantic: Semantic,
        rows: &[u32],
    ) -> Result<Option<Vec<[f32; N]>>, SceneError> {
        let name = semantic.to_string();
        let Some(index) = self.accessor(semantic) else {
            return Ok(None);
        };
        let Some(values) = self
            .draco
            .as_ref()
            .and_then(|draco| draco.floats::<N>(&name, rows))
        else {
            return self.document.floats(index, self.element, Some(rows)).map(Some);
        };
        let mut values = values.map_err(|problem| {
            let element = format!("{}: {name} in its Draco stream", self.element);
            self.document.malformed(element, problem, "export the file again")
        })?;
        // The accessor says what the stream's integers stand for.
        let accessor = self
            .document
            .get(&self.document.root.accessors, index, "accessor", self.element)?;
        if accessor.normalized
            && let Checked::Valid(GenericComponentType(component)) = accessor.component_type
        {
            for value in values.as_flattened_mut() {
                *value = normalized(component, *value);
            }
        }
        Ok(Some(values))
    }
}
