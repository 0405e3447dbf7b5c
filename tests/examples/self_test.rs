//! Overwrites the answers of the self-test that `lightbvh-gpu` carries: `cargo run -p lightbvh-tests --example self_test`. This is
//! a change of results: first describe it in the changelog under "Changes to bits".

use std::path::Path;

use lightbvh_tests::self_test;

fn main() -> std::io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    std::fs::write(root.join(self_test::FILE), self_test::words())
}
