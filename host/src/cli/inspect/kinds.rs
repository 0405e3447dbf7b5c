//! A scene that no triangle lights: what its lights are, the tree over all of their kinds, and whether that tree serves.

use lightbvh::exact::hash;
use lightbvh::importance::DefaultImportance;
use lightbvh::light::{AnyLight, Light};
use lightbvh::node::{Holds, Lit, Node};
use lightbvh::requirements::Declared;
use lightbvh::{BuildParams, Lights, MomentNode, ShadingPoint};
use lightbvh_kernels::bvh::{AnyNode, Kinds, WIDTH};
use serde::Serialize;
use serde_json::json;

use super::light_kinds::LightKinds;
use super::motion::Motion;
use super::options::Args;
use super::report::line;
use super::said::changes;
use super::steps::{SAMPLES_IN_A_TURN, TURNS};
use super::subject::time;
use super::surfaces::Surfaces;
use super::{MOST_PROBABILITIES, animations, declared};
use crate::cli::measure::interval::Interval;
use crate::cli::measure::times::in_turns;
use crate::cli::measure::{NOT_MEASURED, kinds::irradiance_of, mean_of, points, variance};
use crate::cli::{Context, Outcome, table};
use crate::error::HostError;
use crate::scene::{Instances, Scene};
use crate::workload::lights_of;

/// Without beams: for scenes none of whose lights has a cone.
type Plain = Lit<MomentNode<WIDTH>, AnyLight>;

/// What was found of a tree.
#[derive(Serialize)]
struct Checked {
    /// The invariant that does not hold, if any.
    violation: Option<String>,
    /// Points that probabilities were asked for at, and how many were asked for.
    points: usize,
    probabilities: usize,
    /// How many lights that send light to a point are never chosen there.
    unreached: usize,
    /// Mean over the points that any light reaches of the relative variance of one sample.
    variance: Option<f64>,
    nodes: usize,
    depth: u32,
    bytes_per_light: f64,
    memory_per_light: f64,
    ns_per_sample: Interval,
}

impl Checked {
    fn holds(&self) -> bool {
        self.violation.is_none() && self.unreached == 0
    }
}

/// The whole command for such a scene.
pub(super) fn run(context: &Context, args: &Args, scene: &Scene) -> Result<Outcome, HostError> {
    let parts = ["layout", "levels", "uniform share", "updates"];
    if parts.iter().any(|part| args.asks_for(part)) {
        return Err(HostError::Usage {
            option: "--layout, --levels, --uniform or --updates",
            needs: "a scene with emissive triangles; over lights of other kinds there is one tree to choose",
        });
    }
    let motion = Motion::of::<Kinds>(scene)?;
    let surfaces = Surfaces::of(scene);
    let declared = declared(args, &motion);
    // What is refitted is looked at after a refit.
    let moved = args.frame + u32::from(declared.transforms);
    let lights = lights_of::<AnyLight>(scene, moved)?;
    let most = MOST_PROBABILITIES / lights.triangles().len().max(1);
    let count = args.points.min((most as u32).max(1));
    let points = points::on_surfaces(scene, moved, count);
    let kinds = LightKinds::of(lights.triangles());
    let checked = match (lights.triangles().len(), kinds.narrow) {
        // Suns and maps alone: there is nothing that a tree would choose among.
        (0, _) => None,
        (_, 0) => Some(check::<Plain>(scene, [args.frame, moved], &lights, &points)?),
        _ => Some(check::<AnyNode>(scene, [args.frame, moved], &lights, &points)?),
    };
    let holds = checked.as_ref().is_none_or(Checked::holds);
    let tree = format!("Bvh<{}, Defensive<Moments, 6>, {WIDTH}>", kinds.node_type(WIDTH));
    if context.json {
        table::print_json(&json!({
            "scene": scene.name(), "frame": args.frame, "checked_frame": moved, "lights": lights.triangles().len(),
            "kinds": { "said": kinds.said(), "narrow": kinds.narrow, "light": kinds.light_type(), "node": kinds.node_type(WIDTH) },
            "suns": scene.sun_count(), "environment": scene.data().environment.is_some(),
            "motion": motion, "animations": animations(scene), "surfaces": surfaces, "tree": checked.as_ref().map(|_| tree), "checked": checked, "holds": holds,
        }))?;
    } else {
        let about = About {
            scene,
            args,
            declared,
            motion: &motion,
            surfaces,
            kinds,
        };
        let mut text = about.required(lights.triangles().len());
        if let Some(checked) = &checked {
            text += &found(&tree, [args.frame, moved], checked);
        }
        table::print_text(&text)?;
    }
    Ok(Outcome::good_if(holds))
}

/// What the text is about.
struct About<'a> {
    scene: &'a Scene,
    args: &'a Args,
    declared: Declared,
    motion: &'a Motion,
    surfaces: Surfaces,
    kinds: LightKinds,
}

impl About<'_> {
    /// What the scene requires.
    fn required(&self, lights: usize) -> String {
        let Self { scene, kinds, .. } = self;
        let [gloss, masks] = self.surfaces.said();
        let mut text = format!(
            "{} in frame {}, lit by {}\n\nwhat it requires\n",
            scene.name(),
            self.args.frame,
            scene.other_lights()
        );
        let of_tree = match lights {
            0 => String::from("none; what lights the scene stands beside trees"),
            _ => format!(
                "{}; {} of them send their light into a cone of less than 90 degrees",
                kinds.said(),
                kinds.narrow
            ),
        };
        text += &line("lights of a tree", &of_tree);
        if scene.sun_count() > 0 || scene.data().environment.is_some() {
            text += &line(
                "beside it",
                "suns and environment maps (lightbvh::light::infinite)",
            );
        }
        let is_glossy = table::yes(self.surfaces.glossy > 0);
        text += &line("changes", &table::yes(!changes(&self.declared).is_empty()));
        text += &line("glossy receivers", &format!("{is_glossy}: {gloss}"));
        text += &line("pmf of given lights", &table::yes(self.declared.pmf));
        text += &line("masks", &masks);
        text += &line("animation", &self.motion.said());
        for note in self.motion.notes() {
            text += &line("", &note);
        }
        text
    }
}

/// What was found of the tree over the lights, which was built in one frame and looked at in another.
fn found(tree: &str, [first, moved]: [u32; 2], checked: &Checked) -> String {
    let mut text = format!("\na tree over its lights: {tree}, two levels\n");
    let refitted = match moved == first {
        true => String::new(),
        false => format!(" in frame {moved}, after a refit"),
    };
    text += &match &checked.violation {
        None => format!("every invariant holds{refitted}\n"),
        Some(violation) => {
            format!("{violation}{refitted}: this is a fault of lightbvh; please report it\n")
        }
    };
    let memory = format!(
        "{} nodes, {} deep; {:.1} bytes per light that sampling reads, {:.1} in all arrays",
        checked.nodes, checked.depth, checked.bytes_per_light, checked.memory_per_light
    );
    text += &match (checked.points, checked.variance) {
        (0, _) => format!("there is no surface that is shown, so nothing was asked\n{memory}\n"),
        (points, None) => {
            format!("from {points} points on surfaces: {NOT_MEASURED}\n{memory}\n")
        }
        (points, Some(variance)) => format!(
            "{} probabilities from {points} points on surfaces: {} lights that send light there are never chosen; variance of one sample {variance:.4}\n\
                 {memory}, {:.0} ns per sample\n",
            checked.probabilities, checked.unreached, checked.ns_per_sample.median
        ),
    };
    text
}

/// Builds the tree in the first of the frames, moves it to the second, and asks it.
fn check<N: Node<WIDTH> + Holds<Light = AnyLight>>(
    scene: &Scene,
    [first, moved]: [u32; 2],
    lights: &Lights<AnyLight>,
    points: &[ShadingPoint],
) -> Result<Checked, HostError>
where
    DefaultImportance: lightbvh::ImportanceModel<N, WIDTH>,
{
    let refused = |error| HostError::in_frame(scene.name(), moved, error);
    let (mut bvh, mut instances) =
        Instances::<AnyLight>::new::<N, DefaultImportance, WIDTH>(scene, first, BuildParams::default())
            .map_err(refused)?;
    bvh.apply(instances.edits(scene, moved)).map_err(refused)?;
    bvh.refit();
    let lights = lights.triangles();
    let (mut unreached, mut variances) = (0, Vec::new());
    for point in points {
        variances.extend(variance((0..).zip(lights).map(|(number, light)| {
            let sent = irradiance_of(light, point);
            if sent <= 0.0 {
                return (sent, 0.0);
            }
            let pmf = f64::from(bvh.pmf(point, number, light.mesh()));
            unreached += usize::from(pmf <= 0.0);
            (sent, pmf)
        })));
    }
    let passes = SAMPLES_IN_A_TURN.div_ceil((points.len() as u32).max(1));
    let samples = passes * (points.len() as u32).max(1);
    let mut times = in_turns(1, TURNS, samples, |_, turn| {
        Ok(time(points, hash(turn), passes, |point, number| {
            bvh.sample(point, number)
        }))
    })?;
    let ns_per_sample = Interval::of(times.remove(0));
    let per_light = |bytes: usize| bytes as f64 / lights.len().max(1) as f64;
    Ok(Checked {
        violation: bvh.validate().err().map(|violation| violation.to_string()),
        points: points.len(),
        probabilities: points.len() * lights.len(),
        unreached,
        variance: mean_of(&variances),
        nodes: bvh.nodes().len() + bvh.top_nodes().len(),
        depth: bvh.depth(),
        bytes_per_light: per_light(bvh.bytes()),
        memory_per_light: per_light(bvh.memory()),
        ns_per_sample,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::measure::tests::room;

    fn checked(is_lit: bool) -> Checked {
        let scene = room(is_lit, Some([0.2, 0.2, -1.0]));
        let lights = lights_of::<AnyLight>(&scene, 0).expect("lights");
        let points = points::on_surfaces(&scene, 0, 16);
        check::<Plain>(&scene, [0; 2], &lights, &points).expect("a tree")
    }

    #[test]
    fn what_is_not_measured_has_no_figure() {
        let dark = checked(false);
        assert_eq!((dark.points, dark.variance), (16, None));
        assert!(json!(dark)["variance"].is_null());
        let text = found("Bvh", [0; 2], &dark);
        assert!(
            text.contains("nothing is measured") && !text.contains("never chosen"),
            "{text}"
        );
        let lit = checked(true);
        assert!(lit.variance.is_some());
        let text = found("Bvh", [0; 2], &lit);
        assert!(
            text.contains("never chosen") && !text.contains("nothing is measured"),
            "{text}"
        );
    }
}
