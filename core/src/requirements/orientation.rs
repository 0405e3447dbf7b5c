//! Whether the normals of lights tell anything.

use alloc::vec::Vec;

use crate::exact::hash;
use crate::light::EmissiveTriangle;
use crate::moments::LightMoments;

/// What the normals of lights tell. Of several meshes, what tells most counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Orientation {
    /// No light has a mean normal: all shine from both sides, or have none that is known.
    Absent,
    /// Lights have normals, but in each mesh to each there is one of the same flux and the opposite normal: those of whole meshes
    /// cancel exactly, those within them do not.
    Cancelling,
    /// Some normals are left over.
    Present,
}

/// The normals of a mesh.
pub(super) struct Normals {
    pub one_sided: usize,
    pub two_sided: usize,
    pub needles: usize,
    pub unlit: usize,
    pub orientation: Orientation,
}

impl Normals {
    /// Of a mesh with these triangles; those without flux do not count.
    pub fn of(mesh: &[EmissiveTriangle]) -> Self {
        let (mut two_sided, mut needles, mut unlit) = (0, 0, 0);
        let mut directed: Vec<[u32; 4]> = Vec::new();
        for triangle in mesh {
            let moments = LightMoments::of_triangle(triangle);
            if moments.phi <= 0.0 {
                unlit += usize::from(!triangle.is_two_sided());
                continue;
            }
            // A zero of either sign has the same bits then.
            let m = moments.m.to_array().map(|x| x + 0.0);
            if triangle.is_two_sided() {
                two_sided += 1;
            } else if m == [0.0; 3] {
                needles += 1;
            } else {
                let [x, y, z] = m.map(f32::to_bits);
                directed.push([moments.phi.to_bits(), x, y, z]);
            }
        }
        Self {
            one_sided: directed.len(),
            two_sided,
            needles,
            unlit,
            orientation: if directed.is_empty() {
                Orientation::Absent
            } else if cancel(directed) {
                Orientation::Cancelling
            } else {
                Orientation::Present
            },
        }
    }
}

/// Whether flux and normals, as bits, are the same set when all normals are turned.
fn cancel(mut directed: Vec<[u32; 4]>) -> bool {
    let turn = |bits: u32| (0.0 - f32::from_bits(bits)).to_bits();
    // Sums of hashes do not depend on the order: they tell most sets apart without sorting them.
    let hashed = |[phi, x, y, z]: [u32; 4]| u64::from(hash(hash(hash(phi ^ hash(x)) ^ y) ^ z));
    let sums = directed
        .iter()
        .fold([0_u64; 2], |[sum, of_turned], &[phi, x, y, z]| {
            let other = [phi, turn(x), turn(y), turn(z)];
            [
                sum.wrapping_add(hashed([phi, x, y, z])),
                of_turned.wrapping_add(hashed(other)),
            ]
        });
    if sums[0] != sums[1] {
        return false;
    }
    let mut turned: Vec<[u32; 4]> = directed
        .iter()
        .map(|&[phi, x, y, z]| [phi, turn(x), turn(y), turn(z)])
        .collect();
    directed.sort_unstable();
    turned.sort_unstable();
    directed == turned
}
