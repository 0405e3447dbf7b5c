//! The model of a batch: each edit done to it, or why it may be refused.

use super::*;

impl Staged {
    fn lives(&self, id: MeshId) -> bool {
        self.model.meshes.iter().any(|mesh| mesh.id == id)
    }

    fn placed(&mut self, id: InstanceId) -> Option<&mut Placed> {
        self.model.instances.iter_mut().find(|placed| placed.id == id)
    }

    pub fn add_mesh(&mut self, triangles: Vec<EmissiveTriangle>) -> (Edit, Verdict) {
        let (sound, all) = accepted(&triangles);
        let verdict = first_wrong(&[(Some(!triangles.is_empty()), "EmptyMesh"), (sound, "Light")]);
        self.meshes.push(all);
        (Edit::AddMesh { lights: triangles }, verdict)
    }

    pub fn add_instance(
        &mut self,
        mesh: MeshId,
        transform: Transform,
        radiance: [f32; 3],
    ) -> (Edit, Verdict) {
        let lives = self.lives(mesh);
        let inside = if lives {
            within(&transform, self.model.reach(mesh))
        } else {
            None
        };
        let verdict = first_wrong(&[
            (Some(lives), "UnknownMesh"),
            (inside, "Transform"),
            (shines(radiance), "Radiance"),
        ]);
        self.added.push((mesh, transform, radiance));
        let edit = Edit::AddInstance {
            mesh,
            transform,
            radiance,
            mask: u32::MAX,
        };
        (edit, verdict)
    }

    pub fn move_to(&mut self, instance: InstanceId, transform: Transform) -> (Edit, Verdict) {
        let mesh = self.placed(instance).map(|placed| placed.mesh);
        let inside = mesh.and_then(|mesh| within(&transform, self.model.reach(mesh)));
        let verdict = first_wrong(&[(Some(mesh.is_some()), "UnknownInstance"), (inside, "Transform")]);
        if let Some(placed) = self.placed(instance) {
            placed.transform = transform;
        }
        (Edit::SetTransform { instance, transform }, verdict)
    }

    pub fn shine(&mut self, instance: InstanceId, radiance: [f32; 3]) -> (Edit, Verdict) {
        let placed = self.placed(instance);
        let verdict = first_wrong(&[
            (Some(placed.is_some()), "UnknownInstance"),
            (shines(radiance), "Radiance"),
        ]);
        if let Some(placed) = placed {
            placed.radiance = radiance;
        }
        (Edit::SetRadiance { instance, radiance }, verdict)
    }

    pub fn deform(&mut self, id: MeshId, triangles: Vec<EmissiveTriangle>) -> (Edit, Verdict) {
        let (sound, all) = accepted(&triangles);
        let old = self.model.meshes.iter().find(|mesh| mesh.id == id);
        let same = old.is_some_and(|mesh| mesh.triangles.len() == triangles.len());
        let mut conditions = vec![
            (Some(old.is_some()), "UnknownMesh"),
            (Some(same), "Count"),
            (sound, "Light"),
        ];
        let reach = reach(&all);
        self.push_places(id, reach, &mut conditions);
        if let Some(mesh) = self.model.meshes.iter_mut().find(|mesh| mesh.id == id) {
            mesh.triangles = all;
            mesh.reach = reach;
        }
        (
            Edit::SetLights {
                mesh: id,
                lights: triangles,
            },
            first_wrong(&conditions),
        )
    }

    pub fn deform_some(
        &mut self,
        id: MeshId,
        first: u32,
        triangles: Vec<EmissiveTriangle>,
    ) -> (Edit, Verdict) {
        let (sound, some) = accepted(&triangles);
        let old = self.model.meshes.iter_mut().find(|mesh| mesh.id == id);
        let end = first as usize + triangles.len();
        let inside = old.as_ref().is_some_and(|mesh| end <= mesh.triangles.len());
        let mut conditions = vec![
            (Some(old.is_some()), "UnknownMesh"),
            (Some(inside), "Range"),
            (sound, "Light"),
        ];
        if let Some(mesh) = old.filter(|_| inside && sound == Some(true)) {
            mesh.triangles[first as usize..end].copy_from_slice(&some);
            let is_whole = some.len() == mesh.triangles.len();
            let before = if is_whole { 0.0 } else { mesh.reach };
            mesh.reach = reach(&some).max(before);
            let reach = mesh.reach;
            self.push_places(id, reach, &mut conditions);
        }
        let edit = Edit::SetLightRange {
            mesh: id,
            first,
            lights: triangles,
        };
        (edit, first_wrong(&conditions))
    }

    /// All places of a mesh must have room for it, those of this very batch too.
    fn push_places(&self, id: MeshId, reach: f64, conditions: &mut Vec<(Option<bool>, &'static str)>) {
        let placed = self
            .model
            .instances
            .iter()
            .map(|placed| (placed.mesh, placed.transform));
        let added = self.added.iter().map(|&(mesh, transform, _)| (mesh, transform));
        for (_, transform) in placed.chain(added).filter(|&(mesh, _)| mesh == id) {
            conditions.push((within(&transform, reach), "Transform"));
        }
    }

    pub fn remove_instance(&mut self, id: InstanceId) -> (Edit, Verdict) {
        let lives = self.placed(id).is_some();
        self.model.instances.retain(|placed| placed.id != id);
        if lives {
            self.model.gone_instances.push(id);
        }
        (
            Edit::RemoveInstance(id),
            first_wrong(&[(Some(lives), "UnknownInstance")]),
        )
    }

    pub fn remove_mesh(&mut self, id: MeshId) -> (Edit, Verdict) {
        let lives = self.lives(id);
        let used = self.model.instances.iter().any(|placed| placed.mesh == id)
            || self.added.iter().any(|&(mesh, ..)| mesh == id);
        let verdict = first_wrong(&[(Some(lives), "UnknownMesh"), (Some(!used), "InUse")]);
        if lives && !used {
            self.model.meshes.retain(|mesh| mesh.id != id);
            self.model.gone_meshes.push(id);
        }
        (Edit::RemoveMesh(id), verdict)
    }

    /// The model, once the scene has given the new ones their ids.
    pub fn done<N: LightNode<W>, const W: usize>(self, updated: &Added, scene: &Bvh<(N, ()), W>) -> Model {
        let mut model = self.model;
        assert_eq!(updated.meshes.len(), self.meshes.len());
        assert_eq!(updated.instances.len(), self.added.len());
        for (&id, triangles) in updated.meshes.iter().zip(self.meshes) {
            let new = model.meshes.iter().all(|mesh| mesh.id != id) && !model.gone_meshes.contains(&id);
            assert!(new, "an id never means another one");
            let reach = reach(&triangles);
            model.meshes.push(Mesh { id, triangles, reach });
        }
        for (&id, (mesh, transform, radiance)) in updated.instances.iter().zip(self.added) {
            let new =
                model.instances.iter().all(|placed| placed.id != id) && !model.gone_instances.contains(&id);
            assert!(new, "an id never means another one");
            model.instances.push(Placed {
                id,
                mesh,
                transform,
                radiance,
                lights: scene.view().lights_of(id).expect("just added"),
            });
        }
        model
    }
}
