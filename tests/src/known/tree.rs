//! Answers of a tree: refit pass by pass, samples, pmfs, by the functions that the kernels run or by the kernels.

use bytemuck::bytes_of;
use lightbvh::TreeWords;
use lightbvh::node::kind;
use lightbvh::refit::{self, BlasRoot, Children, PLAIN_ROWS};
use lightbvh::{EmissiveTriangle, INVALID, Instance, LightNode, SampledLight, sweep};
use lightbvh_host::vulkan::{Device, Pass};
use lightbvh_kernels::bvh::{Choice, TreeOf, TriangleChoice};
use lightbvh_kernels::query::{Query, QueryPush, pmf_query, sample_query};
use lightbvh_kernels::refit::RefitPush;

use super::file::{Answer, File};

/// What refit does, in order; each pass is a list of node indices, or of bottom levels for [`Step::Roots`]. Kernel
/// `refit_nodes` follows those over children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// `refit_bottom`.
    Bottom,
    /// `refit_roots`.
    Roots,
    /// `refit_top`.
    Top,
}

impl Step {
    /// All of them with their names in the files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("bottom", Self::Bottom),
        ("roots", Self::Roots),
        ("top", Self::Top),
    ];
}

/// The arrays of a tree file, with nodes of layout `N`.
#[derive(Clone, Debug)]
pub struct Tree<N, const W: usize> {
    /// Nodes with links but without summaries.
    pub nodes: Vec<N>,
    /// Triangles of the bottom levels.
    pub triangles: Vec<EmissiveTriangle>,
    /// Of each light, the leaf of the top level that it belongs to: what is asked of `pmf` beside the light.
    pub meshes_of_lights: Vec<u32>,
    /// Leaves of the top level; empty in a single level.
    pub instances: Vec<Instance>,
    /// Roots of the bottom levels, without summaries.
    pub roots: Vec<BlasRoot>,
    /// Bit trails of the triangles.
    pub trails: Vec<u32>,
    /// What a tree holds besides its arrays.
    pub push: TreeWords,
    /// The passes of a refit.
    pub passes: Vec<(Step, Vec<u32>)>,
    /// What is sampled.
    pub samples: Vec<Query>,
    /// What is evaluated.
    pub pmfs: Vec<Query>,
}

impl<N: LightNode<W>, const W: usize> Tree<N, W> {
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

    fn query_push(&self, queries: &[Query]) -> QueryPush {
        QueryPush {
            count: queries.len() as u32,
            tree: self.push,
        }
    }

    /// Nodes and roots after a refit on the CPU.
    #[must_use]
    pub fn refitted(&self) -> (Vec<N>, Vec<BlasRoot>) {
        let (mut nodes, mut roots) = (self.nodes.clone(), self.roots.clone());
        for (step, list) in &self.passes {
            for &index in list {
                let i = index as usize;
                match step {
                    Step::Bottom => nodes[i] = refit::bottom(&nodes, &self.triangles, index),
                    Step::Roots => roots[i] = refit::root(&nodes, roots[i].node),
                    Step::Top => nodes[i] = refit::top(&nodes, &self.instances, &roots, index),
                }
            }
        }
        (nodes, roots)
    }

    /// The nodes after a refit by [`sweep`], which `Bvh` uses on the CPU.
    #[must_use]
    pub fn swept(&self) -> Vec<N> {
        let (mut nodes, mut roots) = (self.nodes.clone(), self.roots.clone());
        for (step, list) in &self.passes {
            match step {
                Step::Bottom => sweep::bottom(&mut nodes, &self.triangles, list),
                Step::Roots => {
                    for &blas in list {
                        let root = &mut roots[blas as usize];
                        *root = refit::root(&nodes, root.node);
                    }
                }
                Step::Top => sweep::top(&mut nodes, &self.instances, &roots, list),
            }
        }
        nodes
    }

    /// The tree over `nodes`, as traversal takes it.
    #[must_use]
    pub fn tree<'a, C: Choice<W, Node = N>>(&'a self, nodes: &'a [N]) -> TreeOf<'a, C, W> {
        self.push.tree(nodes, &self.instances, &self.trails)
    }

    /// What the CPU samples and evaluates in `nodes`.
    #[must_use]
    pub fn queried<C: Choice<W, Node = N>>(&self, nodes: &[N]) -> (Vec<SampledLight>, Vec<f32>) {
        let tree = self.tree::<C>(nodes);
        let sampled = self
            .samples
            .iter()
            .map(|query| sample_query::<C, W>(&tree, query));
        let pmfs = self.pmfs.iter().map(|query| pmf_query::<C, W>(&tree, query));
        (sampled.collect(), pmfs.collect())
    }

    /// The greatest number of nodes on a way down, over both levels.
    #[must_use]
    pub fn depth(&self) -> u32 {
        self.depth_below(self.push.root)
    }

    fn depth_below(&self, node: u32) -> u32 {
        let node = &self.nodes[node as usize];
        let children = (0..W).map(|slot| match node.kind(slot) {
            kind::INNER => self.depth_below(node.link(slot)),
            kind::MESH => self.depth_below(self.instances[node.link(slot) as usize].root),
            _ => 0,
        });
        1 + children.max().unwrap_or(0)
    }
}

/// The answers of the CPU.
#[must_use]
pub fn answer<C: TriangleChoice<W>, const W: usize>(file: &File) -> Vec<Answer> {
    let tree = Tree::<C::Node, W>::read(file);
    let (nodes, roots) = tree.refitted();
    let (sampled, pmfs) = tree.queried::<C>(&nodes);
    answers(&nodes, &roots, &sampled, &pmfs)
}

fn answers<N: LightNode<W>, const W: usize>(
    nodes: &[N],
    roots: &[BlasRoot],
    sampled: &[SampledLight],
    pmfs: &[f32],
) -> Vec<Answer> {
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
pub fn answer_on<C: TriangleChoice<W>, const W: usize>(device: &Device, file: &File) -> Vec<Answer> {
    let tree = Tree::<C::Node, W>::read(file);
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
    let kernel = |name: &str| device.kernel(&format!("{name}{}", C::SUFFIX)).expect("a kernel");
    let refit = Step::NAMES.map(|(name, step)| (step, kernel(&format!("refit_{name}"))));
    let refit_nodes = kernel("refit_nodes");
    let most = tree.passes.iter().map(|(_, list)| list.len()).max().unwrap_or(0);
    let children = device.output::<Children<W, PLAIN_ROWS>>(most).expect("an output");
    let push = |count: usize| RefitPush {
        first: 0,
        count: count as u32,
    };
    let pushes: Vec<_> = tree
        .passes
        .iter()
        .map(|(step, list)| match step {
            Step::Roots => [push(list.len()), push(0)],
            Step::Bottom | Step::Top => [push(list.len() * W), push(list.len())],
        })
        .collect();
    let mut pass = Pass::new();
    for (((step, _), list), [push, then]) in tree.passes.iter().zip(&lists).zip(&pushes) {
        let bindings = match step {
            Step::Bottom => vec![list.bind(), triangles.bind(), nodes.bind(), children.bind()],
            Step::Roots => vec![list.bind(), nodes.bind(), roots.bind()],
            Step::Top => vec![
                list.bind(),
                instances.bind(),
                roots.bind(),
                nodes.bind(),
                children.bind(),
            ],
        };
        let (_, kernel) = refit.iter().find(|(of, _)| of == step).expect("every step");
        pass.dispatch(kernel, &bindings, bytes_of(push), push.count);
        if then.count > 0 {
            let bindings = [list.bind(), children.bind(), nodes.bind()];
            pass.dispatch(&refit_nodes, &bindings, bytes_of(then), then.count);
        }
    }

    let (sample, pmf) = (kernel("sample"), kernel("pmf"));
    let asked = device.upload(&tree.samples).expect("an upload");
    let asked_pmf = device.upload(&tree.pmfs).expect("an upload");
    let sampled = device
        .output::<SampledLight>(tree.samples.len())
        .expect("an output");
    let pmfs = device.output::<f32>(tree.pmfs.len()).expect("an output");
    let (nodes_and, results) = (
        [nodes.bind(), instances.bind(), trails.bind()],
        [sampled.bind(), pmfs.bind()],
    );
    let push = tree.query_push(&tree.samples);
    let bindings = [&nodes_and[..], &[asked.bind(), results[0].clone()]].concat();
    pass.dispatch(&sample, &bindings, bytes_of(&push), push.count);
    let push = tree.query_push(&tree.pmfs);
    let bindings = [&nodes_and[..], &[asked_pmf.bind(), results[1].clone()]].concat();
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
pub fn light_of(sampled: &SampledLight) -> Option<u32> {
    (sampled.light != INVALID).then_some(sampled.light)
}
