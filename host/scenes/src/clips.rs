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
        self.warnings.extend(self.clip_words());
    }

    /// Shows the first animation of this name, or that at this place in the file, from 0, and the others that are named
    /// likewise; none besides. Of those that move the same things the first.
    ///
    /// # Errors
    /// The word that names none, and the names that there are.
    pub fn play(&mut self, words: &[String]) -> Result<(), NoClip> {
        self.warnings.retain(|warning| !warning.ends_with(ADVICE));
        let mut all = std::mem::take(&mut self.animations);
        all.append(&mut self.clips);
        all.sort_by_key(|animation| animation.place);
        let mut chosen: Vec<Animation> = Vec::new();
        for word in words {
            let place: Option<u32> = word.parse().ok();
            let by_name = all.iter().position(|animation| animation.name == *word);
            let by_place = || all.iter().position(|animation| Some(animation.place) == place);
            let Some(index) = by_name.or_else(by_place) else {
                if chosen
                    .iter()
                    .any(|own| own.name == *word || Some(own.place) == place)
                {
                    // Named again.
                    continue;
                }
                return Err(NoClip {
                    word: word.clone(),
                    expected: match (all.is_empty(), chosen.is_empty()) {
                        (true, true) => {
                            String::from("a scene with animations, and it has none; leave the option out")
                        }
                        (true, false) => String::from("no more: all that there are are named"),
                        _ => format!("one of {}", names_of(&all)),
                    },
                });
            };
            chosen.push(all.remove(index));
        }
        self.animations = chosen;
        self.part_clips();
        self.clips.extend(all);
        Ok(())
    }

    /// What moves what another does, and is left out for that, in words.
    fn clip_words(&self) -> Option<String> {
        let (is, are) = match self.clips.len() {
            0 => return None,
            1 => ("animation", "moves what another does, and is left out"),
            _ => ("animations", "move what others do, and are left out"),
        };
        Some(format!("{is} {} {are}: {ADVICE}", names_of(&self.clips)))
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

fn names_of(all: &[Animation]) -> String {
    names(all.iter().map(|own| (own.place, own.name.as_str())))
}

/// The first numbers and names, and how many more there are.
fn names<'a>(of: impl ExactSizeIterator<Item = (u32, &'a str)>) -> String {
    let count = of.len();
    let some: Vec<String> = of.take(NAMED).map(|(place, name)| named(place, name)).collect();
    match count.saturating_sub(NAMED) {
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

    fn shown(data: &SceneData) -> Vec<&str> {
        data.animations.iter().map(|own| own.name.as_str()).collect()
    }

    #[test]
    fn clips_of_one_thing_exclude_each_other() {
        let mut data = SceneData {
            animations: vec![
                clip(0, "idle", &[0, 1], Property::Rotation),
                clip(1, "walk", &[1, 2], Property::Rotation),
                clip(2, "door", &[3], Property::Rotation),
                clip(3, "bob", &[0], Property::Translation),
            ],
            ..SceneData::default()
        };
        data.part_clips();
        assert_eq!(shown(&data), ["idle", "door", "bob"]);
        assert_eq!(data.warnings.len(), 1);
        assert!(data.warnings[0].starts_with("animation 1 \"walk\" moves what another does"));
        let play = |data: &mut SceneData, words: &[&str]| {
            data.play(&words.iter().map(ToString::to_string).collect::<Vec<_>>())
        };
        // What is named moves alone.
        play(&mut data, &["walk"]).expect("there");
        assert_eq!(shown(&data), ["walk"]);
        assert_eq!((data.warnings.len(), data.clips.len()), (0, 3));
        play(&mut data, &["bob", "walk", "idle"]).expect("there");
        assert_eq!(shown(&data), ["bob", "walk"]);
        assert!(data.warnings[0].starts_with("animation 0 \"idle\""));
        let all = "one of 0 \"idle\", 1 \"walk\", 2 \"door\", 3 \"bob\"";
        let error = play(&mut data.clone(), &["run"]).expect_err("there is none");
        assert_eq!((error.word.as_str(), error.expected.as_str()), ("run", all));
        // Named again it is the same, which is there.
        let mut again = data.clone();
        play(&mut again, &["walk", "walk", "1"]).expect("there");
        assert_eq!(shown(&again), ["walk"]);
        assert!(play(&mut SceneData::default(), &["run"]).is_err());
        // Two of one name are told apart by their places; names come first.
        let mut twins = SceneData {
            animations: vec![
                clip(2, "idle", &[0], Property::Rotation),
                clip(5, "idle", &[0], Property::Rotation),
                clip(6, "5", &[0], Property::Rotation),
            ],
            ..SceneData::default()
        };
        for (word, place) in [("2", 2), ("idle", 2), ("5", 6), ("6", 6)] {
            play(&mut twins, &[word]).expect("there");
            assert_eq!(twins.animations[0].place, place, "{word}");
        }
        play(&mut twins, &["5", "5"]).expect("one by its name, one by its place");
        assert_eq!((twins.animations[0].place, twins.warnings.len()), (6, 1));
        assert_eq!(
            names_of(&[clip(0, "a\n\u{1b}[1m", &[], Property::Scale)]),
            r#"0 "a\n\u{1b}[1m""#
        );
        assert_eq!(named(3, &"\u{e4}".repeat(80)).chars().count(), 84);
        assert_eq!(named(3, &"\u{e4}".repeat(81)).chars().count(), 85);
    }
}
