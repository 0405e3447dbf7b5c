//! Facts with their reasons, in words.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Extent, Orientation, Receivers, Requirements, TransformKind};

/// A fact about a scene's lights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// What is asked.
    pub name: &'static str,
    /// The answer.
    pub found: String,
    /// Where it is from.
    pub reason: String,
}

impl Requirements {
    /// Every fact, each with its reason.
    #[must_use]
    pub fn facts(&self) -> Vec<Fact> {
        let fact = |name, found: &str, reason: String| Fact {
            name,
            found: found.to_string(),
            reason,
        };
        let yes = |is: bool| if is { "yes" } else { "no" };
        let (orientation, normals) = self.orientation_words();
        let (changes, what) = self.changes_words();
        let [least, most] = self.depth_bounds(8);
        let kinds = self.transforms;
        Vec::from([
            fact("orientation", orientation, normals),
            fact(
                "two-sided only",
                yes(self.two_sided > 0 && self.orientation == Orientation::Absent && self.needles == 0),
                format!(
                    "{} of {} triangles shine from both sides",
                    self.two_sided, self.triangles
                ),
            ),
            fact(
                "one mesh",
                yes(self.is_one_mesh()),
                format!(
                    "meshes: {}, instances: {}, at most {} of a mesh",
                    self.meshes, self.instances, self.most_instances
                ),
            ),
            fact(
                "flux alike",
                yes(self.flux_alike),
                format!(
                    "the flux of {} lights, as it is computed, {} the same bits",
                    self.lights - self.dark,
                    if self.flux_alike { "has" } else { "has not" }
                ),
            ),
            fact(
                "lights without flux",
                &self.dark.to_string(),
                format!("of {} lights; the tree gives them no weight", self.lights),
            ),
            fact(
                "extent",
                match self.extent {
                    Extent::Point => "a point",
                    Extent::Collinear => "a line",
                    Extent::Planar => "a plane",
                    Extent::Spatial => "space",
                },
                "exact determinants of the vertices of lights with flux, in the world".to_string(),
            ),
            fact(
                "transforms",
                match self.transform() {
                    TransformKind::Identity => "identity",
                    TransformKind::Translation => "translations",
                    TransformKind::Rigid => "rigid",
                    TransformKind::Uniform => "uniform scales",
                    TransformKind::NonUniform => "non-uniform",
                },
                format!(
                    "instances: identity {}, translated {}, rigid {}, scaled alike {}, otherwise {}; mirrored {}, radiance by a factor {}",
                    kinds[0], kinds[1], kinds[2], kinds[3], kinds[4], self.mirrored, self.dimmed
                ),
            ),
            fact("changes", changes, what),
            fact(
                "receivers",
                match self.declared.receivers {
                    Receivers::Surfaces => "surfaces",
                    Receivers::Volumes => "volumes",
                },
                "declared; boxes and horizons matter to surfaces alone".to_string(),
            ),
            fact(
                "pmf of given lights",
                yes(self.declared.pmf),
                "declared; multiple importance sampling asks for it".to_string(),
            ),
            fact(
                "depth",
                &format!("{least} to {most}"),
                format!(
                    "of two levels, 8 children to a node, over {} instances of up to {} triangles",
                    self.instances, self.most_triangles
                ),
            ),
        ])
    }

    fn orientation_words(&self) -> (&'static str, String) {
        let one_sided = |rest: &str| format!("triangles shine from one side, {rest}");
        match self.orientation {
            Orientation::Absent if self.needles > 0 => (
                "absent",
                format!(
                    "{} triangles shine from both sides, {} from one, too thin for a normal",
                    self.two_sided, self.needles
                ),
            ),
            Orientation::Absent => (
                "absent",
                "no triangle with flux shines from one side only".to_string(),
            ),
            Orientation::Cancelling => (
                "cancelling",
                one_sided("but in each mesh normals cancel in pairs: whole meshes have none, their parts do"),
            ),
            Orientation::Present => ("present", one_sided("and their mean normals are not zero")),
        }
    }

    fn changes_words(&self) -> (&'static str, String) {
        let changes = self.declared.changes;
        let named = [
            (changes.transforms, "instances move"),
            (changes.vertices, "meshes deform"),
            (changes.emission, "emission varies"),
            (changes.instances, "instances come and go"),
            (changes.meshes, "meshes come"),
        ];
        let what: Vec<&str> = named
            .into_iter()
            .filter(|(is, _)| *is)
            .map(|(_, what)| what)
            .collect();
        if what.is_empty() {
            ("none", "declared: everything stays as it is".to_string())
        } else {
            ("some", format!("declared: {}", what.join(", ")))
        }
    }
}
