//! Files tell who strayed.

use super::*;

/// Files tell who strayed, and go on word for word.
#[test]
fn files_go_on() {
    let (mut bvh, mesh) = scene(200);
    let half = |at: [f32; 3]| Edit::SetTriangleRange {
        mesh,
        first: 0,
        triangles: cloud(100, at, 0),
    };
    let mut rebuilders = [rebuilder(), rebuilder()];
    frame(&mut bvh, &mut rebuilders[0], [half([60.0, 40.0, 40.0])].to_vec());
    assert!(!bvh.top.strayed.is_empty());
    let words = bvh.to_words();
    let mut read = LightBvh::from_words(&words).expect("its own");
    assert!(read.to_words() == words);
    rebuilders[0] = rebuilder();
    for k in 0..60 {
        for (bvh, own) in [&mut bvh, &mut read].into_iter().zip(&mut rebuilders) {
            let edits = if k == 20 {
                let mesh = bvh.mesh_id(mesh.index()).expect("there");
                let triangles = cloud(100, [-60.0, 0.0, 40.0], 0);
                [Edit::SetTriangleRange {
                    mesh,
                    first: 50,
                    triangles,
                }]
                .to_vec()
            } else {
                Vec::new()
            };
            frame(bvh, own, edits);
        }
        assert!(bvh.to_words() == read.to_words(), "{k}");
    }
}

/// A list that names what is gone, or one twice, or not in order, is none.
#[test]
fn files_name_instances_that_are_there_once() {
    let (mut bvh, _) = scene(20);
    let gone = bvh.instance_id(3).expect("there");
    bvh.remove_instance(gone).expect("its own");
    bvh.refit();
    bvh.top.strayed.extend([7, 9]);
    let words = bvh.to_words();
    assert!(LightBvh::from_words(&words).is_ok());
    let at: Vec<usize> = (0..words.len() - 1)
        .filter(|&k| words[k..k + 2] == [7, 9] && LightBvh::from_words(&with(&words, k, [9, 7])).is_err())
        .collect();
    // The list itself is among the places where these two stand.
    assert!(!at.is_empty());
    assert!(at.iter().any(|&k| {
        let fails = |pair: [u32; 2]| {
            let error = LightBvh::from_words(&with(&words, k, pair)).err();
            error.is_some_and(|error| std::format!("{error}").contains("strayed"))
        };
        fails([9, 7]) && fails([7, 7]) && fails([3, 9]) && fails([7, 9999])
    }));
}

/// Words with two others at a place.
fn with(words: &[u32], at: usize, pair: [u32; 2]) -> Vec<u32> {
    let mut words = words.to_vec();
    words[at..at + 2].copy_from_slice(&pair);
    words
}
