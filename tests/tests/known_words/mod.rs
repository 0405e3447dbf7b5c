//! The words themselves: of builds, refits, samples, scenes and reservoirs over fixed inputs. Other tests say what must hold
//! whatever the words are; this one notices when a change gives others. Equal bits are this crate's promise, so a change that
//! is meant belongs under "Changes to bits" in `CHANGELOG.md`, with the new digests here.

mod digest;
mod reservoirs;
mod scenes;
pub mod trees;

use lightbvh::Transform;
use lightbvh::bvh::FORMAT;
use lightbvh::node::NODE_FORMAT;
use lightbvh_gpu::self_test as shipped;
use lightbvh_tests::generate::Random;
use lightbvh_tests::self_test;

/// Maps without trigonometry: turns by 3:4:5 triangles, scales, mirrorings, and some that are no similarity.
fn place(random: &mut Random) -> Transform {
    let (c, s) = (0.6, 0.8);
    let turn: [[f32; 3]; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]],
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    ][random.below(4) as usize];
    let scale = [1.0, 0.5, 3.0, -1.0][random.below(4) as usize];
    let uneven = [1.0, 1.0, 1.0, 2.0, 0.25, 0.0][random.below(6) as usize];
    let mut columns = turn.map(|column| column.map(|x| x * scale));
    columns[1] = columns[1].map(|x| x * uneven);
    Transform {
        columns,
        translation: [0; 3].map(|_| random.between(-20.0, 20.0)),
    }
}

/// The first entry under "Changes to bits" that names a version names the present one: the newest stand above.
#[test]
fn changelog_names_versions_of_words() {
    let text = include_str!("../../../CHANGELOG.md");
    let changes = text.split("### Changes to bits").nth(1).expect("the heading");
    for (name, version) in [("NODE_FORMAT", NODE_FORMAT), ("FORMAT", FORMAT)] {
        let found = changes.split(&format!("`{name}` ")).nth(1).expect("a version");
        let digits = found.split(|c: char| !c.is_ascii_digit()).next();
        assert_eq!(digits, Some(&*version.to_string()), "{name}");
    }
}

/// Exact arithmetic, bit by bit. `cargo run -p lightbvh-tests --example self_test` writes the answers.
#[test]
fn self_test_has_the_answers_of_this_build() {
    let words = self_test::words();
    let (operands, answers) = words.split_at(shipped::operands().len());
    assert_eq!(shipped::operands(), operands);
    assert_eq!(answers.len(), shipped::ANSWERS_BYTES);
    assert_eq!(shipped::defect(answers), None);
}
