//! A receiver that some lights light alone.

use super::{Receiver, ShadingPoint};
use crate::instance::Instance;

/// A receiver with a mask, for [`Linked`](crate::importance::Linked): lit by the instances
/// whose mask shares a bit with its own, and by no others. Around a [`ShadingPoint`](super::ShadingPoint), or any other receiver.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkedPoint<P> {
    /// The receiver without a mask.
    pub point: P,
    /// Its mask; no light lights 0.
    pub mask: u32,
}

impl<P: AsRef<ShadingPoint>> AsRef<ShadingPoint> for LinkedPoint<P> {
    fn as_ref(&self) -> &ShadingPoint {
        self.point.as_ref()
    }
}

impl<P: Receiver> Receiver for LinkedPoint<P> {
    const IS_TWO_SIDED: bool = P::IS_TWO_SIDED;

    /// The mask stays.
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        Self {
            point: self.point.to_local(instance),
            mask: self.mask,
        }
    }

    fn is_within_reach(&self) -> bool {
        self.point.is_within_reach()
    }
}
