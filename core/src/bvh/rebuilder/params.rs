//! How a rebuilder works.

/// When results are swapped in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Swap {
    /// In the frame that is due or the first one after it that finds the worker done; never waits.
    #[default]
    WhenReady,
    /// In the frame that is due, which waits for the worker if it is not done. Trees depend on edits and frames alone, never on
    /// the worker's speed, so runs and devices can be compared bit for bit.
    Deterministic,
}

/// How a [`Rebuilder`](crate::Rebuilder) works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RebuilderParams {
    /// Frames from the end of the one that starts a build to the start of the one in which it is due, at least 1, the default; 0
    /// is taken as 1.
    pub after: u32,
    /// Action if it is due and not done.
    pub swap: Swap,
    /// Pause after a build, in durations of that build, from 0; by default 3, a quarter of a core while lights move. Under
    /// [`Swap::Deterministic`] it counts in frames: `after` is the duration. NaN is taken as 0, infinity builds once.
    pub idle: f64,
    /// Most bytes of lights that the end of a frame copies for meshes to be built, by default 8 MiB: about 0.8 ms.
    /// A mesh with more keeps its tree.
    pub bytes: usize,
}

impl Default for RebuilderParams {
    fn default() -> Self {
        Self {
            after: 1,
            swap: Swap::WhenReady,
            idle: 3.0,
            bytes: 8 << 20,
        }
    }
}
