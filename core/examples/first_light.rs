//! One point, a hundred lamps: which lamp to trace a shadow ray to, and how likely that choice was.
//!
//! `cargo run -p lightbvh --example first_light` (seconds)

use lightbvh::{Edit, EmissiveTriangle, LightBvh, Random64, ShadingPoint, Transform};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // One triangle of 5 cm² that shines down, W/(m² sr), shared by a hundred instances along a street.
    let lamp = EmissiveTriangle {
        p: [[0.0, 3.0, 0.0], [0.03, 3.0, 0.0], [0.0, 3.0, 0.03]],
        radiance: [900.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp])?;
    let row = (0..100_u8).map(|i| Edit::AddInstance {
        mesh,
        transform: Transform::at([f32::from(i), 0.0, 0.0]),
        radiance: 1.0,
    });
    bvh.apply(row.collect())?;
    bvh.refit();

    let point = ShadingPoint {
        p: [42.3, 0.0, 0.5],
        n: [0.0, 1.0, 0.0],
    };
    // Numbers in order give lights in order: eight strata, as many lamps or fewer.
    for stratum in 0..8_u32 {
        let sampled = bvh.sample(&point, Random64::from((stratum << 29) + (1 << 28)));
        let triangle = bvh
            .triangle(sampled.light, sampled.instance)
            .expect("it was sampled");
        println!(
            "light {:2} at x = {:5.2} m, probability {:.4}",
            sampled.light, triangle.p[0][0], sampled.pmf
        );
        let pmf = bvh.pmf(&point, sampled.light, sampled.instance);
        assert_eq!(
            pmf.to_bits(),
            sampled.pmf.to_bits(),
            "exactly that, whenever it is asked for"
        );
    }
    Ok(())
}
