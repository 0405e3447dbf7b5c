// A path tracer of a city at night, behind the functions of lightbvh: three vertices, direct light at each.
// Rays pass through lamps, whose light counts at vertices alone: by a single strategy, so there are no weights between two.
// All lamps emit from their front side; `flags` would say otherwise.

// How a vertex chooses lights, and how many candidates it resamples to one (Talbot, Cline and Egbert 2005).
override METHOD: u32 = 0;
override CANDIDATES: u32 = 1;
const UNIFORM = 0u;
const TILES = 1u;

const SIZE = vec2(256u, 192u);
const TILE_COUNT = 128u;
const TILE_LIGHTS = 1024u;

// The city: blocks at equal distances between streets, on a square of ground.
const CELLS = 12;
const PITCH = 10.0;
const HALF_STREET = 2.0;
const EYE = vec3(50.3, 8.6, 1.0);
const FORWARD = vec3(0.36, -0.29, 0.85);

// A light of an instance; the sum of the powers before it, in parts of 2^32 of all.
struct Listed { light: u32, instance: u32, below: u32 }

// A point on a light, and the inverse of its density over all lights' area, m².
struct Emitter { p: vec3<f32>, weight: f32, normal: vec3<f32>, radiance: vec3<f32> }

struct Hit { distance: f32, normal: vec3<f32>, albedo: vec3<f32> }

@group(0) @binding(5) var<storage> listed: array<Listed>;
@group(0) @binding(6) var<storage, read_write> tiles: array<Emitter>;
// Sums over the frames: radiance, and the distance of what is seen, metres.
@group(0) @binding(7) var<storage, read_write> image: array<vec4<f32>>;
var<immediate> frame: u32;

var<private> state: u32;

// M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
fn hash(x: u32) -> u32 {
    let word = x * 747796405u + 2891336453u;
    let mixed = ((word >> ((word >> 28u) + 4u)) ^ word) * 277803737u;
    return (mixed >> 22u) ^ mixed;
}

// In [0, 1).
fn unit(word: u32) -> f32 {
    return f32(word >> 8u) / 16777216.0;
}

fn bits() -> u32 {
    state += 0x9e3779b9u;
    return hash(state);
}

fn random() -> f32 {
    return unit(bits());
}

fn luminance(rgb: vec3<f32>) -> f32 {
    return dot(rgb, vec3(0.2126, 0.7152, 0.0722));
}

// The first surface within `far` metres; at `far` if there is none.
fn trace(o: vec3<f32>, d: vec3<f32>, far: f32) -> Hit {
    var hit = Hit(far, vec3(0.0, 1.0, 0.0), vec3(0.0));
    let ground = -o.y / d.y;
    let at = o.xz + ground * d.xz;
    if d.y < 0.0 && ground < far && all(at > vec2(0.0)) && all(at < vec2(f32(CELLS) * PITCH)) {
        let stone = vec2<i32>(floor(at * 1.25));
        hit.distance = ground;
        hit.albedo = vec3(0.36, 0.34, 0.33) + 0.08 * f32((stone.x + stone.y) & 1);
    }
    var cell = vec2<i32>(floor(o.xz / PITCH));
    let step = select(vec2(-1), vec2(1), d.xz > vec2(0.0));
    let per = 1.0 / select(d, vec3(1e-12), abs(d) < vec3(1e-12));
    let along = abs(per.xz) * PITCH;
    var next = (vec2<f32>(cell + max(step, vec2(0))) * PITCH - o.xz) * per.xz;
    var reached = 0.0;
    while all(cell >= vec2(0)) && all(cell < vec2(CELLS)) && reached < hit.distance {
        let block = u32(cell.y * CELLS + cell.x);
        let low = vec2<f32>(cell) * PITCH + HALF_STREET;
        let high = low + (PITCH - 2.0 * HALF_STREET);
        let a = (vec3(low.x, 0.0, low.y) - o) * per;
        let height = 1.5 + 4.5 * unit(hash(block)) * unit(hash(block + 144u));
        let b = (vec3(high.x, height, high.y) - o) * per;
        let near = min(a, b);
        let end = max(a, b);
        let enter = max(max(near.x, near.y), near.z);
        if enter > 0.0 && enter < hit.distance && enter < min(min(end.x, end.y), end.z) {
            let side = select(vec3(0.0), vec3(1.0), near == vec3(enter));
            let tint = vec3(unit(hash(block + 288u)), unit(hash(block + 432u)), unit(hash(block + 576u)));
            return Hit(enter, normalize(-sign(d) * side), vec3(0.5, 0.42, 0.38) + 0.3 * tint);
        }
        reached = min(next.x, next.y);
        let x_first = next.x < next.y;
        cell += select(vec2(0, step.y), vec2(step.x, 0), x_first);
        next += select(vec2(0.0, along.y), vec2(along.x, 0.0), x_first);
    }
    return hit;
}

// A uniform point on a light that was chosen with probability `pmf`.
fn emitter(light: u32, instance: u32, pmf: f32) -> Emitter {
    let own = lightbvh_light_point(light, instance, vec2(random(), random()));
    let density = pmf * own.density;
    return Emitter(own.p, select(0.0, 1.0 / density, density > 0.0), own.normal, own.radiance);
}

// Presampled tiles (Wyman and Panteleev, "Rearchitecting Spatiotemporal Resampling for Production", 2021): points on lights
// that were drawn by power, so that the many vertices of a block of pixels read few of them, side by side.
@compute @workgroup_size(64)
fn presample(@builtin(global_invocation_id) id: vec3<u32>) {
    state = hash(id.x + hash(frame));
    let drawn = bits();
    var first = 0u;
    var count = arrayLength(&listed);
    while count > 1u {
        let half = count / 2u;
        if listed[first + half].below <= drawn {
            first += half;
        }
        count -= half;
    }
    let own = listed[first];
    // The last one ends at 2^32, which is 0.
    let end = select(0u, listed[min(first + 1u, arrayLength(&listed) - 1u)].below, first + 1u < arrayLength(&listed));
    tiles[id.x] = emitter(own.light, own.instance, f32(end - own.below) / 4294967296.0);
}

fn candidate(p: vec3<f32>, n: vec3<f32>, k: u32, number: vec2<u32>, tile: u32) -> Emitter {
    if METHOD == UNIFORM {
        let own = listed[bits() % arrayLength(&listed)];
        return emitter(own.light, own.instance, 1.0 / f32(arrayLength(&listed)));
    }
    if METHOD == TILES {
        return tiles[tile * TILE_LIGHTS + (number.x + k) % TILE_LIGHTS];
    }
    // One number serves all candidates: each takes its own stratum.
    let apart = k * ((0xffffffffu - (CANDIDATES - 1u)) / CANDIDATES + 1u);
    let own = lightbvh_sample(p, n, vec2(number.x + apart, number.y));
    return emitter(own.light, own.instance, own.pmf);
}

// Irradiance from one light of `CANDIDATES`, chosen in proportion to what it would send without shadows.
fn direct(p: vec3<f32>, n: vec3<f32>, tile: u32) -> vec3<f32> {
    let number = vec2(bits(), bits());
    var total = 0.0;
    var end = p;
    var sent = vec3(0.0);
    for (var k = 0u; k < CANDIDATES; k++) {
        let own = candidate(p, n, k, number, tile);
        let to = own.p - p;
        let squared = dot(to, to);
        let d = to * inverseSqrt(squared);
        let light = own.radiance * max(dot(n, d), 0.0) * max(-dot(own.normal, d), 0.0) / squared;
        let weight = luminance(light) * own.weight;
        total += weight;
        if random() * total < weight {
            end = own.p;
            sent = light / luminance(light);
        }
    }
    let far = distance(p, end);
    if total > 0.0 && trace(p, (end - p) / far, far).distance >= far {
        return sent * total / f32(CANDIDATES);
    }
    return vec3(0.0);
}

// A unit vector around `n`, by its cosine.
fn scattered(n: vec3<f32>) -> vec3<f32> {
    let y = 1.0 - 2.0 * random();
    let turn = 6.2831853 * random();
    let r = sqrt(max(1.0 - y * y, 0.0));
    return normalize(n + 0.9999 * vec3(r * cos(turn), y, r * sin(turn)));
}

fn camera(pixel: vec2<u32>) -> vec3<f32> {
    let at = (vec2<f32>(pixel) + vec2(random(), random())) / vec2<f32>(SIZE) - 0.5;
    let right = normalize(cross(FORWARD, vec3(0.0, 1.0, 0.0)));
    let up = normalize(cross(right, FORWARD));
    return normalize(normalize(FORWARD) + 1.3 * (at.x * right - 0.75 * at.y * up));
}

@compute @workgroup_size(8, 8)
fn path(@builtin(global_invocation_id) id: vec3<u32>, @builtin(workgroup_id) block: vec3<u32>) {
    let pixel = id.y * SIZE.x + id.x;
    state = hash(pixel + hash(frame));
    var o = EYE;
    var d = camera(id.xy);
    var throughput = vec3(1.0);
    var seen = vec3(0.0);
    var distance = 0.0;
    for (var vertex = 0u; vertex < 3u; vertex++) {
        let hit = trace(o, d, 1e4);
        if vertex == 0u {
            distance = hit.distance;
        }
        if hit.distance == 1e4 {
            if vertex == 0u {
                seen = mix(vec3(0.05, 0.05, 0.10), vec3(0.006, 0.009, 0.03), saturate(4.0 * d.y));
            }
            break;
        }
        o += hit.distance * d + 1e-3 * hit.normal;
        throughput *= hit.albedo;
        let tile = hash(block.x + hash(block.y + hash(frame + vertex))) % TILE_COUNT;
        seen += throughput / 3.14159265 * direct(o, hit.normal, tile);
        d = scattered(hit.normal);
    }
    image[pixel] += vec4(seen, distance);
}
