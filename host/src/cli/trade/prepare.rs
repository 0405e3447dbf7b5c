//! From a scene to configurations that have followed its lights to the frame that is measured.

use std::sync::Arc;

use lightbvh::ShadingPoint;

use super::Args;
use super::choices::{Axis, Subject, all};
use super::image::Budget;
use super::reservoirs::HISTORY;
use super::update::{Frame, Updates};
use crate::backend::SceneArrays;
use crate::cli::table::news;
use crate::cli::variance::points;
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
    pub background: [f32; 3],
}

type Shown = Option<Arc<SceneArrays>>;

/// A frame whose images are measured: the configurations as they are in it, their updates so far, what to render and its
/// background.
pub(super) type InFrame<'a> =
    dyn FnMut(&mut [Box<dyn Subject>], &[Updates], &SceneArrays, [f32; 3]) -> Result<(), HostError> + 'a;

/// Builds what is asked for at the first frame and brings it to the last one that is measured; `in_frame` is called in each of
/// `measured`, which ascend to that one.
pub(super) fn prepare(
    name: &str,
    args: &Args,
    budget: &Budget,
    measured: &[u32],
    in_frame: &mut InFrame<'_>,
) -> Result<Prepared, HostError> {
    let scene = Scene::open(name)?;
    for warning in scene.warnings().iter().chain(&scene.unknown_lights()) {
        news!("{name}: {warning}");
    }
    scene.require_lights()?;
    let points = points::on_surfaces(&scene, args.frame, budget.points);
    // ReSTIR looks back from the frames that are measured.
    let looks_back = args.axes.is_empty() || args.axes.contains(&Axis::Integrator);
    let arrays = |number: u32| {
        let back = if looks_back { HISTORY } else { 0 };
        let wanted = measured.iter().any(|&at| number <= at && number + back >= at);
        let made = wanted.then(|| arrays_at(&scene, number, budget.width, budget.height));
        made.transpose().map(|arrays| arrays.map(Arc::new))
    };
    let first = lights_at(&scene, 0)?;
    let mut shown = arrays(0)?;
    let mut subjects: Vec<Box<dyn Subject>> =
        all(&Frame::new(&scene, 0, &first).rendered_from(shown.as_ref()))?
            .into_iter()
            .filter(|subject| {
                let axis = subject.config().axis;
                axis == Axis::Default || args.axes.is_empty() || args.axes.contains(&axis)
            })
            .collect();
    news!(
        "{name}: {} choices follow its lights to frame {}",
        subjects.len(),
        args.frame
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
    for number in 1..=args.frame {
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
        None => Arc::new(arrays_at(&scene, args.frame, budget.width, budget.height)?),
    };
    let background = scene.frame(args.frame).background;
    Ok(Prepared {
        scene,
        points,
        subjects,
        updates,
        arrays,
        background,
    })
}
