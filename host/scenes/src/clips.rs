//! Clips of a file of which the first is shown: those that move the same things exclude each other, for a format does not say
//! which is meant.

use std::collections::HashSet;
use std::mem::discriminant;

use super::model::{Animation, SceneData};

/// Most names that a message has.
const NAMED: usize = 8;
/// Most letters of a name that a message has.
const LETTERS: usize = 80;

impl SceneData {
    /// Leaves out each animation that moves what one before it does, and says so.
    pub(super) fn part_clips(&mut self) {
        let mut touched = HashSet::new();
        for animation in std::mem::take(&mut self.animations) {
            let all = animation.channels.iter();
            let own: Vec<_> = all.map(|own| (own.node, discriminant(&own.property))).collect();
            if own.iter().any(|own| touched.contains(own)) {
                self.clips.push(animation);
            } else {
                touched.extend(own);
                self.animations.push(animation);
            }
        }
        if !self.clips.is_empty() {
            let names = names_of(&self.clips);
            self.warnings.push(format!(
                "animations {names} move what others before them do, and are left out"
            ));
        }
    }
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
fn names_of(all: &[Animation]) -> String {
    let some = all.iter().take(NAMED).map(|own| named(own.place, &own.name));
    let some = some.collect::<Vec<_>>().join(", ");
    match all.len().saturating_sub(NAMED) {
        0 => some,
        more => format!("{some} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::{Channel, Interpolation, Property};
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
                clip(2, "door", &[2, 3], Property::Rotation),
                clip(3, "bob", &[0], Property::Translation),
                clip(5, "bob", &[0], Property::Translation),
            ],
            ..SceneData::default()
        };
        data.part_clips();
        let shown: Vec<u32> = data.animations.iter().map(|own| own.place).collect();
        assert_eq!(shown, [0, 2, 3]);
        let said = "animations 1 \"walk\", 5 \"bob\" move what others";
        assert!(data.warnings[0].starts_with(said), "{:?}", data.warnings);
    }
}
