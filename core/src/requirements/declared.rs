//! What no array tells: what will change, what is lit, what is asked.

/// What the caller says of the frames to come. Nothing of it can be seen in a scene as it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Declared {
    /// What changes.
    pub changes: Changes,
    /// Whether surfaces that are lit have a glossy lobe.
    pub glossy: bool,
    /// Whether the probability of a given light is asked for, as multiple importance sampling does of a light that a ray has hit.
    pub pmf: bool,
}

/// What changes from frame to frame, edit by edit; [`NONE`](Self::NONE) of it, or any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Changes {
    /// Instances move ([`Edit::SetTransform`](crate::Edit::SetTransform)).
    pub transforms: bool,
    /// Instances become brighter or dimmer, as a whole ([`Edit::SetRadiance`](crate::Edit::SetRadiance)).
    pub radiance: bool,
    /// Meshes deform, or the emission of their triangles varies ([`Edit::SetTriangles`](crate::Edit::SetTriangles)); none turns
    /// from one that shines from both sides into one that shines from one.
    pub triangles: bool,
    /// Instances of the same meshes come and go.
    pub instances: bool,
    /// Meshes come that are not in the scene yet: of them nothing is known.
    pub meshes: bool,
}

impl Changes {
    /// Everything stays.
    pub const NONE: Self = Self {
        transforms: false,
        radiance: false,
        triangles: false,
        instances: false,
        meshes: false,
    };
    /// Anything may change.
    pub const ANY: Self = Self {
        transforms: true,
        radiance: true,
        triangles: true,
        instances: true,
        meshes: true,
    };

    /// Whether anything does.
    #[must_use]
    pub const fn any(self) -> bool {
        self.of_instances() | self.of_meshes()
    }

    /// Whether instances do.
    pub(super) const fn of_instances(self) -> bool {
        self.transforms | self.radiance | self.instances
    }

    /// Whether triangles do.
    pub(super) const fn of_meshes(self) -> bool {
        self.triangles | self.meshes
    }
}

impl Declared {
    /// Nothing changes, surfaces are diffuse, and probabilities of given lights are asked for.
    pub const STATIC: Self = Self {
        changes: Changes::NONE,
        glossy: false,
        pmf: true,
    };
    /// Anything changes, surfaces may be glossy, and probabilities of given lights are asked for: the default model serves it.
    pub const ANYTHING: Self = Self {
        changes: Changes::ANY,
        glossy: true,
        pmf: true,
    };
}
