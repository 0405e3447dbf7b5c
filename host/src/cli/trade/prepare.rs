//! From a scene to configurations that have followed its lights to the frame that is measured.

use std::sync::Arc;

use lightbvh::ShadingPoint;

use super::Args;
use super::choices::{Axis, Subject, all};
use super::image::Budget;
use super::reservoirs::HISTORY;
use super::update::{Frame, Updates};
use crate::backend::SceneArrays;
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

/// Builds what is asked for at the first frame and brings it to the one that is measured.
pub(super) fn prepare(name: &str, args: &Args, budget: &Budget) -> Result<Prepared, HostError> {
    let scene = Scene::open(name)?;
    for warning in scene.warnings() {
        eprintln!("{name}: {warning}");
    }
    let (_, points) = points::of(name, 0, args.frame, budget.points)?;
    // ReSTIR looks back from the frame that is measured.
    let looks_back = args.axes.is_empty() || args.axes.contains(&Axis::Integrator);
    let arrays = |number: u32| {
        let wanted = number == args.frame || (looks_back && number + HISTORY >= args.frame);
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
    let mut updates = vec![Updates::default(); subjects.len()];
    for number in 1..=args.frame {
        let lights = lights_at(&scene, number)?;
        shown = arrays(number)?;
        for k in 0..subjects.len() {
            let at = (k + number as usize) % subjects.len();
            let frame = Frame::new(&scene, number, &lights).rendered_from(shown.as_ref());
            updates[at].push(subjects[at].advance(&frame)?);
        }
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
