//! The smallest model that is sufficient, and why each of its parts is what it is.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Layout, Model, Orientation, Requirements, Structure, TransformKind, Updates};

impl Requirements {
    /// The smallest model that is sufficient. Layout, trails and updates keep the bits of probabilities. One level in place of
    /// several, or of a mesh that stands elsewhere than at the identity, is another tree, and without uniform choice
    /// probabilities are others too: what that does to the variance depends on the scene, and `lightbvh inspect` measures it.
    #[must_use]
    pub fn model(&self) -> Model {
        let default = Model::DEFAULT;
        Model {
            layout: if self.normals_stay_absent() {
                Layout::TwoSidedMoments
            } else {
                default.layout
            },
            structure: if self.one_level_is_enough() {
                Structure::SingleLevel
            } else {
                default.structure
            },
            uniform_halvings: if self.declared.pmf {
                default.uniform_halvings
            } else {
                0
            },
            trails: self.declared.pmf,
            updates: self.updates(),
            ..default
        }
    }

    /// What has to be kept for the changes that are declared.
    pub(super) fn updates(&self) -> Updates {
        let changes = self.declared.changes;
        if changes.of_meshes() {
            Updates::Meshes
        } else if changes.of_instances() {
            Updates::Instances
        } else {
            Updates::Nothing
        }
    }

    /// Whether no light has a normal, now and later.
    fn normals_stay_absent(&self) -> bool {
        self.orientation == Orientation::Absent
            && !self.declared.changes.meshes
            && self.normals_to_come() == 0
    }

    /// Triangles that may get a normal: needles that move, deform, or stand in the world otherwise than in their mesh, and
    /// those that start to shine.
    fn normals_to_come(&self) -> usize {
        let changes = self.declared.changes;
        let moved = self.transform() > TransformKind::Identity;
        let widen = usize::from(changes.triangles || changes.transforms || moved);
        self.needles * widen + self.unlit * usize::from(changes.triangles)
    }

    /// Whether a tree over triangles in the world can follow what changes, without another copy of any triangle: of one mesh
    /// that stays where it is, or of several that stay as they are.
    pub(super) fn one_level_is_enough(&self) -> bool {
        self.needs_instances().is_empty()
    }

    /// What only instances can follow.
    fn needs_instances(&self) -> Vec<String> {
        let changes = self.declared.changes;
        let several = changes.triangles && self.meshes.max(self.instances) > 1;
        let named = [
            (changes.transforms, "instances move".to_string()),
            (changes.radiance, "instances are dimmed".to_string()),
            (changes.instances, "instances come and go".to_string()),
            (changes.meshes, "meshes come".to_string()),
            (several, format!("{} meshes change by themselves", self.meshes)),
            (
                self.most_instances > 1,
                format!("{} instances share {} meshes", self.instances, self.meshes),
            ),
        ];
        named
            .into_iter()
            .filter(|(is, _)| *is)
            .map(|(_, what)| what)
            .collect()
    }

    /// Why each part of [`model`](Self::model) is what it is: a sentence for each that begins with its name.
    #[must_use]
    pub fn reasons(&self) -> Vec<String> {
        let mut said = Vec::from([
            self.layout_reason(),
            self.levels_reason(),
            self.trails_reason(),
            self.updates_reason(),
        ]);
        if self.declared.glossy && !self.declared.pmf {
            said.push(
                "glossy surfaces: without probabilities of given lights no ray into a lobe can share a light with a sample; ask for them, \
                 resample several candidates (`sample_many`), or let the importance know the lobe (`Glossy`), which takes longer"
                    .to_string(),
            );
        }
        if self.declared.glossy && self.declared.pmf {
            said.push(
                "glossy surfaces: rays into their lobes share lights with samples by probabilities (multiple importance sampling); an \
                 importance that knows the lobe (`Glossy`) may have less variance for the same samples, and takes longer for each"
                    .to_string(),
            );
        }
        said
    }

    fn layout_reason(&self) -> String {
        if self.normals_stay_absent() {
            return "layout: no light has a normal, so nodes leave the row of normals out and hold the same in 20 bytes of each child \
                    instead of 24"
                .to_string();
        }
        let needed = match self.orientation {
            Orientation::Absent if self.normals_to_come() > 0 => format!(
                "{} one-sided triangles, too thin for a normal or without flux, may get one as they change",
                self.normals_to_come()
            ),
            Orientation::Absent => "of meshes that come nothing is known".to_string(),
            Orientation::Cancelling => {
                "normals cancel in whole meshes, but not in the nodes within".to_string()
            }
            Orientation::Present => {
                format!(
                    "{} of {} triangles shine from one side",
                    self.one_sided, self.triangles
                )
            }
        };
        format!("layout: {needed}, so nodes keep mean normals")
    }

    fn levels_reason(&self) -> String {
        let needed = self.needs_instances();
        if !needed.is_empty() {
            format!("levels: two, because {}", needed.join(", "))
        } else if self.instances == 0 {
            "levels: one, because nothing stands in the world".to_string()
        } else if self.is_one_mesh() {
            "levels: one, because one mesh stays in its place: its tree stands in the world, and no top level chooses it".to_string()
        } else {
            format!(
                "levels: one, because all {} meshes stay as they are, each in one place: one tree over all their triangles, no instances",
                self.meshes
            )
        }
    }

    fn trails_reason(&self) -> String {
        if self.declared.pmf {
            "trails: kept, because probabilities of given lights are asked for; 1/64 of uniform choice finds its lights by them".to_string()
        } else {
            "trails: none, because no probability of a given light is asked for; without them there is no share of uniform choice"
                .to_string()
        }
    }

    fn updates_reason(&self) -> String {
        match self.updates() {
            Updates::Nothing => {
                "updates: nothing changes, so triangles, instance states and lists for refits are not kept".to_string()
            }
            Updates::Instances => {
                "updates: instances change and meshes stay, so triangles and lists for refits of bottom levels are not kept on the CPU"
                    .to_string()
            }
            Updates::Meshes => "updates: meshes change or come, so everything is kept".to_string(),
        }
    }
}
