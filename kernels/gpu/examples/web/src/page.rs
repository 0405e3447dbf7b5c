//! Writes the page: `index.html` with the shaders, the interfaces of kernels, and the WebAssembly in their places.
//!
//! `page index.html lightbvh_web.wasm >page.html`

use std::fmt::Write;

use lightbvh_gpu::{Access, DeviceBuffer, MOMENTS, Pass, functions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let [Some(page), Some(wasm), None] = [(); 3].map(|()| arguments.next()) else {
        return Err("usage: page INDEX.html MODULE.wasm".into());
    };
    let (mut scripts, mut passes) = (String::new(), String::new());
    let mut script = |name: &str, text: &str| {
        assert!(!text.contains("</script"), "{name} would end its element");
        write!(
            scripts,
            "<script type=\"text/wgsl\" id=\"{name}\">\n{text}</script>\n"
        )
    };
    script("lightbvh", functions::WGSL)?;
    for pass in Pass::ALL {
        let kernel = MOMENTS.refit(pass);
        let names: Vec<String> = kernel.bindings.iter().map(|own| own.name.to_owned()).collect();
        let text = lightbvh_kernels_builder::shader::kernel(&kernel.words(), &names)?;
        script(kernel.name, &text)?;
        let buffer = |name| DeviceBuffer::named(name).ok_or(format!("no buffer {name}"));
        let mut bindings = String::new();
        for own in kernel.bindings {
            let is_read = own.access == Access::Read;
            write!(bindings, "[{},{is_read}],", buffer(own.name)? as usize)?;
        }
        let [width, ..] = kernel.workgroup;
        writeln!(
            passes,
            "{{name:\"{}\",width:{width},bindings:[{bindings}]}},",
            kernel.name
        )?;
    }
    let names = DeviceBuffer::ALL.map(DeviceBuffer::name);
    let mut text = std::fs::read_to_string(page)?;
    for (place, own) in [
        ("<!--SHADERS-->", scripts),
        ("/*PASSES*/", passes),
        ("/*BUFFERS*/", format!("{names:?}")),
        ("/*WASM*/", base64(&std::fs::read(wasm)?)),
    ] {
        assert_eq!(text.matches(place).count(), 1, "{place}");
        text = text.replace(place, &own);
    }
    print!("{text}");
    Ok(())
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::new();
    for three in bytes.chunks(3) {
        let bits = (0..3).fold(0, |bits, k| {
            bits << 8 | three.get(k).map_or(0, |&own| u32::from(own))
        });
        for k in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * k) & 63) as usize];
            out.push(if k > three.len() { '=' } else { digit.into() });
        }
    }
    out
}
