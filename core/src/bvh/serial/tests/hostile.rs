//! Malformed input.

use crate::light::EmissiveTriangle;
use crate::model::Model;
use alloc::vec::Vec;

use alloc::string::ToString;

use super::{alike, read};
use crate::bvh::{Bvh, Edit};
use crate::importance::{Eq4, Moments};
use crate::kit::Random;
use crate::kit::scenes::{edits, lamps, placed};
use crate::node::{CompactNode, MomentNode, Node};

/// A small BVH with an opened instance, and places not in use.
fn small<M: Model<W, Light = EmissiveTriangle>, const W: usize>() -> Bvh<M, W> {
    let random = &mut Random(5);
    let mut bvh = Bvh::<M, W>::default();
    let mut ids = Vec::new();
    for count in [64, 1, 5] {
        let mesh = bvh.add_mesh(lamps(random, count)).expect("lights");
        for _ in 0..2 {
            ids.push(bvh.add_instance(mesh, placed(random, 20.0)).expect("a mesh"));
        }
    }
    bvh.refit();
    let mesh = bvh.view().mesh_of(ids[2]).expect("its mesh");
    bvh.remove(ids[2]).expect("there");
    bvh.remove(ids[3]).expect("there");
    bvh.apply(std::vec![Edit::RemoveMesh(mesh)]).expect("unused");
    bvh.refit();
    assert!(bvh.top.opened.values().any(|own| own.first != u32::MAX));
    bvh
}

/// What is read, if it is, is valid, and edits do not break it.
fn harmless(words: &[u32], seed: u32) {
    let Ok(mut bvh) = Bvh::<(CompactNode<4>, Eq4), 4>::from_words(words) else {
        return;
    };
    alike(&bvh, &read(&bvh));
    let random = &mut Random(seed);
    for count in [3, 5] {
        let _ = bvh.apply(edits(random, &bvh, count, 30));
        bvh.refit();
        bvh.view().validate().expect("valid");
        bvh.rebuild();
        bvh.view().validate().expect("valid");
    }
}

/// Words of numbers that say how many, where and which, all of them, to other small numbers and to great ones. Other bits are the
/// fuzz target `read_words`.
#[test]
fn wrong_numbers_are_refused_or_harmless() {
    let words = small::<(CompactNode<4>, Eq4), 4>().to_words();
    for at in 0..words.len() {
        for value in [
            0,
            1,
            2,
            3,
            words[at].wrapping_add(1),
            words[at].wrapping_sub(1),
            1 << 30,
            u32::MAX,
        ] {
            let mut wrong = words.clone();
            wrong[at] = value;
            harmless(&wrong, value);
        }
    }
}

#[test]
fn cut_words_are_refused() {
    let words = small::<(MomentNode<8>, Moments), 8>().to_words();
    for length in 0..words.len() {
        let mut cut = words[..length].to_vec();
        let error = Bvh::<(MomentNode<8>, Moments)>::from_words(&cut).expect_err("words are missing");
        assert!(error.to_string().contains("cut or damaged"), "{error}");
        // As long as it says.
        if length > 2 {
            cut[2] = length as u32;
            assert!(Bvh::<(MomentNode<8>, Moments)>::from_words(&cut).is_err());
        }
    }
    let mut more = words.clone();
    more.push(0);
    more[2] += 1;
    let error = Bvh::<(MomentNode<8>, Moments)>::from_words(&more).expect_err("one too many");
    assert!(error.to_string().contains("cut or damaged"), "{error}");
}

/// A node of a bottom level comes before those below it, and what is below one is together.
#[test]
fn nodes_in_another_order_are_refused() {
    type Deep = Bvh<(CompactNode<2>, Eq4), 2>;
    let lights = super::lights(1, 6);
    let bvh = Deep::single_level(&lights, &crate::BuildParams::default());
    let count = bvh.meshes[0].nodes.len();
    assert!(count >= 5);
    let mut refused = 0;
    for i in 1..count {
        for j in i + 1..count {
            let mut other = bvh.clone();
            other.nodes.swap(i, j);
            for node in &mut other.nodes {
                for slot in 0..2 {
                    if node.kind(slot) == crate::node::kind::INNER {
                        let link = node.link(slot) as usize;
                        let link = if link == i {
                            j
                        } else if link == j {
                            i
                        } else {
                            link
                        };
                        node.relink(slot, link as u32);
                    }
                }
            }
            match Deep::from_words(&other.to_words()) {
                Ok(read) => assert!(read.view().validate().is_ok()),
                Err(error) => {
                    assert!(error.to_string().starts_with("places of nodes"), "{error}");
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 0);
}

/// A count of numbers beyond those in use would make `world_lights` allocate for all of them.
#[test]
fn numbers_that_nobody_has_are_refused() {
    type Small = Bvh<(MomentNode<8>, Moments)>;
    let mut bvh: Small = small();
    assert!(bvh.take_removed_lights().iter().len() > 0);
    let mut words = bvh.to_words();
    assert!(words[13] >= bvh.view().light_count() as u32);
    words[13] = 1 << 30;
    let error = Small::from_words(&words).expect_err("too many");
    assert!(
        super::std::format!("{error}").contains("the lights' numbers"),
        "{error}"
    );
}
