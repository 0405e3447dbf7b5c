//! What lights a scene, and which commands can do with it.

use super::error::SceneError;
use super::scene::Scene;

impl Scene {
    /// What a command that knows emissive triangles alone leaves out.
    pub fn unknown_lights(&self) -> Option<String> {
        let mut parts = Vec::new();
        if self.has_other_lights() {
            parts.push(format!("{} are left out here", self.other_lights()));
        }
        if self.data().has_textures() {
            parts.push(String::from("textures are shown by their means here"));
        }
        (!parts.is_empty()).then(|| format!("{}; `lightbvh render` and `verify` know them", parts.join("; ")))
    }

    /// What lights the scene beside emissive triangles, in words.
    pub fn other_lights(&self) -> String {
        match self.counts.analytic {
            1 => String::from("1 light of another kind than triangles"),
            count => format!("{count} lights of other kinds than triangles"),
        }
    }

    /// Emissive triangles of every frame.
    pub fn emissive_count(&self) -> usize {
        self.counts.emissive
    }

    /// Lights by formula.
    pub fn analytic_count(&self) -> usize {
        self.counts.analytic
    }

    /// Whether it has other light than that of emissive triangles: lights by formula.
    pub fn has_other_lights(&self) -> bool {
        self.counts.analytic > 0
    }

    /// Whether only passes over all kinds of light show all of it: it has [other lights](Self::has_other_lights), or
    /// textures.
    pub fn has_kinds(&self) -> bool {
        self.has_other_lights() || self.data().has_textures()
    }

    /// For commands that sample emissive triangles.
    ///
    /// # Errors
    /// [`SceneError::NoEmissive`] where no triangle emits.
    pub fn require_lights(&self) -> Result<(), SceneError> {
        let others = match self.has_other_lights() {
            _ if self.counts.emissive > 0 => return Ok(()),
            false => String::new(),
            true => format!(
                ", and only `render`, `verify` and `inspect` know what lights it ({})",
                self.other_lights()
            ),
        };
        Err(SceneError::NoEmissive(self.name().to_owned(), others))
    }

    /// For commands that take lights of every kind.
    ///
    /// # Errors
    /// [`SceneError::NoEmissive`] where nothing emits.
    pub fn require_any_light(&self) -> Result<(), SceneError> {
        if self.has_other_lights() {
            return Ok(());
        }
        self.require_lights()
    }
}
