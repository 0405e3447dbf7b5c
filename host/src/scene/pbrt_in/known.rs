//! Which parameters directives have, in pbrt-v4 and in what versions 1 to 3 wrote: any other is most likely misspelt, and pbrt
//! itself refuses it.

/// Of cameras of every kind.
const CAMERA: &[&str] = &[
    "aperture",
    "aperturediameter",
    "filmdistance",
    "focaldistance",
    "focusdistance",
    "fov",
    "frameaspectratio",
    "halffov",
    "hither",
    "lensfile",
    "lensradius",
    "mapping",
    "screenwindow",
    "shutterclose",
    "shutteropen",
    "simpleweighting",
    "yon",
];

/// Of films of every kind.
const FILM: &[&str] = &[
    "coordinatesystem",
    "cropwindow",
    "diagonal",
    "display",
    "exposuretime",
    "filename",
    "gain",
    "imagingratio",
    "iso",
    "lambdamax",
    "lambdamin",
    "maxcomponentvalue",
    "maxsampleluminance",
    "nbuckets",
    "pixelbounds",
    "premultiplyalpha",
    "savefp16",
    "scale",
    "sensor",
    "whitebalance",
    "writefrequency",
    "xresolution",
    "yresolution",
];

/// Of shapes of every kind.
const SHAPE: &[&str] = &["alpha", "shadowalpha"];

const TRIANGLES: &[&str] = &[
    "N",
    "P",
    "S",
    "discarddegenerateUVs",
    "emissionfilename",
    "faceIndices",
    "indices",
    "st",
    "uv",
];

const SUBDIVISION: &[&str] = &["P", "indices", "levels", "nlevels", "scheme"];

const PLY: &[&str] = &[
    "displacement",
    "displacement.edgelength",
    "displacement.texscale",
    "displacement.uvscale",
    "edgelength",
    "filename",
];

const ROUND: &[&str] = &["height", "innerradius", "phimax", "radius", "zmax", "zmin"];

/// Of lights of every kind.
const LIGHT: &[&str] = &[
    "I",
    "L",
    "conedeltaangle",
    "coneangle",
    "filename",
    "fov",
    "from",
    "illuminance",
    "mapname",
    "nsamples",
    "portal",
    "power",
    "samples",
    "scale",
    "spectrum",
    "to",
];

const AREA_LIGHT: &[&str] = &[
    "L", "filename", "nsamples", "power", "samples", "scale", "twosided",
];

/// Of materials of every kind.
const MATERIAL: &[&str] = &[
    "B",
    "Kd",
    "Kr",
    "Ks",
    "Kt",
    "albedo",
    "alpha",
    "amount",
    "anisotropic",
    "basecolor",
    "beta_m",
    "beta_n",
    "bsdffile",
    "bumpmap",
    "clearcoat",
    "clearcoatgloss",
    "color",
    "conductor.eta",
    "conductor.k",
    "conductor.reflectance",
    "conductor.roughness",
    "conductor.uroughness",
    "conductor.vroughness",
    "difftrans",
    "displacement",
    "eta",
    "eumelanin",
    "filename",
    "flatness",
    "g",
    "index",
    "interface.eta",
    "interface.roughness",
    "interface.uroughness",
    "interface.vroughness",
    "k",
    "materials",
    "maxdepth",
    "metallic",
    "mfp",
    "name",
    "namedmaterial1",
    "namedmaterial2",
    "normalmap",
    "nsamples",
    "opacity",
    "pheomelanin",
    "reflect",
    "reflectance",
    "remaproughness",
    "roughness",
    "scale",
    "scatterdistance",
    "sheen",
    "sheentint",
    "sigma",
    "sigma_a",
    "sigma_prime_s",
    "sigma_s",
    "spectrans",
    "speculartint",
    "thickness",
    "thin",
    "transmit",
    "transmittance",
    "type",
    "uroughness",
    "vroughness",
];

/// Of textures of every class.
const TEXTURE: &[&str] = &[
    "aamode",
    "amount",
    "dimension",
    "dir",
    "encoding",
    "filename",
    "filter",
    "gamma",
    "inside",
    "invert",
    "mapping",
    "maxanisotropy",
    "octaves",
    "outside",
    "roughness",
    "scale",
    "tex",
    "tex1",
    "tex2",
    "trilinear",
    "udelta",
    "uscale",
    "v00",
    "v01",
    "v1",
    "v10",
    "v11",
    "v2",
    "value",
    "variation",
    "vdelta",
    "vscale",
    "wrap",
];

/// Whether a directive has a parameter of a name; of directives and shapes that are not known, every one.
pub(super) fn is_known(directive: &str, kind: &str, name: &str) -> bool {
    let of_shape = match kind {
        "trianglemesh" | "bilinearmesh" => TRIANGLES,
        "loopsubdiv" => SUBDIVISION,
        "plymesh" => PLY,
        "sphere" | "disk" | "cylinder" => ROUND,
        _ => &[],
    };
    match directive {
        "Camera" => CAMERA.contains(&name),
        "Film" => FILM.contains(&name),
        "Shape" if !of_shape.is_empty() => of_shape.contains(&name) || SHAPE.contains(&name),
        "LightSource" => LIGHT.contains(&name),
        "AreaLightSource" => AREA_LIGHT.contains(&name),
        "Material" | "MakeNamedMaterial" => MATERIAL.contains(&name),
        "Texture" => TEXTURE.contains(&name),
        _ => true,
    }
}
