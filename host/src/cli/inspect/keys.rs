//! The frames at which what moves lights has its keys: between two keys it moves one way, so that what is the same in all of
//! them does not move.

use std::collections::BTreeSet;

use crate::scene::{Animation, FRAMES_PER_SECOND, Interpolation, Primitive, SceneData};

/// Which nodes move lights: those that lights stand on, joints of meshes that shine, and whatever carries one of them.
pub(super) fn carriers(data: &SceneData) -> Vec<bool> {
    let is_bright = |rgb: &[f32; 3]| rgb.iter().any(|&channel| channel > 0.0);
    let shines = |primitive: &Primitive| match &primitive.radiance {
        Some(all) => all.iter().any(is_bright),
        None => is_bright(&data.materials[primitive.material as usize].radiance),
    };
    let meshes: Vec<bool> = data
        .meshes
        .iter()
        .map(|mesh| mesh.primitives.iter().any(shines))
        .collect();
    let mut carries = vec![false; data.nodes.len()];
    for (index, node) in data.nodes.iter().enumerate() {
        if node.mesh.is_some_and(|mesh| meshes[mesh as usize]) {
            carries[index] = true;
            let skin = node.skin.map(|skin| &data.skins[skin as usize]);
            for &joint in skin.iter().flat_map(|skin| &skin.joints) {
                carries[joint as usize] = true;
            }
        }
    }
    for light in &data.analytic {
        carries[light.node as usize] = true;
    }
    // Parents come before their children.
    for index in (0..data.nodes.len()).rev() {
        if let Some(parent) = data.nodes[index].parent {
            carries[parent as usize] |= carries[index];
        }
    }
    carries
}

/// The frames beside the keys of what moves lights, in the first round of each of these animations; of splines those between
/// keys too.
pub(super) fn frames(animations: &[Animation], carries: &[bool]) -> Vec<u32> {
    let mut frames = BTreeSet::new();
    for animation in animations {
        for channel in animation.channels.iter().filter(|own| carries[own.node as usize]) {
            let keys = channel.times.iter().map(|&time| f64::from(time));
            let between = channel
                .times
                .windows(2)
                .filter(|_| channel.interpolation == Interpolation::CubicSpline)
                .map(|pair| 0.5 * (f64::from(pair[0]) + f64::from(pair[1])));
            for time in keys.chain(between) {
                let frame = time * f64::from(FRAMES_PER_SECOND);
                frames.extend([frame.floor() as u32, frame.ceil() as u32]);
            }
        }
    }
    frames.into_iter().collect()
}

/// How many of `most` each of several may have that want so many: all of them what they want where it is enough, else those
/// that want much as many as one another.
pub(super) fn share(wanted: &[usize], most: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by_key(|&index| wanted[index]);
    let (mut given, mut left) = (vec![0; wanted.len()], most);
    for (passed, index) in order.into_iter().enumerate() {
        given[index] = wanted[index].min(left / (wanted.len() - passed));
        left -= given[index];
    }
    given
}

/// So many of all, evenly.
pub(super) fn some(all: &[u32], count: usize) -> impl Iterator<Item = u32> + '_ {
    let count = count.min(all.len());
    (0..count).map(move |k| all[k * all.len() / count])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_wants_little_has_it() {
        assert_eq!(share(&[3, 0, 5], 100), [3, 0, 5]);
        assert_eq!(share(&[50, 2, 900], 100), [49, 2, 49]);
        assert_eq!(share(&[7, 7, 7], 2), [0, 1, 1]);
        assert_eq!(share(&[], 2), [0; 0]);
        assert_eq!(some(&[1, 2, 3, 4], 2).collect::<Vec<_>>(), [1, 3]);
        assert_eq!(some(&[1, 2], 9).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(some(&[], 9).count(), 0);
    }
}
