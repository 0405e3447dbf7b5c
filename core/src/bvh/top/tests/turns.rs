//! Who has a turn, and when.

use super::super::rebuild::PART;
use super::adoption::parts;
use super::*;
use crate::BuildParams;
use crate::kit::line;

/// A node as if it had told its children apart better when it was built, and those above know.
fn wear(scene: &mut LightBvh, node: u32) {
    scene.quality[node as usize].built = 0.0;
    let mut node = node;
    while node != INVALID {
        scene.judge_list(&[node]);
        node = scene.parents[node as usize];
    }
}

/// What is worn and did not fit into a frame is found by a later search, though nothing that was found comes in.
#[test]
fn what_did_not_fit_is_still_found() {
    let (mut scene, _) = grid(18);
    let mut all = parts(&scene);
    all.retain(|&node| scene.top.heights[scene.top.number(node) as usize] > 1);
    for &part in &all {
        wear(&mut scene, part);
    }
    let mut found = Vec::new();
    let mut search = Search::default();
    scene.search_again(&mut search);
    while !search.is_done() {
        let copies = scene.copy_worn_parts(1.02, 0, &mut search);
        assert!(copies.len() < all.len());
        for copy in copies {
            let node = copy.root.and_then(|part| scene.node_of(part)).expect("there");
            // Its tree gains nothing.
            scene.judge_new(node);
            found.push(node);
        }
    }
    found.sort_unstable();
    all.sort_unstable();
    assert_eq!(found, all);
}

/// Where nodes above parts gain little the time belongs to parts. They have their turn all the same, though parts never end.
#[test]
fn nodes_above_parts_wait_where_they_gain_little() {
    let (mut scene, _) = grid(18);
    for part in parts(&scene) {
        wear(&mut scene, part);
    }
    let root = scene.top.root;
    wear(&mut scene, root);
    let turns_of_parts = |cost: f64| {
        let mut search = Search::default();
        scene.search_again(&mut search);
        search.note_gain(cost);
        let is_above = |copies: Vec<TopCopy<_>>| copies[0].root == Some(scene.part(root));
        (0..50).find(|_| is_above(scene.copy_worn_parts(1.02, 0, &mut search)))
    };
    let [much, little] = [0.5, 0.98].map(turns_of_parts);
    let [much, little] = [much, little].map(|turns| turns.expect("a turn of its own"));
    assert!(much < little, "{much} and {little}");
}

/// A node that lost much is built before parts, wherever it is among the nodes above them.
#[test]
fn what_lost_much_is_first_wherever_it_is() {
    let (mut scene, _) = grid(10);
    let root = scene.top.root;
    let lowest: Vec<u32> = scene.top.in_use().collect();
    let number = |scene: &LightBvh, node: u32| scene.top.number(node) as usize;
    let lowest: Vec<u32> = lowest
        .into_iter()
        .filter(|&node| scene.top.heights[number(&scene, node)] == 2 && scene.level(node) > 1)
        .collect();
    // As if there were more than a part holds below each, but for one, which is a part.
    for own in 0..scene.top.nodes.len() {
        scene.top.counts[own] = PART + 1;
    }
    let by_share = |&a: &u32, &b: &u32| scene.quality(a).built.total_cmp(&scene.quality(b).built);
    let node = lowest.iter().copied().max_by(by_share).expect("a node");
    let part = lowest
        .iter()
        .copied()
        .find(|&other| other != node)
        .expect("another");
    let own = number(&scene, part);
    scene.top.counts[own] = PART - 1;
    wear(&mut scene, part);
    wear(&mut scene, node);
    assert!(scene.level(node) > 1 && scene.quality(node).own() > 0.12 && node != root);
    let mut search = Search::default();
    scene.search_again(&mut search);
    let copies = scene.copy_worn_parts(1.02, 0, &mut search);
    assert_eq!(copies.len(), 1);
    assert_eq!(copies[0].root, Some(scene.part(node)));
}

/// A node above parts that lost little waits while a part is worn, and has its turn where none is.
#[test]
fn what_lost_little_above_parts_waits_for_them() {
    let first = |has_worn_part: bool, lost: f32| {
        let (mut scene, _) = grid(18);
        let root = scene.top.root;
        if has_worn_part {
            let part = parts(&scene)[0];
            wear(&mut scene, part);
        }
        wear(&mut scene, root);
        let all = scene.quality(root).own();
        assert!(all > 0.2, "{all}");
        scene.quality[root as usize].built = all - lost;
        scene.judge_list(&[root]);
        assert!(crate::exact::abs(scene.quality(root).own() - lost) < 0.01);
        let mut search = Search::default();
        scene.search_again(&mut search);
        let copies = scene.copy_worn_parts(1.02, 0, &mut search);
        assert!(!copies.is_empty());
        copies[0].root == Some(scene.part(root))
    };
    // 0.05 at least, 0.12 while parts are worn.
    assert!(first(false, 0.1) && !first(true, 0.1) && first(true, 0.15));
}

/// Small meshes that are many take turns with the top level where that is large: both in one frame would take longer than it may.
#[test]
fn many_small_meshes_take_turns_with_the_top_level() {
    let mut scene = LightBvh::new(BuildParams {
        opens: false,
        ..BuildParams::default()
    });
    let random = &mut Random(3);
    let mixed = |step: u16| (0..100).map(move |k| line(k * step % 100, 0.01)).collect();
    let meshes: Vec<MeshId> = (0..40)
        .map(|_| scene.add_mesh(mixed(1)).expect("a mesh"))
        .collect();
    let place = |random: &mut Random| Transform::at((random.vector() * 100.0).to_array());
    let add = (0..520).map(|k| Edit::AddInstance {
        mesh: meshes[k % 40],
        transform: place(random),
        radiance: 1.0,
    });
    let ids = scene.apply(add.collect()).expect("instances").instances;
    scene.refit();
    let moves = ids.iter().map(|&instance| Edit::SetTransform {
        instance,
        transform: place(random),
    });
    scene.apply(moves.collect()).expect("there");
    for &mesh in &meshes {
        scene.set_triangles(mesh, mixed(37)).expect("as many");
    }
    scene.refit();
    // What is put in elsewhere one by one is no top level.
    scene.top.strayed.clear();
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let mut came = [0, 0];
    for frame in 0..20 {
        rebuilder.end_frame(&scene);
        let (births, epoch) = (scene.top.births, scene.epoch);
        rebuilder.begin_frame(&mut scene).expect("no panic");
        let is_top = scene.top.births > births;
        let is_meshes = scene.blases.iter().any(|own| own.created > epoch);
        assert!(!is_top || !is_meshes, "both in frame {frame}");
        came[0] += u32::from(is_top);
        came[1] += u32::from(is_meshes);
        scene.refit();
    }
    assert!(came[0] > 0 && came[1] >= 4, "{came:?}");
    assert!(!rebuilder.is_busy());
}
