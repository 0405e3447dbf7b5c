use lightbvh::light::infinite::direction_at;

use super::*;

/// Mean over all directions of what `weight` makes of each and its radiance.
fn mean(texels: &Texels, weight: impl Fn([f64; 3]) -> f64) -> f64 {
    let size = 2 * texels.size;
    let (mut sum, mut all) = (0.0, 0.0);
    for (column, row) in (0..size).flat_map(|row| (0..size).map(move |column| (column, row))) {
        let at = |x: u32| ((f64::from(x) + 0.5) * 2.0 / f64::from(size) - 1.0) as f32;
        let direction = direction_at([at(column), at(row)]).map(f64::from);
        let angle = direction.iter().map(|x| x.abs()).sum::<f64>().powi(3);
        let radiance = texels.radiance(direction, || panic!("a texel without a place: {direction:?}"));
        sum += angle * weight(direction) * radiance[0];
        all += angle;
    }
    sum / all
}

/// Solid angle of the pixels of a row over that of the sphere.
fn share([width, height]: [u32; 2], y: u32) -> f64 {
    let at = |y: u32| libm::cos(PI * f64::from(y) / f64::from(height));
    (at(y) - at(y + 1)) / 2.0 / f64::from(width)
}

/// What of a picture's single pixel is in the texels, over what it has.
fn kept(size: [u32; 2], at: [u32; 2]) -> f64 {
    let mut texels = Texels::new(size_for(size));
    let pixel = |x, y| [f64::from(u8::from([x, y] == at)); 3];
    texels.add_longitude_latitude(size, pixel, |own| own);
    mean(&texels, |_| 1.0) / share(size, at[1])
}

/// Asked at places of its own a map has none of a small one, or many times as much. Texels hold more places or fewer than their
/// share of the sphere, so it is not all.
#[test]
fn a_single_pixel_keeps_its_light_wherever_it_lies() {
    for size @ [width, height] in [
        [3, 3],
        [64, 32],
        [200, 100],
        [513, 257],
        [16, 400],
        [700, 1],
        [1, 900],
    ] {
        for at in [
            [0, 0],
            [width - 1, 0],
            [width / 2, height / 2],
            [width / 3, height / 5],
            [width / 7, height - 1],
        ] {
            let ratio = kept(size, at);
            assert!((ratio - 1.0).abs() < 0.2, "{size:?} {at:?}: {ratio}");
        }
    }
    // Nearly all within a twenty-fifth: as many at random.
    let random = |k: u32, count: u32| lightbvh::exact::hash(k) % count;
    let all = (0..60).map(|k| kept([200, 100], [random(2 * k, 200), random(2 * k + 1, 100)]));
    let beyond = all.filter(|ratio| (ratio - 1.0).abs() > 0.04).count();
    assert!(beyond <= 2, "{beyond} of 60");
}

#[test]
fn a_horizon_is_where_it_is() {
    for size in [[1, 2], [4, 2], [8, 4], [16, 8], [1, 64], [256, 2]] {
        let mut texels = Texels::new(size_for(size));
        let pixel = |_, y| [f64::from(u8::from(2 * y < size[1])); 3];
        texels.add_longitude_latitude(size, pixel, |[x, y, z]| [x, z, y]);
        let up = 4.0 * mean(&texels, |[_, y, _]| y.max(0.0));
        let down = 4.0 * mean(&texels, |[_, y, _]| (-y).max(0.0));
        assert!((up - 1.0).abs() < 1e-3 && down < 1e-3, "{size:?}: {up} {down}");
    }
}

#[test]
fn what_is_the_same_everywhere_stays_so() {
    for size in [[1, 1], [2, 1], [7, 5], [640, 320]] {
        let mut texels = Texels::new(size_for(size));
        texels.add_longitude_latitude(size, |_, _| [0.7; 3], |own| own);
        for own in &texels.sums {
            assert!((own[0] / own[3] - 0.7).abs() < 1e-12, "{size:?}: {own:?}");
        }
    }
}
