//! A backend on the CPU, and the devices that are compared with it.

use bytemuck::{NoUninit, cast_slice};
use lightbvh::INVALID;
use lightbvh::exact::hash;
use lightbvh_kernels::query::Query;

use super::tally::{Kind, Tallies};
use crate::backend::{Backend, BackendError, PMF_RECORD, SAMPLED_RECORD};
use crate::error::HostError;
use crate::scene::SceneLight;
use crate::words::Record;

/// One backend on the CPU and on each device.
pub(super) struct Side<'a, L: SceneLight> {
    pub cpu: &'a mut dyn Backend<L>,
    pub devices: Vec<&'a mut dyn Backend<L>>,
}

impl<L: SceneLight> Side<'_, L> {
    /// Compares what `work` gives on each device with what it gives on the CPU, which is returned.
    pub fn compare<T: NoUninit>(
        &mut self,
        tallies: &mut Tallies,
        kind: Kind,
        what: &str,
        record: &Record,
        work: impl Fn(&mut dyn Backend<L>) -> Result<Vec<T>, BackendError>,
    ) -> Result<Vec<T>, HostError> {
        let expected = work(self.cpu)?;
        for (device, tally) in self.devices.iter_mut().zip(&mut tallies.devices) {
            let found = work(&mut **device)?;
            tally.take(kind, what, record, cast_slice(&expected), cast_slice(&found))?;
        }
        Ok(expected)
    }

    /// Sample, then pmf: of the light sampled for every query but each eighth, which asks for some of the `lights` in the
    /// world, of one level or two. What the CPU evaluates again must be what it sampled.
    pub fn compare_queries(
        &mut self,
        tallies: &mut Tallies,
        what: &dyn Fn(&str) -> String,
        mut asked: Vec<Query>,
        (lights, single): (&[L], bool),
    ) -> Result<(), HostError> {
        let sampled = self.compare(
            tallies,
            Kind::Samples,
            &what("sample"),
            &SAMPLED_RECORD,
            |backend| Ok(backend.sample(&asked)?.value),
        )?;
        for (i, (query, sampled)) in asked.iter_mut().zip(&sampled).enumerate() {
            query.words = if i % 8 == 7 && !lights.is_empty() {
                let light = hash(i as u32) % lights.len() as u32;
                let mesh = lights[light as usize].mesh();
                [light, if single { INVALID } else { mesh }]
            } else {
                [sampled.light, sampled.instance]
            };
        }
        let pmfs = self.compare(tallies, Kind::Pmfs, &what("pmf"), &PMF_RECORD, |backend| {
            Ok(backend.pmf(&asked)?.value)
        })?;
        let again: (Vec<u32>, Vec<u32>) = asked
            .iter()
            .zip(sampled.iter().zip(&pmfs))
            .filter(|(query, (sampled, _))| query.words[0] == sampled.light)
            .map(|(_, (sampled, pmf))| (sampled.pmf.to_bits(), pmf.to_bits()))
            .unzip();
        let what = what("sample against pmf");
        tallies
            .cpu
            .take(Kind::Pmfs, &what, &PMF_RECORD, &again.0, &again.1)
    }
}
