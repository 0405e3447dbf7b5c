//! What the refit after a batch may do.

use lightbvh::bvh::RefitPlan;

use super::batch::Touched;

/// Leaves of an instance: the parts that it is opened into, and itself.
const LEAVES: usize = 17;
/// Nodes of a subtree that an edit builds anew, which has at most 512 leaves and in each node at least two children.
const SUBTREE: usize = 511;
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
    let paths = PATHS * (SUBTREE + depth as usize) * (LEAVES * touched.instances + ROOT);
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
    let roots = LEAVES * (touched.meshes + touched.instances);
    assert!(computed <= roots, "{computed} roots for {touched:?}");
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
