//! The storage buffers by which a device follows a light BVH.

/// A storage buffer that a device has for each light BVH. As a number (`buffer as usize`) it counts from 0 in the order of
/// [`ALL`](Self::ALL).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DeviceBuffer {
    /// The nodes of bottom levels, and behind them those of the top level. A refit writes them.
    Nodes,
    /// The lights of bottom levels, in the spaces of their meshes.
    Lights,
    /// The instances.
    Instances,
    /// The bit trails of lights, `LightTree::trail_words` words each, and the links of the top level, for pmfs.
    Trails,
    /// Indices of the nodes that a frame's refit computes. Like [`Children`](Self::Children) it belongs to one frame
    /// until the device is done with it.
    List,
    /// Passed from one dispatch of a refit to the next; never uploaded.
    Children,
}

impl DeviceBuffer {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Nodes,
        Self::Lights,
        Self::Instances,
        Self::Trails,
        Self::List,
        Self::Children,
    ];

    /// Name of the bindings that take it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Nodes => "nodes",
            Self::Lights => "lights",
            Self::Instances => "instances",
            Self::Trails => "trails",
            Self::List => "list",
            Self::Children => "children",
        }
    }

    /// The buffer of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|buffer| buffer.name() == name)
    }
}
