//! The loader of OBJ.

use arbitrary::{Result, Unstructured};
use lightbvh_scenes::{Scene, SceneError};

use crate::Forms;
use crate::gltf::within_domain;

/// What OBJ files are made of, with bars between.
const OBJ: &str = "v|vn|vt|f|f|f|o|g|usemtl|mtllib|l|p|s|\n|\n|\n|\\\n|\
    #|a|b|1/1/1|2//2|3/3|1/2/3|-1|-2|-3//-1|1|2|3";

/// Numbers, of which some are at the edge of what is taken, and none.
const NUMBERS: &str = "0 1 -1 2 0.5 3 4 8 -0 1e-3 90 180 360 1e10 1e20 1e30 1e38 3.5e38 -1e30 1e-30 1e-45 1e300 nan \
    inf 1048577 4294967296 18446744073709551616 0x10 1.5.2 ";

/// An OBJ file, of any bytes or of words that such files are made of: refused, or a scene whose frames hold numbers in the
/// domain.
pub fn texts(data: &[u8], _: Forms) {
    let run = |u: &mut Unstructured<'_>| -> Result<()> {
        let kind: u8 = u.arbitrary()?;
        let bytes = match kind % 8 {
            0 => u.bytes(u.len())?.to_vec(),
            _ => text(u)?.into_bytes(),
        };
        open(Scene::read_obj_slice("fuzz.obj", &bytes, None));
        Ok(())
    };
    let _ = run(&mut Unstructured::new(data));
}

/// Words and numbers until the input ends: a quarter of them numbers, and now and then several in a row, as points come.
fn text(u: &mut Unstructured<'_>) -> Result<String> {
    let words: Vec<&str> = OBJ.split('|').collect();
    let numbers: Vec<&str> = NUMBERS.split(' ').collect();
    let mut text = String::new();
    while !u.is_empty() && text.len() < 1 << 16 {
        let which: u8 = u.arbitrary()?;
        match which {
            0..=63 => text += u.choose(&numbers)?,
            64..=79 => {
                for _ in 0..u.int_in_range(2..=12)? {
                    text += u.choose(&numbers[..8])?;
                    text.push(' ');
                }
            }
            _ => text += u.choose(&words)?,
        }
        text.push(if which & 7 == 0 { '\n' } else { ' ' });
    }
    Ok(text)
}

fn open(read: std::result::Result<Scene, SceneError>) {
    match read {
        Ok(scene) => {
            for frame in [0, 11] {
                within_domain(&scene.frame(frame));
            }
            assert!(scene.warnings().iter().all(|warning| !warning.is_empty()));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
