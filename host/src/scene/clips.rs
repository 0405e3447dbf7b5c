//! Clips of a file of which one is shown at a time: those that move the same things exclude each other, for a format does not say which is meant.

use std::collections::BTreeSet;

use super::model::{Animation, Property, SceneData};

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

    /// Shows the animation of this name, and of the others those that move other things.
    ///
    /// # Errors
    /// The names that there are, where none is this.
    pub fn play(&mut self, name: &str) -> Result<(), String> {
        let mut all: Vec<Animation> = self.animations.drain(..).collect();
        let said = self.clip_words();
        self.warnings.retain(|warning| said.as_ref() != Some(warning));
        all.append(&mut self.clips);
        let Some(chosen) = all.iter().position(|animation| animation.name == name) else {
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

    /// What is left out, in words.
    fn clip_words(&self) -> Option<String> {
        let (is, are) = match self.clips.len() {
            0 => return None,
            1 => ("animation", "moves what another does, and is left out"),
            _ => ("animations", "move what others do, and are left out"),
        };
        Some(format!(
            "{is} {} {are}: --animation NAME of `render` shows one of them",
            names(&self.clips)
        ))
    }
}

/// The first names, and how many more there are.
fn names(of: &[Animation]) -> String {
    let some: Vec<String> = of
        .iter()
        .take(NAMED)
        .map(|own| format!("\"{}\"", own.name))
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

    fn clip(name: &str, nodes: &[u32], property: Property) -> Animation {
        let channel = |&node: &u32| Channel {
            node,
            property,
            interpolation: Interpolation::Linear,
            times: vec![0.0],
            values: vec![[0.0; 4]],
        };
        Animation {
            name: String::from(name),
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
                clip("idle", &[0, 1], Property::Rotation),
                clip("walk", &[1, 2], Property::Rotation),
                clip("door", &[3], Property::Rotation),
                clip("bob", &[0], Property::Translation),
            ],
            ..SceneData::default()
        };
        data.part_clips();
        assert_eq!(shown(&data), ["idle", "door", "bob"]);
        assert_eq!(data.warnings.len(), 1);
        assert!(data.warnings[0].starts_with("animation \"walk\" moves what another does"));
        data.play("walk").expect("there");
        assert_eq!(shown(&data), ["walk", "door", "bob"]);
        assert_eq!(data.warnings.len(), 1);
        assert!(data.warnings[0].starts_with("animation \"idle\""));
        let mut other = data.clone();
        assert_eq!(
            other.play("run"),
            Err(String::from("one of \"walk\", \"door\", \"bob\", \"idle\""))
        );
        assert!(SceneData::default().play("run").is_err());
    }
}
