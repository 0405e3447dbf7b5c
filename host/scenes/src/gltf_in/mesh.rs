//! Meshes: indexed triangles.

use std::collections::HashMap;
use std::rc::Rc;

use gltf::json;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;

use super::super::check::MAX_TRIANGLES;
use super::super::error::SceneError;
use super::super::model::{Material, Mesh, Primitive};
use super::super::paint::{Opacity, Paint};
use super::attributes::Attributes;
use super::material::Look;
use super::{Document, bend, emission};

/// Greatest texture coordinate, as a scene takes them.
const FARTHEST: f32 = (1 << 20) as f32;

/// Decoded data that neighbouring primitives often share.
#[derive(Default)]
struct Shared {
    positions: Option<(usize, Rc<Vec<[f32; 3]>>)>,
    emission: emission::Shared,
    triangles: u64,
}

/// All meshes. Primitives without a material get one that is appended to `looks`.
pub(super) fn read<'a>(document: &Document<'a>, looks: &mut Vec<Look<'a>>) -> Result<Vec<Mesh>, SceneError> {
    let mut shared = Shared::default();
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
fn one<'a>(
    document: &Document<'a>,
    primitive: &json::mesh::Primitive,
    element: &str,
    looks: &mut Vec<Look<'a>>,
    shared: &mut Shared,
) -> Result<Option<Primitive>, SceneError> {
    let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) = primitive.mode
    else {
        document.warn(format!(
            "{element}: skipped, as only triangles (modes 4 to 6) are used"
        ));
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
        document.warn(format!("{element}: it has no positions, and is left out"));
        return Ok(None);
    }
    if attributes.accessor(Semantic::Colors(0)).is_some() {
        document.warn(format!("{element}: its vertex colours are left out"));
    }
    let positions = positions(document, &attributes, shared)?;
    let triangles = triangles(document, &attributes, (primitive, mode), positions.len())?;
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
    let coordinates = coordinates(document, &attributes, &looks[material], positions.len())?;
    let material = match coordinates {
        None => without_textures(document, looks, material),
        Some(_) => material,
    };
    let look = (material, &looks[material]);
    let radiance = emission::radiance(document, &attributes, look, &triangles, &mut shared.emission)?;
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
        targets: targets
            .into_iter()
            .map(|target| {
                if target.is_empty() {
                    target
                } else {
                    pick(&target, kept)
                }
            })
            .collect(),
        influences: influences.into_iter().map(|set| pick(&set, kept)).collect(),
    }))
}

fn positions(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    shared: &mut Shared,
) -> Result<Rc<Vec<[f32; 3]>>, SceneError> {
    let missing = || {
        let advice = "add positions or remove the primitive";
        document.malformed(attributes.element, "has no POSITION attribute", advice)
    };
    let index = attributes.accessor(Semantic::Positions).ok_or_else(missing)?;
    match &shared.positions {
        Some((of, positions)) if *of == index.value() && attributes.draco.is_none() => {
            return Ok(Rc::clone(positions));
        }
        _ => {}
    }
    let positions = Rc::new(attributes.floats::<3>(Semantic::Positions)?.ok_or_else(missing)?);
    if attributes.draco.is_none() {
        shared.positions = Some((index.value(), Rc::clone(&positions)));
    }
    Ok(positions)
}

/// The material with means in place of its textures, where it has any: appended to `looks`, once for each.
fn without_textures(document: &Document<'_>, looks: &mut Vec<Look<'_>>, material: usize) -> usize {
    let look = &looks[material];
    let Some(paint) = look
        .material
        .paint
        .filter(|paint| paint.textures().next().is_some())
    else {
        return material;
    };
    let [r, g, b] = look.material.base_color;
    let glass = Paint {
        base: [r, g, b, 1.0],
        base_texture: None,
        rough_texture: None,
        bump_texture: None,
        glow_texture: None,
        opacity: Opacity::Opaque,
        ..paint
    };
    let plain = Material {
        paint: paint.is_clear().then_some(glass),
        ..look.material.clone()
    };
    // One for the default material stands first, whether or not it is asked for.
    if looks.len() == document.root.materials.len() {
        looks.push(Look::default());
    }
    if let Some(known) = looks.iter().position(|look| look.material == plain) {
        return known;
    }
    let (glow, set, is_unlit) = (
        looks[material].glow,
        looks[material].set,
        looks[material].is_unlit,
    );
    looks.push(Look {
        material: plain,
        glow,
        set,
        is_unlit,
    });
    looks.len() - 1
}

/// Where the vertices lie on the textures of a material; `None` where it has none, or the primitive does not say.
fn coordinates(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look<'_>,
    vertices: usize,
) -> Result<Option<Vec<[f32; 2]>>, SceneError> {
    let paint = look.material.paint.as_ref();
    if paint.is_none_or(|paint| paint.textures().next().is_none()) {
        return Ok(None);
    }
    let Some(mut values) = attributes.floats::<2>(Semantic::TexCoords(look.set))? else {
        document.warn(format!(
            "{}: its textures are replaced by their means, as TEXCOORD_{} is missing",
            attributes.element, look.set
        ));
        return Ok(None);
    };
    // What is missing, or no number, lies at the origin.
    let is_short = values.len() < vertices;
    values.resize(vertices, [0.0; 2]);
    let mut is_far = false;
    for value in values.as_flattened_mut() {
        is_far |= !(-FARTHEST..=FARTHEST).contains(value);
        *value = if value.is_nan() {
            0.0
        } else {
            value.clamp(-FARTHEST, FARTHEST)
        };
    }
    if is_short {
        document.warn(format!(
            "{}: TEXCOORD_{} has fewer entries than POSITION, and what is missing counts as 0",
            attributes.element, look.set
        ));
    }
    if is_far {
        document.warn(format!(
            "{}: numbers of TEXCOORD_{} beyond 2^20 count as 2^20, and what is no number as 0; repair the texture coordinates",
            attributes.element, look.set
        ));
    }
    Ok(Some(values))
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
        (Some(draco), _) => (draco.indices(), Mode::Triangles),
        (None, Some(index)) => (document.indices(index, element)?, mode),
        (None, None) => ((0..vertices as u32).collect(), mode),
    };
    if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
        let problem = format!("refers to vertex {index}, but there are only {vertices}");
        return Err(document.malformed(element, problem, "the file is damaged; export it again"));
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
                return Err(document.malformed(element, problem, "the file is damaged; export it again"));
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

/// The values of the vertices that are kept.
fn pick<T: Copy>(values: &[T], kept: Option<&[u32]>) -> Vec<T> {
    match kept {
        None => values.to_vec(),
        Some(kept) => kept.iter().map(|&vertex| values[vertex as usize]).collect(),
    }
}
