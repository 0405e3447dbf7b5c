//! What C may get wrong is answered by a status.

use std::ffi::CStr;
use std::ptr::{null, null_mut, without_provenance_mut};

use lightbvh::light::AnyLight;
use lightbvh::{LightPoint, SampledLight};
use lightbvh_c::*;

const MODELS: [u32; 3] = [0, 1, 2];
const LAMP: CLight = CLight {
    kind: AnyLight::TRIANGLE,
    flags: 0,
    p: [0.0, 3.0, 0.0],
    a: [1.0, 3.0, 0.0],
    b: [0.0, 3.0, 1.0],
    emission: [1.0; 3],
    radius: 0.0,
    range: 0.0,
    inner: 0.0,
    outer: 0.0,
};
const SPOT: CLight = CLight {
    kind: AnyLight::SPOT,
    a: [0.0, -1.0, 0.0],
    outer: 1.0,
    ..LAMP
};
const POINT: CPoint = CPoint {
    p: [0.0; 3],
    n: [0.0, 1.0, 0.0],
    mask: u32::MAX,
};

fn last() -> String {
    // SAFETY: a string that stays until the next failure on this thread.
    let text = unsafe { CStr::from_ptr(lightbvh_last_error()) };
    text.to_str().unwrap().to_owned()
}

#[track_caller]
fn ok(found: Status) {
    assert_eq!(found, Status::Ok, "{}", last());
}

/// Refused, with these words.
#[track_caller]
fn says(expected: Status, found: Status, words: &str) {
    assert_eq!(found, expected);
    assert!(last().contains(words), "{}", last());
}

/// Results that a failing function leaves as they are.
fn nothing<T: Copy, const N: usize>() -> [T; N] {
    // SAFETY: each is a structure of the header, whose words may be any.
    unsafe { std::mem::zeroed() }
}

fn at(x: f32) -> CTransform {
    CTransform {
        translation: [x, 0.0, 0.0],
        ..CEdit::default().transform
    }
}

/// An instance of a mesh of one triangle at each place, refitted.
unsafe fn add(bvh: *mut Handle, places: &[f32]) -> (CId, Vec<CId>) {
    let mut mesh = CId::default();
    let mut instances = vec![CId::default(); places.len()];
    // SAFETY: the caller's light BVH, and places for all results.
    unsafe {
        ok(lightbvh_add_mesh(bvh, &LAMP, 1, &mut mesh));
        let add = |&x: &f32| CEdit {
            kind: edit_kind::ADD_INSTANCE,
            id: mesh,
            transform: at(x),
            ..CEdit::default()
        };
        let edits: Vec<_> = places.iter().map(add).collect();
        let made = instances.as_mut_ptr();
        ok(lightbvh_apply(bvh, edits.as_ptr(), edits.len(), made, null_mut()));
        ok(lightbvh_refit(bvh));
    }
    (mesh, instances)
}

/// Each pointer of each function is null, or not aligned.
#[test]
fn null_and_unaligned_pointers_are_refused() {
    let bvh = lightbvh_create(1);
    let mirror = lightbvh_mirror_create(1);
    let ([mut id], [mut sample], [mut sampled], [mut on]) = (
        nothing::<CId, 1>(),
        nothing::<SampledLight, 1>(),
        nothing::<CSampled, 1>(),
        nothing::<LightPoint, 1>(),
    );
    let (mut part, mut pmf, mut count, mut long) = (0, 0.0, 0, 0);
    let [mut frame] = nothing::<CFrame, 1>();
    let [odd, odd_id, odd_status] = [without_provenance_mut::<u8>(2); 3];
    // SAFETY: pointers are null, unaligned, or good.
    unsafe {
        let instance = add(bvh, &[0.0]).1[0];
        let edit = CEdit {
            kind: edit_kind::ADD_LIGHT,
            ..CEdit::default()
        };
        let refused = [
            lightbvh_add_mesh(null_mut(), &LAMP, 1, &mut id),
            lightbvh_add_mesh(bvh, null(), 1, &mut id),
            lightbvh_add_mesh(bvh, odd.cast(), 1, &mut id),
            lightbvh_add_mesh(bvh, &LAMP, 1, null_mut()),
            lightbvh_add_instance(bvh, id, at(0.0), null_mut()),
            lightbvh_add_light(bvh, null(), &mut id),
            lightbvh_add_light(bvh, &LAMP, null_mut()),
            lightbvh_set_light(bvh, instance, null()),
            lightbvh_set_transform(null_mut(), instance, at(0.0)),
            lightbvh_set_lights(null_mut(), id, 0, &LAMP, 1),
            lightbvh_apply(bvh, null(), 1, null_mut(), null_mut()),
            lightbvh_apply(bvh, &edit, 1, odd_id.cast(), null_mut()),
            lightbvh_apply(bvh, &edit, 1, null_mut(), odd.cast()),
            lightbvh_apply(bvh, &edit, 1, null_mut(), null_mut()),
            lightbvh_apply_each(bvh, &edit, 1, null_mut(), odd_status.cast()),
            lightbvh_apply_each(bvh, &edit, 1, null_mut(), null_mut()),
            lightbvh_refit(null_mut()),
            lightbvh_rebuild(null_mut()),
            lightbvh_sample_light(null(), &POINT, 0, 0.5, 0.5, &mut sampled),
            lightbvh_sample_light(bvh, null(), 0, 0.5, 0.5, &mut sampled),
            lightbvh_sample_light(bvh, &POINT, 0, 0.5, 0.5, null_mut()),
            lightbvh_pdf_of_hit(bvh, &POINT, instance, 0, null(), &mut pmf),
            lightbvh_pdf_of_hit(bvh, &POINT, instance, 0, &[0.0; 3], null_mut()),
            lightbvh_sample(null(), &POINT, 0, &mut sample),
            lightbvh_sample(bvh, null(), 0, &mut sample),
            lightbvh_sample(bvh, &POINT, 0, null_mut()),
            lightbvh_sample_batch(bvh, null(), &7, 1, &mut sample),
            lightbvh_sample_batch(bvh, &POINT, null(), 1, &mut sample),
            lightbvh_sample_batch(bvh, &POINT, &7, 1, null_mut()),
            lightbvh_pmf(bvh, &POINT, 0, 0, null_mut()),
            lightbvh_pmf_of(bvh, null(), instance, 0, &mut pmf),
            lightbvh_pmf_of(bvh, &POINT, instance, 0, null_mut()),
            lightbvh_owner(bvh, 0, 0, null_mut(), &mut part),
            lightbvh_owner(bvh, 0, 0, &mut id, null_mut()),
            lightbvh_point_of(bvh, null(), 0, 0, 0.5, 0.5, &mut on),
            lightbvh_point_of(bvh, &POINT, 0, 0, 0.5, 0.5, null_mut()),
            lightbvh_mesh_at(bvh, 0, null_mut()),
            lightbvh_instance_at(bvh, 0, null_mut()),
            lightbvh_lights_of(bvh, instance, null_mut(), null_mut()),
            lightbvh_removed_lights(null(), null_mut(), 0, &mut count),
            lightbvh_removed_lights(bvh, null_mut(), 1, &mut count),
            lightbvh_removed_lights(bvh, null_mut(), 0, null_mut()),
            lightbvh_forget_removed_lights(null_mut()),
            lightbvh_words(bvh, null_mut(), 1, &mut count),
            lightbvh_words(bvh, null_mut(), 0, null_mut()),
            lightbvh_swap_after(null_mut(), 1),
            lightbvh_begin_frame(null_mut(), null_mut()),
            lightbvh_begin_frame(bvh, odd.cast()),
            lightbvh_end_frame(null_mut()),
            lightbvh_kernel_of(0, 0, null_mut()),
            lightbvh_kernel_words(0, 0, 0, null_mut(), 1, &mut count),
            lightbvh_kernel_words(0, 0, 0, null_mut(), 0, null_mut()),
            lightbvh_groups(1, null_mut()),
            lightbvh_self_test_operands(null_mut(), 0, null_mut()),
            lightbvh_self_test_check(null(), 1),
            lightbvh_mirror_frame(null_mut(), bvh, &mut frame),
            lightbvh_mirror_frame(mirror, null(), &mut frame),
            lightbvh_mirror_frame(mirror, bvh, null_mut()),
            lightbvh_mirror_compare(null(), bvh, 0, null(), 0, &mut long, &mut long),
            lightbvh_mirror_compare(mirror, bvh, 0, null(), 1, &mut long, &mut long),
            lightbvh_mirror_compare(mirror, bvh, 0, null(), 0, null_mut(), null_mut()),
        ];
        for (k, status) in refused.into_iter().enumerate() {
            assert_eq!(status, Status::BadPointer, "call {k}");
        }
        assert!(lightbvh_create_from_words(0, null(), 1).is_null());
        // No elements need no array.
        ok(lightbvh_sample_batch(bvh, null(), null(), 0, null_mut()));
        ok(lightbvh_apply(bvh, null(), 0, null_mut(), null_mut()));
        ok(lightbvh_pmf(bvh, &POINT, 7, 0, &mut pmf));
        assert_eq!(pmf.to_bits(), 0);
        lightbvh_mirror_free(mirror);
        lightbvh_mirror_free(null_mut());
        lightbvh_free(bvh);
        lightbvh_free(null_mut());
    }
}

#[test]
fn counts_and_numbers_out_of_range_are_refused() {
    let bvh = lightbvh_create(0);
    let [mut id] = nothing::<CId, 1>();
    let [mut sampled] = nothing::<CSampled, 1>();
    let [mut on] = nothing::<LightPoint, 1>();
    let mut pdf = 0.0;
    // SAFETY: counts that no memory holds are refused before it is read; else all pointers are good.
    unsafe {
        let many = (1 << 30) + 1;
        let found = lightbvh_add_mesh(bvh, &LAMP, many, &mut id);
        says(Status::TooMany, found, "1073741825 lights");
        assert_eq!(
            lightbvh_add_mesh(bvh, &LAMP, usize::MAX, &mut id),
            Status::BadPointer
        );
        let edit = CEdit::default();
        assert_eq!(
            lightbvh_apply(bvh, &edit, many, null_mut(), null_mut()),
            Status::TooMany
        );
        assert_eq!(lightbvh_add_mesh(bvh, null(), 0, &mut id), Status::EmptyMesh);
        let (mesh, own) = add(bvh, &[0.0]);
        // Nobody has 2^29 lights at that address: reading them would fault.
        let found = lightbvh_set_lights(bvh, mesh, 0, &LAMP, 1 << 29);
        says(Status::BadRange, found, "of a mesh of 1;");
        for [u, v] in [[f32::NAN, 0.5], [0.5, 1.0], [-5.0, 3.0], [0.5, f32::INFINITY]] {
            let found = lightbvh_point_of(bvh, &POINT, 0, 0, u, v, &mut on);
            says(Status::BadPoint, found, "expected numbers in [0, 1)");
            let found = lightbvh_sample_light(bvh, &POINT, 0, u, v, &mut sampled);
            says(Status::BadPoint, found, "expected numbers in [0, 1)");
        }
        ok(lightbvh_point_of(bvh, &POINT, 0, 0, 0.0, 0.999, &mut on));
        for far in [f32::NAN, f32::INFINITY, -1.2e12] {
            let found = lightbvh_pdf_of_hit(bvh, &POINT, own[0], 0, &[0.0, far, 0.0], &mut pdf);
            says(Status::BadPoint, found, "coordinate y of the hit position");
        }
        ok(lightbvh_pdf_of_hit(
            bvh,
            &POINT,
            own[0],
            0,
            &[0.2, 3.0, 0.2],
            &mut pdf,
        ));
        let found = lightbvh_groups(u32::MAX, &mut [0; 3]);
        says(Status::TooMany, found, "dispatch several times");
        lightbvh_free(bvh);
    }
}

#[test]
fn unknown_tags_and_other_models_are_refused() {
    assert!(lightbvh_create(3).is_null());
    assert!(last().contains("lightbvh_model"), "{}", last());
    assert!(lightbvh_mirror_create(7).is_null());
    let [mut id] = nothing::<CId, 1>();
    let [mut frame] = nothing::<CFrame, 1>();
    let [mut kernel] = nothing::<CKernel, 1>();
    let mut count = 0;
    // SAFETY: all pointers are good.
    unsafe {
        for (model, which, device) in [(3, 0, 0), (0, 8, 0), (0, 0, 8)] {
            let found = lightbvh_kernel_words(model, which, device, null_mut(), 0, &mut count);
            assert_eq!(found, Status::BadTag);
        }
        assert_eq!(lightbvh_kernel_of(0, u32::MAX, &mut kernel), Status::BadTag);
        for model in MODELS {
            let bvh = lightbvh_create(model);
            let mirror = lightbvh_mirror_create(model);
            for buffer in [13, 99, u32::MAX] {
                let (compared, different) = (&mut 0, &mut 0);
                let found = lightbvh_mirror_compare(mirror, bvh, buffer, null(), 0, compared, different);
                says(Status::BadTag, found, "lightbvh_buffer");
            }
            lightbvh_mirror_free(mirror);
            let edit = CEdit {
                kind: 10,
                ..CEdit::default()
            };
            let found = lightbvh_apply(bvh, &edit, 1, null_mut(), null_mut());
            says(Status::BadTag, found, "edit 0: kind 10");
            let unknown = CLight { kind: 6, ..LAMP };
            let found = lightbvh_add_mesh(bvh, [LAMP, unknown].as_ptr(), 2, &mut id);
            says(Status::BadTag, found, "light 1: kind 6");
            let found = lightbvh_add_light(bvh, &SPOT, &mut id);
            match model {
                0 => says(Status::WrongModel, found, "LIGHTBVH_ANY_LIGHTS"),
                _ => ok(found),
            }
            for other in MODELS.into_iter().filter(|&other| other != model) {
                let mirror = lightbvh_mirror_create(other);
                let found = lightbvh_mirror_frame(mirror, bvh, &mut frame);
                says(Status::WrongModel, found, "another mirror");
                lightbvh_mirror_free(mirror);
            }
            lightbvh_free(bvh);
        }
    }
}

#[test]
fn lights_out_of_the_domain_are_refused() {
    let bvh = lightbvh_create(2);
    let [mut id] = nothing::<CId, 1>();
    let spot = |inner, outer| CLight { inner, outer, ..SPOT };
    // SAFETY: all pointers are good.
    unsafe {
        for (light, words) in [
            (
                CLight {
                    p: [f32::NAN; 3],
                    ..LAMP
                },
                "coordinate x",
            ),
            (
                CLight {
                    emission: [-1.0; 3],
                    ..LAMP
                },
                "red of",
            ),
            (CLight { flags: 2, ..LAMP }, "0x2"),
            (
                CLight {
                    flags: 1 << 24,
                    ..LAMP
                },
                "0x1000000",
            ),
            (CLight { flags: 1, ..SPOT }, "expected 0"),
            (CLight { range: -1.0, ..SPOT }, "range"),
            (
                CLight {
                    a: [2.0, 0.0, 0.0],
                    ..SPOT
                },
                "axis",
            ),
            (
                CLight {
                    kind: AnyLight::SPHERE,
                    radius: 0.0,
                    ..LAMP
                },
                "radius",
            ),
            (spot(0.5, 0.25), "inner <= outer"),
            (spot(-0.5, 0.25), "inner <= outer"),
            (spot(0.0, 45.0), "radians"),
            (spot(f32::NAN, 1.0), "NaN"),
            (spot(0.0, f32::NAN), "NaN"),
        ] {
            says(Status::BadLight, lightbvh_add_light(bvh, &light, &mut id), words);
            says(
                Status::BadLight,
                lightbvh_add_mesh(bvh, &light, 1, &mut id),
                "light 0: ",
            );
        }
        assert_eq!(id, CId::default());
        lightbvh_free(bvh);
    }
}

/// Whatever is under way: another delay, words, the end.
#[test]
fn builds_under_way_may_be_dropped() {
    for frames in [0, 1, 3, u32::MAX] {
        let bvh = lightbvh_create(1);
        let (mut start, mut swapped) = (CFrameStart::default(), 0);
        // SAFETY: all pointers are good.
        unsafe {
            ok(lightbvh_end_frame(bvh));
            for frame in 0..30_u8 {
                ok(lightbvh_begin_frame(bvh, &mut start));
                swapped += start.swapped;
                add(bvh, &[0.0, f32::from(frame)]);
                ok(lightbvh_end_frame(bvh));
                if frame == 2 {
                    ok(lightbvh_swap_after(bvh, frames));
                    ok(lightbvh_end_frame(bvh));
                    swapped = 0;
                }
            }
            // Without a delay it depends on the thread.
            assert!(
                frames == 0 || (swapped > 0) == (frames < 30),
                "{frames}: {swapped}"
            );
            lightbvh_free(bvh);
        }
    }
}

/// A number of a light that went is no other's until it is forgotten.
#[test]
fn numbers_of_lights_are_kept_until_they_are_forgotten() {
    let bvh = lightbvh_create(0);
    let mut ranges = [CRange::default(); 3];
    let (mut count, mut first, mut lights) = (9, 0, 0);
    // SAFETY: all pointers are good, or null where nothing is written.
    unsafe {
        let own = add(bvh, &[0.0, 2.0, 4.0, 6.0]).1;
        let mut number = |instance: CId| {
            ok(lightbvh_lights_of(bvh, instance, &mut first, &mut lights));
            first
        };
        let gone = [number(own[2]), number(own[0])];
        ok(lightbvh_remove(bvh, own[2]));
        ok(lightbvh_remove(bvh, own[0]));
        let known = gone.map(|first| CRange { first, count: 1 });
        for capacity in 0..3 {
            ranges = [CRange::default(); 3];
            ok(lightbvh_removed_lights(
                bvh,
                ranges.as_mut_ptr(),
                capacity,
                &mut count,
            ));
            let written = capacity.min(2);
            assert_eq!((count, &ranges[..written]), (2, &known[..written]));
        }
        assert_eq!(ranges[2], CRange::default());
        let kept = number(add(bvh, &[8.0]).1[0]);
        assert!(!gone.contains(&kept));
        ok(lightbvh_forget_removed_lights(bvh));
        ok(lightbvh_removed_lights(bvh, null_mut(), 0, &mut count));
        assert_eq!(count, 0);
        assert!(gone.contains(&number(add(bvh, &[9.0]).1[0])));
        lightbvh_free(bvh);
    }
}

#[test]
fn wrong_ids_points_and_lights_are_refused() {
    let (bvh, other) = (lightbvh_create(1), lightbvh_create(1));
    let mut samples = nothing::<SampledLight, 2>();
    let [mut on] = nothing::<LightPoint, 1>();
    let [mut id] = nothing::<CId, 1>();
    let (mut part, mut first, mut lights, mut pmf) = (0, 0, 0, 0.0);
    // SAFETY: all pointers are good.
    unsafe {
        let (mesh, own) = add(bvh, &[0.0]);
        let instance = own[0];
        // Cleared memory, another light BVH, an instance for a mesh and the other way round, a bad factor.
        let found = lightbvh_add_instance(bvh, CId::default(), at(0.0), &mut id);
        says(Status::UnknownMesh, found, "lightbvh_add_mesh");
        let found = lightbvh_add_instance(other, mesh, at(0.0), &mut id);
        says(Status::UnknownMesh, found, "another light BVH");
        assert!(last().contains("`lightbvh_mesh_at`"), "{}", last());
        let found = lightbvh_set_mask(other, instance, 1);
        says(Status::UnknownInstance, found, "`lightbvh_instance_at`");
        let found = lightbvh_add_instance(bvh, instance, at(0.0), &mut id);
        says(Status::UnknownMesh, found, "no id of a mesh");
        let found = lightbvh_set_mask(bvh, mesh, 1);
        says(Status::UnknownInstance, found, "no id of an instance");
        let found = lightbvh_set_light(bvh, instance, &LAMP);
        says(
            Status::NotALight,
            found,
            "of a mesh; change the mesh's lights by `lightbvh_set_lights`",
        );
        let found = lightbvh_set_radiance(bvh, instance, 1.0, f32::NAN, 1.0);
        says(Status::BadRadiance, found, "NaN");
        let found = lightbvh_set_transform(bvh, instance, at(f32::INFINITY));
        says(Status::BadTransform, found, "translation[0]");
        says(Status::InUse, lightbvh_remove(bvh, mesh), "1 instance");
        assert_eq!(id, CId::default());
        // The second point is bad, so the first one is not answered either.
        let far = CPoint {
            p: [f32::INFINITY, 0.0, 0.0],
            ..POINT
        };
        let points = [POINT, far];
        let found = lightbvh_sample_batch(bvh, points.as_ptr(), [0, 0].as_ptr(), 2, samples.as_mut_ptr());
        says(Status::BadPoint, found, "point 1: ");
        assert_eq!(samples, nothing::<SampledLight, 2>());
        for (light, index) in [(1, 0), (0, 1), (0, u32::MAX)] {
            let found = lightbvh_point_of(bvh, &POINT, light, index, 0.5, 0.5, &mut on);
            assert_eq!(found, Status::NoLight);
            assert_eq!(
                lightbvh_owner(bvh, light, index, &mut id, &mut part),
                Status::NoLight
            );
        }
        ok(lightbvh_owner(bvh, 0, 0, &mut id, &mut part));
        assert_eq!((id, part), (instance, 0));
        for wrong in [1, u32::MAX] {
            let found = lightbvh_pmf_of(bvh, &POINT, instance, wrong, &mut pmf);
            says(Status::NoLight, found, "an instance of 1 lights");
            let found = lightbvh_pdf_of_hit(bvh, &POINT, instance, wrong, &[0.0; 3], &mut pmf);
            assert_eq!(found, Status::NoLight);
            assert_eq!(lightbvh_mesh_at(bvh, wrong, &mut id), Status::UnknownMesh);
            assert_eq!(lightbvh_instance_at(bvh, wrong, &mut id), Status::UnknownInstance);
        }
        ok(lightbvh_remove(bvh, instance));
        for found in [
            lightbvh_remove(bvh, instance),
            lightbvh_lights_of(bvh, instance, &mut first, &mut lights),
            lightbvh_pmf_of(bvh, &POINT, instance, 0, &mut pmf),
        ] {
            says(Status::UnknownInstance, found, "it was removed");
        }
        ok(lightbvh_remove(bvh, mesh));
        says(Status::UnknownMesh, lightbvh_remove(bvh, mesh), "it was removed");
        lightbvh_free(bvh);
        lightbvh_free(other);
    }
}

/// A batch that is refused changes nothing and names its edit; each by itself, the sound ones are done.
#[test]
fn batches_are_done_as_a_whole_or_each_by_itself() {
    let bvh = lightbvh_create(2);
    let edit = |kind, light: *const CLight| CEdit {
        kind,
        lights: light,
        count: 1,
        ..CEdit::default()
    };
    let bad = CLight {
        radius: -1.0,
        kind: AnyLight::SPHERE,
        ..LAMP
    };
    let edits = [
        edit(edit_kind::ADD_LIGHT, &SPOT),
        edit(edit_kind::ADD_LIGHT, &bad),
        edit(edit_kind::ADD_MESH, &LAMP),
        edit(77, null()),
    ];
    let mut ids = [CId::default(); 4];
    let mut statuses = [Status::Panicked; 4];
    let mut failed = 9;
    // SAFETY: all pointers are good.
    unsafe {
        let found = lightbvh_apply(bvh, edits.as_ptr(), 3, ids.as_mut_ptr(), &mut failed);
        says(Status::BadLight, found, "edit 1: ");
        assert_eq!((failed, ids), (1, [CId::default(); 4]));
        assert_eq!(lightbvh_instance_at(bvh, 0, &mut ids[0]), Status::UnknownInstance);
        let found = lightbvh_apply_each(bvh, edits.as_ptr(), 4, ids.as_mut_ptr(), statuses.as_mut_ptr());
        says(Status::BadLight, found, "edit 1: ");
        let expected = [Status::Ok, Status::BadLight, Status::Ok, Status::BadTag];
        assert_eq!(statuses, expected);
        ok(lightbvh_set_mask(bvh, ids[0], 0b10));
        assert_eq!([ids[1], ids[3]], [CId::default(); 2]);
        ok(lightbvh_add_instance(bvh, ids[2], at(1.0), &mut ids[1]));
        ok(lightbvh_refit(bvh));
        // What the mask leaves out is not found, and where nothing is left all is zero.
        let [mut sampled, none] = nothing::<CSampled, 2>();
        for (mask, expected) in [(0b10, None), (0b01, Some(ids[1])), (0, Some(CId::default()))] {
            let point = CPoint { mask, ..POINT };
            ok(lightbvh_sample_light(
                bvh,
                &point,
                1 << 63,
                0.5,
                0.5,
                &mut sampled,
            ));
            assert!(expected.is_none_or(|id| sampled.instance == id));
            assert_eq!(sampled == none, mask == 0);
        }
        lightbvh_free(bvh);
    }
}

/// Words of another model, and words that are none, give no light BVH.
#[test]
fn words_are_read_back_or_refused() {
    // SAFETY: all pointers are good.
    unsafe {
        for model in MODELS {
            let bvh = lightbvh_create(model);
            add(bvh, &[0.0, 5.0, 9.0]);
            let mut count = 0;
            ok(lightbvh_words(bvh, null_mut(), 0, &mut count));
            let mut words = vec![0; count];
            ok(lightbvh_words(bvh, words.as_mut_ptr(), count, &mut count));
            for other in MODELS {
                let read = lightbvh_create_from_words(other, words.as_ptr(), count);
                assert_eq!(read.is_null(), other != model);
                lightbvh_free(read);
            }
            assert!(lightbvh_create_from_words(model, words.as_ptr(), count - 1).is_null());
            assert!(last().contains("damaged"), "{}", last());
            lightbvh_free(bvh);
        }
    }
}
