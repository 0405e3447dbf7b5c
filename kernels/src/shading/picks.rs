//! The lights of a pixel's samples, one after the other.

use lightbvh::{SampledLight, ShadingPoint};

use super::numbers::Numbers;
use super::pick::PickLight;

/// Lights that processors pick at once: their walks share nodes. An invocation of a device picks one at a time, to the same words:
/// it has no memory for more.
#[cfg(not(target_arch = "spirv"))]
const BLOCK: usize = 32;

/// Lights at equal distances for one point.
#[derive(Clone, Copy, Debug)]
pub struct Picks {
    numbers: Numbers,
    first: u32,
    #[cfg(not(target_arch = "spirv"))]
    count: u32,
    all: u32,
    #[cfg(not(target_arch = "spirv"))]
    block: [SampledLight; BLOCK],
}

impl Picks {
    /// `count` lights by `numbers`, from `first` of `all` on.
    #[inline]
    #[must_use]
    #[cfg_attr(target_arch = "spirv", expect(unused_variables))]
    pub fn new(numbers: Numbers, first: u32, count: u32, all: u32) -> Self {
        Self {
            numbers,
            first,
            #[cfg(not(target_arch = "spirv"))]
            count,
            all,
            #[cfg(not(target_arch = "spirv"))]
            block: [SampledLight::NONE; BLOCK],
        }
    }

    /// Light `k`, asked for in order from 0 on, always of the same picker for the same point.
    #[inline]
    pub fn next<P: PickLight>(&mut self, picker: &P, point: &ShadingPoint, k: u32) -> SampledLight {
        #[cfg(not(target_arch = "spirv"))]
        {
            let at = k as usize % BLOCK;
            if at == 0 {
                let left = if k < self.count { self.count - k } else { 1 };
                let block = &mut self.block[..BLOCK.min(left as usize)];
                let first = self.first.wrapping_add(k);
                picker.pick_spaced(point, self.numbers.light(0, self.all), first, self.all, block);
            }
            self.block[at]
        }
        #[cfg(target_arch = "spirv")]
        picker.pick(point, self.numbers.light(self.first.wrapping_add(k), self.all))
    }

    /// The numbers of the point on light `k`, in [0, 1).
    #[inline]
    #[must_use]
    pub fn uv(&self, k: u32) -> [f32; 2] {
        self.numbers.uv(self.first.wrapping_add(k))
    }
}
