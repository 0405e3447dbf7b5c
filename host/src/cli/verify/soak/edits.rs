//! A world that changes at random, about as large all the time.

use lightbvh::bvh::{Added, InstanceId, MeshId};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, Transform};

use super::report::Counts;
use crate::backend::Bvh;

/// Meshes at a time.
const MESHES: usize = 40;
/// Side of the box that all lies in, metres; and how far a near move goes.
const SIDE: f32 = 100.0;
const NEAR: f32 = 0.5;

/// A mesh, and what its triangles were at first.
struct Mesh {
    id: MeshId,
    triangles: Vec<EmissiveTriangle>,
}

/// An instance, as it should be.
struct Placed {
    id: InstanceId,
    mesh: MeshId,
    transform: Transform,
}

/// The scene and what it should hold.
pub(super) struct World {
    pub bvh: Bvh,
    meshes: Vec<Mesh>,
    instances: Vec<Placed>,
    /// Instances and meshes of the last edits, in their order, whose ids are not known yet.
    new_instances: Vec<(MeshId, Transform)>,
    new_mesh: Option<Vec<EmissiveTriangle>>,
    count: usize,
    largest: u32,
    random: u32,
}

impl World {
    /// About `count` instances of meshes of up to `largest` triangles.
    pub fn new(seed: u32, count: u32, largest: u32) -> Self {
        let mut world = Self {
            bvh: lightbvh::Bvh::default(),
            meshes: Vec::new(),
            instances: Vec::new(),
            new_instances: Vec::new(),
            new_mesh: None,
            count: count as usize,
            largest,
            random: hash(seed ^ 0x50a4),
        };
        for number in 0..MESHES {
            // The largest is there from the first.
            let size = if number == 0 { largest } else { world.size() };
            let triangles = world.mesh(size);
            let id = world.bvh.add_mesh(triangles.clone()).expect("within the domain");
            world.meshes.push(Mesh { id, triangles });
        }
        let mut edits = Vec::new();
        world.add(count, &mut edits);
        let added = world.bvh.apply(edits).expect("within the domain");
        world.take(&added);
        world.bvh.refit();
        world
    }

    fn draw(&mut self) -> u32 {
        self.random = self.random.wrapping_add(1);
        hash(self.random)
    }

    fn below(&mut self, count: usize) -> usize {
        ((u64::from(self.draw()) * count as u64) >> 32) as usize
    }

    fn unit(&mut self) -> f32 {
        unit_f32(self.draw())
    }

    /// Of a mesh: each size half as likely as half of it.
    fn size(&mut self) -> u32 {
        let most = self.largest.ilog2();
        let most = 1 << self.below(most as usize + 1);
        (1 + self.below(most) as u32).min(self.largest)
    }

    fn mesh(&mut self, count: u32) -> Vec<EmissiveTriangle> {
        let size = 0.2 * (count as f32).cbrt();
        let one = |world: &mut Self| {
            let corner: [f32; 3] = std::array::from_fn(|_| size * (world.unit() - 0.5));
            let mut p = [corner; 3];
            for (axis, vertex) in p.iter_mut().enumerate() {
                vertex[axis] += 0.05 + 0.1 * world.unit();
            }
            EmissiveTriangle {
                p,
                radiance: [0.1 + world.unit(); 3],
                mesh: 0,
                flags: 0,
            }
        };
        (0..count).map(|_| one(self)).collect()
    }

    fn anywhere(&mut self) -> Transform {
        let place = std::array::from_fn(|_| SIDE * self.unit());
        self.turned(place)
    }

    fn turned(&mut self, place: [f32; 3]) -> Transform {
        let (s, c) = libm::sincosf(std::f32::consts::TAU * self.unit());
        Transform {
            columns: [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
            translation: place,
        }
    }

    /// How many of `all` a batch has: most often one, seldom many.
    fn few(&mut self, all: usize) -> usize {
        let most = match self.below(64) {
            0 => all / 4,
            1..4 => all / 64,
            4..16 => 8,
            _ => 1,
        };
        (1 + self.below(most.max(1))).min(all)
    }

    /// The edits of a frame; [`take`](Self::take) gets what they add.
    pub fn edits(&mut self, counts: &mut Counts) -> Vec<Edit> {
        let mut edits = Vec::new();
        for _ in 0..1 + self.below(3) {
            match self.below(16) {
                // Nothing happens in some frames.
                0 => {}
                1..4 => {
                    let count = self.few(self.count);
                    // The more there are, the fewer come.
                    let room = (self.count + self.count / 10).saturating_sub(self.instances.len());
                    let count = count.min(room) as u32;
                    self.add(count, &mut edits);
                    counts.added += count;
                }
                4..7 => {
                    let least = self.count - self.count / 10;
                    let spare = self.instances.len().saturating_sub(least);
                    let count = self.few(self.count).min(spare);
                    self.remove(count, &mut edits);
                    counts.removed += count as u32;
                }
                7..13 => {
                    let count = self.few(self.instances.len());
                    let is_far = self.below(4) == 0;
                    self.go(count, is_far, &mut edits);
                    counts.moved += count as u32;
                }
                13 => {
                    let count = self.few(self.instances.len());
                    for _ in 0..count {
                        let at = self.below(self.instances.len());
                        let radiance = if self.below(8) == 0 {
                            0.0
                        } else {
                            0.1 + self.unit()
                        };
                        let instance = self.instances[at].id;
                        edits.push(Edit::SetRadiance { instance, radiance });
                    }
                    counts.dimmed += count as u32;
                }
                14 => self.deform(&mut edits, counts),
                _ => self.exchange(&mut edits, counts),
            }
        }
        edits
    }

    /// Notes what the last edits made.
    pub fn take(&mut self, added: &Added) {
        let meshes = added.meshes.iter().zip(self.new_mesh.take());
        self.meshes
            .extend(meshes.map(|(&id, triangles)| Mesh { id, triangles }));
        let new = std::mem::take(&mut self.new_instances).into_iter();
        for (&id, (mesh, transform)) in added.instances.iter().zip(new) {
            self.instances.push(Placed { id, mesh, transform });
        }
    }

    fn add(&mut self, count: u32, edits: &mut Vec<Edit>) {
        for _ in 0..count {
            let at = self.below(self.meshes.len());
            let (mesh, transform) = (self.meshes[at].id, self.anywhere());
            self.new_instances.push((mesh, transform));
            edits.push(Edit::AddInstance {
                mesh,
                transform,
                radiance: 1.0,
            });
        }
    }

    fn remove(&mut self, count: usize, edits: &mut Vec<Edit>) {
        for _ in 0..count {
            let at = self.below(self.instances.len());
            edits.push(Edit::RemoveInstance(self.instances.swap_remove(at).id));
        }
    }

    fn go(&mut self, count: usize, is_far: bool, edits: &mut Vec<Edit>) {
        for _ in 0..count {
            let at = self.below(self.instances.len());
            let transform = if is_far {
                self.anywhere()
            } else {
                let old = self.instances[at].transform.translation;
                let place = old.map(|x| (x + NEAR * (self.unit() - 0.5)).clamp(0.0, SIDE));
                self.turned(place)
            };
            let own = &mut self.instances[at];
            own.transform = transform;
            edits.push(Edit::SetTransform {
                instance: own.id,
                transform,
            });
        }
    }

    /// A mesh jitters, or is scrambled, as a whole or in a range of its triangles.
    fn deform(&mut self, edits: &mut Vec<Edit>, counts: &mut Counts) {
        let at = self.below(self.meshes.len());
        let count = self.meshes[at].triangles.len();
        let step = if self.below(4) == 0 { 2.0 } else { 0.05 };
        let is_whole = self.below(2) == 0;
        let range = if is_whole {
            0..count
        } else {
            let first = self.below(count);
            first..count.min(first + 1 + self.below(32))
        };
        let mut triangles = self.meshes[at].triangles[range.clone()].to_vec();
        for triangle in &mut triangles {
            let by: [f32; 3] = std::array::from_fn(|_| step * (self.unit() - 0.5));
            triangle.p = triangle.p.map(|p| std::array::from_fn(|k| p[k] + by[k]));
        }
        counts.deformed += 1;
        let (mesh, first) = (self.meshes[at].id, range.start as u32);
        edits.push(if is_whole {
            Edit::SetTriangles { mesh, triangles }
        } else {
            Edit::SetTriangleRange {
                mesh,
                first,
                triangles,
            }
        });
    }

    /// A mesh is removed with all its instances; another is added, with as many.
    fn exchange(&mut self, edits: &mut Vec<Edit>, counts: &mut Counts) {
        if self.new_mesh.is_some() {
            return;
        }
        // Only such as no edit of this batch has placed anew.
        let at = self.below(self.meshes.len());
        let id = self.meshes[at].id;
        if self.new_instances.iter().any(|&(mesh, _)| mesh == id) {
            return;
        }
        let mut users = 0;
        self.instances.retain(|placed| {
            let stays = placed.mesh != id;
            if !stays {
                edits.push(Edit::RemoveInstance(placed.id));
                users += 1;
            }
            stays
        });
        self.meshes.swap_remove(at);
        edits.push(Edit::RemoveMesh(id));
        let size = self.size();
        let triangles = self.mesh(size);
        edits.push(Edit::AddMesh {
            triangles: triangles.clone(),
        });
        self.new_mesh = Some(triangles);
        counts.exchanged += 1;
        self.add(users, edits);
    }

    /// That the scene holds what it should.
    pub fn check(&self) -> Result<(), String> {
        let mut lights = 0;
        for placed in &self.instances {
            let Some(own) = self.bvh.lights_of(placed.id) else {
                return Err(format!("instance {} is gone", placed.id.index()));
            };
            let mesh = self.bvh.mesh_triangles(placed.mesh).map_or(0, <[_]>::len);
            if mesh != own.len() {
                return Err(format!(
                    "instance {} has {} lights of {mesh}",
                    placed.id.index(),
                    own.len()
                ));
            }
            lights += mesh;
        }
        if lights == self.bvh.light_count() {
            Ok(())
        } else {
            Err(format!("{} lights, expected {lights}", self.bvh.light_count()))
        }
    }

    /// Instances and lights.
    pub fn size_now(&self) -> (usize, usize) {
        (self.instances.len(), self.bvh.light_count())
    }
}
