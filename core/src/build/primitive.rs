//! Primitives of the builder: a light or a mesh light, as two boxes.

use crate::bounds::LightBounds;
use crate::cone::sine_of;
use crate::emission::MAX_SUM;
use crate::exact;

/// Lanes of a box pair: x, y, z of position, one unused, x, y, z of the normals, one unused. Eight lanes become whole
/// vector registers.
pub(super) type Lanes = [f32; 8];

/// A light to be sorted into a tree. Beside the box of its points it carries the box of its *normals*: unions of boxes
/// are cheap and independent of order, and the box of normals bounds their cone (see [`cost`](super::cost)).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Primitive {
    pub(super) low: Lanes,
    pub(super) high: Lanes,
    pub(super) phi: f32,
    pub(super) index: u32,
}

impl Primitive {
    /// The light `index` with the given bounds.
    pub fn new(index: u32, bounds: &LightBounds) -> Self {
        let (cos, sin) = (bounds.cos_theta_o, sine_of(bounds.cos_theta_o));
        // The farthest that a direction within θ_o of the axis reaches along a coordinate axis: cos max(0, θ_k − θ_o).
        let reach = |a: f32| if a >= cos { 1.0 } else { a * cos + sine_of(a) * sin };
        let (a, lo, hi) = (bounds.axis, bounds.min, bounds.max);
        let narrow = cos >= 1.0;
        let top = |a: f32| if narrow { a } else { reach(a) };
        Self {
            low: [lo.x, lo.y, lo.z, 0.0, -top(-a.x), -top(-a.y), -top(-a.z), 0.0],
            high: [hi.x, hi.y, hi.z, 0.0, top(a.x), top(a.y), top(a.z), 0.0],
            phi: bounds.phi,
            index,
        }
    }

    /// Twice the centre of the box; the factor cancels wherever it is used.
    #[inline]
    pub(super) fn centroid(&self, axis: usize) -> f32 {
        self.low[axis] + self.high[axis]
    }
}

/// The union of some primitives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    pub low: Lanes,
    pub high: Lanes,
    pub phi: f32,
    pub count: u32,
}

impl Group {
    pub const EMPTY: Self = Self {
        low: [f32::MAX; 8],
        high: [f32::MIN; 8],
        phi: 0.0,
        count: 0,
    };

    /// The union of `range`.
    pub fn of(range: &[Primitive]) -> Self {
        let mut all = Self::EMPTY;
        for p in range {
            all.add(p);
        }
        all
    }

    /// The union of `range`, if anything will be asked of it: splits of up to two primitives need no costs.
    pub fn of_inner(range: &[Primitive]) -> Self {
        if range.len() > 2 {
            Self::of(range)
        } else {
            Self::EMPTY
        }
    }

    #[inline]
    pub fn add(&mut self, primitive: &Primitive) {
        grow(&mut self.low, &mut self.high, &primitive.low, &primitive.high);
        self.phi = exact::min(self.phi + primitive.phi, MAX_SUM);
        self.count += 1;
    }

    #[inline]
    pub fn merge(&mut self, other: &Self) {
        grow(&mut self.low, &mut self.high, &other.low, &other.high);
        self.phi = exact::min(self.phi + other.phi, MAX_SUM);
        self.count += other.count;
    }
}

#[inline]
fn grow(low: &mut Lanes, high: &mut Lanes, other_low: &Lanes, other_high: &Lanes) {
    for k in 0..8 {
        low[k] = if other_low[k] < low[k] {
            other_low[k]
        } else {
            low[k]
        };
        high[k] = if other_high[k] > high[k] {
            other_high[k]
        } else {
            high[k]
        };
    }
}
