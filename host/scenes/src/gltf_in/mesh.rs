//! Meshes: indexed triangles.

use std::collections::HashMap;

use gltf::json;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;

use super::super::error::{SceneError, short};
use super::super::model::{Mesh, Primitive};
use super::attributes::Attributes;
use super::material::Look;
use super::{DAMAGED, Document, RADIANCE_ATTRIBUTE};

/// All meshes. Primitives without a material get one that is appended to `looks`.
pub(super) fn read(document: &Document<'_>, looks: &mut Vec<Look>) -> Result<Vec<Mesh>, SceneError> {
    let (mut meshes, mut glowing, mut count) = (Vec::new(), Vec::new(), 0);
    for (m, mesh) in document.root.meshes.iter().enumerate() {
        let mut primitives = Vec::new();
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let element = format!("meshes[{m}].primitives[{p}]");
            let Some((own, glow)) = one(document, primitive, &element, looks)? else {
                continue;
            };
            if let Some(coordinates) = glow {
                count += own.triangles.len();
                glowing.push((m, primitives.len(), coordinates));
            }
            primitives.push(own);
        }
        meshes.push(Mesh {
            name: short(mesh.name.as_deref().unwrap_or_default()),
            primitives,
        });
    }
    // All triangles that glow share the lookups, so their number comes first.
    for (m, p, coordinates) in glowing {
        let own = &mut meshes[m].primitives[p];
        let look = &looks[own.material as usize];
        let glow = look.glow.as_ref();
        own.radiance =
            glow.map(|(glow, _)| glow.radiance(&own.triangles, &coordinates, look.material.radiance, count));
    }
    Ok(meshes)
}

/// A primitive, and its coordinates on the texture that it glows by.
type Read = (Primitive, Option<Vec<[f32; 2]>>);

/// One primitive, or `None` where it has no triangles.
fn one(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    element: &str,
    looks: &mut Vec<Look>,
) -> Result<Option<Read>, SceneError> {
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
    // Each node would look at it for nothing.
    if triangles.is_empty() {
        return Ok(None);
    }
    let rows = &compact(&mut triangles);
    let look = &looks[material];
    let positions = attributes.floats(Semantic::Positions, rows)?.unwrap_or_default();
    let radiance = radiance(&attributes, &triangles, rows)?;
    let glow = match radiance {
        Some(_) => None,
        None => glow(document, &attributes, look, rows)?,
    };
    let primitive = Primitive {
        positions,
        material: material as u32,
        radiance,
        coordinates: coordinates(document, &attributes, look, rows)?,
        triangles,
    };
    Ok(Some((primitive, glow)))
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

/// Radiance of each triangle where an attribute makes them differ.
fn radiance(
    attributes: &Attributes<'_, '_>,
    triangles: &[[u32; 3]],
    rows: &[u32],
) -> Result<Option<Vec<[f32; 3]>>, SceneError> {
    let own = Semantic::Extras(RADIANCE_ATTRIBUTE.to_owned());
    let values = attributes.floats::<3>(own, rows)?;
    let first = |values: Vec<[f32; 3]>| triangles.iter().map(|&[a, _, _]| values[a as usize]).collect();
    Ok(values.map(first))
}

/// Where the vertices lie on the texture that the material glows by; `None` where it has none, or the primitive does not say.
fn glow(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look,
    rows: &[u32],
) -> Result<Option<Vec<[f32; 2]>>, SceneError> {
    let Some((_, set)) = look.glow.as_ref().filter(|_| look.material.radiance != [0.0; 3]) else {
        return Ok(None);
    };
    let values = attributes.floats::<2>(Semantic::TexCoords(*set), rows)?;
    if values.is_none() {
        let what = format!("its emissive texture is ignored, as TEXCOORD_{set} is missing");
        document.note(attributes.element, what);
    }
    Ok(values)
}

/// Vertex indices in threes, all below `vertices`.
fn triangles(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    (primitive, mode): (&json::mesh::Primitive, Mode),
    vertices: usize,
) -> Result<Vec<[u32; 3]>, SceneError> {
    let element = attributes.element;
    let take = |bytes: usize| document.load.take(element, "the list of triangles", bytes as u64);
    if primitive.indices.is_none() {
        take(4 * vertices)?;
    }
    let (indices, mode) = match (&attributes.draco, primitive.indices) {
        (Some(draco), _) => (draco.indices.clone(), Mode::Triangles),
        (None, Some(index)) => (document.indices(index, element)?, mode),
        (None, None) => ((0..vertices as u32).collect(), mode),
    };
    if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
        let problem = format!("refers to vertex {index}, but there are only {vertices}");
        return Err(document.malformed(element, problem, DAMAGED));
    }
    let each = if mode == Mode::Triangles { 3 } else { 1 };
    // A triangle and its radiance; where each vertex in use stands, in a table that is half empty.
    take(24 * (indices.len() / each + indices.len().min(vertices)))?;
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
