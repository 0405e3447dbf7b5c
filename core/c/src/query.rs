//! Functions that ask a light BVH.

use lightbvh::bvh::EditReason;
use lightbvh::error::DomainError;
use lightbvh::{LightPoint, Random64, SampledLight, ShadingPoint};

use crate::error::{Fault, Status};
use crate::held::Handle;
use crate::ids::CInstance;
use crate::raw;

fn bad_point(error: DomainError) -> Fault {
    Fault::new(Status::BadPoint, error)
}

/// Chooses a light for a point.
///
/// # Safety
/// The pointers are null or as `lightbvh.h` says: `bvh` is a light BVH that nobody changes meanwhile, the others point to one of
/// theirs. The same holds for the functions below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_sample_light(
    bvh: *const Handle,
    point: *const ShadingPoint,
    random: u64,
    sample: *mut SampledLight,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let point = raw::shared(point, "point")?.checked().map_err(bad_point)?;
            raw::place(sample, "sample")?.write(bvh.tree().sample(&point, random));
            Ok(())
        })
    }
}

/// Chooses a light for each point.
///
/// # Safety
/// As [`lightbvh_sample_light`], with `count` points, numbers and samples.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_sample_batch(
    bvh: *const Handle,
    points: *const ShadingPoint,
    randoms: *const u64,
    count: usize,
    samples: *mut SampledLight,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let points = raw::array(points, count, "points")?;
            let randoms = raw::array(randoms, count, "randoms")?;
            let samples = raw::places(samples, count, "samples")?;
            // Nothing is written where one of them is bad.
            let checked = points.iter().enumerate().map(|(index, point)| {
                let bad = |error| Fault::new(Status::BadPoint, format!("point {index}: {error}"));
                point.checked().map_err(bad)
            });
            let points = checked.collect::<Result<Vec<_>, _>>()?;
            let randoms: Vec<_> = randoms.iter().map(|&bits| Random64::from(bits)).collect();
            let mut sampled = vec![SampledLight::NONE; count];
            bvh.tree().sample_batch(&points, &randoms, &mut sampled);
            for (place, sampled) in samples.iter_mut().zip(sampled) {
                place.write(sampled);
            }
            Ok(())
        })
    }
}

/// The probability of a light at a point.
///
/// # Safety
/// As [`lightbvh_sample_light`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_pmf(
    bvh: *const Handle,
    point: *const ShadingPoint,
    light: u32,
    instance: u32,
    pmf: *mut f32,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let point = raw::shared(point, "point")?.checked().map_err(bad_point)?;
            raw::place(pmf, "pmf")?.write(bvh.tree().pmf(&point, light, instance));
            Ok(())
        })
    }
}

/// The numbers of an instance's lights.
///
/// # Safety
/// As [`lightbvh_sample_light`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_lights_of(
    bvh: *const Handle,
    instance: CInstance,
    first: *mut u32,
    count: *mut u32,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let (first, count) = (raw::place(first, "first")?, raw::place(count, "count")?);
            let id = instance.id()?;
            let lights = bvh
                .view()
                .lights_of(id)
                .ok_or_else(|| Fault::new(Status::Refused, EditReason::UnknownInstance(id)))?;
            first.write(lights.start);
            count.write(lights.end - lights.start);
            Ok(())
        })
    }
}

/// A point on the light that a sample names.
///
/// # Safety
/// As [`lightbvh_sample_light`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_point_of(
    bvh: *const Handle,
    light: u32,
    instance: u32,
    u: f32,
    v: f32,
    point: *mut LightPoint,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let place = raw::place(point, "point")?;
            if ![u, v].iter().all(|number| (0.0..1.0).contains(number)) {
                let message = format!("u and v are {u} and {v}, expected numbers in [0, 1)");
                return Err(Fault::new(Status::BadPoint, message));
            }
            let missing = || {
                let message = format!("no light {light} in an instance {instance}");
                Fault::new(Status::NoLight, message)
            };
            let triangle = bvh.view().light(light, instance).ok_or_else(missing)?;
            place.write(triangle.point([u, v]));
            Ok(())
        })
    }
}

/// Numbers of lights, one after another: `lightbvh_range`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CRange {
    /// The first of them.
    pub first: u32,
    /// How many they are.
    pub count: u32,
}

/// The numbers of lights that are no more.
///
/// # Safety
/// `bvh` is null or a light BVH that nobody changes meanwhile; `ranges` has memory of `capacity` ranges, `count` of one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_removed_lights(
    bvh: *const Handle,
    ranges: *mut CRange,
    capacity: usize,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let places = raw::places(ranges, capacity, "ranges")?;
            let count = raw::place(count, "count")?;
            let removed = bvh.view().removed_lights();
            for (place, range) in places.iter_mut().zip(removed) {
                place.write(CRange {
                    first: range.start,
                    count: range.end - range.start,
                });
            }
            count.write(removed.len());
            Ok(())
        })
    }
}
