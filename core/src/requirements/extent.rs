//! Whether points lie in one place, on a line, or in a plane: exactly, whatever their coordinates are.
//!
//! Coordinates are whole multiples of 2^-123, below 2^163 of them in magnitude, so determinants of differences are integers below
//! 2^500. Such an integer is zero where it is so modulo primes whose product is greater: no rounding, and no long arithmetic.

/// How many directions lights extend in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Extent {
    /// One point, or nothing.
    Point,
    /// A line.
    Collinear,
    /// A plane.
    Planar,
    /// All three.
    Spatial,
}

/// The unit of coordinates is 2^-123: a significand of 24 bits at the least exponent, -100.
const UNIT_EXPONENT: i32 = -123;
/// 2^61 less these are prime; the product of all nine is above 2^548.
const BELOW_2_61: [u64; 9] = [1, 31, 45, 229, 259, 283, 339, 391, 403];

/// Three integers modulo a prime.
type Residues = [u64; 3];

/// The points that span what was found so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Span {
    origin: Option<[f32; 3]>,
    first: Option<[f32; 3]>,
    second: Option<[f32; 3]>,
    third: bool,
}

impl Span {
    /// Takes a point in; each coordinate is zero or of magnitude 2^-100 to 2^40.
    pub fn add(&mut self, p: [f32; 3]) {
        if self.third {
            return;
        }
        let Some(origin) = self.origin else {
            self.origin = Some(p);
            return;
        };
        // Equal numbers, so that zeros of either sign are one.
        if p == origin {
            return;
        }
        match (self.first, self.second) {
            (None, _) => self.first = Some(p),
            (Some(first), None) => {
                if !all_primes(|prime| {
                    let [a, b] = [first, p].map(|end| difference(end, origin, prime));
                    cross(a, b, prime) == [0; 3]
                }) {
                    self.second = Some(p);
                }
            }
            (Some(first), Some(second)) => {
                self.third = !all_primes(|prime| {
                    let [a, b, c] = [first, second, p].map(|end| difference(end, origin, prime));
                    dot(cross(a, b, prime), c, prime) == 0
                });
            }
        }
    }

    pub fn extent(&self) -> Extent {
        match (self.third, self.second, self.first) {
            (true, ..) => Extent::Spatial,
            (_, Some(_), _) => Extent::Planar,
            (_, _, Some(_)) => Extent::Collinear,
            _ => Extent::Point,
        }
    }
}

fn all_primes(holds: impl Fn(u64) -> bool) -> bool {
    BELOW_2_61.iter().all(|below| holds((1 << 61) - below))
}

/// `x` in units, modulo `prime`.
fn residue(x: f32, prime: u64) -> u64 {
    let bits = x.to_bits();
    let exponent = ((bits >> 23) & 255) as i32 - 127;
    if bits & 0x7fff_ffff == 0 {
        return 0;
    }
    let mut rest = u64::from((bits & 0x7f_ffff) | 0x80_0000);
    let mut shift = (exponent - 23 - UNIT_EXPONENT).max(0) as u32;
    while shift > 0 {
        let step = shift.min(60);
        rest = ((u128::from(rest) << step) % u128::from(prime)) as u64;
        shift -= step;
    }
    if bits >> 31 == 0 {
        rest
    } else {
        minus(0, rest, prime)
    }
}

fn difference(a: [f32; 3], b: [f32; 3], prime: u64) -> Residues {
    core::array::from_fn(|k| minus(residue(a[k], prime), residue(b[k], prime), prime))
}

fn minus(a: u64, b: u64, prime: u64) -> u64 {
    if a >= b { a - b } else { a + prime - b }
}

fn times(a: u64, b: u64, prime: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(prime)) as u64
}

fn cross(a: Residues, b: Residues, prime: u64) -> Residues {
    core::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        minus(times(a[i], b[j], prime), times(a[j], b[i], prime), prime)
    })
}

fn dot(a: Residues, b: Residues, prime: u64) -> u64 {
    (0..3).fold(0, |sum, k| (sum + times(a[k], b[k], prime)) % prime)
}
