//! The glTF loader.

mod document;

use arbitrary::{Result, Unstructured};
use lightbvh::Lights;
use lightbvh_scenes::{Frame, Scene};

use self::document::Document;
use crate::Forms;

/// A glTF file, of any bytes or a sound document with wrong values, in JSON or in a container, damaged or not: refused, or
/// a scene whose first frame holds numbers in the domain and whose own file gives the same frames.
pub fn gltf(data: &[u8], forms: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let kind: u8 = u.arbitrary()?;
        let bytes = match kind % 8 {
            0 => u.bytes(u.len())?.to_vec(),
            1..=4 => Document::new(u)?.glb(),
            5 | 6 => Document::new(u)?.json(),
            _ => {
                let places: [(u16, u8); 3] = u.arbitrary()?;
                let mut bytes = Document::new(u)?.glb();
                for (place, byte) in places {
                    let place = usize::from(place) % bytes.len();
                    bytes[place] = byte;
                }
                bytes
            }
        };
        open(&bytes, forms == Forms::All || kind & 0xe0 == 0);
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

/// The document that `data` describes, as a container: for tests that what the target tries is what the loader reads.
pub fn gltf_document(data: &[u8]) -> Vec<u8> {
    Document::new(&mut Unstructured::new(data)).map_or_else(|_| Vec::new(), Document::glb)
}

fn open(bytes: &[u8], written: bool) {
    let scene = match Scene::read_gltf_slice("fuzz", bytes, None) {
        Ok(scene) => scene,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let frames = [0, 11].map(|frame| scene.frame(frame));
    within_domain(&frames[0]);
    if written {
        let bytes = scene.to_glb().expect("a small scene");
        let again = Scene::read_gltf_slice("fuzz", &bytes, None).unwrap_or_else(|error| panic!("{error}"));
        // A spline may leave the domain later, up to NaN.
        let words = |frames: &[Frame; 2]| format!("{frames:?}");
        assert_eq!(words(&frames), words(&[0, 11].map(|frame| again.frame(frame))));
    }
}

/// The numbers of a frame are in the domain of lights.
pub(crate) fn within_domain(frame: &Frame) {
    let finite = |triangle: &[[f32; 3]; 3]| triangle.as_flattened().iter().all(|x| x.is_finite());
    assert!(frame.triangles.iter().all(|triangle| finite(&triangle.p)));
    let (count, meshes) = (frame.emissive.len(), frame.mesh_lights.len());
    if count > 0 {
        let lights = Lights::new(frame.emissive.clone()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(lights.mesh_count(), meshes);
        for (mesh, range) in frame.mesh_lights.iter().enumerate() {
            assert_eq!(
                lights.mesh(mesh),
                range.first as usize..(range.first + range.count) as usize
            );
        }
    }
}
