//! What the refit after a batch may do.

use lightbvh::bvh::RefitPlan;

use super::batch::Touched;

/// Nodes of the top level for each level of each path that an edit touches: its own, and those beside it that turn with it.
const BESIDE: usize = 4;
/// The root, whatever changes.
const ROOT: usize = 1;

/// The nodes that a plan writes and computes are on paths from what the batch changed, or of the meshes that it brought.
///
/// # Panics
/// If there are more.
pub fn check(plan: &RefitPlan, touched: &Touched, depth: u32) {
    let paths = BESIDE * depth as usize * (touched.instances + ROOT);
    // A node of a bottom level holds a triangle, or two nodes at least.
    let bottom = touched.triangles;
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
