//! Functions that ask a light BVH.

use std::ops::Range;

use bytemuck::Zeroable;
use lightbvh::bvh::EditReason;
use lightbvh::importance::LinkedPoint;
use lightbvh::light::{Light, MAX_COORDINATE, mis_weight};
use lightbvh::{InstanceId, LightPoint, Random64, SampledLight, ShadingPoint};

use crate::error::{Fault, Status};
use crate::held::{Handle, functions};
use crate::ids::CId;
use crate::raw;
use crate::scene::{Scene, by_model};

/// `lightbvh_point`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CPoint {
    pub p: [f32; 3],
    pub n: [f32; 3],
    pub mask: u32,
}

impl CPoint {
    fn plain(&self) -> Result<ShadingPoint, Fault> {
        let Self { p, n, .. } = *self;
        let point = ShadingPoint { p, n }.checked();
        point.map_err(|error| Fault::new(Status::BadPoint, error))
    }

    fn linked(&self) -> Result<LinkedPoint<ShadingPoint>, Fault> {
        let (point, mask) = (self.plain()?, self.mask);
        Ok(LinkedPoint { point, mask })
    }
}

/// `$do` with the light BVH, whatever its model, and the function that makes its receivers.
macro_rules! by_receiver {
    ($scene:expr, $bvh:ident, $receiver:ident => $do:expr) => {
        match $scene {
            Scene::Triangles($bvh, ..) => {
                let $receiver = CPoint::plain;
                $do
            }
            Scene::Any($bvh, ..) => {
                let $receiver = CPoint::plain;
                $do
            }
            Scene::Masked($bvh, ..) => {
                let $receiver = CPoint::linked;
                $do
            }
        }
    };
}

/// Two numbers in [0, 1).
fn unit(u: f32, v: f32) -> Result<[f32; 2], Fault> {
    let uv = [u, v];
    if uv.iter().all(|number| (0.0..1.0).contains(number)) {
        return Ok(uv);
    }
    let message = format!("u and v are {u} and {v}, expected numbers in [0, 1)");
    Err(Fault::new(Status::BadPoint, message))
}

/// The position where a ray has met a light.
fn hit(position: &[f32; 3]) -> Result<[f32; 3], Fault> {
    // NaN is in no range.
    let is_far = |x: &f32| !(-MAX_COORDINATE..=MAX_COORDINATE).contains(x);
    let Some(axis) = position.iter().position(is_far) else {
        return Ok(*position);
    };
    let found = format!(
        "{} of the hit position is {}",
        ["x", "y", "z"][axis],
        position[axis]
    );
    let message = format!("coordinate {found}, expected a magnitude of at most 2^40 (1.1e12)");
    Err(Fault::new(Status::BadPoint, message))
}

/// `lightbvh_sampled`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Zeroable)]
pub struct CSampled {
    pub instance: CId,
    pub part: u32,
    pub pmf: f32,
    pub point: LightPoint,
    pub direction: [f32; 3],
    pub distance: f32,
    pub pdf: f32,
    pub irradiance: [f32; 3],
}

/// `lightbvh_range`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CRange {
    pub first: u32,
    pub count: u32,
}

/// The numbers of an instance's lights.
fn numbers_of(scene: &Scene, instance: CId) -> Result<Range<u32>, Fault> {
    let id = instance.instance()?;
    let found = by_model!(scene, bvh => bvh.view().lights_of(id));
    found.ok_or_else(|| EditReason::UnknownInstance(id).into())
}

/// The id of an instance that has a light `part`.
fn known(scene: &Scene, instance: CId, part: u32) -> Result<InstanceId, Fault> {
    let count = numbers_of(scene, instance)?.len();
    if part as usize >= count {
        let message = format!("part {part} of an instance of {count} lights");
        return Err(Fault::new(Status::NoLight, message));
    }
    instance.instance()
}

fn no_light(light: u32, instance: u32) -> Fault {
    Fault::new(
        Status::NoLight,
        format!("no light {light} in an instance {instance}"),
    )
}

/// The power heuristic with exponent 2.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_mis_weight(own: f32, other: f32) -> f32 {
    mis_weight(own, other)
}

functions! {
    /// Chooses a light for a point, and a point on it.
    fn lightbvh_sample_light(
        bvh: *const Handle, point: *const CPoint, random: u64, u: f32, v: f32, sampled: *mut CSampled
    ) {
        let scene = Handle::of(bvh, "bvh")?;
        let (point, place, uv) = (raw::shared(point, "point")?, raw::place(sampled, "sampled")?, unit(u, v)?);
        let sampled = by_receiver!(scene, bvh, receiver => {
            bvh.sample_light(&receiver(point)?, random, uv).map(|own| CSampled {
                instance: own.instance.into(),
                part: own.part,
                pmf: own.pmf,
                point: own.point,
                direction: own.direction,
                distance: own.distance,
                pdf: own.pdf,
                irradiance: own.irradiance,
            })
        });
        place.write(sampled.unwrap_or(Zeroable::zeroed()));
        Ok(())
    }

    /// The density over solid angle where a ray has met a light.
    fn lightbvh_pdf_of_hit(
        bvh: *const Handle, point: *const CPoint, instance: CId, part: u32, position: *const [f32; 3], pdf: *mut f32
    ) {
        let scene = Handle::of(bvh, "bvh")?;
        let (point, place) = (raw::shared(point, "point")?, raw::place(pdf, "pdf")?);
        let position = hit(raw::shared(position, "position")?)?;
        let id = known(scene, instance, part)?;
        let found = by_receiver!(scene, bvh, receiver => bvh.pdf_of_hit(&receiver(point)?, id, part, position));
        place.write(found.unwrap_or(0.0));
        Ok(())
    }

    /// Chooses a light for a point.
    fn lightbvh_sample(bvh: *const Handle, point: *const CPoint, random: u64, sample: *mut SampledLight) {
        let scene = Handle::of(bvh, "bvh")?;
        let (point, place) = (raw::shared(point, "point")?, raw::place(sample, "sample")?);
        let found = by_receiver!(scene, bvh, receiver => bvh.sample(&receiver(point)?, random));
        place.write(found.unwrap_or(SampledLight::NONE));
        Ok(())
    }

    /// Chooses a light for each point.
    fn lightbvh_sample_batch(
        bvh: *const Handle, points: *const CPoint, randoms: *const u64, count: usize, samples: *mut SampledLight
    ) {
        let scene = Handle::of(bvh, "bvh")?;
        let (points, randoms) = (raw::array(points, count, "points")?, raw::array(randoms, count, "randoms")?);
        let places = raw::places(samples, count, "samples")?;
        let randoms: Vec<_> = randoms.iter().map(|&bits| Random64::from(bits)).collect();
        let mut sampled = vec![SampledLight::NONE; count];
        // Nothing is written where one of them is bad.
        by_receiver!(scene, bvh, receiver => {
            let points = points.iter().enumerate();
            let points = points.map(|(index, point)| receiver(point).map_err(|fault| fault.at("point", index)));
            bvh.tree().sample_batch(&points.collect::<Result<Vec<_>, _>>()?, &randoms, &mut sampled);
        });
        places.iter_mut().zip(sampled).for_each(|(place, own)| _ = place.write(own));
        Ok(())
    }

    /// The probability of a light at a point, as a sample names it.
    fn lightbvh_pmf(bvh: *const Handle, point: *const CPoint, light: u32, instance: u32, pmf: *mut f32) {
        let scene = Handle::of(bvh, "bvh")?;
        let (point, place) = (raw::shared(point, "point")?, raw::place(pmf, "pmf")?);
        place.write(by_receiver!(scene, bvh, receiver => bvh.tree().pmf(&receiver(point)?, light, instance)));
        Ok(())
    }

    /// The probability of a light at a point, by its id.
    fn lightbvh_pmf_of(bvh: *const Handle, point: *const CPoint, instance: CId, part: u32, pmf: *mut f32) {
        let scene = Handle::of(bvh, "bvh")?;
        let (point, place) = (raw::shared(point, "point")?, raw::place(pmf, "pmf")?);
        let id = known(scene, instance, part)?;
        let found = by_receiver!(scene, bvh, receiver => bvh.pmf(&receiver(point)?, id, part));
        place.write(found.unwrap_or(0.0));
        Ok(())
    }

    /// Whose light a sample names.
    fn lightbvh_owner(bvh: *const Handle, light: u32, instance: u32, id: *mut CId, part: *mut u32) {
        let scene = Handle::of(bvh, "bvh")?;
        let (place, part) = (raw::place(id, "id")?, raw::place(part, "part")?);
        let sample = SampledLight { light, instance, pmf: 1.0 };
        let found = by_model!(scene, bvh => bvh.owner(&sample).map(|own| (own.instance, own.part)));
        let found = found.ok_or_else(|| no_light(light, instance))?;
        place.write(found.0.into());
        part.write(found.1);
        Ok(())
    }

    /// A point on the light that a sample names.
    fn lightbvh_point_of(
        bvh: *const Handle, point: *const CPoint, light: u32, instance: u32, u: f32, v: f32, on: *mut LightPoint
    ) {
        let scene = Handle::of(bvh, "bvh")?;
        let from = raw::shared(point, "point")?.plain()?.position();
        let (place, uv) = (raw::place(on, "on")?, unit(u, v)?);
        let found = by_model!(scene, bvh => bvh.view().light(light, instance).map(|own| own.point_for(from, uv)));
        place.write(found.ok_or_else(|| no_light(light, instance))?);
        Ok(())
    }

    /// The id of the mesh of an index.
    fn lightbvh_mesh_at(bvh: *const Handle, index: u32, id: *mut CId) {
        let scene = Handle::of(bvh, "bvh")?;
        let place = raw::place(id, "id")?;
        let missing = || Fault::new(Status::UnknownMesh, format!("no mesh of index {index}"));
        place.write(by_model!(scene, bvh => bvh.view().mesh_id(index)).ok_or_else(missing)?.into());
        Ok(())
    }

    /// The id of the instance of an index.
    fn lightbvh_instance_at(bvh: *const Handle, index: u32, id: *mut CId) {
        let scene = Handle::of(bvh, "bvh")?;
        let place = raw::place(id, "id")?;
        let missing = || Fault::new(Status::UnknownInstance, format!("no instance of index {index}"));
        place.write(by_model!(scene, bvh => bvh.view().instance_id(index)).ok_or_else(missing)?.into());
        Ok(())
    }

    /// The numbers of an instance's lights.
    fn lightbvh_lights_of(bvh: *const Handle, instance: CId, first: *mut u32, count: *mut u32) {
        let scene = Handle::of(bvh, "bvh")?;
        let (first, count) = (raw::place(first, "first")?, raw::place(count, "count")?);
        let lights = numbers_of(scene, instance)?;
        first.write(lights.start);
        count.write(lights.end - lights.start);
        Ok(())
    }

    /// The numbers of lights that are no more.
    fn lightbvh_removed_lights(bvh: *const Handle, ranges: *mut CRange, capacity: usize, count: *mut usize) {
        let scene = Handle::of(bvh, "bvh")?;
        let removed = by_model!(scene, bvh => bvh.view().removed_lights()).iter();
        let removed = removed.map(|own| CRange { first: own.start, count: own.end - own.start });
        raw::list(ranges, capacity, count, removed)
    }

    /// The words of a light BVH.
    fn lightbvh_words(bvh: *const Handle, words: *mut u32, capacity: usize, count: *mut usize) {
        let scene = Handle::of(bvh, "bvh")?;
        raw::list(words, capacity, count, by_model!(scene, bvh => bvh.to_words()).into_iter())
    }
}
