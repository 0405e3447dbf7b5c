//! Textured emission, and a room of all textures.

use super::*;

/// A sheet that glows as a picture says lights the floor as the integral over it, whatever its means are.
#[test]
fn pictures_glow() {
    let texels = |x: u32, y: u32| -> [u8; 4] {
        let bright = hash(x + 4 * y) & 3 == 0;
        let word = hash(100 + x + 4 * y);
        let level = |shift: u32| if bright { ((word >> shift) & 255) as u8 } else { 0 };
        [level(0), level(8), level(16), 255]
    };
    let linear = |byte: u8| match f64::from(byte) / 255.0 {
        x if x <= 0.04045 => x / 12.92,
        x => ((x + 0.055) / 1.055).powf(2.4),
    };
    let textures = MaterialTextures {
        radiance: [3.0, 5.0, 2.0],
        glow_texture: Some(lying(0)),
        ..PLAIN
    };
    // Without a picture of the glow each triangle has its own; another texture changes nothing of that.
    for is_shown in [true, false] {
        let own = [[0.3_f32, 0.2, 0.1], [0.1, 0.2, 0.6]];
        let textures = MaterialTextures {
            glow_texture: textures.glow_texture.filter(|_| is_shown),
            base_texture: Some(lying(0)).filter(|_| !is_shown),
            ..textures
        };
        let (side, h, aim) = (2.0, 1.5, 0.4);
        let floor_textures = MaterialTextures {
            base: [0.5, 0.5, 0.5, 1.0],
            ..PLAIN
        };
        let mut data = floor(floor_textures, vec![picture(4, 4, texels)], [aim as f32, 1.0]);
        data.materials.push(textured(textures));
        // The mean of each triangle is any: it chooses lights, and the picture says what they send.
        let mut lamp = sheet(side as f32, 1);
        lamp.primitives[0].radiance = Some(own.to_vec());
        data.meshes.push(lamp);
        // Turned about x: its front looks down, its second coordinate grows towards -z.
        data.nodes.push(Node {
            transform: Transform::Trs {
                translation: [0.0, h as f32, 0.0],
                rotation: [1.0, 0.0, 0.0, 0.0],
                scale: [1.0; 3],
            },
            mesh: Some(1),
            ..Node::default()
        });
        let mut e = [0.0; 3];
        let n = 400;
        for i in 0..n {
            for j in 0..n {
                let (u, v) = ((i as f64 + 0.5) / f64::from(n), (j as f64 + 0.5) / f64::from(n));
                let texel = texels((4.0 * u) as u32, (4.0 * v) as u32);
                let (x, z) = (side * (u - 0.5), -side * (v - 0.5));
                let squared = (x - aim).powi(2) + z * z + h * h;
                let area = side * side / f64::from(n * n);
                for k in 0..3 {
                    let radiance = match is_shown {
                        true => f64::from(textures.radiance[k]) * linear(texel[k]),
                        // Places on the diagonal are half in each.
                        false if i == j => 0.5 * f64::from(own[0][k] + own[1][k]),
                        false => f64::from(own[usize::from(v < u)][k]),
                    };
                    e[k] += radiance * area * h * h / (squared * squared);
                }
            }
        }
        reflects(data, e, [0.5; 3], 2e-3);
    }
}

/// The room of all kinds, textured.
pub fn textured_room() -> Scene {
    let mut data = room().into_data();
    let noise = picture(8, 8, |x, y| hash(x + 8 * y).to_le_bytes());
    data.pictures = vec![noise];
    let smooth = |wrap| Texture {
        is_nearest: false,
        wrap: [wrap; 2],
        transform: [[2.4, -1.8], [1.2, 1.6], [0.1, 0.2]],
        ..lying(0)
    };
    data.materials[0].textures = Some(MaterialTextures {
        base: [0.9, 0.8, 0.7, 1.0],
        base_texture: Some(smooth(Wrap::Repeat)),
        ..PLAIN
    });
    data.materials[1].textures = Some(MaterialTextures {
        base: [1.0, 1.0, 1.0, 0.8],
        radiance: [2.0, 3.0, 1.0],
        base_texture: Some(smooth(Wrap::Clamp)),
        glow_texture: Some(smooth(Wrap::Mirror)),
        cutoff: 0.3,
    });
    data.materials[2].textures = Some(MaterialTextures {
        base_texture: Some(smooth(Wrap::Repeat)),
        cutoff: 0.4,
        ..PLAIN
    });
    for primitive in data.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        primitive.coordinates = Some(vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]);
    }
    Scene::new(data).expect("a sound scene")
}
