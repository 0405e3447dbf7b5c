//! From a scene to configurations that have followed its lights to the frame that is measured.

use lightbvh::ShadingPoint;

use super::choices::all;
use super::image::Budget;
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
    pub arrays: SceneArrays,
}

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
    let arrays_at = |number: u32| arrays_at(&scene, number, budget.width, budget.height);
    let first = lights_at(&scene, 0)?;
    let mut subjects = all(&Frame::new(&scene, 0, &first), is_wanted)?;
    news!(
        "{name}: {} choices follow its lights to frame {last}",
        subjects.len()
    );
    let mut updates = vec![Updates::default(); subjects.len()];
    let mut measure = |number: u32, subjects: &mut [Box<dyn Subject>], updates: &[Updates]| {
        if !measured.contains(&number) {
            return Ok(());
        }
        let arrays = arrays_at(number)?;
        news!("{name}: frame {number}, images by {} choices", subjects.len());
        in_frame(subjects, updates, &arrays, scene.frame(number).background)
    };
    measure(0, &mut subjects, &updates)?;
    for number in 1..=last {
        let lights = lights_at(&scene, number)?;
        for k in 0..subjects.len() {
            let at = (k + number as usize) % subjects.len();
            updates[at].push(subjects[at].advance(&Frame::new(&scene, number, &lights))?);
        }
        measure(number, &mut subjects, &updates)?;
    }
    let arrays = arrays_at(last)?;
    Ok(Prepared {
        scene,
        points,
        subjects,
        updates,
        arrays,
    })
}
