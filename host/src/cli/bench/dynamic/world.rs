//! A scene of moving lamps, and the edits of its frames.

use lightbvh::{Edit, EmissiveTriangle, InstanceId, MeshId, Rebuilder, Transform};

use crate::backend::Bvh;
use crate::cli::measure::times::thread_us;
use crate::error::HostError;
use crate::stability::random::Random;

pub(super) type Point = [f32; 3];

const WITHIN: &str = "the scene is made within the domain";

/// Lamps that share a mesh.
pub(super) struct World {
    pub bvh: Bvh,
    mesh: MeshId,
    /// By number, in the order in which they were added; none where a lamp was removed.
    lamps: Vec<Option<InstanceId>>,
    /// Edits of the next frame.
    edits: Vec<Edit>,
}

/// Thread time of a frame, µs.
#[derive(Clone, Copy)]
pub(super) struct Times {
    pub frame: f64,
    /// Time of both calls of the rebuilder.
    pub begin_end: f64,
    /// Whether a top level was swapped in.
    pub has_swapped: bool,
}

impl World {
    pub fn new() -> Self {
        // A tenth of a metre wide, shining down.
        let lamp = EmissiveTriangle {
            p: [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1]],
            radiance: [9.0; 3],
            mesh: 0,
            flags: 0,
        };
        let mut bvh: Bvh = lightbvh::Bvh::default();
        let mesh = bvh.add_mesh(vec![lamp]).expect(WITHIN);
        Self {
            bvh,
            mesh,
            lamps: Vec::new(),
            edits: Vec::new(),
        }
    }

    pub fn add(&mut self, at: Point, radiance: f32) {
        self.lamps.push(None);
        self.edits.push(Edit::AddInstance {
            mesh: self.mesh,
            transform: Transform::at(at),
            radiance: [radiance; 3],
            mask: u32::MAX,
        });
    }

    pub fn remove(&mut self, lamp: usize) {
        if let Some(instance) = self.lamps[lamp].take() {
            self.edits.push(Edit::RemoveInstance(instance));
        }
    }

    pub fn place(&mut self, lamp: usize, at: Point) {
        let transform = Transform::at(at);
        let edit = |instance| Edit::SetTransform { instance, transform };
        self.edits.extend(self.lamps[lamp].map(edit));
    }

    /// A random lamp that was not removed.
    pub fn some(&self, random: &mut Random) -> usize {
        loop {
            let lamp = random.below(self.lamps.len() as u32) as usize;
            if self.lamps[lamp].is_some() {
                return lamp;
            }
        }
    }

    /// Number of lamps that were not removed.
    pub fn count(&self) -> usize {
        self.lamps.iter().flatten().count()
    }

    /// Applies the edits so far.
    fn edit(&mut self) {
        let edits = std::mem::take(&mut self.edits);
        let added = self.bvh.apply(edits).expect(WITHIN).instances;
        let new = self.lamps.len() - added.len();
        for (lamp, id) in self.lamps[new..].iter_mut().zip(added) {
            *lamp = Some(id);
        }
    }

    /// Applies the edits so far, and refits.
    pub fn start(&mut self) {
        self.edit();
        self.bvh.refit();
    }

    /// A frame with the edits so far. The current pool has one thread, so that this one does all the work.
    pub fn frame(&mut self, rebuilder: &mut Rebuilder) -> Result<Times, HostError> {
        let (begin, start) = thread_us(|| rebuilder.begin_frame(&mut self.bvh));
        let has_swapped = start?.swapped;
        let (edit, ()) = thread_us(|| self.edit());
        let (refit, ()) = thread_us(|| self.bvh.refit());
        let (end, ()) = thread_us(|| rebuilder.end_frame(&self.bvh));
        Ok(Times {
            frame: begin + edit + refit + end,
            begin_end: begin + end,
            has_swapped,
        })
    }

    /// The same lamps in a new light BVH.
    pub fn fresh(&self) -> Bvh {
        let mut new = Self::new();
        for id in self.lamps.iter().flatten() {
            let own = &self.bvh.view().instances()[id.index() as usize];
            new.add(own.translation, own.radiance[0]);
        }
        new.start();
        new.bvh
    }
}
