//! The ends of the domain.

extern crate std;

use crate::build::BuildParams;
use crate::kit::triangle;
use crate::{LightBvh, Lights};

/// Lights at the ends of the domain may be followed there.
#[test]
fn the_whole_domain_is_followed() {
    let far = crate::exact::pow2(40);
    let lamp = triangle([[-far, -far, -far], [far, far, -far], [far, -far, far]]);
    let lights = Lights::new(std::vec![lamp]).expect("within the domain");
    for mut bvh in [
        LightBvh::single_level(&lights, &BuildParams::BALANCED),
        LightBvh::two_level(&lights, &BuildParams::BALANCED),
    ] {
        bvh.follow(&lights).expect("the same lights");
        bvh.validate().expect("valid");
    }
}
