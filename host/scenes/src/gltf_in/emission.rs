//! Radiance of each triangle, where a texture or an attribute makes them differ.

use gltf::json::mesh::Semantic;

use super::super::error::SceneError;
use super::attributes::Attributes;
use super::material::Look;
use super::{DAMAGED, Document, RADIANCE_ATTRIBUTE};

/// One for each triangle; `None` where the material's holds for all of them.
pub(super) fn radiance(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    look: &Look,
    triangles: &[[u32; 3]],
) -> Result<Option<Vec<[f32; 3]>>, SceneError> {
    let element = attributes.element;
    let check = |count: usize| {
        let problem = || format!("has an attribute of {count} elements, fewer than its positions");
        match triangles
            .as_flattened()
            .iter()
            .any(|&vertex| vertex as usize >= count)
        {
            true => Err(document.malformed(element, problem(), DAMAGED)),
            false => Ok(()),
        }
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
