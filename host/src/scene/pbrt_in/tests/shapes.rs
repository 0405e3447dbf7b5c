//! Shapes: windings, sides, bounds.

use super::*;

/// The side that the first emissive triangle shines to.
fn front(text: &str) -> [f64; 3] {
    let scene = read(&format!("{UNMIRRORED}AreaLightSource \"diffuse\"\n{text}"));
    let n = normal(scene.frame(0).emissive[0].p);
    let length = dot(n, n).sqrt();
    n.map(|x| x / length)
}

#[test]
fn winding_orientation_and_transforms_say_which_side_emits() {
    assert_eq!(front(TRIANGLE), [0.0, 0.0, 1.0]);
    assert_eq!(front(&format!("ReverseOrientation {TRIANGLE}")), [0.0, 0.0, -1.0]);
    // A mirror keeps the side that it mirrors: x → −x leaves +z in front.
    assert_eq!(front(&format!("Scale -1 1 1 {TRIANGLE}")), [0.0, 0.0, 1.0]);
    assert_eq!(front(&format!("Scale 1 1 -1 {TRIANGLE}")), [0.0, 0.0, -1.0]);
    // Normals have the last word, and are turned with the orientation.
    let turned = TRIANGLE.replace("\"integer", "\"normal N\" [0 0 -1 0 0 -1 0 0 -1] \"integer");
    assert_eq!(front(&turned), [0.0, 0.0, -1.0]);
    assert_eq!(front(&format!("ReverseOrientation {turned}")), [0.0, 0.0, 1.0]);
    // A patch: the first axis is that of the second corner, the second that of the third.
    let patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]";
    assert_eq!(front(patch), [0.0, 0.0, 1.0]);
    assert_eq!(front(&format!("ReverseOrientation {patch}")), [0.0, 0.0, -1.0]);
}

/// The volume that front faces enclose; negative where they look inward.
fn volume(frame: &Frame) -> f64 {
    let corners = frame
        .triangles
        .iter()
        .map(|triangle| triangle.p.map(|p| p.map(f64::from)));
    corners.map(|[a, b, c]| dot(a, cross(b, c)) / 6.0).sum()
}

#[test]
fn spheres_discs_and_cylinders_are_as_large_as_they_say() {
    let frame = |shape: &str| read(&format!("{UNMIRRORED}{shape}")).frame(0);
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
    // 48 by 24 facets lie within the ball: less by some π² / 3 (1 / 24² + ...), about 1 %.
    let found = volume(&frame("Shape \"sphere\" \"float radius\" 2"));
    assert!(found > 0.97 * ball && found < ball, "{found} of {ball}");
    let found = volume(&frame("ReverseOrientation Shape \"sphere\" \"float radius\" 2"));
    assert!(found < -0.97 * ball, "{found}");
    // Outward in a mirrored space too.
    let found = volume(&frame("Scale -1 1 1 Shape \"sphere\" \"float radius\" 2"));
    assert!(found > 0.97 * ball, "{found}");
    let area = |frame: &Frame| -> f64 {
        let sizes = frame.triangles.iter().map(|triangle| {
            let n = normal(triangle.p);
            0.5 * dot(n, n).sqrt()
        });
        sizes.sum()
    };
    // 48 sides are 0.3 % less than a circle.
    let ring = area(&frame(
        "Shape \"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float phimax\" 180",
    ));
    let expected = 0.5 * std::f64::consts::PI * (4.0 - 1.0);
    assert!((ring / expected - 1.0).abs() < 0.01, "{ring}");
    let pipe = area(&frame(
        "Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 1 \"float zmax\" 4",
    ));
    let expected = std::f64::consts::TAU * 2.0 * 3.0;
    assert!((pipe / expected - 1.0).abs() < 0.01, "{pipe}");
    for triangle in &frame("Shape \"cylinder\"").triangles {
        let n = normal(triangle.p);
        let p = triangle.p[0].map(f64::from);
        assert!(n[0] * p[0] + n[1] * p[1] > 0.0, "a pipe's front is outside");
    }
    let n = normal(frame("Shape \"disk\"").triangles[0].p);
    assert!(n[2] > 0.0, "a disc's front is +z");
}

#[test]
fn meshes_in_files_are_shared_and_may_be_missing() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
               property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let shape = "Shape \"plymesh\" \"string filename\" \"quad.ply\"\n";
    let text = format!(
        "{shape}Translate 0 0 1 {shape}Shape \"plymesh\" \"string filename\" \"none.ply\"\nShape \"curve\" \"float width\" 1"
    );
    let folder = Folder::new(
        "ply",
        &[("x.pbrt", text.as_bytes()), ("quad.ply", ply.as_bytes())],
    );
    let scene = folder.read("x.pbrt").expect("valid");
    assert_eq!(scene.triangle_count(), 4);
    assert_eq!(scene.data().meshes.len(), 1);
    let warnings = scene.warnings().join("\n");
    assert!(
        warnings.contains("none.ply") && warnings.contains("`curve` are left out"),
        "{warnings}"
    );
}

#[test]
fn meshes_that_contradict_themselves_are_refused_by_line() {
    let cases = [
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3]",
            "vertex 3, but there are only 3",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1]",
            "not a multiple of 3",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 -1]",
            "vertex -1",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0]",
            "5 numbers, not a multiple of 3",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0]",
            "no `indices`",
        ),
        ("Shape \"trianglemesh\" \"point3 P\" [0 0 nan]", "not finite"),
        ("Shape \"trianglemesh\" \"point3 P\" [0 0 0", "ends in a list"),
        ("Shape \"trianglemesh\" \"P\" [0 0 0]", "no type and name"),
        ("Shape trianglemesh", "in quotes, found `trianglemesh`"),
        ("Shape \"trianglemesh", "does not end on its line"),
    ];
    for (text, expected) in cases {
        let error = refused(&format!("\n\n{text}"));
        assert!(
            error.starts_with("x.pbrt, line 3: ") && error.contains(expected),
            "{error}"
        );
    }
    assert!(refused("WorldBegin").contains("no triangles"));
    // The mesh that is missing is why.
    let error = refused("WorldBegin\nShape \"plymesh\" \"string filename\" \"missing.ply\"");
    assert!(
        error.contains("no triangles") && error.contains("meshes in files are left out"),
        "{error}"
    );
}
