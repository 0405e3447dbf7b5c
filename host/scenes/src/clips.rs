//! Clips of a file of which one is shown at a time: those that move the same things exclude each other, for a format does not
//! say which is meant.

use std::collections::HashSet;
use std::mem::{Discriminant, discriminant};

use super::model::{Animation, Property, SceneData};

/// Most names that a message has.
const NAMED: usize = 8;
/// Most letters of a name that a message has.
const LETTERS: usize = 80;
/// How a message of what is left out ends.
const ADVICE: &str = "`render --animation NAME|NUMBER` shows one of them";

impl Animation {
    /// Nodes that it moves, with what of them.
    fn touches(&self) -> impl Iterator<Item = (u32, Discriminant<Property>)> + '_ {
        let all = self.channels.iter();
        all.map(|channel| (channel.node, discriminant(&channel.property)))
    }
}

impl SceneData {
    /// Leaves out each animation that moves what one before it does, and says so.
    pub fn part_clips(&mut self) {
        self.warnings.retain(|warning| !warning.ends_with(ADVICE));
        let mut touched = HashSet::new();
        let all = std::mem::take(&mut self.animations);
        for animation in all.into_iter().chain(std::mem::take(&mut self.clips)) {
            if animation.touches().any(|own| touched.contains(&own)) {
                self.clips.push(animation);
            } else {
                touched.extend(animation.touches());
                self.animations.push(animation);
            }
        }
        let (is, are) = match self.clips.len() {
            0 => return,
            1 => ("animation", "moves what another does, and is left out"),
            _ => ("animations", "move what others do, and are left out"),
        };
        let names = names_of(&self.clips);
        self.warnings.push(format!("{is} {names} {are}: {ADVICE}"));
    }

    /// Shows the first animation of this name, or that at this place in the file, from 0, and the others that are named
    /// likewise; none besides. Of those that move the same things the first.
    ///
    /// # Errors
    /// The word that names none, and the names that there are.
    pub fn play(&mut self, words: &[String]) -> Result<(), NoClip> {
        let mut rest = std::mem::take(&mut self.animations);
        rest.append(&mut self.clips);
        rest.sort_by_key(|animation| animation.place);
        let mut chosen: Vec<Animation> = Vec::new();
        for word in words {
            let is_named = |own: &Animation| own.name == *word;
            let is_there = |own: &Animation| word.parse() == Ok(own.place);
            let found = rest
                .iter()
                .position(is_named)
                .or_else(|| rest.iter().position(is_there));
            match found {
                Some(index) => chosen.push(rest.remove(index)),
                // Named again.
                None if chosen.iter().any(|own| is_named(own) || is_there(own)) => {}
                None => {
                    let word = word.clone();
                    let expected = match rest.is_empty() && chosen.is_empty() {
                        true => {
                            String::from("a scene with animations, and it has none; leave the option out")
                        }
                        false => format!("one of {}", names_of(chosen.iter().chain(&rest))),
                    };
                    return Err(NoClip { word, expected });
                }
            }
        }
        self.animations = chosen;
        self.part_clips();
        self.clips.extend(rest);
        Ok(())
    }
}

/// A word that names no animation that can be shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoClip {
    /// The word.
    pub word: String,
    /// What would do.
    pub expected: String,
}

/// The number and the name of an animation, so that a terminal shows it as it is, and not all of a long one.
pub(super) fn named(place: u32, name: &str) -> String {
    let mut own: String = name.chars().take(LETTERS).collect();
    if own.len() < name.len() {
        own.push('\u{2026}');
    }
    format!("{place} \"{}\"", own.escape_debug())
}

/// The first numbers and names, and how many more there are.
fn names_of<'a>(all: impl IntoIterator<Item = &'a Animation>) -> String {
    let mut all = all.into_iter();
    let some: Vec<String> = all
        .by_ref()
        .take(NAMED)
        .map(|own| named(own.place, &own.name))
        .collect();
    match all.count() {
        0 => some.join(", "),
        more => format!("{} and {more} more", some.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::{Channel, Interpolation};
    use super::*;

    fn clip(place: u32, name: &str, nodes: &[u32], property: Property) -> Animation {
        let channel = |&node: &u32| Channel {
            node,
            property,
            interpolation: Interpolation::Linear,
            times: vec![0.0],
            values: vec![0.0; property.numbers()],
        };
        Animation {
            name: String::from(name),
            place,
            channels: nodes.iter().map(channel).collect(),
        }
    }

    #[test]
    fn clips_of_one_thing_exclude_each_other() {
        let mut data = SceneData {
            animations: vec![
                clip(0, "idle", &[0, 1], Property::Rotation),
                clip(1, "walk", &[1, 2], Property::Rotation),
                clip(2, "door", &[3], Property::Rotation),
                clip(3, "bob", &[0], Property::Translation),
                clip(4, "0", &[9], Property::Scale),
                clip(5, "bob", &[0], Property::Translation),
            ],
            ..SceneData::default()
        };
        data.part_clips();
        let shown = |data: &SceneData| data.animations.iter().map(|own| own.place).collect::<Vec<_>>();
        assert_eq!((shown(&data), data.warnings.len()), (vec![0, 2, 3, 4], 1));
        let said = "animations 1 \"walk\", 5 \"bob\" move what others do";
        assert!(data.warnings[0].starts_with(said), "{:?}", data.warnings);
        // A name selects its first animation, a number its place. Only selected animations move. A repeated name changes nothing.
        for (words, places, warnings) in [
            ("walk", vec![1], 0),
            ("bob walk idle", vec![3, 1], 1),
            ("walk walk 1", vec![1], 0),
            ("0", vec![4], 0),
            ("0 0", vec![4, 0], 0),
            ("5", vec![5], 0),
        ] {
            let words: Vec<String> = words.split(' ').map(String::from).collect();
            data.play(&words).expect("there");
            assert_eq!(
                (shown(&data), data.warnings.len()),
                (places, warnings),
                "{words:?}"
            );
            assert_eq!(data.animations.len() + data.clips.len(), 6);
        }
        let run = [String::from("run")];
        let error = data.play(&run).expect_err("there is none");
        assert_eq!(error.word, "run");
        assert!(error.expected.starts_with("one of 0 \"idle\", 1 \"walk\", 2"));
        assert!(SceneData::default().play(&run).is_err());
    }
}
