//! The words themselves: of builds, refits, samples, scenes and reservoirs over fixed inputs. Other tests say what must hold
//! whatever the words are; this one notices when a change gives others. Equal bits are this crate's promise, so a change that
//! is meant belongs under "Changes to bits" in `CHANGELOG.md`, with the new digests here.

mod arithmetic;
mod digest;
mod instances;
mod reservoirs;
mod scenes;
mod trees;

use lightbvh::Transform;
use lightbvh_tests::generate::Random;

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
