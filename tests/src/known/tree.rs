//! Answers of a tree: refit pass by pass, samples, pmfs, by the kernels' functions or by the kernels.

use bytemuck::{Zeroable, bytes_of};
use glam::UVec3;
use lightbvh::refit::BlasRoot;
use lightbvh::{EmissiveTriangle, Eq4, INVALID, Instance, LightNode, ShadingPoint, lanes};
use lightbvh_host::vulkan::{Device, Pass};
use lightbvh_kernels::bvh::{Node, TreePush, WIDTH};
use lightbvh_kernels::query::{Query, QueryPush, Sampled, pmf, sample};
use lightbvh_kernels::refit::{RefitPush, refit_instances, refit_leaves, refit_level, refit_roots};

use super::file::{Answer, File};

/// What refit does, in order; each pass is a list of node indices, or of bottom levels for [`Step::Roots`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// `refit_leaves`.
    Leaves,
    /// `refit_level`.
    Level,
    /// `refit_roots`.
    Roots,
    /// `refit_instances`.
    Instances,
}

impl Step {
    /// All of them with their names in the files.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("leaves", Self::Leaves),
        ("level", Self::Level),
        ("roots", Self::Roots),
        ("instances", Self::Instances),
    ];
}

/// The arrays of a tree file.
#[derive(Clone, Debug)]
pub struct Tree {
    /// Nodes with links but without bounds.
    pub nodes: Vec<Node>,
    /// Triangles of the bottom levels.
    pub triangles: Vec<EmissiveTriangle>,
    /// Of each light, the leaf of the top level that it belongs to.
    pub meshes_of_lights: Vec<u32>,
    /// Leaves of the top level; empty in a single level.
    pub instances: Vec<Instance>,
    /// Roots of the bottom levels, without bounds.
    pub roots: Vec<BlasRoot>,
    /// Bit trails of the triangles.
    pub trails: Vec<u32>,
    /// Root, words per trail, whether there are two levels.
    pub push: TreePush,
    /// The passes of a refit.
    pub passes: Vec<(Step, Vec<u32>)>,
    /// What is sampled.
    pub samples: Vec<Query>,
    /// What is evaluated.
    pub pmfs: Vec<Query>,
}

impl Tree {
    /// Reads the inputs.
    ///
    /// # Panics
    /// If tables are missing.
    #[must_use]
    pub fn read(file: &File) -> Self {
        let passes = file.tables.iter().filter_map(|table| {
            let kind = table.name.strip_prefix("pass_")?.split_once('_')?.1;
            let step = Step::NAMES
                .iter()
                .find(|(name, _)| *name == kind)
                .expect("a pass")
                .1;
            Some((step, table.input()))
        });
        Self {
            nodes: file.records("nodes"),
            triangles: file.records("triangles"),
            meshes_of_lights: file.records("meshes_of_lights"),
            instances: file.records("instances"),
            roots: file.records("roots"),
            trails: file.records("trails"),
            push: file.records("tree")[0],
            passes: passes.collect(),
            samples: file.records("sample"),
            pmfs: file.records("pmf"),
        }
    }

    /// The lights as `pmf` takes them: of the world's triangles it reads the mesh alone.
    fn lights(&self) -> Vec<EmissiveTriangle> {
        let light = |&mesh: &u32| EmissiveTriangle {
            mesh,
            ..EmissiveTriangle::zeroed()
        };
        self.meshes_of_lights.iter().map(light).collect()
    }

    fn query_push(&self, queries: &[Query]) -> QueryPush {
        QueryPush {
            count: queries.len() as u32,
            tree: self.push,
        }
    }

    /// Nodes and roots after a refit on the CPU.
    #[must_use]
    pub fn refitted(&self) -> (Vec<Node>, Vec<BlasRoot>) {
        let (mut nodes, mut roots) = (self.nodes.clone(), self.roots.clone());
        for (step, list) in &self.passes {
            let push = RefitPush {
                first: 0,
                count: list.len() as u32,
            };
            for i in 0..push.count {
                let id = UVec3::new(i, 0, 0);
                match step {
                    Step::Leaves => refit_leaves(id, &push, list, &self.triangles, &mut nodes),
                    Step::Level => refit_level(id, &push, list, &mut nodes),
                    Step::Roots => refit_roots(id, &push, list, &nodes, &mut roots),
                    Step::Instances => refit_instances(id, &push, list, &self.instances, &roots, &mut nodes),
                }
            }
        }
        (nodes, roots)
    }

    /// The nodes after a refit by [`lanes`], which `LightBvh` and `Scene` use on the CPU.
    #[must_use]
    pub fn refitted_in_lanes(&self) -> Vec<Node> {
        let (mut nodes, mut roots) = (self.nodes.clone(), self.roots.clone());
        for (step, list) in &self.passes {
            match step {
                Step::Leaves => lanes::leaves(&mut nodes, &self.triangles, list),
                Step::Level => lanes::level(&mut nodes, list),
                Step::Roots => {
                    for &blas in list {
                        let root = &mut roots[blas as usize];
                        *root = lightbvh::refit::root(&nodes, root.node);
                    }
                }
                Step::Instances => lanes::mesh_leaves(&mut nodes, &self.instances, &roots, list),
            }
        }
        nodes
    }

    /// What the CPU samples and evaluates in `nodes`.
    #[must_use]
    pub fn queried(&self, nodes: &[Node]) -> (Vec<Sampled>, Vec<f32>) {
        let mut sampled = vec![Sampled::zeroed(); self.samples.len()];
        let push = self.query_push(&self.samples);
        for i in 0..push.count {
            let id = UVec3::new(i, 0, 0);
            sample(
                id,
                &push,
                nodes,
                &self.instances,
                &self.trails,
                &self.samples,
                &mut sampled,
            );
        }
        let (lights, mut pmfs) = (self.lights(), vec![0.0; self.pmfs.len()]);
        let push = self.query_push(&self.pmfs);
        for i in 0..push.count {
            pmf(
                UVec3::new(i, 0, 0),
                &push,
                nodes,
                &self.instances,
                &self.trails,
                &lights,
                &self.pmfs,
                &mut pmfs,
            );
        }
        (sampled, pmfs)
    }

    /// The greatest number of nodes on a way down, over both levels.
    #[must_use]
    pub fn depth(&self) -> u32 {
        fn below(tree: &Tree, node: u32) -> u32 {
            let node = &tree.nodes[node as usize];
            let children = (0..WIDTH).map(|slot| match node.kind(slot) {
                lightbvh::node::kind::INNER => below(tree, node.link(slot)),
                lightbvh::node::kind::MESH => below(tree, tree.instances[node.link(slot) as usize].root),
                _ => 0,
            });
            1 + children.max().unwrap_or(0)
        }
        below(self, self.push.root)
    }

    /// How many pairs of a sampled point and a node of the tree that the walk starts in are dead: the node's bounds have
    /// importance there, and none of its children has.
    #[must_use]
    pub fn dead(&self, nodes: &[Node]) -> usize {
        let mut points: Vec<ShadingPoint> = self.samples.iter().map(|query| query.point).collect();
        points.dedup();
        let mut dead = 0;
        for point in &points {
            let mut open = vec![self.push.root];
            while let Some(index) = open.pop() {
                let node = &nodes[index as usize];
                let (weights, _) = node.weights::<Eq4, _>(point);
                for (slot, weight) in weights.into_iter().enumerate() {
                    if weight > 0.0 && node.kind(slot) == lightbvh::node::kind::INNER {
                        let child = node.link(slot);
                        let (_, sum) = nodes[child as usize].weights::<Eq4, _>(point);
                        dead += usize::from(sum == 0.0);
                        open.push(child);
                    }
                }
            }
        }
        dead
    }
}

/// The answers of the CPU.
#[must_use]
pub fn answer(file: &File) -> Vec<Answer> {
    let tree = Tree::read(file);
    let (nodes, roots) = tree.refitted();
    let (sampled, pmfs) = tree.queried(&nodes);
    answers(&nodes, &roots, &sampled, &pmfs)
}

fn answers(nodes: &[Node], roots: &[BlasRoot], sampled: &[Sampled], pmfs: &[f32]) -> Vec<Answer> {
    vec![
        Answer::new("nodes", nodes),
        Answer::new("roots", roots),
        Answer::new("sample", sampled),
        Answer::new("pmf", pmfs),
    ]
}

/// The answers of a device.
///
/// # Panics
/// If the device fails.
#[must_use]
pub fn answer_on(device: &Device, file: &File) -> Vec<Answer> {
    let tree = Tree::read(file);
    let nodes = device.upload(&tree.nodes).expect("an upload");
    let roots = device.upload(&tree.roots).expect("an upload");
    let triangles = device.upload(&tree.triangles).expect("an upload");
    let instances = device.upload(&tree.instances).expect("an upload");
    let trails = device.upload(&tree.trails).expect("an upload");
    let lists: Vec<_> = tree
        .passes
        .iter()
        .map(|(_, list)| device.upload(list).expect("an upload"))
        .collect();
    let pushes: Vec<_> = tree
        .passes
        .iter()
        .map(|(_, list)| RefitPush {
            first: 0,
            count: list.len() as u32,
        })
        .collect();
    let kernel = |name: &str| device.kernel(name).expect("a kernel");
    let refit = Step::NAMES.map(|(name, step)| (step, kernel(&format!("refit_{name}"))));
    let mut pass = Pass::new();
    for (((step, _), list), push) in tree.passes.iter().zip(&lists).zip(&pushes) {
        let bindings = match step {
            Step::Leaves => vec![list.bind(), triangles.bind(), nodes.bind()],
            Step::Level => vec![list.bind(), nodes.bind()],
            Step::Roots => vec![list.bind(), nodes.bind(), roots.bind()],
            Step::Instances => vec![list.bind(), instances.bind(), roots.bind(), nodes.bind()],
        };
        let (_, kernel) = refit.iter().find(|(of, _)| of == step).expect("every step");
        pass.dispatch(kernel, &bindings, bytes_of(push), push.count);
    }

    let (sample, pmf) = (kernel("sample"), kernel("pmf"));
    let lights = device.upload(&tree.lights()).expect("an upload");
    let asked = device.upload(&tree.samples).expect("an upload");
    let asked_pmf = device.upload(&tree.pmfs).expect("an upload");
    let sampled = device.output::<Sampled>(tree.samples.len()).expect("an output");
    let pmfs = device.output::<f32>(tree.pmfs.len()).expect("an output");
    let (nodes_and, results) = (
        [nodes.bind(), instances.bind(), trails.bind()],
        [sampled.bind(), pmfs.bind()],
    );
    let push = tree.query_push(&tree.samples);
    let bindings = [&nodes_and[..], &[asked.bind(), results[0]]].concat();
    pass.dispatch(&sample, &bindings, bytes_of(&push), push.count);
    let push = tree.query_push(&tree.pmfs);
    let bindings = [&nodes_and[..], &[lights.bind(), asked_pmf.bind(), results[1]]].concat();
    pass.dispatch(&pmf, &bindings, bytes_of(&push), push.count);
    device.run(&pass).expect("a run");
    answers(
        &nodes.read().expect("a read"),
        &roots.read().expect("a read"),
        &sampled.read().expect("a read"),
        &pmfs.read().expect("a read"),
    )
}

/// A sampled light, unless there is none.
#[must_use]
pub fn light_of(sampled: &Sampled) -> Option<u32> {
    (sampled.light != INVALID).then_some(sampled.light)
}
