//! Paint in files.

use super::*;

/// A painted scene that is written and read again is painted as it was, and shows the same image.
#[test]
fn paint_survives_a_file() {
    let scene = painted_room();
    let back =
        Scene::read_gltf_slice("back.glb", &scene.to_glb().expect("written"), None).expect("read back");
    assert!(back.data().is_painted());
    let of = |scene: &Scene| {
        let materials = scene.data().materials.iter();
        materials.map(|own| own.paint).collect::<Vec<_>>()
    };
    for (own, other) in of(&scene).iter().zip(of(&back)) {
        let (own, mut other) = (own.expect("painted"), other.expect("painted"));
        let near = |a: Option<Texture>, b: &mut Option<Texture>| {
            if let (Some(a), Some(b)) = (a, b.as_mut()) {
                let [x, y] = [a.transform, b.transform].map(|t| t.as_flattened().to_vec());
                assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-6), "{x:?} {y:?}");
                b.transform = a.transform;
            }
        };
        near(own.base_texture, &mut other.base_texture);
        near(own.rough_texture, &mut other.rough_texture);
        near(own.bump_texture, &mut other.bump_texture);
        near(own.glow_texture, &mut other.glow_texture);
        if own.bump_texture.is_none() {
            other.bump = own.bump;
        }
        // Means of textures are chosen by; what they are of is equal.
        assert_eq!(own, other);
    }
    assert_eq!(scene.data().pictures, back.data().pictures);
    let coordinates = |scene: &Scene| -> Vec<_> {
        let meshes = scene.data().meshes.iter();
        let primitives = meshes.flat_map(|mesh| &mesh.primitives);
        primitives
            .map(|own| {
                let uv = own.coordinates.as_ref().expect("coordinates");
                own.triangles
                    .iter()
                    .map(|t| t.map(|v| uv[v as usize]))
                    .collect::<Vec<_>>()
            })
            .collect()
    };
    assert_eq!(coordinates(&scene), coordinates(&back));
}
