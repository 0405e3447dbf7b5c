//! Inputs of trees: the domain's ends, dead branches, two levels, ways as long as trails, instances of every kind.

mod built;
mod deep;
mod links;
mod moving;
mod passes;
mod queries;

use lightbvh::exact;

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
    let (note, mut tree) = match name {
        "tree_extremes" => (
            "A tree of one level over triangles of every size and flux of the domain.",
            built::extremes(random),
        ),
        "tree_dead_branches" => (
            "A tree of one level over triangles that face anywhere: children's bounds seem to shine where no light does.",
            built::dead_branches(random),
        ),
        "tree_two_levels" => (
            "A tree of two levels over meshes in the world.",
            built::two_levels(random),
        ),
        "tree_deep" => ("Both levels as deep as bit trails are long.", deep::deep()),
        "tree_instances" => (
            "Moving lights: meshes in spaces of their own, turned, scaled, mirrored, sheared, flattened, dimmed, turned off.",
            moving::instances(random),
        ),
        _ => panic!("no tree `{name}`"),
    };
    queries::ask(&mut tree, random);
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
