//! Functions for shaders: what they promise, from a shader of one's own in WGSL, on every device.

use std::mem::offset_of;
use std::path::Path;
use std::process::Command;

use bytemuck::bytes_of;
use glam::Vec3;
use lightbvh::importance::Cell;
use lightbvh::light::Light;
use lightbvh::refit::world_light;
use lightbvh::{
    EmissiveTriangle, Instance, LightBvh, LightPoint, Random64, SampledLight, ShadingPoint, TreeWords,
};
use lightbvh_gpu::{Access, Binding, Kernel, MOMENTS, Query, functions};
use lightbvh_host::backend::Mirrored;
use lightbvh_host::vulkan::Options;
use lightbvh_kernels_builder::manifest::{self, ModuleRecord, read_module};
use lightbvh_kernels_builder::shader::{Language, Library, Naming, SETS, Set, kernel};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::{Random, small_triangles};
use lightbvh_tests::placing;
use lightbvh_tests::statistics::{chi_squared, chi_squared_quantile};
use naga::TypeInner;

/// Answers a sample, its probability by `pmf`, and a point on its light; or the probability of the light of the query.
const OWN: &str = "
struct Query { p: array<f32, 3>, n: array<f32, 3>, words: vec2<u32> }
struct Answer { light: u32, instance: u32, pmf: f32, again: f32, p: array<f32, 3>, density: f32, radiance: array<f32, 3>, own: f32, cell: f32, cell_again: f32, cell_own: f32 }
@group(0) @binding(4) var<storage> queries: array<Query>;
@group(0) @binding(5) var<storage, read_write> results: array<Answer>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let p = vec3(query.p[0], query.p[1], query.p[2]);
    let n = vec3(query.n[0], query.n[1], query.n[2]);
    let own = lightbvh_sample(p, n, query.words);
    let again = lightbvh_pmf(p, n, own.light, own.instance);
    let at = lightbvh_light_point(own.light, own.instance, vec2(0.25, 0.5));
    let asked = lightbvh_pmf(p, n, query.words.x, query.words.y);
    let half = vec3(0.5, 0.25, 1.0);
    let cell = lightbvh_sample_cell(p, half, 0.7 * n, query.words);
    let cell_again = lightbvh_pmf_cell(p, half, 0.7 * n, cell.light, cell.instance);
    let cell_own = lightbvh_pmf_cell(p, half, 0.7 * n, query.words.x, query.words.y);
    results[id.x] = Answer(own.light, own.instance, own.pmf, again,
        array(at.p.x, at.p.y, at.p.z), at.density, array(at.radiance.x, at.radiance.y, at.radiance.z), asked, cell.pmf, cell_again, cell_own);
}
";

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
struct Answer {
    light: u32,
    instance: u32,
    pmf: f32,
    again: f32,
    p: [f32; 3],
    density: f32,
    radiance: [f32; 3],
    own: f32,
    cell: f32,
    cell_again: f32,
    cell_own: f32,
}

const fn buffer(binding: u32, name: &'static str, stride: u32) -> Binding {
    let access = if binding == 5 { Access::Write } else { Access::Read };
    Binding {
        binding,
        name,
        access,
        stride,
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn prefixed(prefix: &str) -> Naming {
    Naming {
        prefix: prefix.to_owned(),
        ..Naming::default()
    }
}

/// The library of a set, from the committed modules.
fn library(naming: Naming, set: &Set) -> Result<Library, lightbvh_kernels_builder::Error> {
    let committed = manifest::read(root())?;
    Library::new(naming, set, |kernel| {
        manifest::module(root(), &committed, &format!("{kernel}{}.spv", set.suffix))
    })
}

/// How the host binds it.
const KERNEL: Kernel = Kernel {
    name: "functions",
    bytes: &[],
    bindings: &[
        buffer(0, "nodes", 192),
        buffer(1, "instances", 136),
        buffer(2, "trails", 4),
        buffer(3, "lights", 56),
        buffer(4, "queries", 32),
        buffer(5, "results", 60),
    ],
    push_constants: 36,
    workgroup: [64, 1, 1],
};

/// The shader in SPIR-V. The host passes the tree's words as push constants.
fn module() -> Vec<u32> {
    let library = functions::WGSL.replace("@group(0) @binding(4)\nvar<uniform>", "var<immediate>");
    assert_ne!(library, functions::WGSL);
    let parsed = naga::front::wgsl::parse_str(&format!("{library}\n{OWN}")).unwrap();
    let capabilities = naga::valid::Capabilities::IMMEDIATES;
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities);
    let info = validator.validate(&parsed).unwrap();
    let options = naga::back::spv::Options {
        lang_version: (1, 5),
        flags: naga::back::spv::WriterFlags::empty(),
        ..Default::default()
    };
    naga::back::spv::write_vec(&parsed, &info, &options, None).unwrap()
}

/// Instances under rigid and affine maps, of a mesh of 40 triangles and of single lights.
fn lights(random: &mut Random) -> LightBvh {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(small_triangles(40, 40, 2.0, 0.2, false, 5)).unwrap();
    let lamp = bvh.add_mesh(small_triangles(1, 1, 0.1, 0.1, false, 6)).unwrap();
    for k in 0..60 {
        let kind = [placing::Kind::Rigid, placing::Kind::Affine][k % 2];
        let own = if k % 3 == 0 { mesh } else { lamp };
        bvh.add_instance(own, placing::transform(random, kind, 10.0))
            .unwrap();
    }
    bvh.refit();
    bvh
}

/// Sums of probabilities are one; each light that the CPU may choose can be chosen; lights come as often as the device's own
/// probabilities say; and deviations from the CPU's words are few and small.
#[test]
fn functions_keep_their_promises() {
    const SAMPLES: usize = 40_000;
    let words = module();
    let mut random = Random::new(52);
    let bvh = lights(&mut random);
    let tree = bvh.tree();
    let view = bvh.view();
    // Each light with its instance.
    let all: Vec<[u32; 2]> = (0..)
        .zip(view.instances())
        .flat_map(|(k, own)| (own.first..own.first + own.count).map(move |light| [light, k]))
        .collect();
    let points: Vec<ShadingPoint> = (0..4)
        .map(|_| lightbvh_tests::generate::point(&mut random, 10.0))
        .collect();
    on_each_device(Options::default(), |device| {
        device.kernel_from_words(KERNEL.name, &words).expect("a kernel");
        let mut arrays = Mirrored::new(device, MOMENTS).expect("arrays");
        arrays.follow(&bvh).expect("a frame");
        let ask = |queries: &[Query]| -> Vec<Answer> {
            let queries_held = device.upload(queries).expect("an upload");
            let answers = arrays.ask(
                &KERNEL,
                queries.len(),
                bytes_of(&arrays.words()),
                &[("queries", queries_held.bind())],
            );
            answers.expect("the answers").value
        };
        let mut random = Random::new(53);
        let (mut different, mut furthest) = (0, 0.0_f32);
        for &point in &points {
            let asked: Vec<Query> = all
                .iter()
                .map(|&[light, instance]| Query::pmf(point, light, instance))
                .collect();
            let answers = ask(&asked);
            // As in the shader.
            let cell = Cell {
                center: point.p,
                half: [0.5, 0.25, 1.0],
                n: point.n.map(|x| 0.7 * x),
            };
            let of_cell: f64 = answers.iter().map(|own| f64::from(own.cell_own)).sum();
            assert!((of_cell - 1.0).abs() < 1e-4, "{}: {of_cell}", device.name());
            let pmfs: Vec<f64> = answers.iter().map(|own| f64::from(own.own)).collect();
            assert!((pmfs.iter().sum::<f64>() - 1.0).abs() < 1e-4, "{}", device.name());
            for (own, &[light, instance]) in answers.iter().zip(&all) {
                let at_point = (own.own, tree.pmf(&point, light, instance));
                let of_cell = (own.cell_own, tree.pmf(&cell, light, instance));
                for (pmf, expected) in [at_point, of_cell] {
                    assert_eq!(pmf > 0.0, expected > 0.0, "light {light} of {instance}");
                    if expected > 0.0 {
                        furthest = furthest.max((pmf / expected - 1.0).abs());
                    }
                }
            }
            let numbers: Vec<Random64> = (0..SAMPLES)
                .map(|_| Random64 {
                    high: random.bits(),
                    low: random.bits(),
                })
                .collect();
            let asked: Vec<Query> = numbers
                .iter()
                .map(|&number| Query::sample(point, number))
                .collect();
            let mut counts = vec![0; all.len()];
            for (own, &number) in ask(&asked).iter().zip(&numbers) {
                let k = all
                    .iter()
                    .position(|&own_light| own_light == [own.light, own.instance])
                    .expect("a light");
                counts[k] += 1;
                assert_eq!((own.pmf, own.cell), (own.again, own.cell_again));
                assert_eq!(f64::from(own.pmf), pmfs[k]);
                let expected = tree.sample(&point, number);
                different += usize::from((own.light, own.instance) != (expected.light, expected.instance));
                let light: EmissiveTriangle =
                    world_light(view.lights(), tree.instances, own.light, own.instance);
                let on: LightPoint = light.point_for(Vec3::ZERO, [0.25, 0.5]);
                assert_eq!(own.radiance, on.radiance);
                let far = |a: [f32; 3], b: [f32; 3]| (Vec3::from(a) - Vec3::from(b)).length();
                assert!(far(own.p, on.p) < 1e-4, "{:?}, expected {:?}", own.p, on.p);
                assert!(
                    (own.density / on.density - 1.0).abs() < 1e-3,
                    "{} of {}",
                    own.density,
                    on.density
                );
            }
            let (statistic, degrees) = chi_squared(&counts, &pmfs);
            assert!(
                statistic < chi_squared_quantile(degrees, 1e-7),
                "{}: {statistic} of {degrees}",
                device.name()
            );
        }
        println!(
            "{}: {different} of {} samples are another light than the CPU's; probabilities deviate by at most {furthest:e} of them",
            device.name(),
            SAMPLES * points.len()
        );
        // One in a hundred is far above what differs by rounding alone.
        assert!(
            different < SAMPLES * points.len() / 100 && furthest < 0.02,
            "{different}, {furthest}"
        );
    });
}

/// Each set of kernels in each language, under other names and bindings. Text in WGSL is parsed again, and in GLSL by
/// glslang where it is installed.
#[test]
fn each_set_is_printed_in_each_language() {
    let folder = std::env::temp_dir().join(format!("lightbvh-functions-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for set in &SETS {
        let suffix = set.suffix;
        let naming = Naming {
            prefix: "many_lamps".to_owned(),
            group: 2,
            bindings: [7, 6, 5, 4, 3],
        };
        let library = library(naming, set).unwrap();
        for language in Language::ALL {
            let text = library.print(language).unwrap();
            assert!(
                text.contains(" many_lamps_sample(") && text.contains("ManyLampsLightSample"),
                "{language:?}"
            );
            assert!(!text.contains("lightbvh_"), "{language:?}");
            match language {
                Language::Wgsl => {
                    let parsed = naga::front::wgsl::parse_str(&text).unwrap();
                    let mut bound: Vec<_> = parsed
                        .global_variables
                        .iter()
                        .filter_map(|(_, own)| own.binding)
                        .collect();
                    bound.sort_by_key(|own| own.binding);
                    let bound: Vec<_> = bound.iter().map(|own| (own.group, own.binding)).collect();
                    assert_eq!(bound, [(2, 3), (2, 4), (2, 5), (2, 6), (2, 7)]);
                }
                Language::Glsl => {
                    for binding in 3..=7 {
                        assert!(text.contains(&format!("set = 2, binding = {binding})")));
                    }
                    let file = folder.join(format!("functions{suffix}.comp"));
                    let whole =
                        format!("#version 450\n{text}\nlayout(local_size_x = 1) in;\nvoid main() {{}}\n");
                    std::fs::write(&file, whole).unwrap();
                    match Command::new("glslangValidator")
                        .arg("-V")
                        .arg(&file)
                        .args(["-o", "/dev/null"])
                        .output()
                    {
                        Ok(output) => assert!(
                            output.status.success(),
                            "{}",
                            String::from_utf8_lossy(&output.stdout)
                        ),
                        Err(_) => eprintln!("skipped: glslangValidator is not installed"),
                    }
                }
                Language::Hlsl => {
                    assert!(text.contains("ByteAddressBuffer many_lamps_nodes : register(t7, space2)"))
                }
                Language::Msl => assert!(text.contains("device ManyLampsNodes const& many_lamps_nodes")),
            }
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Prefixes that a language keeps for itself are refused, not renamed.
#[test]
fn prefixes_are_free_or_refused() {
    for (prefix, kept) in [("gl", Language::Glsl), ("naga", Language::Hlsl)] {
        let library = library(prefixed(prefix), &SETS[0]).unwrap();
        let error = library.print(kept).unwrap_err().to_string();
        assert!(error.contains("choose another prefix"), "{error}");
        assert!(library.print(Language::Wgsl).is_ok());
    }
    for prefix in ["", "Lamps", "1a", "a__b", "a_", "ä", &"a".repeat(65)] {
        let error = library(prefixed(prefix), &SETS[0]).unwrap_err().to_string();
        assert!(error.contains("is no prefix"), "{error}");
    }
    let naming = Naming {
        bindings: [0, 1, 2, 3, 1],
        ..Naming::default()
    };
    let error = library(naming, &SETS[0]).unwrap_err().to_string();
    assert!(error.contains("not different"), "{error}");
}

/// Structs have the fields of Rust's at their offsets. Arguments have the names that the documents give.
#[test]
fn names_are_those_of_rust() {
    let parsed = naga::front::wgsl::parse_str(functions::WGSL).unwrap();
    macro_rules! same {
        ($name:literal, $type:ty: $($field:ident),*) => {
            let expected = [$((stringify!($field), offset_of!($type, $field))),*];
            let own = parsed.types.iter().find(|(_, own)| own.name.as_deref() == Some($name));
            let TypeInner::Struct { members, .. } = &own.expect($name).1.inner else {
                panic!("{} is no struct", $name);
            };
            let found: Vec<_> = members
                .iter()
                .map(|own| (own.name.as_deref().unwrap_or_default(), own.offset as usize))
                .collect();
            assert_eq!(found, expected, "{}", $name);
        };
    }
    same!("LightbvhInstance", Instance: root, blas, first, first_light, count, listed, columns, translation, inverse, per_inverse, flux,
        radiance, mask, mirrored);
    same!("LightbvhTree", TreeWords: root, trail_words, live, lights, depth, top, above, places, parts);
    same!("LightbvhLight", EmissiveTriangle: p, radiance, mesh, flags);
    same!("LightbvhLightSample", SampledLight: light, instance, pmf);
    for (name, arguments) in [
        ("lightbvh_sample", "p n number"),
        ("lightbvh_pmf", "p n light instance"),
        ("lightbvh_sample_cell", "center half n number"),
        ("lightbvh_pmf_cell", "center half n light instance"),
        ("lightbvh_light_point", "light instance numbers"),
    ] {
        let mut all = parsed.functions.iter().map(|(_, own)| own);
        let own = all.find(|own| own.name.as_deref() == Some(name)).expect(name);
        // Names that were taken have a number behind them.
        let bare = |own: &str| {
            own.trim_end_matches(|c: char| c.is_ascii_digit())
                .trim_end_matches('_')
                .to_owned()
        };
        let found: Vec<_> = own
            .arguments
            .iter()
            .filter_map(|own| own.name.as_deref().map(bare))
            .collect();
        assert_eq!(found.join(" "), arguments);
    }
}

/// A whole kernel binds its push constants behind its buffers; a module that is not the recorded one is refused.
#[test]
fn whole_kernels_are_printed() {
    let root = root();
    let committed = manifest::read(root).unwrap();
    let own = MOMENTS.refit_top;
    let (words, buffers) = manifest::module(root, &committed, &format!("{}.spv", own.name)).unwrap();
    let text = kernel(&words, &buffers).unwrap();
    for binding in 0..=own.bindings.len() {
        assert_eq!(text.matches(&format!("@group(0) @binding({binding})")).count(), 1);
    }
    let record = committed
        .modules
        .iter()
        .find(|own| own.file == "sample.spv")
        .unwrap();
    let other = ModuleRecord {
        file: "pmf.spv".to_owned(),
        ..record.clone()
    };
    assert!(read_module(root, record).is_ok());
    assert!(
        read_module(root, &other)
            .unwrap_err()
            .to_string()
            .contains("(hash)")
    );
}
