//! What C may get wrong is answered by a status.

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use lightbvh::{EmissiveTriangle, SampledLight, ShadingPoint};
use lightbvh_c::*;

const WHITE: [f32; 3] = [1.0; 3];
const LAMP: EmissiveTriangle = EmissiveTriangle {
    p: [[0.0, 3.0, 0.0], [1.0, 3.0, 0.0], [0.0, 3.0, 1.0]],
    radiance: [1.0; 3],
    mesh: 0,
    flags: 0,
};
const POINT: ShadingPoint = ShadingPoint {
    p: [0.0; 3],
    n: [0.0, 1.0, 0.0],
};

fn last() -> String {
    // SAFETY: a string that stays until the next failure on this thread.
    let text = unsafe { CStr::from_ptr(lightbvh_last_error()) };
    text.to_str().unwrap().to_owned()
}

#[track_caller]
fn ok(found: Status) {
    assert_eq!(found, Status::Ok);
}

#[track_caller]
fn refused(found: Status) {
    assert_eq!(found, Status::Refused);
}

/// A transform, an id: plain words of C.
fn words<T: Copy, const N: usize>(words: [u32; N]) -> T {
    assert_eq!(size_of::<T>(), 4 * N);
    // SAFETY: `T` is one of the structures of the header, whose words may be any, and it has as many.
    unsafe { words.as_ptr().cast::<T>().read_unaligned() }
}

#[test]
fn null_and_unaligned_pointers_are_refused() {
    let bvh = lightbvh_create();
    let rebuilder = lightbvh_rebuilder_create(0);
    let mut mesh: CMesh = words([0; 4]);
    let mut sample = SampledLight::NONE;
    let (mut pmf, mut count) = (0.0, 0);
    let unaligned = std::ptr::from_ref(&LAMP)
        .cast::<u8>()
        .wrapping_add(1)
        .cast::<EmissiveTriangle>();
    // SAFETY: pointers are null, unaligned, or good.
    unsafe {
        let refused = [
            lightbvh_add_mesh(null_mut(), &LAMP, 1, &mut mesh),
            lightbvh_add_mesh(bvh, null(), 1, &mut mesh),
            lightbvh_add_mesh(bvh, unaligned, 1, &mut mesh),
            lightbvh_add_mesh(bvh, &LAMP, usize::MAX, &mut mesh),
            lightbvh_add_mesh(bvh, &LAMP, 1, null_mut()),
            lightbvh_set_transform(bvh, words([0, 0, 0, 2]), null()),
            lightbvh_set_triangle_range(bvh, words([0, 0, 0, 1]), 0, null(), 1),
            lightbvh_set_triangle_range(null_mut(), words([0; 4]), 0, &LAMP, 1),
            lightbvh_refit(null_mut()),
            lightbvh_sample_light(null(), &POINT, 0, &mut sample),
            lightbvh_sample_light(bvh, null(), 0, &mut sample),
            lightbvh_sample_light(bvh, &POINT, 0, null_mut()),
            lightbvh_sample_batch(bvh, null(), &7, 1, &mut sample),
            lightbvh_sample_batch(bvh, &POINT, null(), 1, &mut sample),
            lightbvh_sample_batch(bvh, &POINT, &7, 1, null_mut()),
            lightbvh_pmf(bvh, &POINT, 0, 0, null_mut()),
            lightbvh_add_instances(bvh, words([0, 0, 0, 1]), null(), null(), 1, null_mut()),
            lightbvh_lights_of(bvh, words([0; 4]), null_mut(), null_mut()),
            lightbvh_point_of(bvh, 0, 0, 0.5, 0.5, null_mut()),
            lightbvh_begin_frame(null_mut(), bvh, null_mut()),
            lightbvh_begin_frame(rebuilder, null_mut(), null_mut()),
            lightbvh_begin_frame(rebuilder, bvh, std::ptr::without_provenance_mut(2)),
            lightbvh_end_frame(null_mut(), bvh),
            lightbvh_end_frame(rebuilder, null()),
            lightbvh_removed_lights(null(), null_mut(), 0, &mut count),
            lightbvh_removed_lights(bvh, null_mut(), 1, &mut count),
            lightbvh_removed_lights(bvh, null_mut(), 0, null_mut()),
            lightbvh_forget_removed_lights(null_mut()),
        ];
        assert_eq!(refused, [Status::BadPointer; 28]);
        // No elements need no array.
        ok(lightbvh_sample_batch(bvh, null(), null(), 0, null_mut()));
        ok(lightbvh_pmf(bvh, &POINT, 0, 0, &mut pmf));
        assert_eq!(pmf.to_bits(), 0);
        lightbvh_rebuilder_free(rebuilder);
        lightbvh_rebuilder_free(null_mut());
        lightbvh_free(bvh);
        lightbvh_free(null_mut());
    }
}

#[test]
fn counts_and_numbers_out_of_range_are_refused() {
    let bvh = lightbvh_create();
    let mut mesh: CMesh = words([0; 4]);
    let mut instance: CInstance = words([0; 4]);
    let mut point = None;
    // SAFETY: counts that no memory holds are refused before it is read; else all pointers are good.
    unsafe {
        let many = (1 << 30) + 1;
        refused(lightbvh_add_mesh(bvh, &LAMP, many, &mut mesh));
        assert!(last().contains("1073741825 triangles"), "{}", last());
        refused(lightbvh_set_triangle_range(bvh, mesh, 0, &LAMP, 1 << 40));
        ok(lightbvh_add_mesh(bvh, &LAMP, 1, &mut mesh));
        // Nobody has 2^29 triangles at that address: reading them would fault.
        refused(lightbvh_set_triangle_range(bvh, mesh, 0, &LAMP, 1 << 29));
        assert!(last().contains("of a mesh of 1;"), "{}", last());
        ok(lightbvh_add_instances(
            bvh,
            mesh,
            &at(0.0),
            &WHITE,
            1,
            &mut instance,
        ));
        ok(lightbvh_refit(bvh));
        for [u, v] in [[f32::NAN, 0.5], [0.5, 1.0], [-5.0, 3.0], [0.5, f32::INFINITY]] {
            let asked = lightbvh_point_of(bvh, 0, 0, u, v, point.insert(std::mem::zeroed()));
            assert_eq!(asked, Status::BadPoint, "{u}, {v}");
            assert!(last().contains("expected numbers in [0, 1)"), "{}", last());
        }
        let asked = lightbvh_point_of(bvh, 0, 0, 0.0, 0.999, point.insert(std::mem::zeroed()));
        ok(asked);
        lightbvh_free(bvh);
    }
}

/// As many lights of one mesh as there are places.
unsafe fn add(bvh: *mut Handle, places: &[CTransform]) -> Vec<CInstance> {
    let mut mesh: CMesh = words([0; 4]);
    let mut instances = vec![words([0; 4]); places.len()];
    // SAFETY: the caller's light BVH, and places for all results.
    unsafe {
        ok(lightbvh_add_mesh(bvh, &LAMP, 1, &mut mesh));
        let out = instances.as_mut_ptr();
        let added = lightbvh_add_instances(bvh, mesh, places.as_ptr(), &WHITE, places.len(), out);
        ok(added);
        ok(lightbvh_refit(bvh));
    }
    instances
}

fn at(x: f32) -> CTransform {
    let one = 1.0_f32.to_bits();
    words([one, 0, 0, 0, one, 0, 0, 0, one, x.to_bits(), 0, 0])
}

/// A number of a light that went is no other's until it is forgotten.
#[test]
fn numbers_of_lights_are_kept_until_they_are_forgotten() {
    let bvh = lightbvh_create();
    let mut ranges = [CRange::default(); 3];
    let (mut count, mut first, mut lights) = (9, 0, 0);
    // SAFETY: all pointers are good, or null where nothing is written.
    unsafe {
        let own = add(bvh, &[0.0, 2.0, 4.0, 6.0].map(at));
        let mut number = |instance: CInstance| {
            ok(lightbvh_lights_of(bvh, instance, &mut first, &mut lights));
            first
        };
        let gone = [number(own[2]), number(own[0])];
        ok(lightbvh_remove_instance(bvh, own[2]));
        ok(lightbvh_remove_instance(bvh, own[0]));
        ok(lightbvh_removed_lights(bvh, null_mut(), 0, &mut count));
        assert_eq!((count, ranges), (2, [CRange::default(); 3]));
        let known = gone.map(|first| CRange { first, count: 1 });
        for capacity in 1..=3 {
            let out = ranges.as_mut_ptr();
            ok(lightbvh_removed_lights(bvh, out, capacity, &mut count));
            let written = capacity.min(2);
            assert_eq!((count, &ranges[..written]), (2, &known[..written]));
        }
        assert_eq!(ranges[2], CRange::default());
        let kept = number(add(bvh, &[at(8.0)])[0]);
        assert!(!gone.contains(&kept));
        ok(lightbvh_forget_removed_lights(bvh));
        ok(lightbvh_removed_lights(bvh, null_mut(), 0, &mut count));
        assert_eq!(count, 0);
        assert!(gone.contains(&number(add(bvh, &[at(9.0)])[0])));
        lightbvh_free(bvh);
    }
}

#[test]
fn wrong_ids_points_and_lights_are_refused() {
    let (bvh, other) = (lightbvh_create(), lightbvh_create());
    let (mut mesh, mut instance): (CMesh, CInstance) = (words([0; 4]), words([0; 4]));
    let mut samples = [SampledLight::NONE; 2];
    let place = at(0.0);
    let (mut first, mut lights) = (0, 0);
    let mut on = LAMP.point([0.5, 0.5]);
    // SAFETY: all pointers are good.
    unsafe {
        refused(lightbvh_add_mesh(bvh, null(), 0, &mut mesh));
        ok(lightbvh_add_mesh(bvh, &LAMP, 1, &mut mesh));
        // Cleared memory, another light BVH, a bad factor.
        let cleared = words([0; 4]);
        refused(lightbvh_add_instances(
            bvh,
            cleared,
            &place,
            &WHITE,
            1,
            &mut instance,
        ));
        assert!(last().contains("lightbvh_add_mesh"), "{}", last());
        refused(lightbvh_add_instances(
            other,
            mesh,
            &place,
            &WHITE,
            1,
            &mut instance,
        ));
        refused(lightbvh_add_instances(
            bvh,
            mesh,
            &place,
            &[1.0, f32::NAN, 1.0],
            1,
            &mut instance,
        ));
        ok(lightbvh_add_instances(
            bvh,
            mesh,
            &place,
            &WHITE,
            1,
            &mut instance,
        ));
        ok(lightbvh_refit(bvh));
        // The second point is bad, so the first one is not answered either.
        let far = ShadingPoint {
            p: [f32::INFINITY, 0.0, 0.0],
            ..POINT
        };
        let points = [POINT, far];
        let status = lightbvh_sample_batch(bvh, points.as_ptr(), [0, 0].as_ptr(), 2, samples.as_mut_ptr());
        assert_eq!(status, Status::BadPoint);
        assert!(last().starts_with("point 1"), "{}", last());
        assert_eq!(samples, [SampledLight::NONE; 2]);
        ok(lightbvh_point_of(bvh, 0, 0, 0.5, 0.5, &mut on));
        for (light, instance) in [(1, 0), (0, u32::MAX)] {
            let asked = lightbvh_point_of(bvh, light, instance, 0.5, 0.5, &mut on);
            assert_eq!(asked, Status::NoLight);
        }
        // The second of two places is bad, so neither is taken.
        let mut flat = at(0.0);
        let far: &mut [f32; 12] = (&raw mut flat).cast::<[f32; 12]>().as_mut().unwrap();
        far[11] = f32::NAN;
        let mut two = [instance; 2];
        let status = lightbvh_add_instances(bvh, mesh, [place, flat].as_ptr(), &WHITE, 2, two.as_mut_ptr());
        refused(status);
        assert!(last().starts_with("instance 1"), "{}", last());
        let asked = lightbvh_point_of(bvh, 1, 1, 0.5, 0.5, &mut on);
        assert_eq!(asked, Status::NoLight);
        ok(lightbvh_lights_of(bvh, instance, &mut first, &mut lights));
        assert_eq!((first, lights), (0, 1));
        ok(lightbvh_remove_instance(bvh, instance));
        refused(lightbvh_remove_instance(bvh, instance));
        refused(lightbvh_lights_of(bvh, instance, &mut first, &mut lights));
        assert_eq!(lightbvh_point_of(bvh, 0, 0, 0.5, 0.5, &mut on), Status::NoLight);
        ok(lightbvh_remove_mesh(bvh, mesh));
        lightbvh_free(bvh);
        lightbvh_free(other);
    }
}
