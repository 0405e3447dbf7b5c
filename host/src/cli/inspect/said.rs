//! What a scene requires and why, in words.

use lightbvh::requirements::{Declared, Layout, Requirements, Updates};
use serde::Serialize;

use crate::cli::table::yes;

/// A fact about a scene's lights.
#[derive(Serialize)]
pub(super) struct Fact {
    /// What is asked.
    pub name: &'static str,
    /// The answer.
    pub found: String,
    /// Where it is from.
    pub reason: String,
}

/// What changes; nothing where everything stays.
pub(super) fn changes(declared: &Declared) -> Vec<&'static str> {
    let named = [
        (declared.transforms, "instances move"),
        (declared.radiance, "instances are dimmed"),
        (declared.instances, "instances come and go"),
        (declared.meshes, "meshes come"),
        (declared.triangles, "meshes deform or vary in emission"),
    ];
    let there = named.into_iter().filter(|(is, _)| *is);
    there.map(|(_, what)| what).collect()
}

/// Every fact, each with its reason.
pub(super) fn facts(found: &Requirements, is_glossy: bool) -> Vec<Fact> {
    let Requirements {
        triangles,
        one_sided,
        declared,
        ..
    } = *found;
    let changes = changes(&declared);
    let changed = match changes.is_empty() {
        true => "everything stays as it is".to_owned(),
        false => changes.join(", "),
    };
    let kinds = [
        "identity",
        "translations",
        "rigid",
        "uniform scales",
        "non-uniform",
    ];
    let counts = kinds.iter().zip(found.transforms);
    let counts = counts.filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(kind, count)| format!("{count} {kind}")).collect();
    let orientation = if one_sided > 0 { "present" } else { "absent" };
    let facts = [
        (
            "orientation",
            orientation.to_owned(),
            format!("{one_sided} of {triangles} triangles shine from one side"),
        ),
        (
            "two-sided only",
            yes(one_sided == 0 && triangles > 0),
            format!(
                "{} of {triangles} triangles shine from both sides",
                triangles - one_sided
            ),
        ),
        (
            "one mesh",
            yes(found.is_one_mesh()),
            format!(
                "meshes: {}, instances: {}, at most {} of a mesh",
                found.meshes, found.instances, found.most_instances
            ),
        ),
        (
            "dark lights",
            yes(found.dark > 0),
            format!("{} of {} have no flux", found.dark, found.lights),
        ),
        (
            "transforms",
            kinds[found.transform() as usize].to_owned(),
            format!("instances: {}; {} dimmed", counts.join(", "), found.dimmed),
        ),
        (
            "changes",
            yes(!changes.is_empty()),
            format!("{changed}, as declared"),
        ),
        (
            "glossy receivers",
            yes(is_glossy),
            "importances but `Glossy` take receivers as diffuse".to_owned(),
        ),
        (
            "pmf of given lights",
            yes(declared.pmf),
            "multiple importance sampling asks for them; as declared".to_owned(),
        ),
    ];
    let all = facts.into_iter();
    all.map(|(name, found, reason)| Fact { name, found, reason })
        .collect()
}

/// Why each part of the smallest model is what it is: a sentence for each that begins with its name.
pub(super) fn reasons(found: &Requirements, is_glossy: bool) -> Vec<String> {
    let (model, declared) = (found.model(), found.declared);
    let layout = match (model.layout, found.one_sided) {
        (Layout::TwoSidedMoments, _) => {
            "no light has a normal, so nodes leave their row out: 20 bytes of each child instead of 24"
                .to_owned()
        }
        (_, 0) => "of meshes that come nothing is known, so nodes keep mean normals".to_owned(),
        (_, some) => format!(
            "{some} of {} triangles shine from one side, so nodes keep mean normals",
            found.triangles
        ),
    };
    let levels = match (model.single_level, found.is_one_mesh()) {
        (false, _) => {
            let mut needs = changes(&declared);
            if found.most_instances > 1 {
                needs.push("instances share meshes");
            }
            format!("two, because {}", needs.join(", "))
        }
        (true, true) => "one, because one mesh stays in its place: no top level chooses it".to_owned(),
        (true, false) => format!(
            "one, because all {} meshes stay as they are, each in one place",
            found.meshes
        ),
    };
    let trails = match declared.pmf {
        true => {
            "kept, because probabilities of given lights are asked for; 1/64 of uniform choice finds its lights by them"
        }
        false => {
            "none, because no probability of a given light is asked for; without them there is no share of uniform choice"
        }
    };
    let updates = match model.updates {
        Updates::Nothing => {
            "nothing changes, so triangles, instance states and lists for refits are not kept"
        }
        Updates::Instances => {
            "instances change and meshes stay, so triangles and their lists are not kept on the CPU"
        }
        Updates::Meshes => "meshes change or come, so everything is kept",
    };
    let mut said = vec![
        format!("layout: {layout}"),
        format!("levels: {levels}"),
        format!("trails: {trails}"),
        format!("updates: {updates}"),
    ];
    if is_glossy {
        let glossy = match declared.pmf {
            true => {
                "rays into their lobes share lights with samples by probabilities (multiple importance sampling); an importance that knows \
                 the lobe (`Glossy`) may have less variance for the same samples, and takes longer for each"
            }
            false => {
                "without probabilities of given lights no ray into a lobe can share a light with a sample; ask for them, resample several \
                 candidates (`sample_many`), or take `Glossy`"
            }
        };
        said.push(format!("glossy surfaces: {glossy}"));
    }
    said
}
