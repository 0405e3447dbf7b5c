//! What pbrt refuses or reads otherwise is named.

use super::*;
use crate::scene::paint::Opacity;

/// A scene that is sound but for `text`, and what is said of it.
fn noted(text: &str) -> (Scene, String) {
    let scene = read(&format!("{UNMIRRORED}{text}\n{TRIANGLE}"));
    let said = scene.warnings().join("\n");
    (scene, said)
}

#[test]
fn light_that_is_replaced_is_named() {
    let light = |params: &str| {
        let (scene, said) = noted(&format!("LightSource \"point\" {params}"));
        (scene.data().analytic.first().map(|light| light.color), said)
    };
    let cold = light("\"blackbody I\" 500").0;
    let hot = light("\"blackbody I\" 1000000").0;
    for (kelvin, expected) in [("0", cold), ("-5", cold), ("499.9", cold), ("1e30", hot)] {
        let (color, said) = light(&format!("\"blackbody I\" {kelvin}"));
        assert!(
            color == expected && said.contains("500 to 1000000 K"),
            "{kelvin}: {said}"
        );
    }
    for (numbers, what) in [
        ("[400]", "odd count"),
        ("[400]", "no list of pairs"),
        ("[700 1 400 1]", "no list of pairs"),
        ("[10 1 20 1]", "nothing where it is visible"),
    ] {
        let (color, said) = light(&format!("\"spectrum I\" {numbers}"));
        assert_eq!(color, Some([1.0; 3]), "{numbers}");
        assert!(
            said.contains(what) && said.contains("taken as white"),
            "{numbers}: {said}"
        );
    }
    let (color, said) = light("\"rgb I\" [-5 5 5]");
    assert_eq!(color, Some([0.0, 5.0, 5.0]));
    assert!(
        said.contains("negative numbers of light by `I` count as 0"),
        "{said}"
    );
    let (color, said) = light("\"float scale\" -2");
    assert_eq!(color, None);
    assert!(said.contains("negative `scale`"), "{said}");
    for fine in [
        "\"blackbody I\" 500",
        "\"spectrum I\" [400 1 700 2]",
        "\"rgb I\" [0 5 5]",
        "\"float scale\" 0",
    ] {
        assert_eq!(light(fine).1, "", "{fine}");
    }
}

#[test]
fn lights_that_shine_nowhere_are_named() {
    for kind in ["spot", "distant"] {
        let at = |to: &str| {
            noted(&format!(
                "LightSource \"{kind}\" \"point3 from\" [0 3 0] \"point3 to\" {to}"
            ))
        };
        let (scene, said) = at("[0 3 0]");
        assert!(scene.data().analytic.is_empty(), "{kind}");
        assert!(said.contains("`from` is at their `to`"), "{kind}: {said}");
        let (scene, said) = at("[0 2 0]");
        assert_eq!((scene.data().analytic.len(), said.as_str()), (1, ""), "{kind}");
    }
}

#[test]
fn surfaces_that_are_replaced_are_named() {
    let base = |text: &str| {
        let (scene, said) = noted(text);
        let data = scene.data();
        let material = data.meshes[0].primitives[0].material;
        (data.materials[material as usize].base_color, said)
    };
    for (given, expected) in [("[-1 0.5 0]", [0.0, 0.5, 0.0]), ("[5 0.5 1]", [1.0, 0.5, 1.0])] {
        let (found, said) = base(&format!("Material \"diffuse\" \"rgb reflectance\" {given}"));
        assert_eq!(found, expected);
        assert!(
            said.contains("`reflectance` of a surface outside of 0 to 1"),
            "{said}"
        );
    }
    let textured = |kind: &str, param: &str| {
        base(&format!(
            "Texture \"t\" \"{kind}\" \"constant\" \"float value\" 0.25\nMaterial \"coateddiffuse\" \"texture {param}\" \"t\""
        ))
    };
    let (found, said) = textured("float", "reflectance");
    assert_eq!(found, [0.25; 3]);
    assert!(
        said.contains("`reflectance` names a texture of kind `float`"),
        "{said}"
    );
    let (_, said) = textured("spectrum", "roughness");
    assert!(
        said.contains("`roughness` names a texture of kind `spectrum`"),
        "{said}"
    );
    assert_eq!(textured("spectrum", "reflectance").1, "");
    assert_eq!(textured("float", "roughness").1, "");
    let (_, said) = base("Material \"diffuse\" \"spectrum reflectance\" [700 1 400 1]");
    assert!(said.contains("taken as grey"), "{said}");
}

/// Half of the light went nowhere: the picture was that of an opaque surface.
#[test]
fn shapes_of_some_alpha_are_seen_through() {
    let first = |alpha: &str, before: &str| {
        let shape = TRIANGLE.replacen("\"trianglemesh\"", &format!("\"trianglemesh\" {alpha}"), 1);
        let (scene, said) = noted(&format!("{before}{shape}{shape}"));
        let data = scene.data();
        let [first, second, last] = [0, 1, 2].map(|mesh| data.meshes[mesh].primitives[0].material);
        assert_eq!(first, second, "the same material");
        let [first, last] = [first, last].map(|material| data.materials[material as usize].clone());
        assert!(last.paint.is_none(), "what comes after is as before");
        (first, said)
    };
    let red = "Material \"coateddiffuse\" \"rgb reflectance\" [1 0 0]\n";
    let (material, said) = first("\"float alpha\" 0.25", red);
    let paint = material.paint.expect("seen through");
    assert_eq!(
        (paint.base, paint.opacity),
        ([1.0, 0.0, 0.0, 0.25], Opacity::Blended)
    );
    assert_eq!(
        (paint.roughness, material.transmission),
        (material.roughness, 0.75)
    );
    assert_eq!(said, "");
    assert!(first("\"float alpha\" 1", red).0.paint.is_none());
    for (alpha, before, what) in [
        ("\"texture alpha\" \"t\"", "", "textures of alpha are left out"),
        ("\"string alpha\" \"x\"", "", "`string alpha` is not one number"),
        (
            "\"float alpha\" 0.5",
            "AreaLightSource \"diffuse\"\n",
            "alpha of shapes that shine",
        ),
        ("\"float shadowalpha\" 0.5", "", "`shadowalpha` is left out"),
    ] {
        let (material, said) = first(alpha, before);
        assert!(material.paint.is_none() && said.contains(what), "{alpha}: {said}");
    }
}

#[test]
fn numbers_of_shapes_that_are_replaced_are_named() {
    for (shape, triangles, what) in [
        (
            "Shape \"sphere\" \"float phimax\" -90",
            0,
            "`phimax` outside of 0 to 360",
        ),
        (
            "Shape \"disk\" \"float phimax\" 720",
            48,
            "`phimax` outside of 0 to 360",
        ),
        ("Shape \"disk\" \"float phimax\" 0", 0, "shapes without area"),
        ("Shape \"disk\" \"float innerradius\" 2", 0, "shapes without area"),
        (
            "Shape \"sphere\" \"float zmin\" 2 \"float zmax\" 3",
            0,
            "shapes without area",
        ),
        (
            "Shape \"cylinder\" \"float zmin\" 1 \"float zmax\" -1",
            96,
            "`zmin` above its `zmax`",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer uv\" [0 0 1 0 0 1]",
            1,
            "`integer uv` is read as `point2 uv`",
        ),
    ] {
        let (scene, said) = noted(shape);
        assert!(said.contains(what), "{shape}: {said}");
        // The triangle that every scene here has.
        assert_eq!(scene.triangle_count(), triangles + 1, "{shape}");
    }
    // Beyond the ends of a sphere there is nothing to leave out.
    let (_, said) = noted("Shape \"sphere\" \"float zmin\" -10 \"float zmax\" 0.5");
    assert_eq!(said, "");
}
