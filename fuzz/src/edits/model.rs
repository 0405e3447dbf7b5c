//! What a scene should hold.

use std::ops::Range;

use lightbvh::{Bvh, EmissiveTriangle, InstanceId, LightNode, MeshId, Transform};

/// What a scene should hold.
#[derive(Clone, Default)]
pub struct Model {
    pub meshes: Vec<Mesh>,
    pub instances: Vec<Placed>,
    pub gone_meshes: Vec<MeshId>,
    pub gone_instances: Vec<InstanceId>,
}

/// Triangles in the mesh's own space.
#[derive(Clone)]
pub struct Mesh {
    pub id: MeshId,
    pub triangles: Vec<EmissiveTriangle>,
    /// The greatest coordinate since all triangles were set.
    pub reach: f64,
}

/// A mesh in the world.
#[derive(Clone)]
pub struct Placed {
    pub id: InstanceId,
    pub mesh: MeshId,
    pub transform: Transform,
    pub radiance: [f32; 3],
    pub lights: Range<u32>,
}

/// 2^40.
const MOST: f64 = 1_099_511_627_776.0;

impl Model {
    pub fn triangles(&self, id: MeshId) -> &[EmissiveTriangle] {
        let mesh = self.meshes.iter().find(|mesh| mesh.id == id);
        &mesh.expect("an instance's mesh stays").triangles
    }

    pub fn reach(&self, id: MeshId) -> f64 {
        let mesh = self.meshes.iter().find(|mesh| mesh.id == id);
        mesh.expect("an instance's mesh stays").reach
    }

    /// The scene's lights against the exact maps in `f64`.
    pub fn check_lights<N: LightNode<W>, const W: usize>(&self, scene: &Bvh<(N, ()), W>) {
        let world = scene.view().world_lights();
        for placed in &self.instances {
            let lights = scene.view().lights_of(placed.id).expect("it lives");
            assert_eq!(lights, placed.lights, "numbers stay");
            let local = self.triangles(placed.mesh);
            assert_eq!(lights.len(), local.len());
            for (light, local) in lights.zip(local) {
                let found = scene.view().light(light, placed.id.index()).expect("one of its lights");
                assert_eq!(bytes(&found), bytes(&world[light as usize]));
                assert_eq!(found.mesh, placed.id.index());
                assert_eq!(found.flags, local.flags);
                check_vertices(&placed.transform, local, &found);
                check_radiance(local.radiance, placed.radiance, found.radiance);
            }
        }
    }
}

fn bytes(triangle: &EmissiveTriangle) -> &[u8] {
    bytemuck::bytes_of(triangle)
}

/// Entries of maps and coordinates in a mesh's space below this count as zero: 2^-60.
const TINY: f64 = 1.0 / 1_152_921_504_606_846_976.0;

/// The vertices under the map, two of them exchanged where it mirrors; off by no more than rounding.
fn check_vertices(map: &Transform, local: &EmissiveTriangle, found: &EmissiveTriangle) {
    let [x, y, z] = map.columns.map(|column| column.map(f64::from));
    let determinant = x[0] * (y[1] * z[2] - y[2] * z[1]) - y[0] * (x[1] * z[2] - x[2] * z[1])
        + z[0] * (x[1] * y[2] - x[2] * y[1]);
    let [a, b, c] = local.p;
    let near = |order: [[f32; 3]; 3]| {
        order.iter().zip(&found.p).all(|(p, found)| {
            let terms: [[f64; 4]; 3] = std::array::from_fn(|row| {
                let across: [f64; 3] =
                    std::array::from_fn(|k| f64::from(map.columns[k][row]) * f64::from(p[k]));
                [across[0], across[1], across[2], f64::from(map.translation[row])]
            });
            let size: f64 = terms.iter().flatten().map(|term| term.abs()).sum();
            // Four roundings of 2^-24 of all terms; what counts as zero of an entry or a coordinate, times the other of the
            // two; and the result's own zero.
            let entries: f64 = map.columns.iter().flatten().map(|x| f64::from(x.abs())).sum();
            let along: f64 = p.iter().map(|x| f64::from(x.abs())).sum();
            let tolerance = size * 2f64.powi(-22) + TINY * (entries + along) + 2f64.powi(-98);
            terms
                .iter()
                .zip(found)
                .all(|(terms, &found)| (terms.iter().sum::<f64>() - f64::from(found)).abs() <= tolerance)
        })
    };
    let lengths = [x, y, z].map(|c| c.iter().map(|x| x * x).sum::<f64>().sqrt());
    // Of a map as flat as that nobody can tell whether it mirrors.
    let unclear = determinant.abs() <= 1e-12 * lengths.iter().product::<f64>();
    let (straight, mirrored) = (near([a, b, c]), near([a, c, b]));
    let expected = if determinant < 0.0 { mirrored } else { straight };
    assert!(
        expected || unclear && (straight || mirrored),
        "{local:?} under {map:?} is {found:?}"
    );
    assert!(
        found
            .p
            .iter()
            .flatten()
            .all(|x| f64::from(x.abs()) <= MOST * 1.000_001),
        "{found:?}"
    );
}

fn check_radiance(local: [f32; 3], factor: [f32; 3], found: [f32; 3]) {
    let (least, most) = (2f32.powi(-100), 2f32.powi(100));
    for ((local, factor), found) in local.into_iter().zip(factor).zip(found) {
        let exact = f64::from(local) * f64::from(factor);
        let expected = if exact == 0.0 {
            0.0
        } else {
            exact.clamp(least.into(), most.into())
        };
        // A light without area, or turned off, is dark.
        let same = (f64::from(found) - expected).abs() <= expected * 2f64.powi(-23);
        assert!(same || found == 0.0, "{local:e} times {factor:e} is {found:e}");
    }
}

/// The greatest magnitude of a coordinate.
pub fn reach(triangles: &[EmissiveTriangle]) -> f64 {
    let coordinates = triangles.iter().flat_map(|triangle| triangle.p).flatten();
    coordinates.fold(0.0, |most: f64, x| most.max(f64::from(x.abs())))
}

/// Whether a mesh of this reach stays in the domain under a map; `None` where rounding decides.
pub fn within(map: &Transform, reach: f64) -> Option<bool> {
    let entries = map.columns.iter().flatten().chain(&map.translation);
    if !entries.clone().all(|x| f64::from(x.abs()) <= MOST) {
        return Some(false);
    }
    let farthest = (0..3).map(|row| {
        let across: f64 = map
            .columns
            .iter()
            .map(|column| f64::from(column[row].abs()))
            .sum();
        across * reach + f64::from(map.translation[row].abs())
    });
    let farthest = farthest.fold(0.0, f64::max);
    let unclear = (farthest / MOST - 1.0).abs() < 1e-9;
    (!unclear).then_some(farthest <= MOST)
}
