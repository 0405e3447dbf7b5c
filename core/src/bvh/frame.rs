//! A frame: lights are added and changed, what changed is refitted, and lights are sampled.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;

use super::edit::{Edit, EditError, EditReason, InstanceId, MeshId};
use super::log::Log;
use super::ranges::Ranges;
use super::records::TreeId;
use super::refit::SWEPT;
use super::sampled::{Owner, Sampled};
use super::top::Top;
use super::{Added, Bvh, Outbox, View};
use crate::build::{BuildParams, Topology, build_each, build_over};
use crate::exact::{self, pow2};
use crate::light::Light;
use crate::lights::Lights;
use crate::model::{Model, ReceiverOf};
use crate::point::ShadingPoint;
use crate::random::Random64;
use crate::transform::Transform;
use crate::traverse::SampledLight;
use crate::tree::LightTree;
use crate::vector::{dot, vector};

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// A BVH without lights, whose trees will be built by `params`.
    #[must_use]
    pub fn new(params: BuildParams) -> Self {
        let mut scene = Self {
            id: TreeId::next(),
            params,
            nodes: Vec::new(),
            node_ranges: Ranges::default(),
            lights: Vec::new(),
            light_ranges: Ranges::default(),
            trails: Vec::new(),
            trail_words: 1,
            roots: Vec::new(),
            meshes: Vec::new(),
            mesh_ranges: Ranges::default(),
            placed: Vec::new(),
            placed_ranges: Ranges::default(),
            instances: Vec::new(),
            live: Vec::new(),
            numbers: Ranges::default(),
            top: Top::default(),
            stale: Vec::new(),
            dirty: BTreeMap::new(),
            reshaped: BTreeSet::new(),
            unapplied: Vec::new(),
            outbox: Outbox::default(),
            log: Log::default(),
            removed_lights: Vec::new(),
            waiting_lights: 0,
            forgotten: false,
            light_count: 0,
            bottom_depth: 0,
            single: false,
            model: PhantomData,
        };
        scene.top.build(&scene.params);
        scene
    }

    /// One tree over all lights: the paper's baseline. Light `k` is part `k`; the only edits are [`Edit::SetLights`]
    /// and [`Edit::SetLightRange`].
    #[must_use]
    pub fn single_level(lights: &Lights<M::Light>, params: &BuildParams) -> Self {
        let all = Some(0..lights.all().len()).filter(|all| !all.is_empty());
        let mut bvh = Self::new(*params);
        bvh.single = true;
        bvh.over(lights.all(), all.into_iter());
        bvh
    }

    /// A bottom level (BLAS) over the lights of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2), each an instance that stays where it is. Light `k` is part `k`, instance `i` is mesh light `i`.
    #[must_use]
    pub fn two_level(lights: &Lights<M::Light>, params: &BuildParams) -> Self {
        let meshes = (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh));
        let mut bvh = Self::new(*params);
        bvh.over(lights.all(), meshes);
        bvh
    }

    /// Puts a light by itself into the world: an instance, with a transform, a colour and a mask.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn add_light(&mut self, light: impl Into<M::Light>) -> Result<InstanceId, EditReason> {
        let light = light.into();
        let mask = u32::MAX;
        Ok(self.one(Edit::AddLight { light, mask })?.instances[0])
    }

    /// Makes a light by itself another one, of any kind and in any place.
    ///
    /// # Errors
    /// [`EditReason`], [`EditReason::NoLight`] for an instance of a mesh; nothing is changed then.
    pub fn set_light(&mut self, instance: InstanceId, light: impl Into<M::Light>) -> Result<(), EditReason> {
        let light = light.into();
        self.one(Edit::SetLight { instance, light }).map(|_| ())
    }

    /// Adds a mesh of at least one light, in its own space; it lights nothing before an instance puts it into the world.
    /// [`Edit`] changes and removes it.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn add_mesh(&mut self, lights: Vec<M::Light>) -> Result<MeshId, EditReason> {
        Ok(self.one(Edit::AddMesh { lights })?.meshes[0])
    }

    /// Puts a mesh into the world.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn add_instance(&mut self, mesh: MeshId, transform: Transform) -> Result<InstanceId, EditReason> {
        let added = self.one(Edit::AddInstance {
            mesh,
            transform,
            radiance: [1.0; 3],
            mask: u32::MAX,
        })?;
        Ok(added.instances[0])
    }

    /// Moves an instance, anywhere: it keeps its id and its lights' numbers. One that goes away from those around it is put in
    /// elsewhere in the top level.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_transform(&mut self, instance: InstanceId, transform: Transform) -> Result<(), EditReason> {
        self.one(Edit::SetTransform { instance, transform }).map(|_| ())
    }

    /// Makes an instance brighter, dimmer, or of another colour: `radiance` is a factor on its mesh's, linear RGB, each 0 or from 2^-60 to
    /// 2^60. Zeros turn it off; uniform choice may still return its lights, which then have no radiance. Weights go by its luminance, as if the
    /// mesh were white.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_radiance(&mut self, instance: InstanceId, radiance: [f32; 3]) -> Result<(), EditReason> {
        self.one(Edit::SetRadiance { instance, radiance }).map(|_| ())
    }

    /// Makes an instance light the receivers whose mask has a bit of `mask`, and no others, where nodes store masks: see
    /// [`Linked`](crate::importance::Linked); from the next [`refit`](Self::refit) on. Costs what moving it costs.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_mask(&mut self, instance: InstanceId, mask: u32) -> Result<(), EditReason> {
        self.one(Edit::SetMask { instance, mask }).map(|_| ())
    }

    /// Takes an instance, or a light by itself, out of the world.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn remove(&mut self, instance: InstanceId) -> Result<(), EditReason> {
        self.one(Edit::RemoveInstance(instance)).map(|_| ())
    }

    /// Applies a batch of edits in their order, all or none. The next [`refit`](Self::refit) restores the quality of sampling.
    /// Until then probabilities are exact and no removed light is returned, but a sample may be none if a light was removed,
    /// and added lights have the uniform share alone.
    ///
    /// Time is in proportion to the edits, to the lights in them, and to the instances of each mesh that is deformed as a
    /// whole, reaches farther than before, or gets its first [surface](crate::light::Light::is_surface) or loses its
    /// last, as often as it is. A mesh is built within the call that adds it: 0.2 to 0.4 µs for each light. The top level
    /// is edited by the next refit (measured: `docs/dynamics.md`).
    ///
    /// # Errors
    /// [`EditError`] naming the first edit that cannot be done; the scene is as before then.
    pub fn apply(&mut self, mut edits: Vec<Edit<M::Light>>) -> Result<Added, EditError> {
        for (mesh, reach) in self.check(&mut edits)? {
            self.meshes[mesh.index as usize].reach = reach;
        }
        let new_meshes = edits.iter().filter_map(|edit| match edit {
            Edit::AddMesh { lights } => Some(&**lights),
            _ => None,
        });
        let mut topologies = build_each(&new_meshes.collect::<Vec<_>>(), &self.params).into_iter();
        let mut added = Added::default();
        for edit in edits {
            match edit {
                Edit::AddMesh { lights } => {
                    let mesh = topologies
                        .next()
                        .map(|topology| self.insert_mesh(&lights, &topology));
                    added.meshes.extend(mesh);
                }
                Edit::AddInstance {
                    mesh,
                    transform,
                    radiance,
                    mask,
                } => {
                    let id = self.insert_instance(mesh, transform, radiance, mask);
                    added.instances.push(id);
                }
                Edit::AddLight { light, mask } => {
                    // A mesh of one light has no tree.
                    let (nodes, trails, depth) = (Vec::new(), Vec::new(), 0);
                    let none = Topology { nodes, trails, depth };
                    let mesh = self.insert_mesh(&[light], &none);
                    self.meshes[mesh.index as usize].is_light = true;
                    let id = self.insert_instance(mesh, Transform::IDENTITY, [1.0; 3], mask);
                    added.instances.push(id);
                }
                Edit::SetLight { instance, light } => {
                    let mesh = self.placed[instance.index as usize].mesh;
                    self.write_lights(mesh, 0, &[light]);
                }
                // Skip edits that change nothing.
                Edit::SetTransform { instance, transform } => self.set_place(instance.index, transform),
                Edit::SetRadiance { instance, radiance } => {
                    let own = &mut self.placed[instance.index as usize].radiance;
                    if core::mem::replace(own, radiance).map(f32::to_bits) != radiance.map(f32::to_bits) {
                        self.place(instance.index);
                    }
                }
                Edit::SetMask { instance, mask } => {
                    let own = &mut self.placed[instance.index as usize].mask;
                    if core::mem::replace(own, mask) != mask {
                        self.place(instance.index);
                    }
                }
                Edit::SetLights { mesh, lights } => self.write_lights(mesh.index, 0, &lights),
                Edit::SetLightRange { mesh, first, lights } => self.write_lights(mesh.index, first, &lights),
                Edit::RemoveInstance(id) => self.take_instance(id.index),
                Edit::RemoveMesh(id) => self.take_mesh(id.index),
            }
        }
        self.bound_log();
        Ok(added)
    }

    /// Applies each edit of a batch that is sound, in their order. Returns for each edit what it added, or why it is refused.
    /// [`apply`](Self::apply) is all or none, and builds several meshes at a time.
    pub fn apply_each(&mut self, edits: Vec<Edit<M::Light>>) -> Vec<Result<Added, EditReason>> {
        edits.into_iter().map(|edit| self.one(edit)).collect()
    }

    /// Brings the trees in line with the edits since the last call, and touches no other node. Computes the nodes of meshes that
    /// changed. In the top level, removes and inserts leaves, inserts again those that moved far from their siblings, and computes
    /// all nodes above: in time in proportion to the changed instances times the depth, at most that of a whole build.
    pub fn refit(&mut self) {
        for (mesh, ranges) in core::mem::take(&mut self.dirty) {
            let changed: usize = ranges.iter().map(ExactSizeIterator::len).sum();
            let all = self.meshes[mesh as usize].lights.len();
            if changed == 0 || changed * SWEPT > all {
                self.sweep_mesh(mesh);
            } else {
                ranges.iter().for_each(|range| self.refit_paths(mesh, range));
                self.compute_root(mesh);
            }
        }
        self.refit_top();
    }

    /// Refits, then rebuilds the trees of meshes that changed since theirs was built, and the top level, within the call. A
    /// [`Rebuilder`](crate::Rebuilder) does so in the background. Takes the time of a build.
    pub fn rebuild(&mut self) {
        self.refit();
        for index in core::mem::take(&mut self.reshaped) {
            let mesh = &self.meshes[index as usize].lights;
            let own = &self.lights[mesh.start as usize..mesh.end as usize];
            let topology = build_over::<M::Node, W>(own, &self.params);
            self.place_tree(index, &topology);
            self.sweep_mesh(index);
        }
        self.refit();
        if !self.single {
            self.build_top();
        }
    }

    /// Chooses a light for a receiver by `number`, as [`sample`](Self::sample) does, and a point on it by `uv`, two numbers in [0, 1).
    ///
    /// ```
    /// # use lightbvh::{LightBvh, ShadingPoint};
    /// # let (bvh, point) = (LightBvh::default(), ShadingPoint { p: [0.0; 3], n: [0.0; 3] });
    /// if let Some(sampled) = bvh.sample_light(&point, 7_u32, [0.5, 0.25]) {
    ///     let arrives = sampled.irradiance.map(|e| e / sampled.pmf); // times the BRDF, if a shadow ray finds nothing
    /// }
    /// ```
    #[must_use]
    pub fn sample_light<P: ReceiverOf<M, W> + AsRef<ShadingPoint>>(
        &self,
        point: &P,
        number: impl Into<Random64>,
        uv: [f32; 2],
    ) -> Option<Sampled<M::Light>> {
        let mut at = *point.as_ref();
        let found = self.sample(point, number)?;
        let Owner {
            light,
            instance,
            part,
            ..
        } = self.owner(&found)?;
        let on = light.point_for(at.position(), uv);
        let seen = on.seen_from(at.position());
        let direction = seen.d * seen.per_distance;
        if P::IS_TWO_SIDED && dot(direction, at.normal()) < 0.0 {
            at.n = at.n.map(|x| -x);
        }
        Some(Sampled {
            light,
            instance,
            part,
            pmf: found.pmf,
            point: on,
            direction: [direction.x, direction.y, direction.z],
            distance: exact::sqrt(seen.squared) * pow2(seen.exponent),
            pdf: on.density_seen(at.position(), found.pmf),
            irradiance: on.irradiance(&at),
        })
    }

    /// Density over solid angle, 1/sr, with which [`sample_light`](Self::sample_light) finds the point `position`, metres, on light
    /// `part` of an instance, where a ray from the receiver has met it: for multiple importance sampling. 0 where the light does not emit to there. `None` where
    /// there is no such instance or part, and for an invalid receiver. Near the rim of a sphere it differs from that of the
    /// sample, for `position` has fewer digits than the angle.
    #[must_use]
    pub fn pdf_of_hit<P: ReceiverOf<M, W> + AsRef<ShadingPoint>>(
        &self,
        point: &P,
        instance: InstanceId,
        part: u32,
        position: [f32; 3],
    ) -> Option<f32> {
        let (at, pmf) = (point.as_ref(), self.pmf(point, instance, part)?);
        let number = self.view().lights_of(instance)?.start + part;
        let light = self.view().light(number, instance.index)?;
        let on = light.point_at(at.position(), vector(&position));
        Some(on.density_seen(at.position(), pmf))
    }

    /// Chooses a light for a receiver by `number`: for a [`ShadingPoint`], or for one of which the importance knows more; see
    /// [`LightTree::sample`]. `None` where no light that it may take has flux as of the last [`refit`](Self::refit), and for an
    /// invalid receiver: NaN, beyond 2^60 m, or with a normal that is not of length 1.
    #[must_use]
    pub fn sample<P: ReceiverOf<M, W>>(
        &self,
        point: &P,
        number: impl Into<Random64>,
    ) -> Option<SampledLight> {
        let sampled = point
            .is_within_reach()
            .then(|| point.choose(&self.tree(), number.into()))?;
        (sampled.light != SampledLight::INVALID).then_some(sampled)
    }

    /// Probability with which [`sample`](Self::sample) returns light `part` of an instance, to the bit the one that comes with the
    /// sample; [`LightTree::pmf`] takes a [`SampledLight`]'s numbers. `None` where there is no such instance or part, and for an
    /// invalid receiver.
    #[must_use]
    pub fn pmf<P: ReceiverOf<M, W>>(&self, point: &P, instance: InstanceId, part: u32) -> Option<f32> {
        let lights = self.view().lights_of(instance)?;
        let light = lights.start.checked_add(part)?;
        let is_known = lights.contains(&light) && point.is_within_reach();
        is_known.then(|| point.probability(&self.tree(), light, instance.index))
    }

    /// Whose light a sample is. `None` where there is no such light, as after its removal.
    #[must_use]
    pub fn owner(&self, sampled: &SampledLight) -> Option<Owner<M::Light>> {
        let index = if self.single { 0 } else { sampled.instance };
        let light = self.view().light(sampled.light, index)?;
        let placed = &self.placed[index as usize];
        Some(Owner {
            light,
            instance: self.id_of_instance(index),
            part: sampled.light - placed.numbers.start,
            mesh: self.id_of_mesh(placed.mesh),
        })
    }

    /// Takes the [numbers of lights that are no more](View::removed_lights) since they were taken last. From now on new lights
    /// may get them. Call it even if you keep no numbers: ranges not taken stay in memory and in
    /// files, 16 bytes for each removed instance, up to the limit that [`View::removed_lights`] names.
    pub fn take_removed_lights(&mut self) -> Vec<Range<u32>> {
        let removed = core::mem::take(&mut self.removed_lights);
        let given_back = usize::from(core::mem::take(&mut self.forgotten));
        for range in &removed[given_back..] {
            self.numbers.give(range.clone());
        }
        self.waiting_lights = 0;
        removed
    }

    /// The arrays as traversal takes them: many samples at a time, by numbers of lights, or by another importance.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, M::Node, M::Importance, W> {
        let mut tree = LightTree {
            nodes: &self.nodes,
            top: &self.top.nodes,
            first: 0,
            root: self.top.root,
            instances: &self.instances,
            trails: &self.trails,
            links: self.top.links(),
            trail_words: self.trail_words,
            live: self.live.len() as u32,
            lights: 0,
            depth: self.view().depth(),
            importance: PhantomData,
        };
        if self.single && !self.roots.is_empty() {
            tree.top = &self.nodes;
            tree.root = self.roots[0].node;
            tree.live = 0;
            tree.lights = self.numbers.end();
        }
        tree
    }

    /// All that can be read: arrays, ids, lights by number, sizes.
    #[must_use]
    pub fn view(&self) -> View<'_, M, W> {
        View(self)
    }

    /// Applies an edit by itself: there is no batch for an error to name a place in.
    fn one(&mut self, edit: Edit<M::Light>) -> Result<Added, EditReason> {
        self.apply(alloc::vec![edit]).map_err(|error| error.reason)
    }

    /// A mesh and an instance of it for each range of the lights.
    fn over(&mut self, lights: &[M::Light], meshes: impl Iterator<Item = Range<usize>>) {
        let meshes: Vec<_> = meshes.map(|range| &lights[range]).collect();
        let topologies = build_each(&meshes, &self.params);
        self.lights.reserve_exact(lights.len());
        self.trails.reserve_exact(lights.len());
        self.nodes.reserve_exact(
            topologies
                .iter()
                .map(|one| one.nodes.len() + one.nodes.len() / 8)
                .sum(),
        );
        for (lights, topology) in meshes.into_iter().zip(topologies) {
            let mesh = self.insert_mesh(lights, &topology);
            self.insert_instance(mesh, Transform::IDENTITY, [1.0; 3], u32::MAX);
        }
        self.refit();
    }
}
