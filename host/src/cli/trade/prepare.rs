//! From a scene to configurations that have followed its lights to the frame that is measured.

use std::sync::Arc;

use lightbvh::ShadingPoint;

use super::choices::all;
use super::image::Budget;
use super::reservoirs::HISTORY;
use super::subject::{Axis, Subject};
use super::update::{Frame, Updates};
use crate::backend::SceneArrays;
use crate::cli::measure::points;
use crate::cli::table::news;
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{arrays_at, lights_at};

/// The configurations at the frame that is measured.
pub(super) struct Prepared {
    pub scene: Scene,
    pub points: Vec<ShadingPoint>,
    pub subjects: Vec<Box<dyn Subject>>,
    pub updates: Vec<Updates>,
    pub arrays: Arc<SceneArrays>,
}

type Shown = Option<Arc<SceneArrays>>;

/// A frame whose images are measured: the configurations as they are in it, their updates so far, what to render and its
/// background.
pub(super) type InFrame<'a> =
    dyn FnMut(&mut [Box<dyn Subject>], &[Updates], &SceneArrays, [f32; 3]) -> Result<(), HostError> + 'a;

/// Builds what is asked for at the first frame and brings it to the last one that is measured; `in_frame` is called in each of
/// `measured`, which ascend to that one.
pub(super) fn prepare(
    scene: Scene,
    is_wanted: &dyn Fn(Axis) -> bool,
    budget: &Budget,
    measured: &[u32],
    in_frame: &mut InFrame<'_>,
) -> Result<Prepared, HostError> {
    let name = scene.name().to_owned();
    for warning in scene.warnings().iter().chain(&scene.unknown_lights()) {
        news!("{name}: {warning}");
    }
    scene.require_lights()?;
    let last = measured.last().copied().unwrap_or(0);
    let points = points::on_surfaces(&scene, last, budget.points);
    // ReSTIR looks back from the frames that are measured.
    let looks_back = is_wanted(Axis::Integrator);
    let arrays = |number: u32| {
        let back = if looks_back { HISTORY } else { 0 };
        let wanted = measured.iter().any(|&at| number <= at && number + back >= at);
        let made = wanted.then(|| arrays_at(&scene, number, budget.width, budget.height));
        made.transpose().map(|arrays| arrays.map(Arc::new))
    };
    let first = lights_at(&scene, 0)?;
    let mut shown = arrays(0)?;
    let first = Frame::new(&scene, 0, &first).rendered_from(shown.as_ref());
    let mut subjects = all(&first, is_wanted)?;
    news!(
        "{name}: {} choices follow its lights to frame {last}",
        subjects.len()
    );
    let mut updates = vec![Updates::default(); subjects.len()];
    let mut measure =
        |number: u32, subjects: &mut [Box<dyn Subject>], updates: &[Updates], shown: &Shown| match shown {
            Some(arrays) if measured.contains(&number) => {
                news!("{name}: frame {number}, images by {} choices", subjects.len());
                in_frame(subjects, updates, arrays, scene.frame(number).background)
            }
            _ => Ok(()),
        };
    measure(0, &mut subjects, &updates, &shown)?;
    for number in 1..=last {
        let lights = lights_at(&scene, number)?;
        shown = arrays(number)?;
        for k in 0..subjects.len() {
            let at = (k + number as usize) % subjects.len();
            let frame = Frame::new(&scene, number, &lights).rendered_from(shown.as_ref());
            updates[at].push(subjects[at].advance(&frame)?);
        }
        measure(number, &mut subjects, &updates, &shown)?;
    }
    let arrays = match shown {
        Some(arrays) => arrays,
        None => Arc::new(arrays_at(&scene, last, budget.width, budget.height)?),
    };
    Ok(Prepared {
        scene,
        points,
        subjects,
        updates,
        arrays,
    })
}
