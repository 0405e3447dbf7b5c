//! Inputs of trees: the domain's ends, two levels, ways as long as trails, instances of every kind, for each importance that the
//! kernels know.

mod built;
mod deep;
mod links;
mod moving;
mod passes;
mod queries;

use lightbvh::{LightNode, exact};
use lightbvh_kernels::bvh::{Paper, Standard, TriangleChoice, WIDTH};

use super::super::Table;
use super::super::tree::{Step, Tree};
use super::{array, words};
use crate::generate::Random;

pub use moving::instances_of_any_kind;

/// The tree file `name`.
///
/// # Panics
/// If there is none.
pub fn tree(name: &str) -> (&'static str, Vec<Table>) {
    let random = &mut Random::new(exact::hash(name.len() as u32));
    match name {
        "tree_extremes" => asked::<Standard, WIDTH>(
            "A tree of one level over triangles of every size and flux of the domain.",
            built::extremes(random),
            random,
        ),
        "tree_two_levels" => asked::<Standard, WIDTH>(
            "A tree of two levels over meshes in the world.",
            built::two_levels(random),
            random,
        ),
        "tree_deep" => asked::<Standard, WIDTH>(
            "Both levels as deep as bit trails are long.",
            deep::deep(),
            random,
        ),
        "tree_instances" => asked::<Standard, WIDTH>(
            "Moving lights: meshes in spaces of their own, turned, scaled, mirrored, sheared, flattened, dimmed, turned off.",
            moving::instances(random),
            random,
        ),
        "tree_eq4" => asked::<Paper, 4>(
            "Moving lights by the paper's layout and importance.",
            moving::instances(random),
            random,
        ),
        _ => panic!("no tree `{name}`"),
    }
}

fn asked<C: TriangleChoice<W>, const W: usize>(
    note: &'static str,
    mut tree: Tree<C::Node, W>,
    random: &mut Random,
) -> (&'static str, Vec<Table>) {
    queries::ask::<C, W>(&mut tree, random);
    (note, tables(&tree))
}

fn tables<N: LightNode<W>, const W: usize>(tree: &Tree<N, W>) -> Vec<Table> {
    let words_of_node = size_of::<N>() / 4;
    let mut out = vec![
        array(
            "tree",
            "root node, words per trail, instances in use, triangles of a single level, depth",
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
            "leaves of the top level: root trail[2] blas first first_triangle count listed columns[9] translation[3] inverse[9] \
             per_inverse flux radiance mirrored",
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
            &format!(
                "nodes of layout {} for {W} children, field by field; without summaries -> refitted",
                N::NAME
            ),
            words_of_node,
            words_of_node,
            &words(&tree.nodes),
        ),
        Table::new(
            "roots",
            "roots of the bottom levels: node, twelve words of their summary; without it -> refitted",
            13,
            13,
            &words(&tree.roots),
        ),
        Table::new(
            "sample",
            "p[3] n[3] number, its high word first -> light (ffffffff for none), instance, pmf",
            8,
            3,
            &words(&tree.samples),
        ),
        Table::new("pmf", "p[3] n[3] light instance -> pmf", 8, 1, &words(&tree.pmfs)),
    ]);
    out
}
