//! Meshes: indexed triangles, and emission per triangle where it is textured.

use std::collections::HashMap;
use std::rc::Rc;

use gltf::json::accessor::Accessor;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{self, Index};

use super::super::check::MAX_TRIANGLES;
use super::super::error::SceneError;
use super::super::model::{Material, Mesh, Primitive};
use super::image::Texture;
use super::{Document, RADIANCE_ATTRIBUTE};

/// Texels looked at for one primitive, about: 2^26.
const MAX_LOOKUPS: u32 = 1 << 26;

/// Finest subdivision of one triangle for the mean of a texture.
const MAX_STEPS: f64 = 64.0;

/// Decoded data that neighbouring primitives often share.
#[derive(Default)]
struct Shared {
    positions: Option<(usize, Rc<Vec<[f32; 3]>>)>,
    emissive: Option<(usize, Rc<Texture>)>,
    triangles: u64,
}

/// All meshes. Primitives without a material get one that is appended to `materials`.
pub(super) fn read(document: &Document<'_>, materials: &mut Vec<Material>) -> Result<Vec<Mesh>, SceneError> {
    let mut shared = Shared::default();
    let mut meshes = Vec::new();
    for (m, mesh) in document.root.meshes.iter().enumerate() {
        let mut primitives = Vec::new();
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let element = format!("meshes[{m}].primitives[{p}]");
            if primitive.mode != Checked::Valid(Mode::Triangles) {
                document.warn(format!(
                    "{element}: skipped, as only plain triangles (mode 4) are used"
                ));
                continue;
            }
            if primitive.targets.is_some() {
                document.warn(format!("{element}: morph targets are ignored"));
            }
            primitives.push(one(document, primitive, &element, materials, &mut shared)?);
        }
        meshes.push(Mesh {
            name: mesh.name.clone().unwrap_or_default(),
            primitives,
        });
    }
    Ok(meshes)
}

fn one(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    element: &str,
    materials: &mut Vec<Material>,
    shared: &mut Shared,
) -> Result<Primitive, SceneError> {
    let material = match primitive.material {
        Some(index) => {
            document.get(&document.root.materials, index, "material", element)?;
            index.value()
        }
        // The default material comes after those of the file.
        None => {
            if materials.len() == document.root.materials.len() {
                materials.push(Material::default());
            }
            document.root.materials.len()
        }
    };
    let Some(position_index) = attribute(primitive, Semantic::Positions) else {
        let advice = "add positions or remove the primitive";
        return Err(document.malformed(element, "has no POSITION attribute", advice));
    };
    let positions = match &shared.positions {
        Some((index, positions)) if *index == position_index.value() => Rc::clone(positions),
        _ => Rc::new(document.floats::<3>(position_index, element)?),
    };
    shared.positions = Some((position_index.value(), Rc::clone(&positions)));

    let triangles = triangles(document, primitive, positions.len(), element)?;
    shared.triangles += triangles.len() as u64;
    if shared.triangles > MAX_TRIANGLES {
        let (scene, what) = (document.path.to_owned(), "triangles");
        return Err(SceneError::TooMany {
            scene,
            what,
            count: shared.triangles,
            limit: MAX_TRIANGLES,
        });
    }
    let radiance = radiance(
        document,
        primitive,
        element,
        &materials[material],
        &triangles,
        shared,
    )?;
    let (positions, triangles) = compact(&positions, triangles);
    Ok(Primitive {
        positions,
        triangles,
        material: material as u32,
        radiance,
    })
}

fn attribute(primitive: &json::mesh::Primitive, semantic: Semantic) -> Option<Index<Accessor>> {
    primitive.attributes.get(&Checked::Valid(semantic)).copied()
}

/// Vertex indices in threes, all below `vertices`.
fn triangles(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    vertices: usize,
    element: &str,
) -> Result<Vec<[u32; 3]>, SceneError> {
    let indices = match primitive.indices {
        Some(index) => document.indices(index, element)?,
        None => (0..vertices as u32).collect(),
    };
    let (triangles, rest) = indices.as_chunks::<3>();
    if !rest.is_empty() {
        let problem = format!("has {} vertex indices, not a multiple of 3", indices.len());
        return Err(document.malformed(element, problem, "the file is damaged; export it again"));
    }
    if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
        let problem = format!("refers to vertex {index}, but there are only {vertices}");
        return Err(document.malformed(element, problem, "the file is damaged; export it again"));
    }
    Ok(triangles.to_vec())
}

/// Keeps only the vertices in use where most are not, as when many primitives share one list.
fn compact(positions: &[[f32; 3]], mut triangles: Vec<[u32; 3]>) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    if positions.len() <= 3 * triangles.len() {
        return (positions.to_vec(), triangles);
    }
    let mut place = HashMap::new();
    let mut used = Vec::new();
    for vertex in triangles.as_flattened_mut() {
        let old = *vertex;
        *vertex = *place.entry(old).or_insert_with(|| {
            used.push(positions[old as usize]);
            used.len() as u32 - 1
        });
    }
    (used, triangles)
}

/// Radiance per triangle, or `None` where the material's holds for all.
fn radiance(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    element: &str,
    material: &Material,
    triangles: &[[u32; 3]],
    shared: &mut Shared,
) -> Result<Option<Vec<[f32; 3]>>, SceneError> {
    let of_vertex = |count: usize, vertex: u32| -> Result<usize, SceneError> {
        let problem = || format!("has an attribute of {count} elements, fewer than its positions");
        let inside = (vertex as usize) < count;
        inside
            .then_some(vertex as usize)
            .ok_or_else(|| document.malformed(element, problem(), "the file is damaged; export it again"))
    };
    if let Some(index) = attribute(primitive, Semantic::Extras(RADIANCE_ATTRIBUTE.to_owned())) {
        let values = document.floats::<3>(index, element)?;
        let first = |&[a, _, _]: &[u32; 3]| Ok(values[of_vertex(values.len(), a)?]);
        return triangles
            .iter()
            .map(first)
            .collect::<Result<Vec<_>, _>>()
            .map(Some);
    }
    let info = primitive
        .material
        .and_then(|index| document.root.materials.get(index.value()))
        .and_then(|material| material.emissive_texture.as_ref());
    let Some(info) = info else { return Ok(None) };
    let Some(coordinates) = attribute(primitive, Semantic::TexCoords(info.tex_coord)) else {
        document.warn(format!(
            "{element}: its emissive texture is ignored, as TEXCOORD_{} is missing",
            info.tex_coord
        ));
        return Ok(None);
    };
    let coordinates = document.floats::<2>(coordinates, element)?;
    let texture = match &shared.emissive {
        Some((index, texture)) if *index == info.index.value() => Rc::clone(texture),
        _ => Rc::new(document.texture(info.index, element)?),
    };
    shared.emissive = Some((info.index.value(), Rc::clone(&texture)));

    let steps = (f64::from(MAX_LOOKUPS) / triangles.len().max(1) as f64)
        .sqrt()
        .min(MAX_STEPS) as u32;
    let mut radiance = Vec::with_capacity(triangles.len());
    for &[a, b, c] in triangles {
        let corner = |vertex| Ok(coordinates[of_vertex(coordinates.len(), vertex)?]);
        let mean = texture.mean_over([corner(a)?, corner(b)?, corner(c)?], steps);
        radiance.push([0, 1, 2].map(|i| mean[i] * material.radiance[i]));
    }
    Ok(Some(radiance))
}
