//! Writes the page: `index.html` with the shaders, the interfaces of kernels, and the WebAssembly in their places.
//!
//! `page index.html lightbvh_web.wasm >page.html`

use std::fmt::Write;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
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
        ("/*WASM*/", STANDARD.encode(std::fs::read(wasm)?)),
    ] {
        assert_eq!(text.matches(place).count(), 1, "{place}");
        text = text.replace(place, &own);
    }
    print!("{text}");
    Ok(())
}
