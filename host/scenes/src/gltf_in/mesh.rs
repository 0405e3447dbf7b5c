//! Meshes: indexed triangles.

use std::collections::HashMap;
use std::rc::Rc;

use gltf::json;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;

use super::super::error::SceneError;
use super::super::model::{Mesh, Primitive};
use super::attributes::Attributes;
use super::material::Look;
use super::{DAMAGED, Document, RADIANCE_ATTRIBUTE, bend};

/// The positions of the last accessor of them, which neighbouring primitives often share.
type Shared = Option<(usize, Rc<Vec<[f32; 3]>>)>;

/// All meshes. Primitives without a material get one that is appended to `looks`.
pub(super) fn read(document: &Document<'_>, looks: &mut Vec<Look>) -> Result<Vec<Mesh>, SceneError> {
    let mut shared = None;
    let mut meshes = Vec::new();
    for (m, mesh) in document.root.meshes.iter().enumerate() {
        let mut primitives = Vec::new();
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let element = format!("meshes[{m}].primitives[{p}]");
            primitives.extend(one(document, primitive, &element, looks, &mut shared)?);
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
    shared: &mut Shared,
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
    let attributes = Attributes::new(document, primitive, element)?;
    if attributes.accessor(Semantic::Positions).is_none() {
        // glTF 2.0, section 3.7.2.1: renderers skip what has no positions.
        document.note(element, "it has no positions, and is left out");
        return Ok(None);
    }
    if attributes.accessor(Semantic::Colors(0)).is_some() {
        document.note(element, "its vertex colours are left out");
    }
    let positions = positions(&attributes, shared)?;
    let triangles = triangles(document, &attributes, (primitive, mode), positions.len())?;
    let coordinates = coordinates(document, &attributes, &looks[material], positions.len())?;
    let radiance = radiance(document, &attributes, &looks[material], &triangles)?;
    let targets = bend::targets(document, primitive, positions.len(), element)?;
    let influences = bend::influences(document, &attributes, positions.len())?;
    let (kept, triangles) = compact(positions.len(), triangles);
    let kept = kept.as_deref();
    Ok(Some(Primitive {
        positions: pick(&positions, kept),
        triangles,
        material: material as u32,
        radiance,
        coordinates: coordinates.map(|all| pick(&all, kept)),
        targets: targets.iter().map(|target| pick(target, kept)).collect(),
        influences: influences.iter().map(|set| pick(set, kept)).collect(),
    }))
}

fn positions(attributes: &Attributes<'_, '_>, shared: &mut Shared) -> Result<Rc<Vec<[f32; 3]>>, SceneError> {
    let index = attributes
        .accessor(Semantic::Positions)
        .map(|index| index.value());
    match shared {
        Some((of, positions)) if Some(*of) == index && attributes.draco.is_none() => {
            return Ok(Rc::clone(positions));
        }
        _ => {}
    }
    let positions = Rc::new(attributes.floats::<3>(Semantic::Positions)?.unwrap_or_default());
    if attributes.draco.is_none() {
        *shared = index.map(|index| (index, Rc::clone(&positions)));
    }
    Ok(positions)
}

/// Where the vertices lie on the textures of a material; `None` where it has none, or the primitive does not say.
fn coordinates(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look,
    vertices: usize,
) -> Result<Option<Vec<[f32; 2]>>, SceneError> {
    let paint = look.material.paint.as_ref();
    if paint.is_none_or(|paint| paint.textures().next().is_none()) {
        return Ok(None);
    }
    let (element, set) = (attributes.element, look.set);
    let Some(mut values) = attributes.floats::<2>(Semantic::TexCoords(set))? else {
        let what = format!("its textures are replaced by their means, as TEXCOORD_{set} is missing");
        document.note(element, what);
        return Ok(None);
    };
    // What is missing lies at the origin.
    values.resize(vertices, [0.0; 2]);
    Ok(Some(values))
}

/// Radiance of each triangle where a texture or an attribute makes them differ; `None` where the material's holds for all of them.
fn radiance(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look,
    triangles: &[[u32; 3]],
) -> Result<Option<Vec<[f32; 3]>>, SceneError> {
    let element = attributes.element;
    let check = |count: usize| {
        let mut vertices = triangles.as_flattened().iter();
        if vertices.all(|&vertex| (vertex as usize) < count) {
            return Ok(());
        }
        let problem = format!("has an attribute of {count} elements, fewer than its positions");
        Err(document.malformed(element, problem, DAMAGED))
    };
    if let Some(values) = attributes.floats::<3>(Semantic::Extras(RADIANCE_ATTRIBUTE.to_owned()))? {
        check(values.len())?;
        let first = |&[a, _, _]: &[u32; 3]| values[a as usize];
        return Ok(Some(triangles.iter().map(first).collect()));
    }
    let factor = look.material.radiance;
    let Some((glow, set)) = look.glow.as_ref().filter(|_| factor != [0.0; 3]) else {
        return Ok(None);
    };
    let Some(coordinates) = attributes.floats::<2>(Semantic::TexCoords(*set))? else {
        let what = format!("its emissive texture is ignored, as TEXCOORD_{set} is missing");
        document.note(element, what);
        return Ok(None);
    };
    check(coordinates.len())?;
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

/// Which vertices are kept, in their new order: those in use, where most are not, as when many primitives share one list.
/// `None` keeps all of them.
fn compact(vertices: usize, mut triangles: Vec<[u32; 3]>) -> (Option<Vec<u32>>, Vec<[u32; 3]>) {
    if vertices <= 3 * triangles.len() {
        return (None, triangles);
    }
    let mut place = HashMap::new();
    let mut used = Vec::new();
    for vertex in triangles.as_flattened_mut() {
        let old = *vertex;
        *vertex = *place.entry(old).or_insert_with(|| {
            used.push(old);
            used.len() as u32 - 1
        });
    }
    (Some(used), triangles)
}

/// The values of the vertices that are kept; none where there are none.
fn pick<T: Copy>(values: &[T], kept: Option<&[u32]>) -> Vec<T> {
    match kept.filter(|_| !values.is_empty()) {
        None => values.to_vec(),
        Some(kept) => kept.iter().map(|&vertex| values[vertex as usize]).collect(),
    }
}
