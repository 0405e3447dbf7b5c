//! Meshes: indexed triangles.

use std::collections::HashMap;

use gltf::json;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;

use super::super::error::SceneError;
use super::super::model::{Mesh, Primitive};
use super::attributes::Attributes;
use super::material::Look;
use super::{DAMAGED, Document, RADIANCE_ATTRIBUTE};

/// All meshes. Primitives without a material get one that is appended to `looks`.
pub(super) fn read(document: &Document<'_>, looks: &mut Vec<Look>) -> Result<Vec<Mesh>, SceneError> {
    let mut meshes = Vec::new();
    for (m, mesh) in document.root.meshes.iter().enumerate() {
        let mut primitives = Vec::new();
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let element = format!("meshes[{m}].primitives[{p}]");
            primitives.extend(one(document, primitive, &element, looks)?);
        }
        meshes.push(Mesh {
            name: mesh.name.clone().unwrap_or_default(),
            primitives,
        });
    }
    Ok(meshes)
}

/// One primitive, or `None` where it has no triangles.
fn one(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    element: &str,
    looks: &mut Vec<Look>,
) -> Result<Option<Primitive>, SceneError> {
    let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) = primitive.mode
    else {
        document.note(element, "skipped, as only triangles (modes 4 to 6) are used");
        return Ok(None);
    };
    let material = match primitive.material {
        Some(index) => {
            document.get(&document.root.materials, index, "material", element)?;
            index.value()
        }
        // The default material comes after those of the file.
        None => {
            if looks.len() == document.root.materials.len() {
                looks.push(Look::default());
            }
            document.root.materials.len()
        }
    };
    if looks[material].is_left_out {
        document.note(element, "it is clear glass, and is left out");
        return Ok(None);
    }
    let attributes = Attributes::new(document, primitive, element)?;
    let Some(index) = attributes.accessor(Semantic::Positions) else {
        // glTF 2.0, section 3.7.2.1: renderers skip what has no positions.
        document.note(element, "it has no positions, and is left out");
        return Ok(None);
    };
    if attributes.accessor(Semantic::Colors(0)).is_some() {
        document.note(element, "its vertex colours are left out");
    }
    if primitive.targets.is_some() {
        document.note(element, "its morph targets are left out");
    }
    let vertices = match &attributes.draco {
        Some(draco) => draco.vertices,
        None => document.count(index, element)?,
    };
    let mut triangles = triangles(document, &attributes, (primitive, mode), vertices)?;
    let rows = &compact(&mut triangles);
    let look = &looks[material];
    Ok(Some(Primitive {
        positions: attributes.floats(Semantic::Positions, rows)?.unwrap_or_default(),
        material: material as u32,
        radiance: radiance(document, &attributes, look, &triangles, rows)?,
        coordinates: coordinates(document, &attributes, look, rows)?,
        triangles,
    }))
}

/// Where the vertices lie on the textures of a material; `None` where it has none, or the primitive does not say.
fn coordinates(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look,
    rows: &[u32],
) -> Result<Option<Vec<[f32; 2]>>, SceneError> {
    let textures = look.material.textures.as_ref();
    if textures.is_none_or(|textures| textures.all().next().is_none()) {
        return Ok(None);
    }
    let (element, set) = (attributes.element, look.set);
    let values = attributes.floats::<2>(Semantic::TexCoords(set), rows)?;
    if values.is_none() {
        let what = format!("its textures are replaced by their means, as TEXCOORD_{set} is missing");
        document.note(element, what);
    }
    Ok(values)
}

/// Radiance of each triangle where a texture or an attribute makes them differ; `None` where the material's holds for all of them.
fn radiance(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look,
    triangles: &[[u32; 3]],
    rows: &[u32],
) -> Result<Option<Vec<[f32; 3]>>, SceneError> {
    let own = Semantic::Extras(RADIANCE_ATTRIBUTE.to_owned());
    if let Some(values) = attributes.floats::<3>(own, rows)? {
        let first = |&[a, _, _]: &[u32; 3]| values[a as usize];
        return Ok(Some(triangles.iter().map(first).collect()));
    }
    let factor = look.material.radiance;
    let Some((glow, set)) = look.glow.as_ref().filter(|_| factor != [0.0; 3]) else {
        return Ok(None);
    };
    let Some(coordinates) = attributes.floats::<2>(Semantic::TexCoords(*set), rows)? else {
        let what = format!("its emissive texture is ignored, as TEXCOORD_{set} is missing");
        document.note(attributes.element, what);
        return Ok(None);
    };
    Ok(Some(glow.radiance(triangles, &coordinates, factor)))
}

/// Vertex indices in threes, all below `vertices`.
fn triangles(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    (primitive, mode): (&json::mesh::Primitive, Mode),
    vertices: usize,
) -> Result<Vec<[u32; 3]>, SceneError> {
    let element = attributes.element;
    let (indices, mode) = match (&attributes.draco, primitive.indices) {
        (Some(draco), _) => (draco.indices.clone(), Mode::Triangles),
        (None, Some(index)) => (document.indices(index, element)?, mode),
        (None, None) => ((0..vertices as u32).collect(), mode),
    };
    if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
        let problem = format!("refers to vertex {index}, but there are only {vertices}");
        return Err(document.malformed(element, problem, DAMAGED));
    }
    Ok(match mode {
        // Every other triangle of a strip is turned, so that all have the same side in front.
        Mode::TriangleStrip => (0..indices.len().saturating_sub(2))
            .map(|i| [i, i + 1 + i % 2, i + 2 - i % 2].map(|i| indices[i]))
            .collect(),
        Mode::TriangleFan => (0..indices.len().saturating_sub(2))
            .map(|i| [i + 1, i + 2, 0].map(|i| indices[i]))
            .collect(),
        _ => {
            let (triangles, rest) = indices.as_chunks::<3>();
            if !rest.is_empty() {
                let problem = format!("has {} vertex indices, not a multiple of 3", indices.len());
                return Err(document.malformed(element, problem, DAMAGED));
            }
            triangles.to_vec()
        }
    })
}

/// The vertices in use, in the order that triangles then name them in: many primitives may share one list.
fn compact(triangles: &mut [[u32; 3]]) -> Vec<u32> {
    let (mut place, mut used) = (HashMap::new(), Vec::new());
    for vertex in triangles.as_flattened_mut() {
        let old = *vertex;
        *vertex = *place.entry(old).or_insert_with(|| {
            used.push(old);
            used.len() as u32 - 1
        });
    }
    used
}
