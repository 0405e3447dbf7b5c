//! Radiance of each triangle, where a texture or an attribute makes them differ.

use std::rc::Rc;

use gltf::json::mesh::Semantic;

use super::super::error::SceneError;
use super::super::glow::Glow;
use super::attributes::Attributes;
use super::material::Look;
use super::texture::Placed;
use super::{Document, RADIANCE_ATTRIBUTE};

/// The texture that the last primitive glowed by, with its material: neighbours often share it.
pub(super) type Shared = Option<(usize, Option<Rc<Placed>>)>;

/// One for each triangle; `None` where the material's holds for all of them.
pub(super) fn radiance(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    (material, look): (usize, &Look<'_>),
    triangles: &[[u32; 3]],
    shared: &mut Shared,
) -> Result<Option<Vec<[f32; 3]>>, SceneError> {
    let element = attributes.element;
    let of_vertex = |count: usize, vertex: u32| -> Result<usize, SceneError> {
        let problem = || format!("has an attribute of {count} elements, fewer than its positions");
        let inside = (vertex as usize) < count;
        inside
            .then_some(vertex as usize)
            .ok_or_else(|| document.malformed(element, problem(), "the file is damaged; export it again"))
    };
    if let Some(values) = attributes.floats::<3>(Semantic::Extras(RADIANCE_ATTRIBUTE.to_owned()))? {
        let first = |&[a, _, _]: &[u32; 3]| Ok(values[of_vertex(values.len(), a)?]);
        return triangles
            .iter()
            .map(first)
            .collect::<Result<Vec<_>, _>>()
            .map(Some);
    }
    let factor = look.material.radiance;
    // Nothing glows, whatever the texture shows.
    let Some(info) = look.glow.filter(|_| factor != [0.0; 3]) else {
        return Ok(None);
    };
    let placed = match shared {
        Some((of, placed)) if *of == material => placed.clone(),
        _ => document.placed(info, element)?.map(Rc::new),
    };
    *shared = Some((material, placed.clone()));
    let Some(placed) = placed else {
        // What is known to glow somewhere is not taken to glow everywhere; unlit surfaces have a colour in any case.
        return Ok((!look.is_unlit).then(|| vec![[0.0; 3]; triangles.len()]));
    };
    let Some(coordinates) = attributes.floats::<2>(Semantic::TexCoords(placed.set))? else {
        document.warn(format!(
            "{element}: its emissive texture is ignored, as TEXCOORD_{} is missing",
            placed.set
        ));
        return Ok(None);
    };
    let steps = Glow::max_steps(triangles.len());
    let mut radiance = Vec::with_capacity(triangles.len());
    for &[a, b, c] in triangles {
        let corner = |vertex| Ok(coordinates[of_vertex(coordinates.len(), vertex)?]);
        let mean = placed.glow.mean_over([corner(a)?, corner(b)?, corner(c)?], steps);
        radiance.push([0, 1, 2].map(|i| mean[i] * factor[i]));
    }
    Ok(Some(radiance))
}
