//! Inputs of functions: the ends of each domain, what is special between them, and random numbers.

use lightbvh::{Instance, LightBounds, LightMoments, ShadingPoint, exact};

use super::super::Table;
use super::super::functions::words_of;
use super::trees::instances_of_any_kind;
use super::words;
use crate::generate::{Random, any_bounds, extreme_triangle, log_uniform, small_triangles};

/// Random rows of each arithmetic table, beside the special ones.
const RANDOM: u32 = 64;

fn special() -> Vec<f32> {
    let least = f32::MIN_POSITIVE;
    let magnitudes = [
        0.0,
        least,
        least.next_up(),
        2.0 * least,
        exact::pow2(-100),
        exact::pow2(-100).next_down(),
        0.5_f32.next_down(),
        1.0_f32.next_down(),
        1.0,
        1.0_f32.next_up(),
        1.5,
        2.0_f32.next_down(),
        3.0,
        8_388_607.5,
        16_777_215.0,
        exact::pow2(24),
        exact::pow2(40),
        exact::pow2(125),
        f32::MAX.next_down(),
        f32::MAX,
    ];
    magnitudes.iter().flat_map(|&x| [x, -x]).collect()
}

/// Numbers that devices may take for zero; only functions that say what they make of them get these.
const SUBNORMAL: [u32; 6] = [1, 0x8000_0001, 0x007f_ffff, 0x807f_ffff, 0x0040_0000, 0x8000_1000];

fn normal(random: &mut Random) -> f32 {
    let bits = random.bits();
    f32::from_bits((bits & 0x807f_ffff) | ((1 + (random.bits() % 254)) << 23))
}

fn one(name: &str, note: &str, numbers: impl IntoIterator<Item = f32>) -> Table {
    let rows: Vec<u32> = numbers.into_iter().map(f32::to_bits).collect();
    Table::new(name, note, 1, 1, &rows)
}

/// The special numbers that `keep` takes, and random ones in `range` of exponents.
fn in_domain(random: &mut Random, keep: fn(f32) -> bool, low: i32, high: i32) -> Vec<f32> {
    let mut out: Vec<f32> = special().into_iter().filter(|&x| keep(x)).collect();
    out.extend(
        (0..RANDOM)
            .map(|_| log_uniform(random, low, high))
            .filter(|&x| keep(x)),
    );
    out
}

/// Arithmetic.
pub fn exact() -> (&'static str, Vec<Table>) {
    let random = &mut Random::new(0x6b6e_6f01);
    let subnormal = SUBNORMAL.map(f32::from_bits);
    let mut pairs = Vec::new();
    for a in special() {
        pairs.extend(special().into_iter().map(|b| [a, b]));
    }
    pairs.extend((0..4 * RANDOM).map(|_| [normal(random), normal(random)]));
    // Every thirteenth of the special pairs will do, and all random ones.
    let pairs: Vec<[f32; 2]> = pairs
        .iter()
        .enumerate()
        .filter(|(i, _)| i % 13 == 0 || *i >= special().len().pow(2))
        .map(|(_, &p)| p)
        .collect();
    let mut quotients: Vec<[f32; 2]> = pairs.iter().copied().filter(|p| p[1] != 0.0).collect();
    quotients.extend(subnormal.map(|a| [a, 3.0]));
    // What is just below the normal range, and just not.
    quotients.extend((126..130_u32).map(|e| [f32::MIN_POSITIVE.next_up(), f32::from_bits(e << 23 | 1)]));
    let near: Vec<[f32; 2]> = (0..RANDOM)
        .map(|_| {
            let b = normal(random);
            [f32::from_bits(b.to_bits().wrapping_add(random.below(9))), b]
        })
        .filter(|p| p[0].is_finite())
        .collect();
    quotients.extend(near);
    let two = |name: &str, note: &str, pairs: &[[f32; 2]]| Table::new(name, note, 2, 1, &words(pairs));
    // Sums and products of magnitudes whose results are normal or zero.
    let moderate: Vec<[f32; 3]> = (0..2 * RANDOM)
        .map(|i| {
            let mut x = || log_uniform(random, -40, 39) * if random.below(2) == 0 { 1.0 } else { -1.0 };
            let (a, b, c) = (x(), x(), x());
            [a, b, if i % 2 == 0 { -(a * b) } else { c }]
        })
        .collect();
    let moderate_pairs: Vec<[f32; 2]> = moderate.iter().map(|&[a, b, _]| [a, b]).collect();

    let mut roots = in_domain(random, |_| true, -126, 126);
    roots.extend(subnormal);
    let with_subnormal = |numbers: Vec<f32>| numbers.into_iter().chain(subnormal).collect::<Vec<f32>>();
    let any: Vec<f32> = with_subnormal(
        special()
            .into_iter()
            .chain((0..RANDOM).map(|_| normal(random)))
            .collect(),
    );
    let reciprocal = |x: f32| (f32::MIN_POSITIVE..=exact::pow2(125)).contains(&exact::abs(x));
    let root = |x: f32| x >= exact::pow2(-125);
    let recips = in_domain(random, reciprocal, -126, 124);
    let rsqrts = in_domain(random, root, -125, 126);
    let integers: Vec<u32> = [0, 1, 2, 0x7fff_ffff, 0x8000_0000, u32::MAX - 1, u32::MAX]
        .into_iter()
        .chain((0..RANDOM).map(|_| random.bits()))
        .collect();
    let clamps: Vec<[f32; 3]> = pairs
        .iter()
        .step_by(3)
        .map(|&[x, y]| [x, exact::min(y, 1.0), exact::max(y, 1.0)])
        .collect();
    let tiny = exact::pow2(-100);
    let flushed: Vec<[f32; 2]> = any.iter().flat_map(|&x| [[x, tiny], [x, 1.0]]).collect();
    let powers: Vec<u32> = (-150..=150_i32)
        .step_by(3)
        .chain([i32::MIN, i32::MAX])
        .map(|e| e as u32)
        .collect();

    let tables = vec![
        two(
            "div",
            "a b -> a / b, rounded to nearest; below 2^-126 the zero of the quotient's sign",
            &quotients,
        ),
        one(
            "sqrt",
            "x -> its root, rounded to nearest; +0 below 2^-126",
            roots,
        ),
        one("recip", "x -> about 1 / x", recips.clone()),
        one("recip_rough", "x -> about 1 / x", recips),
        one("rsqrt", "x -> about 1 / sqrt(x)", rsqrts.clone()),
        one("rsqrt_rough", "x -> about 1 / sqrt(x)", rsqrts),
        two("min", "a b -> a where a < b, else b", &pairs),
        two("max", "a b -> a where a > b, else b", &pairs),
        Table::new("clamp", "x lo hi", 3, 1, &words(&clamps)),
        one("abs", "x -> |x|", any.clone()),
        Table::new(
            "flush",
            "x tiny -> x, or +0 where |x| < tiny",
            2,
            1,
            &words(&flushed),
        ),
        one("order_key", "x -> an integer in the order of x", any.clone()),
        one(
            "exponent",
            "x -> e of x = s 2^e, as i32; -127 for zero and subnormal numbers",
            any,
        ),
        one(
            "significand",
            "x -> s of x = s 2^e",
            in_domain(random, |x| x >= f32::MIN_POSITIVE, -126, 126),
        ),
        Table::new("pow2", "e as i32 -> 2^e, e moved into -126..=127", 1, 1, &powers),
        one(
            "floor_u32",
            "x in 0..=2^24 -> integer",
            in_domain(random, |x| (0.0..=16_777_216.0).contains(&x), -3, 23),
        ),
        one(
            "floor_small",
            "x in 0..2^22 -> integer",
            in_domain(random, |x| (0.0..4_194_304.0).contains(&x), -3, 21),
        ),
        Table::new("hash", "integer -> integer", 1, 1, &integers),
        Table::new(
            "unit_f32",
            "integer -> its upper 24 bits times 2^-24",
            1,
            1,
            &integers,
        ),
        two("add", "a b -> a + b", &moderate_pairs),
        two("sub", "a b -> a - b", &moderate_pairs),
        two("mul", "a b -> a * b", &moderate_pairs),
        Table::new(
            "multiply_add",
            "a b c -> a * b + c, rounded twice",
            3,
            1,
            &words(&moderate),
        ),
    ];
    (
        "Arithmetic: crate `lightbvh`, module `exact`, and the operations it rests on.",
        tables,
    )
}

const BOUNDS: &str = "bounds: min[3] max[3] axis[3] cos_theta_o cos_theta_e phi";
const MOMENTS: &str = "moments: phi c[3] across along m[3] h[3]";
/// Words of an instance.
const INSTANCE: usize = size_of::<Instance>() / 4;

/// Summaries of triangles and of sets, their words in nodes, their place in the world.
pub fn bounds() -> (&'static str, Vec<Table>) {
    let random = &mut Random::new(0x6b6e_6f02);
    let triangles: Vec<_> = (0..64).map(|_| extreme_triangle(random)).collect();
    let any: Vec<LightBounds> = (0..64).map(|_| any_bounds(random)).collect();
    let encoded: Vec<u32> = any.iter().chain(&corners()).flat_map(words_of).collect();
    // Sets of four and of eight, some of them without flux, some alike.
    let sets = |random: &mut Random, size: usize, rows: u32, words: &dyn Fn(usize) -> Vec<u32>| -> Vec<u32> {
        let mut out = Vec::new();
        for row in 0..rows {
            for slot in 0..size as u32 {
                let all_alike = row % 8 == 7;
                out.extend(words(if all_alike {
                    row as usize
                } else {
                    (row * 7 + slot * 11 + random.below(3)) as usize
                }));
            }
        }
        out
    };
    let bounds_of = |i: usize| {
        let mut bounds = any[i % 64];
        if i.is_multiple_of(5) {
            bounds.phi = 0.0;
        }
        words_of(&bounds)
    };
    let moments_of = |i: usize| words_of(&LightMoments::of_triangle(&triangles[i % 64]));
    let (mut placed, mut placed_moments, mut vertices) = (Vec::new(), Vec::new(), Vec::new());
    for (i, instance) in instances_of_any_kind(random).iter().cycle().take(48).enumerate() {
        let own = words(&[*instance]);
        placed.extend([&own[..], &words_of(&LightBounds::of_triangle(&triangles[i]))].concat());
        placed_moments.extend([&own[..], &moments_of(i)].concat());
        vertices.extend([&own[..], &triangles[i].p[i % 3].map(f32::to_bits)].concat());
    }
    let instance = "instance (34 words, see tree_instances.txt)";
    let tables = vec![
        Table::new(
            "triangle_bounds",
            &format!("p0[3] p1[3] p2[3] radiance[3] mesh flags ->\n{BOUNDS}"),
            14,
            12,
            &words(&triangles),
        ),
        Table::new(
            "triangle_moments",
            &format!("the same ->\n{MOMENTS}"),
            14,
            12,
            &words(&triangles),
        ),
        Table::new(
            "merge_bounds",
            "bounds of four sets -> bounds of all",
            48,
            12,
            &sets(random, 4, 48, &bounds_of),
        ),
        Table::new(
            "merge_moments",
            "moments of eight sets -> moments of all",
            96,
            12,
            &sets(random, 8, 40, &moments_of),
        ),
        Table::new(
            "encode_bounds",
            "bounds -> the seven words of a slot of CompactNode (center_x center_y center_z extent axis_kind phi_cone link; \
             kind 2, link 7),\nthe bounds they decode to,\nand what importance sees: center[3] extent[3] r^2 axis[3] \
             cos_theta_o sin_theta_o cos_theta_e phi",
            12,
            33,
            &encoded,
        ),
        Table::new(
            "encode_moments",
            "moments of eight children -> the words of a MomentNode (kinds 2, links 0 to 7), and the moments they decode to",
            96,
            48 + 96,
            &sets(random, 8, 24, &moments_of),
        ),
        Table::new(
            "bounds_to_world",
            &format!("{instance}, bounds -> bounds"),
            INSTANCE + 12,
            12,
            &placed,
        ),
        Table::new(
            "moments_to_world",
            &format!("{instance}, moments -> moments"),
            INSTANCE + 12,
            12,
            &placed_moments,
        ),
        Table::new(
            "vertex",
            &format!("{instance}, p[3] -> p[3] in the world"),
            INSTANCE + 3,
            3,
            &vertices,
        ),
    ];
    (
        "Summaries of lights: crate `lightbvh`, modules `bounds`, `moments`, `node`, `instance`.",
        tables,
    )
}

/// The least and greatest of everything.
fn corners() -> Vec<LightBounds> {
    let (far, tiny) = (exact::pow2(40), exact::pow2(-100));
    let mut out = Vec::new();
    for (min, max) in [
        ([-far; 3], [far; 3]),
        ([0.0; 3], [tiny; 3]),
        ([0.0, -far, tiny], [tiny, far, tiny]),
        ([0.0; 3], [0.0; 3]),
    ] {
        for phi in [exact::pow2(-100), exact::pow2(126), 0.0] {
            for cos_theta_o in [1.0, 0.0, -1.0] {
                out.push(LightBounds {
                    min: min.into(),
                    max: max.into(),
                    axis: glam::Vec3::NEG_Y,
                    cos_theta_o,
                    cos_theta_e: 0.0,
                    phi,
                });
            }
        }
    }
    out
}

/// A point from inside a box to far off it, at its centre too; a volume now and then.
fn about(random: &mut Random, bounds: &LightBounds, i: usize) -> ShadingPoint {
    let (c, size) = ((bounds.min + bounds.max) * 0.5, bounds.max - bounds.min);
    let r = size.length().max(exact::pow2(-50));
    let distance = [0.0, 0.25, 0.5, 1.0, 10.0, 1e6][random.below(6) as usize];
    let (d, far) = (random.direction(), exact::pow2(40));
    ShadingPoint {
        p: std::array::from_fn(|k| (c[k] + d[k] * distance * r).clamp(-far, far)),
        n: if i.is_multiple_of(8) {
            [0.0; 3]
        } else {
            random.direction()
        },
    }
}

/// Weights of nodes at points, and points brought into the space of an instance.
pub fn importance() -> (&'static str, Vec<Table>) {
    let random = &mut Random::new(0x6b6e_6f03);
    let instances = instances_of_any_kind(random);
    let (mut of_bounds, mut of_moments, mut local) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..60 {
        // Siblings of about one size, unless they are of any.
        let alike = small_triangles(8, 8, 4.0, 1.0, i % 2 == 0, random.bits());
        let triangles: Vec<_> = if i % 3 == 0 {
            (0..8).map(|_| extreme_triangle(random)).collect()
        } else {
            alike
        };
        let mut children: Vec<LightBounds> = triangles[..4].iter().map(LightBounds::of_triangle).collect();
        if i < 36 {
            children[1] = corners()[i];
        }
        if i % 4 == 1 {
            children[2] = any_bounds(random);
            children[3].phi = 0.0;
        }
        let point = about(random, &children[i % 4], i);
        of_bounds.extend(children.iter().flat_map(words_of));
        of_bounds.extend(words(&[point]));
        let bounds = LightBounds::of_triangle(&triangles[i % 8]);
        let point = about(random, &bounds, i);
        of_moments.extend(
            triangles
                .iter()
                .map(LightMoments::of_triangle)
                .flat_map(|own| words_of(&own)),
        );
        of_moments.extend(words(&[point]));
        local.extend(words(&[instances[i % instances.len()]]));
        local.extend(words(&[point]));
    }
    let tables = vec![
        Table::new(
            "eq4",
            "bounds of four children (see bounds.txt), p[3] n[3] -> weights by Eq4 on CompactNode",
            54,
            4,
            &of_bounds,
        ),
        Table::new(
            "flux_over_distance",
            "the same -> weights by FluxOverDistance",
            54,
            4,
            &of_bounds,
        ),
        Table::new(
            "moments",
            "moments of eight children (see bounds.txt), p[3] n[3] -> weights by Moments on MomentNode",
            102,
            8,
            &of_moments,
        ),
        Table::new(
            "to_local",
            "instance (34 words, see tree_instances.txt), p[3] n[3] -> p[3] n[3] in the mesh's space",
            INSTANCE + 6,
            6,
            &local,
        ),
    ];
    (
        "Weights: crate `lightbvh`, modules `importance` and `instance`.",
        tables,
    )
}
