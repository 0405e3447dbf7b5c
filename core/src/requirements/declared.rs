//! What no array tells: what will change, what is lit, what is asked.

/// What the caller says of the frames to come. Nothing of it can be seen in a scene as it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Declared {
    /// What changes.
    pub changes: Changes,
    /// What is lit.
    pub receivers: Receivers,
    /// Whether the probability of a given light is asked for, as multiple importance sampling does of a light that a ray has hit.
    pub pmf: bool,
}

/// What changes from frame to frame; [`NONE`](Self::NONE) of it, or any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Changes {
    /// Instances move ([`Edit::SetTransform`](crate::Edit::SetTransform)).
    pub transforms: bool,
    /// Meshes deform: their vertices move ([`Edit::SetTriangles`](crate::Edit::SetTriangles)).
    pub vertices: bool,
    /// Radiance varies, of triangles or of instances ([`Edit::SetRadiance`](crate::Edit::SetRadiance)).
    pub emission: bool,
    /// Instances of the same meshes come and go.
    pub instances: bool,
    /// Meshes come that are not in the scene yet: of them nothing is known.
    pub meshes: bool,
}

impl Changes {
    /// Everything stays.
    pub const NONE: Self = Self {
        transforms: false,
        vertices: false,
        emission: false,
        instances: false,
        meshes: false,
    };
    /// Anything may change.
    pub const ANY: Self = Self {
        transforms: true,
        vertices: true,
        emission: true,
        instances: true,
        meshes: true,
    };

    /// Whether anything does.
    #[must_use]
    pub const fn any(self) -> bool {
        self.transforms | self.vertices | self.emission | self.instances | self.meshes
    }
}

/// What is lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Receivers {
    /// Points with normals, and perhaps points in volumes.
    Surfaces,
    /// Points in volumes alone: every [`ShadingPoint`](crate::ShadingPoint) has a normal of zero.
    Volumes,
}

impl Declared {
    /// Nothing changes, surfaces are lit, and probabilities of given lights are asked for.
    pub const STATIC: Self = Self {
        changes: Changes::NONE,
        receivers: Receivers::Surfaces,
        pmf: true,
    };
    /// Anything changes, surfaces are lit, and probabilities of given lights are asked for: the default model serves it.
    pub const ANYTHING: Self = Self {
        changes: Changes::ANY,
        ..Self::STATIC
    };
}
