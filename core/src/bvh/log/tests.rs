//! Mirrors that follow plans alone.

extern crate std;

use std::vec::Vec;

use super::*;
use crate::importance::{Defensive, Eq4, ImportanceModel, Moments};
use crate::instance::Instance;
use crate::kit::Random;
use crate::kit::scenes::{
    Lamp, bare, edits, instances, lamps, lights, moved, number, points, scattered, sound, sound_samples,
};
use crate::light::{AnyLight, Light};
use crate::node::{CompactNode, Holds, LinkedSpotMomentNode};
use crate::refit;
use crate::{Edit, LightBvh, Rebuilder, RebuilderParams, TreeWords};

/// Start of the top level in the nodes of a mirror, and of its links behind the trails.
const TOP: usize = 1 << 13;
const ABOVE: usize = 1 << 16;
const PLACES: usize = ABOVE + (1 << 12);
const PARTS: usize = PLACES + (1 << 12);

/// The arrays of a device.
#[derive(Clone)]
struct Mirror<N: Holds, const W: usize> {
    cursor: Cursor,
    nodes: Vec<N>,
    lights: Vec<N::Light>,
    trails: Vec<u32>,
    instances: Vec<Instance>,
    wholes: u32,
}

/// Copies ranges of units of `size`, those of the copy beginning at `first`.
fn copy<A: Copy>(to: &mut [A], first: usize, from: &[A], size: usize, ranges: &[Range<u32>]) {
    for range in ranges {
        let own = range.start as usize * size..range.end as usize * size;
        to[first + own.start..first + own.end].copy_from_slice(&from[own]);
    }
}

/// Computes the nodes of a list, which count from `first`. Those of one pass read only what passes before it wrote: their order does not
/// show.
fn passes<N: Copy>(nodes: &mut [N], first: u32, list: &Levels, body: impl Fn(&[N], u32) -> N) {
    for range in list.ranges() {
        let own = list.nodes()[range].iter().map(|node| first + node);
        let found: Vec<_> = own.map(|node| (node, body(nodes, node))).collect();
        for (node, own) in found {
            nodes[node as usize] = own;
        }
    }
}

impl<N: Node<W>, const W: usize> Mirror<N, W> {
    fn new() -> Self {
        Self {
            cursor: Cursor::default(),
            nodes: std::vec![N::EMPTY; 2 * TOP],
            lights: std::vec![N::Light::DARK; ABOVE],
            trails: std::vec![0; PARTS + (1 << 16)],
            instances: std::vec![Instance::IDENTITY; 1 << 12],
            wholes: 0,
        }
    }

    fn follow(&mut self, bvh: &Bvh<impl Model<W, Node = N, Light = N::Light>, W>) {
        let all = |length: usize| std::vec![0..length as u32];
        let mut plan = self.cursor.plan(bvh);
        let (view, links) = (bvh.view(), bvh.tree().links);
        let top = view.top_nodes();
        if plan.everything {
            self.wholes += 1;
            plan.written_nodes = all(view.nodes().len());
            plan.written_lights = all(view.lights().len());
            plan.written_trails = all(view.lights().len());
            plan.written_instances = all(view.instances().len());
        }
        if plan.whole_top {
            plan.written_top = all(top.len());
            plan.written_above = all(links.above.len());
            plan.written_places = all(links.places.len());
            plan.written_parts = all(links.parts.len());
        }
        // No summary is copied: the passes compute them.
        let [nodes, top] = [view.nodes(), top].map(|nodes| nodes.iter().map(bare).collect::<Vec<N>>());
        let trail_words = bvh.tree().trail_words as usize;
        copy(&mut self.nodes, 0, &nodes, 1, &plan.written_nodes);
        copy(&mut self.nodes, TOP, &top, 1, &plan.written_top);
        copy(&mut self.lights, 0, view.lights(), 1, &plan.written_lights);
        copy(
            &mut self.trails,
            0,
            bvh.tree().trails,
            trail_words,
            &plan.written_trails,
        );
        copy(
            &mut self.instances,
            0,
            view.instances(),
            1,
            &plan.written_instances,
        );
        copy(&mut self.trails, ABOVE, links.above, 1, &plan.written_above);
        copy(&mut self.trails, PLACES, links.places, 1, &plan.written_places);
        copy(&mut self.trails, PARTS, links.parts, 1, &plan.written_parts);
        let bottom = |nodes: &[N], node| refit::bottom(nodes, &self.lights, node);
        passes(&mut self.nodes, 0, &plan.bottom, bottom);
        let top = |nodes: &[N], node| refit::top(nodes, TOP as u32, &self.lights, &self.instances, node);
        passes(&mut self.nodes, TOP as u32, &plan.top, top);
    }

    /// Compares all words in use; trails and links by samples and pmfs.
    fn check<M: Model<W, Node = N, Light = N::Light>>(&self, bvh: &Bvh<M, W>)
    where
        M::Importance: ImportanceModel<N, W>,
    {
        let (tree, all) = (bvh.tree(), Cursor::default().plan(bvh));
        for (first, list, known) in [(0, &all.bottom, tree.nodes), (TOP, &all.top, tree.top)] {
            for node in list.nodes().iter().map(|&node| node as usize) {
                let words = [&self.nodes[first + node], &known[node]].map(bytemuck::bytes_of);
                assert!(words[0] == words[1], "node {node} from {first} on");
            }
        }
        assert_eq!(self.instances[..tree.instances.len()], *tree.instances);
        let words = TreeWords {
            root: tree.root,
            trail_words: tree.trail_words,
            live: tree.live,
            lights: tree.lights,
            depth: tree.depth,
            top: TOP as u32,
            above: ABOVE as u32,
            places: PLACES as u32,
            parts: PARTS as u32,
        };
        let own = words.tree::<N, M::Importance, W>(&self.nodes, &self.instances, &self.trails);
        for (k, (point, known)) in (0..).zip(points(16).into_iter().zip(sound_samples(bvh))) {
            assert_eq!(own.sample(&point, number(k)), known);
        }
        let point = points(1)[0];
        for (light, instance) in lights(bvh) {
            let pmfs = [own, tree].map(|tree| tree.pmf(&point, light, instance));
            assert_eq!(pmfs[0].to_bits(), pmfs[1].to_bits(), "{light} of {instance}");
            let found = refit::world_light(&self.lights, &self.instances, light, instance);
            assert_eq!(Some(found), bvh.view().light(light, instance));
        }
        // Names of no light.
        for (light, instance) in [(INVALID, 0), (0, INVALID - 1), (INVALID, INVALID)] {
            assert_eq!(
                (
                    own.pmf(&point, light, instance),
                    bvh.view().light(light, instance)
                ),
                (0.0, None)
            );
        }
    }
}

/// Two mirrors follow edits and swaps, one of them in each frame.
fn follows<M: Model<W> + Clone, const W: usize>(seed: u32)
where
    M::Importance: ImportanceModel<M::Node, W> + Clone,
    M::Light: Lamp,
{
    let random = &mut Random(seed);
    let mut bvh = Bvh::<M, W>::default();
    let rebuilder = || {
        Rebuilder::new(RebuilderParams {
            after: 2,
            swap: crate::bvh::Swap::Deterministic,
            ..RebuilderParams::default()
        })
    };
    let mut own = rebuilder();
    let [mut often, mut seldom] = [0; 2].map(|_| Mirror::<M::Node, W>::new());
    let (mut swapped, mut opened) = (0, 0);
    for frame in 0..120 {
        let start = own.begin_frame(&mut bvh).expect("no panic");
        swapped += start.meshes + u32::from(start.swapped);
        // Also idle frames, in which trees are swapped in.
        let count = if frame % 10 < 4 { 0 } else { random.below(10) };
        // A refused batch changes nothing.
        let _ = bvh.apply(edits(random, &bvh, count, 50));
        sound_samples(&bvh);
        bvh.refit();
        sound(&bvh);
        assert_eq!(bvh.top.count as usize, instances(&bvh).len());
        opened += bvh.top.opened.values().filter(|own| own.first != INVALID).count();
        if frame % 10 == 9 {
            bvh.rebuild();
        }
        own.end_frame(&bvh);
        often.follow(&bvh);
        often.check(&bvh);
        if random.below(5) == 0 || frame == 119 {
            seldom.follow(&bvh);
            seldom.check(&bvh);
        }
        if frame == 60 {
            // A clone is another BVH: no cursor is of it.
            (bvh, own) = (bvh.clone(), rebuilder());
        }
    }
    assert_eq!((often.wholes, seldom.wholes), (2, 2));
    assert!(swapped > 10 && opened > 100, "{swapped} {opened}");
    // More changes than the log holds.
    for _ in 0..400 {
        let moves = instances(&bvh).into_iter();
        let moves = moves.map(|id| moved(id, (random.vector() * 50.0).to_array()));
        bvh.apply(moves.collect()).expect("there");
        bvh.refit();
    }
    often.follow(&bvh);
    often.check(&bvh);
    assert_eq!(often.wholes, 3);
}

#[test]
fn mirrors_follow_by_plans_alone() {
    follows::<(CompactNode<2>, Eq4), 2>(3);
    follows::<(LinkedSpotMomentNode<8, AnyLight>, Defensive<Moments, 6>), 8>(4);
}

/// The log and the lists of changed lights are bounded.
#[test]
fn edits_without_a_refit_take_no_more_room_than_the_arrays() {
    let random = &mut Random(1);
    let (mut bvh, ids): (LightBvh, _) = scattered(lamps(random, 200), 1, |_| [0.0; 3]);
    let mesh = bvh.view().mesh_of(ids[0]).expect("a mesh");
    let mut mirror = Mirror::<_, 8>::new();
    mirror.follow(&bvh);
    for k in 0..5000_u16 {
        let of_mesh = Edit::SetLightRange {
            mesh,
            first: u32::from(k) % 200,
            lights: lamps(random, 1),
        };
        bvh.apply(std::vec![moved(ids[0], [f32::from(k); 3]), of_mesh])
            .expect("there");
        assert!(bvh.log.entries.len() <= LEAST + 2 * (1 + bvh.view().nodes().len()));
        assert!(bvh.dirty[&mesh.index()].len() <= 200);
    }
    bvh.refit();
    bvh.view().validate().expect("valid");
    mirror.follow(&bvh);
    mirror.check(&bvh);
}
