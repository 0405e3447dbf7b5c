//! What the refit after a batch may do.

use lightbvh::bvh::RefitPlan;

use super::batch::Touched;

/// Nodes of the top level for each level of each path that an edit touches: the node itself, and where it is built anew over 64 subtrees
/// as many as those take.
const BESIDE: usize = 1 + 63;
/// Paths of an instance that moves: from where it was, and to where it goes.
const PATHS: usize = 2;
/// A range of more than this part of a mesh is the whole mesh.
const WHOLE: usize = 16;
/// The root, whatever changes.
const ROOT: usize = 1;

/// The nodes that a plan writes and computes are on paths from what the batch changed, or of the meshes that it brought.
///
/// # Panics
/// If there are more.
pub fn check(plan: &RefitPlan, touched: &Touched, depth: u32) {
    let paths = PATHS * BESIDE * depth as usize * (touched.instances + ROOT);
    // A node of a bottom level holds a triangle, or two nodes at least; more than a sixteenth of a mesh is refitted with all of it.
    let bottom = touched.triangles + touched.single * WHOLE.max(depth as usize);
    let computed = plan.top.nodes().len();
    assert!(
        computed <= paths,
        "{computed} nodes of the top level for {touched:?}, {depth} levels"
    );
    let computed = plan.bottom.nodes().len();
    assert!(
        computed <= bottom,
        "{computed} nodes of bottom levels for {touched:?}"
    );
    let computed = plan.roots.len();
    assert!(computed <= touched.meshes, "{computed} roots for {touched:?}");
    let written = plan
        .written_nodes
        .iter()
        .map(ExactSizeIterator::len)
        .sum::<usize>();
    assert!(
        written <= paths + bottom,
        "{written} nodes written for {touched:?}, {depth} levels"
    );
    if touched.instances + touched.meshes == 0 {
        assert_eq!((plan.computed(), written), (0, 0), "nothing changed");
    }
}
