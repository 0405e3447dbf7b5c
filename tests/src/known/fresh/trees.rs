//! Inputs of trees: the domain's ends, dead branches, two levels, ways as long as trails, instances of every kind.

use bytemuck::Zeroable;
use lightbvh::node::kind;
use lightbvh::refit::BlasRoot;
use lightbvh::trail::{BitTrail, max_levels};
use lightbvh::{
    BuildParams, Edit, EmissiveTriangle, Instance, LightBounds, LightNode, Lights, MeshLeaf, Scene,
    ShadingPoint, exact,
};
use lightbvh_host::backend::{Bvh, LightScene, Sampler};
use lightbvh_host::stability::random::adversarial;
use lightbvh_host::workload::build;
use lightbvh_kernels::bvh::{Node, TreePush, WIDTH};
use lightbvh_kernels::query::Query;

use super::super::Table;
use super::super::tree::{Step, Tree, light_of};
use super::{array, words};
use crate::generate::{Random, extreme_triangle, log_uniform, small_triangles};
use crate::placing::{Kind, transform};

/// Random numbers at each point.
const NUMBERS: usize = 5;

/// The tree file `name`.
///
/// # Panics
/// If there is none.
pub fn tree(name: &str) -> (&'static str, Vec<Table>) {
    let random = &mut Random::new(exact::hash(name.len() as u32));
    let (note, mut tree) = match name {
        "tree_extremes" => (
            "A tree of one level over triangles of every size and flux of the domain.",
            extremes(random),
        ),
        "tree_dead_branches" => (
            "A tree of one level over triangles that face anywhere: children's bounds seem to shine where no light does.",
            dead_branches(random),
        ),
        "tree_two_levels" => (
            "A tree of two levels over meshes in the world.",
            two_levels(random),
        ),
        "tree_deep" => ("Both levels as deep as bit trails are long.", deep()),
        "tree_instances" => (
            "Moving lights: meshes in spaces of their own, turned, scaled, mirrored, sheared, flattened, dimmed, turned off.",
            instances(random),
        ),
        _ => panic!("no tree `{name}`"),
    };
    ask(&mut tree, random);
    (note, tables(&tree))
}

fn tables(tree: &Tree) -> Vec<Table> {
    let mut out = vec![
        array(
            "tree",
            "root node, words per trail, 1 where there are two levels",
            &[tree.push],
        ),
        array(
            "triangles",
            "p0[3] p1[3] p2[3] radiance[3] mesh flags; of the bottom levels",
            &tree.triangles,
        ),
        array(
            "meshes_of_lights",
            "for each light the leaf of the top level that it belongs to (unused in a single level)",
            &tree.meshes_of_lights,
        ),
        array(
            "instances",
            "leaves of the top level: root trail[2] blas first first_triangle columns[9] translation[3] per_scale flux \
             radiance error tilt mirrored",
            &tree.instances,
        ),
        array(
            "trails",
            "bit trails of the triangles, low word first",
            &tree.trails,
        ),
    ];
    for (i, (step, list)) in tree.passes.iter().enumerate() {
        let name = Step::NAMES.iter().find(|(_, s)| s == step).expect("every step").0;
        let note = if i == 0 {
            "the passes of a refit in order: node indices, for `roots` indices of bottom levels"
        } else {
            ""
        };
        out.push(array(&format!("pass_{i}_{name}"), note, list));
    }
    out.extend([
        Table::new(
            "nodes",
            "CompactNode<4>, each field for four children: center_x center_y center_z extent axis_kind phi_cone link;\n\
             without bounds -> refitted",
            28,
            28,
            &words(&tree.nodes),
        ),
        Table::new(
            "roots",
            "roots of the bottom levels: node min[3] max[3] axis[3] cos_theta_o cos_theta_e phi; without bounds -> refitted",
            13,
            13,
            &words(&tree.roots),
        ),
        Table::new("sample", "p[3] n[3] random -> light (ffffffff for none), pmf", 7, 2, &words(&tree.samples)),
        Table::new("pmf", "p[3] n[3] light -> pmf", 7, 1, &words(&tree.pmfs)),
    ]);
    out
}

/// The passes that refit all nodes below the roots and the top level above them, from the links alone.
fn passes_of(nodes: &[Node], roots: &[BlasRoot], root: u32, two_level: bool) -> Vec<(Step, Vec<u32>)> {
    let mut passes = Vec::new();
    let trees: Vec<u32> = if two_level {
        roots.iter().map(|root| root.node).collect()
    } else {
        vec![root]
    };
    let mut refit = |first: Step, trees: &[u32]| {
        let mut levels = Vec::new();
        for &root in trees {
            height(nodes, root, &mut levels);
        }
        let mut all = levels.concat();
        all.sort_unstable();
        passes.push((first, all));
        passes.extend(levels.into_iter().skip(1).map(|level| (Step::Level, level)));
        if first == Step::Leaves && two_level {
            passes.push((Step::Roots, (0..roots.len() as u32).collect()));
        }
    };
    refit(Step::Leaves, &trees);
    if two_level {
        refit(Step::Instances, &[root]);
    }
    passes
}

/// Sorts node `index` and those below it by their height over the lowest.
fn height(nodes: &[Node], index: u32, levels: &mut Vec<Vec<u32>>) -> usize {
    let node = &nodes[index as usize];
    let below = (0..WIDTH)
        .filter(|&slot| node.kind(slot) == kind::INNER)
        .map(|slot| 1 + height(nodes, node.link(slot), levels))
        .max()
        .unwrap_or(0);
    if levels.len() <= below {
        levels.resize(below + 1, Vec::new());
    }
    levels[below].push(index);
    below
}

/// The arrays of a built tree, without bounds.
fn of_bvh(bvh: &Bvh, lights: &Lights) -> Tree {
    let tree = bvh.tree();
    let roots = without_root_bounds(bvh.roots());
    Tree {
        nodes: without_bounds(tree.nodes),
        triangles: lights.triangles().to_vec(),
        meshes_of_lights: lights.triangles().iter().map(|t| t.mesh).collect(),
        instances: tree.meshes.to_vec(),
        passes: passes_of(tree.nodes, &roots, tree.root, bvh.is_two_level()),
        roots,
        trails: tree.trails.to_vec(),
        push: TreePush {
            root: tree.root,
            trail_words: tree.trail_words,
            two_level: u32::from(bvh.is_two_level()),
        },
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}

/// The nodes with kinds and links alone.
fn without_bounds(nodes: &[Node]) -> Vec<Node> {
    let mut out = nodes.to_vec();
    for node in &mut out {
        for slot in 0..WIDTH {
            node.set_child(slot, node.kind(slot), node.link(slot));
        }
    }
    out
}

fn without_root_bounds(roots: &[BlasRoot]) -> Vec<BlasRoot> {
    let without = |root: &BlasRoot| BlasRoot {
        node: root.node,
        ..BlasRoot::zeroed()
    };
    roots.iter().map(without).collect()
}

fn checked(triangles: Vec<EmissiveTriangle>) -> Lights {
    Lights::new(triangles).expect("within the domain")
}

fn extremes(random: &mut Random) -> Tree {
    // A few without area or flux among those with it.
    let mut triangles: Vec<_> = (0..6).map(|_| extreme_triangle(random)).collect();
    while triangles.len() < 40 {
        let triangle = extreme_triangle(random);
        if LightBounds::of_triangle(&triangle).phi > 0.0 {
            triangles.push(triangle);
        }
    }
    // Most on both sides and of radiances near each other, so that many lights have a chance to be drawn.
    for triangle in triangles.iter_mut().skip(3) {
        triangle.flags = u32::from(random.below(4) > 0);
        let radiance = log_uniform(random, -6, 6);
        triangle.radiance = triangle.radiance.map(|x| if x > 0.0 { radiance } else { 0.0 });
    }
    // Coordinates and radiances at the very ends, and the flux that each may have.
    let (far, tiny) = (exact::pow2(40), exact::pow2(-100));
    triangles[0].p = [[-far; 3], [far, -far, far], [far, far, -far]];
    triangles[0].radiance = [exact::pow2(-22); 3];
    triangles[1].p = [[0.0; 3], [tiny, 0.0, 0.0], [0.0, tiny, 0.0]];
    triangles[1].radiance = [tiny; 3];
    let edge = exact::pow2(-96);
    triangles[2].p = [[0.0; 3], [edge, 0.0, 0.0], [0.0, 0.0, edge]];
    triangles[2].radiance = [exact::pow2(100); 3];
    let lights = checked(triangles);
    of_bvh(
        &build(&lights, Sampler::SingleLevel, &BuildParams::default()),
        &lights,
    )
}

fn dead_branches(random: &mut Random) -> Tree {
    // Pairs back to back or at right angles, apart by more than their size, so that a box is seen where neither faces.
    let lights = checked(small_triangles(72, 72, 4.0, 0.3, false, random.bits()));
    of_bvh(
        &build(&lights, Sampler::SingleLevel, &BuildParams::default()),
        &lights,
    )
}

fn two_levels(random: &mut Random) -> Tree {
    let mut triangles = small_triangles(60, 6, 10.0, 0.5, true, random.bits());
    for (i, triangle) in triangles.iter_mut().enumerate() {
        triangle.flags = u32::from(i % 5 == 0);
        let factor = [1.0, 1e-12, 1e9, 0.0][i / 6 % 4];
        triangle.radiance = triangle.radiance.map(|x| x * factor);
    }
    let lights = checked(triangles);
    of_bvh(
        &build(&lights, Sampler::TwoLevel, &BuildParams::default()),
        &lights,
    )
}

/// A chain of nodes from node `first` on: children `0..children` of `kind` on the way, the last two in the last node. Gives the
/// trails of the children.
fn chain(nodes: &mut Vec<Node>, of: u32, first_child: u32) -> Vec<BitTrail> {
    let levels = max_levels(WIDTH);
    let first = nodes.len() as u32;
    let mut trails = Vec::new();
    let mut way = BitTrail::default();
    for level in 0..levels {
        let mut node = <Node as LightNode<WIDTH>>::EMPTY;
        let (own, next) = (level % 4, (level * 3 + 1) % 4);
        let next = if next == own { (own + 1) % 4 } else { next };
        node.set_child(own as usize, of, first_child + level);
        trails.push(way.with::<WIDTH>(level, own));
        if level + 1 == levels {
            node.set_child(next as usize, of, first_child + levels);
            trails.push(way.with::<WIDTH>(level, next));
        } else {
            node.set_child(next as usize, kind::INNER, first + level + 1);
            way = way.with::<WIDTH>(level, next);
        }
        nodes.push(node);
    }
    trails
}

fn deep() -> Tree {
    let levels = max_levels(WIDTH);
    // Lights at halving distances along x, all of the same flux but for rounding; those of the last mesh along y.
    let light = |x: f32, y: f32, size: f32, mesh: u32| EmissiveTriangle {
        p: [[x, y, 0.0], [x, y + size, 0.0], [x, y, size]],
        radiance: [exact::pow2(20), 1.0, 0.0],
        mesh,
        flags: 1,
    };
    let (mut nodes, mut triangles, mut roots) = (Vec::new(), Vec::new(), Vec::new());
    let mut trails = Vec::new();
    for mesh in 0..levels {
        let x = exact::pow2(30 - mesh as i32);
        let mut node = <Node as LightNode<WIDTH>>::EMPTY;
        node.set_child(mesh as usize % WIDTH, kind::LIGHT, triangles.len() as u32);
        trails.push(BitTrail::default().with::<WIDTH>(0, mesh % WIDTH as u32));
        roots.push(nodes.len() as u32);
        nodes.push(node);
        triangles.push(light(x, 0.0, x * 0.125, mesh));
    }
    roots.push(nodes.len() as u32);
    trails.extend(chain(&mut nodes, kind::LIGHT, triangles.len() as u32));
    for i in 0..=levels {
        let y = exact::pow2(-(i as i32));
        triangles.push(light(0.0, y, y * 0.125, levels));
    }
    let root = nodes.len() as u32;
    let top_trails = chain(&mut nodes, kind::MESH, 0);
    let instances: Vec<Instance> = (0..=levels)
        .map(|mesh| {
            let mut leaf = Instance::world(roots[mesh as usize], mesh);
            leaf.set_trail(top_trails[mesh as usize]);
            leaf
        })
        .collect();
    let roots: Vec<BlasRoot> = roots
        .iter()
        .map(|&node| BlasRoot {
            node,
            ..BlasRoot::zeroed()
        })
        .collect();
    let lights = checked(triangles);
    Tree {
        passes: passes_of(&nodes, &roots, root, true),
        nodes,
        meshes_of_lights: lights.triangles().iter().map(|t| t.mesh).collect(),
        triangles: lights.triangles().to_vec(),
        instances,
        roots,
        trails: trails.iter().flat_map(|t| [t.low, t.high]).collect(),
        push: TreePush {
            root,
            trail_words: 2,
            two_level: 1,
        },
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}

/// A scene of four meshes and instances of every kind of transform and brightness.
fn moving(random: &mut Random) -> LightScene {
    let mut scene: LightScene = Scene::default();
    let add = |random: &mut Random, count: u32| {
        let mut triangles = small_triangles(count, count, 2.0, 0.4, false, random.bits());
        for (i, triangle) in triangles.iter_mut().enumerate() {
            triangle.p = triangle.p.map(|p| p.map(|x| x - 1.0));
            triangle.flags = u32::from(i % 4 == 3);
        }
        Edit::AddMesh { triangles }
    };
    let meshes = [1, 5, 9, 14].map(|count| add(random, count)).to_vec();
    let meshes = scene.update(meshes).expect("sound meshes").meshes;
    let mut edits = Vec::new();
    let kinds = [
        Kind::Rigid,
        Kind::Similar,
        Kind::Similar,
        Kind::Affine,
        Kind::Flat,
    ];
    for i in 0..14 {
        let mut placed = transform(random, kinds[i % 5], 8.0);
        if i == 5 || i == 6 {
            // The ends of the scales that share a mesh's bottom level.
            let scale = exact::pow2(if i == 5 { 19 } else { -19 });
            placed.columns = [[scale, 0.0, 0.0], [0.0, 0.0, scale], [0.0, scale, 0.0]];
        }
        if i == 4 {
            // So bright that it must be far off for others to be drawn.
            placed.translation = [exact::pow2(29), 0.0, 0.0];
        }
        let radiance = if i > 10 {
            1.0
        } else {
            [1.0, 0.25, 1000.0, 1.0, exact::pow2(60), exact::pow2(-60), 0.0][i % 7]
        };
        edits.push(Edit::AddInstance {
            mesh: meshes[i % 4],
            transform: placed,
            radiance,
        });
    }
    scene.update(edits).expect("sound instances");
    scene
}

fn instances(random: &mut Random) -> Tree {
    let mut scene = moving(random);
    scene.refit();
    let tree = scene.tree();
    let roots = without_root_bounds(scene.roots());
    Tree {
        nodes: without_bounds(tree.nodes),
        triangles: scene.triangles().to_vec(),
        meshes_of_lights: scene.world_lights().iter().map(|light| light.mesh).collect(),
        instances: tree.meshes.to_vec(),
        passes: passes_of(tree.nodes, &roots, tree.root, true),
        roots,
        trails: tree.trails.to_vec(),
        push: TreePush {
            root: tree.root,
            trail_words: tree.trail_words,
            two_level: 1,
        },
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}

/// Leaves of a top level of every kind, those in the world's own space too.
pub fn instances_of_any_kind(random: &mut Random) -> Vec<Instance> {
    let scene = moving(random);
    let mut out = scene.instances().to_vec();
    out.push(Instance::world(3, 1));
    out
}

/// Points around the lights and at the ends of the domain; of each the numbers that choose lights, and lights to evaluate.
fn ask(tree: &mut Tree, random: &mut Random) {
    let (nodes, _) = tree.refitted();
    let all = nodes[tree.push.root as usize].merged();
    let size = (all.max - all.min)
        .max_element()
        .min(exact::pow2(39))
        .max(exact::pow2(-60));
    let mut points = Vec::new();
    for i in 0..36 {
        let p: [f32; 3] = match i {
            0 => [0.0; 3],
            1 => [exact::pow2(40), -exact::pow2(40), exact::pow2(40)],
            2 => [exact::pow2(-100), 0.0, 0.0],
            // On a vertex of a light of the top level's space, near it, and at the middle of everything.
            3 => [all.min.x, all.min.y, all.min.z],
            4 => ((all.min + all.max) * 0.5).to_array(),
            5..=9 => {
                let triangle = tree.triangles[random.below(tree.triangles.len() as u32) as usize];
                let by = log_uniform(random, -40, 0);
                let d = random.direction();
                std::array::from_fn(|k| triangle.p[i % 3][k] + d[k] * by)
            }
            // At a light's own distance, among the lights, and at every distance from the middle.
            10..=24 => {
                let triangle = tree.triangles[random.below(tree.triangles.len() as u32) as usize];
                let edge = (0..3)
                    .map(|k| (triangle.p[1][k] - triangle.p[0][k]).abs())
                    .fold(exact::pow2(-60), f32::max);
                let by = edge * log_uniform(random, -2, 3);
                let d = random.direction();
                std::array::from_fn(|k| triangle.p[0][k] + d[k] * by)
            }
            25..=30 => std::array::from_fn(|k| {
                let (low, high) = (all.min[k], all.max[k]);
                low + (high - low) * random.between(-0.2, 1.2)
            }),
            _ => {
                let by = size * log_uniform(random, -30, 3);
                random.direction().map(|d| d * by)
            }
        };
        let far = exact::pow2(40);
        let n = match i % 7 {
            0 => [0.0; 3],
            1 => [0.0, -1.0, 0.0],
            _ => random.direction(),
        };
        points.push(ShadingPoint {
            p: p.map(|x| x.clamp(-far, far)),
            n,
        });
    }
    let hard = adversarial(4);
    for &point in &points {
        for k in 0..NUMBERS {
            let number = if k < 2 {
                hard[random.below(hard.len() as u32) as usize]
            } else {
                random.bits()
            };
            tree.samples.push(Query {
                point,
                random_or_light: number,
            });
        }
    }
    let (sampled, _) = tree.queried(&nodes);
    let lights = tree.meshes_of_lights.len() as u32;
    for (i, (query, sampled)) in tree.samples.iter().zip(&sampled).enumerate() {
        // Every light that was drawn, but for repetitions, and others.
        let other = random.below(lights);
        let light = if i % 3 == 2 {
            other
        } else {
            light_of(sampled).unwrap_or(other)
        };
        let asked = Query {
            random_or_light: light,
            ..*query
        };
        if !tree.pmfs.contains(&asked) {
            tree.pmfs.push(asked);
        }
    }
}
