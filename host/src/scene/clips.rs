//! Clips of a file of which one is shown at a time: those that move the same things exclude each other, for a format does not say which is meant.

use std::collections::BTreeSet;

use super::model::{Animation, Property, Scene, SceneData};

/// Most names that a message has.
const NAMED: usize = 8;
/// How a message of what is left out ends.
const ADVICE: &str = "`render --animation NAME|NUMBER` shows one of them";

impl Animation {
    /// Nodes that it moves, with what of them: 0 to 2, and 3 for the weights of morph targets.
    fn touches(&self) -> impl Iterator<Item = (u32, u8)> + '_ {
        let moving = self.channels.iter().map(|channel| {
            let property = match channel.property {
                Property::Translation => 0,
                Property::Rotation => 1,
                Property::Scale => 2,
            };
            (channel.node, property)
        });
        moving.chain(self.morphs.iter().map(|channel| (channel.node, 3)))
    }
}

impl SceneData {
    /// Leaves out each animation that moves what one before it does, and says so.
    pub fn part_clips(&mut self) {
        self.warnings.retain(|warning| !warning.ends_with(ADVICE));
        let mut touched = BTreeSet::new();
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

    /// Shows the first animation of this name, or that at this place in the file, from 0, and the others that are named likewise; none besides. Of
    /// those that move the same things the first.
    ///
    /// # Errors
    /// The word that names none, and the names that there are.
    pub fn play(&mut self, words: &[String]) -> Result<(), (String, String)> {
        self.warnings.retain(|warning| !warning.ends_with(ADVICE));
        let mut all = std::mem::take(&mut self.animations);
        all.append(&mut self.clips);
        all.sort_by_key(|animation| animation.place);
        let mut chosen = Vec::new();
        for word in words {
            let place: Option<u32> = word.parse().ok();
            let by_name = all.iter().position(|animation| animation.name == *word);
            let by_place = || all.iter().position(|animation| Some(animation.place) == place);
            let Some(index) = by_name.or_else(by_place) else {
                let expected = match (all.len(), chosen.is_empty()) {
                    (0, true) => {
                        String::from("a scene with animations, and it has none; leave the option out")
                    }
                    (0, false) => String::from("no more: all that there are are named"),
                    _ => format!("one of {}", names(&all)),
                };
                return Err((word.clone(), expected));
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
        Some(format!("{is} {} {are}: {ADVICE}", names(&self.clips)))
    }
}

impl Scene {
    /// Shows one after the other each animation that is left out, alone, the first `most` of them, and calls `with` for the scene then. Those that
    /// [`Scene::new`] would refuse are passed.
    pub fn each_clip(&self, most: usize, mut with: impl FnMut(&Self)) {
        let mut scene = self.clone();
        for clip in self.data().clips.iter().take(most) {
            if scene.show(vec![clip.clone()]).is_ok() {
                with(&scene);
            }
        }
    }
}

/// The first numbers and names, and how many more there are.
fn names(of: &[Animation]) -> String {
    let some: Vec<String> = of
        .iter()
        .take(NAMED)
        .map(|own| format!("{} \"{}\"", own.place, own.name.escape_debug()))
        .collect();
    match of.len().saturating_sub(NAMED) {
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
            values: vec![[0.0; 4]],
        };
        Animation {
            name: String::from(name),
            place,
            channels: nodes.iter().map(channel).collect(),
            ..Animation::default()
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
            let words: Vec<String> = words.iter().copied().map(String::from).collect();
            data.play(&words)
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
        assert_eq!(error, (String::from("run"), String::from(all)));
        assert!(play(&mut data.clone(), &["walk", "walk"]).is_err());
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
            names(&[clip(0, "a\n\u{1b}[1m", &[], Property::Scale)]),
            r#"0 "a\n\u{1b}[1m""#
        );
    }
}
