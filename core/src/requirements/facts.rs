//! Facts with their reasons, in words.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Orientation, Requirements, TransformKind};

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
        Vec::from([
            fact("orientation", orientation, normals),
            fact(
                "two-sided only",
                yes(self.two_sided > 0 && self.one_sided == 0 && self.needles == 0),
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
                "dark lights",
                yes(self.dark > 0),
                format!("{} of {} have no flux", self.dark, self.lights),
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
                self.transform_words(),
            ),
            fact("changes", yes(self.declared.changes.any()), self.changes_words()),
            fact(
                "glossy receivers",
                yes(self.declared.glossy),
                "as declared; importances but `Glossy` take receivers as diffuse".to_string(),
            ),
            fact(
                "pmf of given lights",
                yes(self.declared.pmf),
                if self.declared.pmf {
                    "multiple importance sampling asks for them, as declared".to_string()
                } else {
                    "nothing asks for them, as declared".to_string()
                },
            ),
        ])
    }

    fn orientation_words(&self) -> (&'static str, String) {
        let one_sided = format!(
            "{} of {} triangles shine from one side",
            self.one_sided, self.triangles
        );
        match self.orientation {
            Orientation::Absent if self.needles > 0 => (
                "absent",
                format!(
                    "{} triangles shine from one side, too thin for a normal",
                    self.needles
                ),
            ),
            Orientation::Absent => (
                "absent",
                "no triangle with flux shines from one side only".to_string(),
            ),
            Orientation::Cancelling => (
                "cancelling",
                format!("{one_sided}, and in each mesh their normals cancel in pairs"),
            ),
            Orientation::Present => ("present", one_sided),
        }
    }

    /// How many instances there are of each kind that occurs.
    fn transform_words(&self) -> String {
        let kinds = [
            "at the identity",
            "translated",
            "rigid",
            "scaled",
            "sheared or scaled unevenly",
        ];
        let counts = kinds.into_iter().zip(self.transforms);
        let more = [
            ("mirrored", self.mirrored),
            ("with a factor on radiance", self.dimmed),
        ];
        let said: Vec<String> = counts
            .chain(more)
            .filter(|&(_, count)| count > 0)
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        if said.is_empty() {
            "no instance".to_string()
        } else {
            format!("instances: {}", said.join(", "))
        }
    }

    fn changes_words(&self) -> String {
        let changes = self.declared.changes;
        let named = [
            (changes.transforms, "instances move"),
            (changes.radiance, "instances are dimmed"),
            (changes.triangles, "meshes deform or vary in emission"),
            (changes.instances, "instances come and go"),
            (changes.meshes, "meshes come"),
        ];
        let what: Vec<&str> = named
            .into_iter()
            .filter(|(is, _)| *is)
            .map(|(_, what)| what)
            .collect();
        if what.is_empty() {
            "everything stays as it is, as declared".to_string()
        } else {
            format!("{}, as declared", what.join(", "))
        }
    }
}
