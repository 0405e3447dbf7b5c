//! What was measured of a configuration in a scene.

use serde::Serialize;

use super::image::Images;
use super::structure::Structure;
use super::subject::Config;

/// A configuration in a scene.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Point {
    pub scene: String,
    /// What differs from the default, in words.
    pub choice: String,
    pub config: Config,
    pub default: bool,
    #[serde(flatten)]
    pub structure: Structure,
    #[serde(flatten)]
    pub images: Images,
    /// Whether it is on the front: nothing else takes less time for an update or an image of the same rays, or has less error
    /// in it, at no greater cost of the others, and it differs from the default beyond the spread.
    pub pareto: bool,
}
