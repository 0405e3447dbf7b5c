//! Colours of light, and materials.

use super::*;

fn light(params: &str) -> [f32; 3] {
    let scene = read(&format!("{UNMIRRORED}LightSource \"point\" {params}\n{TRIANGLE}"));
    scene.data().analytic[0].color
}

fn luminance([r, g, b]: [f32; 3]) -> f64 {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}

#[test]
fn light_that_is_not_rgb_has_luminance_one() {
    let folder_less = [
        "\"blackbody I\" 2856",
        "\"blackbody I\" [6500]",
        "\"spectrum I\" \"stdillum-A\"",
        "\"spectrum I\" \"stdillum-F11\"",
        "\"spectrum I\" [400 1 500 3 600 2 700 1]",
    ];
    for params in folder_less {
        let rgb = light(params);
        assert!((luminance(rgb) - 1.0).abs() < 1e-4, "{params}: {rgb:?}");
    }
    assert_eq!(light("\"spectrum I\" \"stdillum-D65\""), [1.0; 3]);
    assert_eq!(light(""), [1.0; 3]);
    // A black body of 2856 K has the colour of illuminant A, but for the fit of the matching functions.
    let (body, named) = (
        light("\"blackbody I\" 2856"),
        light("\"spectrum I\" \"stdillum-A\""),
    );
    near(body, named.map(f64::from), 0.05);
    // IEC 61966-2-1 of x = 0.44757, y = 0.40745: X = 1.09846, Z = 0.35582.
    near(
        named,
        [
            3.240_97 * 1.098_466 - 1.537_383 - 0.498_611 * 0.355_823,
            0.826_0,
            0.233_2,
        ],
        0.01,
    );
    // Cold and hot.
    assert!(body[0] > 2.0 * body[2] && light("\"blackbody I\" 12000")[2] > 1.2);
}

#[test]
fn materials_come_near() {
    let of = |material: &str| {
        let scene = read(&format!("{UNMIRRORED}{material}\n{TRIANGLE}{TRIANGLE}"));
        let data = scene.data();
        data.materials[data.meshes[0].primitives[0].material as usize].clone()
    };
    let diffuse = of("Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]");
    assert_eq!(
        (diffuse.base_color, diffuse.metallic, diffuse.roughness),
        ([0.1, 0.2, 0.3], 0.0, 1.0)
    );
    assert_eq!(of("Material \"diffuse\"").base_color, [0.5; 3]);
    assert_eq!(
        of("Material \"matte\" \"rgb Kd\" [0.1 0.2 2]").base_color,
        [0.1, 0.2, 1.0]
    );
    // α = √0.0625 = 1/4, and its root is the perceptual roughness.
    let coated = of("Material \"coateddiffuse\" \"float roughness\" 0.0625");
    assert_eq!(coated.roughness, 0.5);
    let plain = of("Material \"coateddiffuse\" \"float roughness\" 0.0625 \"bool remaproughness\" false");
    assert_eq!(plain.roughness, 0.25);
    let gold = of(
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float roughness\" 0.0625",
    );
    assert!(gold.metallic == 1.0 && gold.base_color[0] > 2.0 * gold.base_color[2] && gold.roughness == 0.5);
    // Fresnel: ((0.5 - 1)² + 4) / ((0.5 + 1)² + 4).
    let metal = of("Material \"conductor\" \"float eta\" 0.5 \"float k\" 2");
    near(metal.base_color, [4.25 / 6.25; 3], ROUNDED);
    let grey = of("Material \"diffuse\" \"spectrum reflectance\" [300 0.25 900 0.25]");
    near(grey.base_color, [0.25; 3], 1e-5);
    let texture = "Texture \"a\" \"spectrum\" \"constant\" \"rgb value\" [0.5 0.25 1]\nTexture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \
                   \"float scale\" 0.5\nTexture \"c\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"texture tex2\" \"b\"\n";
    let mixed = of(&format!(
        "{texture}Material \"diffuse\" \"texture reflectance\" \"c\""
    ));
    near(mixed.base_color, [0.375, 0.1875, 0.75], ROUNDED);
    let named = of(
        "MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 1 0]\nNamedMaterial \"m\"",
    );
    assert_eq!((named.name.as_str(), named.base_color), ("m", [0.0, 1.0, 0.0]));
}

#[test]
fn glass_is_left_out_unless_it_shines() {
    for glass in ["dielectric", "thindielectric", "interface"] {
        let scene = read(&format!(
            "{TRIANGLE}Material \"{glass}\"\n{TRIANGLE}AreaLightSource \"diffuse\"\n{TRIANGLE}"
        ));
        assert_eq!(
            (scene.triangle_count(), scene.emissive_count()),
            (2, 1),
            "{glass}"
        );
        assert!(scene.warnings()[0].contains("left out unless they emit"));
    }
}

#[test]
fn pictures_count_by_their_means() {
    let mut picture = image::RgbImage::new(2, 1);
    picture.put_pixel(0, 0, image::Rgb([255, 0, 0]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("memory");
    let text = format!(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"half.png\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\n{TRIANGLE}\
         AreaLightSource \"diffuse\" \"string filename\" \"half.png\" \"float scale\" 6\n{TRIANGLE}\
         Texture \"u\" \"spectrum\" \"imagemap\" \"string filename\" \"none.png\"\nMaterial \"diffuse\" \"texture reflectance\" \"u\"\n"
    );
    let folder = Folder::new(
        "maps",
        &[("x.pbrt", text.as_bytes()), ("half.png", &bytes.into_inner())],
    );
    let scene = folder.read("x.pbrt").expect("valid");
    let frame = scene.frame(0);
    assert_eq!(scene.data().materials[1].base_color, [0.5, 0.0, 0.0]);
    assert_eq!(frame.emissive[0].radiance, [3.0, 0.0, 0.0]);
    let warnings = scene.warnings().join("\n");
    assert!(warnings.contains("taken as grey: cannot read"), "{warnings}");
}
