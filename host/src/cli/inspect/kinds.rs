//! A scene that no triangle lights: its kinds of light, the tree over all of them, and whether that tree serves.

use lightbvh::importance::DefaultImportance;
use lightbvh::light::{AnyLight, Light};
use lightbvh::node::{Holds, Lit, Node};
use lightbvh::requirements::Declared;
use lightbvh::{BuildParams, Lights, MomentNode, ShadingPoint};
use lightbvh_kernels::bvh::{AnyNode, WIDTH};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Args, changes, line};
use crate::cli::measure::{NOT_MEASURED, kinds::irradiance_of, mean_of, points, variance};
use crate::cli::{Context, Outcome, table};
use crate::error::HostError;
use crate::scene::{Instances, Scene};
use crate::workload::lights_of;

/// Lights by their kind.
pub(super) struct LightKinds {
    /// How many of each, by [`AnyLight::kind`].
    counts: [usize; 8],
    /// How many send their light into a cone: spots and profiles of less than a right angle around their axis.
    narrow: usize,
}

/// The kinds by their number: one, several, and the type.
const NAMES: [[&str; 3]; 8] = [
    ["triangle", "triangles", "EmissiveTriangle"],
    ["point", "points", "PointLight"],
    ["spot", "spots", "SpotLight"],
    ["sphere", "spheres", "SphereLight"],
    ["rectangle", "rectangles", "RectangleLight"],
    ["disc", "discs", "DiscLight"],
    ["box", "boxes", "BoxLight"],
    ["profile", "profiles", "ProfileLight"],
];

impl LightKinds {
    /// Of lights; those of kinds that are not known are not counted.
    pub fn of(lights: &[AnyLight]) -> Self {
        let (mut counts, mut narrow) = ([0; 8], 0);
        for light in lights {
            if let Some(count) = counts.get_mut(light.kind() as usize) {
                *count += 1;
            }
            narrow += usize::from(light.has_flux() && light.beam().is_narrow());
        }
        Self { counts, narrow }
    }

    /// The type of the lights: the only kind that there is, or [`AnyLight`].
    fn light_type(&self) -> &'static str {
        let mut there = (0..8).filter(|&kind| self.counts[kind] > 0);
        match (there.next(), there.next()) {
            (Some(kind), None) => NAMES[kind][2],
            _ => "AnyLight",
        }
    }

    /// The type of a node `width` wide over all of them, as Rust has it. With cones
    /// ([`SpotMomentNode`](lightbvh::node::SpotMomentNode)) where any light has one: without, points beside its cone choose it,
    /// which costs variance and no bias.
    pub fn node_type(&self, width: usize) -> String {
        let layout = ["MomentNode", "SpotMomentNode"][usize::from(self.narrow > 0)];
        match self.light_type() {
            "EmissiveTriangle" => format!("{layout}<{width}>"),
            light => format!("Lit<{layout}<{width}>, {light}>"),
        }
    }

    /// How many there are of each, in words; empty where there is none.
    fn said(&self) -> String {
        let named = self.counts.iter().zip(NAMES).filter(|(count, _)| **count > 0);
        let parts = named.map(|(count, names)| format!("{count} {}", names[usize::from(*count > 1)]));
        parts.collect::<Vec<_>>().join(", ")
    }

    /// The same, and how many have a cone.
    pub fn cones(&self) -> String {
        let (said, narrow) = (self.said(), self.narrow);
        format!("{said}; {narrow} of them send their light into a cone of less than 90 degrees")
    }

    pub fn json(&self) -> Value {
        json!({ "said": self.said(), "narrow": self.narrow, "light": self.light_type(), "node": self.node_type(WIDTH) })
    }
}

/// Figures of a tree.
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
}

/// The rest of the command for such a scene, whose `report` and lines `about` it are begun.
pub(super) fn run(
    context: &Context,
    args: &Args,
    scene: &Scene,
    (frames, declared): ([u32; 2], Declared),
    (mut report, about): (Value, &str),
) -> Result<Outcome, HostError> {
    let lights = lights_of::<AnyLight>(scene, frames[1])?;
    let count = lights.triangles().len();
    let points = points::on_surfaces(scene, frames[1], args.points_for(count));
    let kinds = LightKinds::of(lights.triangles());
    let checked = match (count, kinds.narrow) {
        // Suns and maps alone: there is nothing that a tree would choose among.
        (0, _) => None,
        (_, 0) => Some(check::<Lit<MomentNode<WIDTH>, AnyLight>>(
            scene, frames, &lights, &points,
        )?),
        _ => Some(check::<AnyNode>(scene, frames, &lights, &points)?),
    };
    let holds = |own: &Checked| own.violation.is_none() && own.unreached == 0;
    let holds = checked.as_ref().is_none_or(holds);
    let tree = format!("Bvh<{}, Defensive<Moments, 6>, {WIDTH}>", kinds.node_type(WIDTH));
    if context.json {
        report["lights"] = count.into();
        report["kinds"] = kinds.json();
        report["suns"] = scene.sun_count().into();
        report["environment"] = scene.data().environment.is_some().into();
        report["tree"] = checked.as_ref().map(|_| tree).into();
        report["checked"] = json!(checked);
        report["holds"] = holds.into();
        table::print_json(&report)?;
        return Ok(Outcome::good_if(holds));
    }
    let mut text = format!(
        "{} in frame {}, lit by {}\n\nwhat it requires\n",
        scene.name(),
        args.frame,
        scene.other_lights()
    );
    text += &match count {
        0 => line(
            "lights of a tree",
            "none; what lights the scene stands beside trees",
        ),
        _ => line("lights of a tree", &kinds.cones()),
    };
    if scene.sun_count() > 0 || scene.data().environment.is_some() {
        text += &line(
            "beside it",
            "suns and environment maps (lightbvh::light::infinite)",
        );
    }
    text += &line("changes", &table::yes(!changes(&declared).is_empty()));
    text += about;
    if let Some(checked) = &checked {
        text += &found(&tree, frames, checked);
    }
    table::print_text(&text)?;
    Ok(Outcome::good_if(holds))
}

/// The figures of the tree over the lights in words; it was built in one frame and looked at in another.
fn found(tree: &str, [first, moved]: [u32; 2], checked: &Checked) -> String {
    let refitted = match moved == first {
        true => String::new(),
        false => format!(" in frame {moved}, after a refit"),
    };
    let sound = match &checked.violation {
        None => format!("every invariant holds{refitted}"),
        Some(violation) => {
            format!("{violation}{refitted}: this is a fault of lightbvh; please report it")
        }
    };
    let asked = match (checked.points, checked.variance) {
        (0, _) => "there is no surface that is shown, so nothing was asked".to_owned(),
        (points, None) => format!("from {points} points on surfaces: {NOT_MEASURED}"),
        (points, Some(variance)) => format!(
            "{} probabilities from {points} points on surfaces: {} lights that send light there are never chosen; variance of one sample \
             {variance:.4}",
            checked.probabilities, checked.unreached
        ),
    };
    format!(
        "\na tree over its lights: {tree}, two levels\n{sound}\n{asked}\n{} nodes, {} deep; {:.1} bytes per light that sampling reads, \
         {:.1} in all arrays\n",
        checked.nodes, checked.depth, checked.bytes_per_light, checked.memory_per_light
    )
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
    })
}

#[cfg(test)]
mod tests {
    use lightbvh::light::{PointLight, SpotLight};

    use super::*;
    use crate::cli::measure::tests::room;

    #[test]
    fn points_without_light_have_no_figure() {
        for is_lit in [false, true] {
            let scene = room(is_lit, Some([0.2, 0.2, -1.0]));
            let lights = lights_of::<AnyLight>(&scene, 0).expect("lights");
            let points = points::on_surfaces(&scene, 0, 16);
            let checked = check::<AnyNode>(&scene, [0; 2], &lights, &points).expect("a tree");
            assert_eq!((checked.points, checked.variance.is_some()), (16, is_lit));
            let text = found("Bvh", [0; 2], &checked);
            assert_eq!(text.contains("nothing is measured"), !is_lit, "{text}");
            assert_eq!(text.contains("never chosen"), is_lit, "{text}");
        }
    }

    #[test]
    fn the_least_type_that_holds_all() {
        let point = AnyLight::from(PointLight {
            p: [0.0; 3],
            intensity: [1.0; 3],
            range: 0.0,
            mesh: 0,
        });
        let spot = |cos_outer, intensity| {
            AnyLight::from(SpotLight {
                p: [0.0; 3],
                intensity: [intensity; 3],
                range: 0.0,
                axis: [0.0, -1.0, 0.0],
                cos_inner: 1.0,
                cos_outer,
                mesh: 0,
            })
        };
        for (lights, node, said) in [
            (&[point][..], "Lit<MomentNode<8>, PointLight>", "1 point"),
            (&[spot(0.5, 1.0)], "Lit<SpotMomentNode<8>, SpotLight>", "1 spot"),
            // A cone of a right angle and one without light need no cones.
            (&[spot(0.0, 1.0)], "Lit<MomentNode<8>, SpotLight>", "1 spot"),
            (
                &[point, spot(0.5, 0.0)],
                "Lit<MomentNode<8>, AnyLight>",
                "1 point, 1 spot",
            ),
            (
                &[spot(0.5, 1.0), spot(0.0, 1.0), point],
                "Lit<SpotMomentNode<8>, AnyLight>",
                "1 point, 2 spots",
            ),
            (&[], "Lit<MomentNode<8>, AnyLight>", ""),
        ] {
            let kinds = LightKinds::of(lights);
            assert_eq!((kinds.node_type(8).as_str(), kinds.said().as_str()), (node, said));
        }
    }
}
