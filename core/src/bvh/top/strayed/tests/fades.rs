//! Meshes that fade to hardly any flux and back, among instances that move, blink, go and come.

use super::*;

/// Some instances go, and others come in their places, of their radiance.
struct Change {
    moved: Vec<(usize, [f32; 3])>,
    shone: Vec<(usize, f32)>,
    renewed: Vec<(usize, f32)>,
    /// Radiance of the triangles of the meshes that fade.
    faded: f32,
}

struct World {
    bvh: LightBvh,
    own: Own,
    meshes: Vec<MeshId>,
    others: Vec<InstanceId>,
    fading: Vec<InstanceId>,
}

impl World {
    /// The same light BVH, by another one that holds its words.
    fn of(&self, bvh: LightBvh) -> Self {
        let named = |ids: &[InstanceId]| {
            let own = |id: &InstanceId| bvh.instance_id(id.index()).expect("there");
            ids.iter().map(own).collect()
        };
        Self {
            own: rebuilder(),
            meshes: self
                .meshes
                .iter()
                .map(|mesh| bvh.mesh_id(mesh.index()).expect("there"))
                .collect(),
            others: named(&self.others),
            fading: named(&self.fading),
            bvh,
        }
    }

    fn step(&mut self, lights: &[EmissiveTriangle], at: &[[f32; 3]], change: &Change) {
        let mut edits: Vec<Edit> = Vec::new();
        for &mesh in &self.meshes {
            let mut triangles = lights.to_vec();
            triangles
                .iter_mut()
                .for_each(|own| own.radiance = [change.faded; 3]);
            edits.push(Edit::SetTriangles { mesh, triangles });
        }
        edits.extend(change.moved.iter().map(|&(k, at)| place(self.others[k], at)));
        edits.extend(
            change
                .shone
                .iter()
                .map(|&(k, radiance)| shine(self.fading[k], radiance)),
        );
        edits.extend(
            change
                .renewed
                .iter()
                .map(|&(k, _)| Edit::RemoveInstance(self.fading[k])),
        );
        edits.extend(change.renewed.iter().map(|&(k, radiance)| Edit::AddInstance {
            mesh: self.meshes[k % self.meshes.len()],
            transform: Transform::at(at[k]),
            radiance,
        }));
        self.own.begin_frame(&mut self.bvh).expect("no panic");
        let added = self.bvh.apply(edits).expect("sound").instances;
        self.bvh.refit();
        self.own.end_frame(&self.bvh);
        for (&(k, _), id) in change.renewed.iter().zip(added) {
            self.fading[k] = id;
        }
    }
}

/// Written in the middle, and read: both go on the same. Parts had what their records told of an instance that was gone, which
/// is in no file.
#[test]
fn what_fades_goes_on_from_a_file() {
    for (count, some, of, size, extent) in [(400, 150, 5, 8, 1.0), (300, 40, 3, 900, 8.0)] {
        let random = &mut Random(200 + size);
        let side = 30.0;
        let mut bvh = LightBvh::default();
        let lamp = bvh.add_mesh(cloud(1, [0.0; 3], 0)).expect("a lamp");
        let mut lights = cloud(size, [0.0; 3], 0);
        for own in &mut lights {
            let by = [0, 1, 2].map(|axis| own.p[0][axis] * (extent - 1.0));
            own.p = own.p.map(|p| [0, 1, 2].map(|axis| p[axis] + by[axis]));
        }
        let meshes: Vec<_> = (0..of)
            .map(|_| bvh.add_mesh(lights.clone()).expect("a mesh"))
            .collect();
        let others = put_in(&mut bvh, lamp, &batches::somewhere(count, side, random));
        let at = batches::somewhere(some, side, random);
        let fading = (0..some).map(|k| walker(&mut bvh, meshes[k % of], 1.0, at[k]));
        let fading = fading.collect();
        let mut world = World {
            bvh,
            own: rebuilder(),
            meshes,
            others,
            fading,
        };
        let pick =
            |random: &mut Random, count: usize| ((random.unit() * count as f32) as usize).min(count - 1);
        let mut change = |frame: i32| {
            let phase = (frame % 16 - 8).abs();
            let mut renewed: Vec<_> = (0..6)
                .map(|_| (pick(random, some), [0.0, 1e-17, 1.0][pick(random, 3)]))
                .collect();
            renewed.sort_by_key(|own| own.0);
            renewed.dedup_by_key(|own| own.0);
            let mut moved: Vec<_> = (0..60)
                .map(|k| {
                    (
                        (7 * frame as usize + 5 * k) % count,
                        (random.vector() * side).to_array(),
                    )
                })
                .collect();
            moved.sort_by_key(|own| own.0);
            moved.dedup_by_key(|own| own.0);
            Change {
                shone: (0..30)
                    .map(|_| (pick(random, some), [0.0, 1e-17, 1.0, 1e-12, 1e9][pick(random, 5)]))
                    .collect(),
                moved,
                renewed,
                faded: 10.0_f64.powi(-30 * (8 - phase) / 8) as f32,
            }
        };
        for frame in 0..24 {
            world.step(&lights, &at, &change(frame));
            let read = LightBvh::from_words(&world.bvh.to_words()).expect("its own");
            let mut twins = [world.of(world.bvh.clone()), world.of(read)];
            for later in 1..=4 {
                let change = change(frame + later);
                twins.iter_mut().for_each(|twin| twin.step(&lights, &at, &change));
                let [own, read] = &twins;
                assert!(
                    own.bvh.to_words() == read.bvh.to_words(),
                    "{size}: {frame}, {later}"
                );
            }
        }
    }
}
