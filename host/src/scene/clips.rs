//! Clips of a file of which one is shown at a time: those that move the same things exclude each other, for a format does not say which is meant.

use std::collections::BTreeSet;

use super::error::SceneError;
use super::model::{Animation, Property, Scene, SceneData};

/// Most names that a message has.
const NAMED: usize = 8;

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
        let said = self.clip_words();
        self.warnings.retain(|warning| said.as_ref() != Some(warning));
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

    /// Shows the first animation of this name, or that at this place in the file, from 0; and of the others those that move other things.
    ///
    /// # Errors
    /// The names that there are, where none is this.
    pub fn play(&mut self, word: &str) -> Result<(), String> {
        let mut all: Vec<Animation> = self.animations.drain(..).collect();
        let said = self.clip_words();
        self.warnings.retain(|warning| said.as_ref() != Some(warning));
        all.append(&mut self.clips);
        all.sort_by_key(|animation| animation.place);
        let place: Option<u32> = word.parse().ok();
        let by_name = all.iter().position(|animation| animation.name == word);
        let by_place = || all.iter().position(|animation| Some(animation.place) == place);
        let Some(chosen) = by_name.or_else(by_place) else {
            return Err(match all.len() {
                0 => String::from("a scene with animations, and it has none; leave the option out"),
                _ => format!("one of {}", names(&all)),
            });
        };
        all[..=chosen].rotate_right(1);
        self.animations = all;
        self.part_clips();
        Ok(())
    }

    /// Shows one after the other each animation that is left out, and calls `with` for the scene then.
    ///
    /// # Errors
    /// Those of `with`, and of [`Scene::new`].
    pub fn each_clip<E: From<SceneError>>(
        mut self,
        mut with: impl FnMut(&Scene) -> Result<(), E>,
    ) -> Result<(), E> {
        let places: Vec<u32> = self.clips.iter().map(|own| own.place).collect();
        for place in places {
            self.animations.append(&mut self.clips);
            // The one that is shown excludes others.
            self.animations.sort_by_key(|own| (own.place != place, own.place));
            self.part_clips();
            let scene = Scene::new(self)?;
            with(&scene)?;
            self = scene.into_data();
        }
        Ok(())
    }

    /// What is left out, in words.
    fn clip_words(&self) -> Option<String> {
        let (is, are) = match self.clips.len() {
            0 => return None,
            1 => ("animation", "moves what another does, and is left out"),
            _ => ("animations", "move what others do, and are left out"),
        };
        Some(format!(
            "{is} {} {are}: `render --animation NAME|NUMBER` shows one of them",
            names(&self.clips)
        ))
    }
}

/// The first numbers and names, and how many more there are.
fn names(of: &[Animation]) -> String {
    let some: Vec<String> = of
        .iter()
        .take(NAMED)
        .map(|own| format!("{} \"{}\"", own.place, own.name))
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
        data.play("walk").expect("there");
        assert_eq!(shown(&data), ["walk", "door", "bob"]);
        assert_eq!(data.warnings.len(), 1);
        assert!(data.warnings[0].starts_with("animation 0 \"idle\""));
        let mut other = data.clone();
        assert_eq!(
            other.play("run"),
            Err(String::from(
                "one of 0 \"idle\", 1 \"walk\", 2 \"door\", 3 \"bob\""
            ))
        );
        assert!(SceneData::default().play("run").is_err());
        // Two of one name are told apart by their places.
        let mut twins = SceneData {
            animations: vec![
                clip(2, "idle", &[0], Property::Rotation),
                clip(5, "idle", &[0], Property::Rotation),
                clip(6, "5", &[0], Property::Rotation),
            ],
            ..SceneData::default()
        };
        let mut plays = |word: &str| {
            twins.play(word).expect("there");
            twins.animations[0].place
        };
        assert_eq!(["2", "idle", "5", "6"].map(&mut plays), [2, 2, 6, 6]);
        twins.animations.retain(|own| own.name != "5");
        twins.clips.retain(|own| own.name != "5");
        twins.play("5").expect("by its place");
        assert_eq!(twins.animations[0].place, 5);
    }
}
