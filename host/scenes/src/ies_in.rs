//! Photometric files: ANSI/IES LM-63 (1986 to 2019), types A, B and C.
//!
//! Read are the angles and the candela values with their factors; keywords and the tilt are not looked at, nor lamps, sizes and
//! watts, which is what `EXT_lights_ies` asks of an implementation.

/// Largest file read, bytes.
pub(super) const MAX_BYTES: usize = 1 << 24;
/// Most angles of a kind, and most candela values.
const MAX_ANGLES: usize = 1 << 12;
const MAX_VALUES: usize = 1 << 20;

/// How angles name directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Horizontal angles turn about the vertical axis, vertical ones tell the height: of vehicles.
    A,
    /// Vertical angles turn about the horizontal axis: of floodlights.
    B,
    /// Vertical angles from the axis of the light, horizontal ones turn about it: of luminaires.
    C,
}

/// What a luminaire sends in each direction, as it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    kind: Kind,
    /// Degrees, ascending.
    vertical: Vec<f64>,
    horizontal: Vec<f64>,
    /// Candela, all vertical angles of the first horizontal one first.
    candela: Vec<f64>,
}

impl Photometry {
    /// Reads a file.
    ///
    /// # Errors
    /// A sentence on what is wrong: no such file, numbers missing, not finite, angles that do not ascend, too many of them.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        if bytes.len() > MAX_BYTES {
            return Err(format!(
                "the file has {} bytes, more than {MAX_BYTES}",
                bytes.len()
            ));
        }
        // Keywords may be in any encoding.
        let text = String::from_utf8_lossy(bytes);
        let (_, rest) = text
            .split_once("TILT=")
            .ok_or("it has no line `TILT=`: no photometric file (ANSI/IES LM-63)")?;
        let (tilt, rest) = rest.split_once(['\n', '\r']).unwrap_or((rest, ""));
        let mut numbers = Numbers {
            words: rest.split(|c: char| c.is_whitespace() || c == ','),
        };
        if tilt.trim() == "INCLUDE" {
            numbers.next("geometry of the tilt")?;
            let count = numbers.count("angles of the tilt")?;
            for _ in 0..2 * count {
                numbers.next("tilt")?;
            }
        }
        numbers.next("number of lamps")?;
        numbers.next("lumens of a lamp")?;
        let multiplier = numbers.next("factor on the candela values")?;
        let vertical = numbers.count("vertical angles")?;
        let horizontal = numbers.count("horizontal angles")?;
        let kind = match numbers.next("photometric type")? {
            1.0 => Kind::C,
            2.0 => Kind::B,
            3.0 => Kind::A,
            other => return Err(format!("its photometric type is {other}, expected 1, 2 or 3")),
        };
        for what in ["unit", "width", "length", "height"] {
            numbers.next(what)?;
        }
        let ballast = numbers.next("ballast factor")?;
        numbers.next("number after the ballast factor")?;
        numbers.next("watts")?;
        if vertical * horizontal > MAX_VALUES {
            return Err(format!(
                "it has {vertical} times {horizontal} values, more than {MAX_VALUES}"
            ));
        }
        let vertical = numbers.angles(vertical, "vertical")?;
        let mut horizontal = numbers.angles(horizontal, "horizontal")?;
        let factor = multiplier * ballast;
        if !(factor >= 0.0 && factor.is_finite()) {
            return Err(format!("the factors on its candela values make {factor}"));
        }
        // The first plane is the last one too, which some files leave out.
        let is_open = kind == Kind::C && horizontal[0] == 0.0;
        let is_open = is_open
            && horizontal
                .last()
                .is_some_and(|&last| last > 180.0 && last < 360.0);
        let mut candela = Vec::with_capacity(vertical.len() * (horizontal.len() + 1));
        for _ in 0..vertical.len() * horizontal.len() {
            // Some have small negative numbers, where stray light was subtracted.
            candela.push(numbers.next("candela value")?.max(0.0) * factor);
        }
        if is_open {
            horizontal.push(360.0);
            candela.extend_from_within(..vertical.len());
        }
        if candela.iter().any(|value| *value > 1.0e30) {
            return Err(String::from("a candela value is beyond 1e30"));
        }
        Ok(Self {
            kind,
            vertical,
            horizontal,
            candela,
        })
    }

    /// The least difference of neighbouring angles, degrees.
    pub(super) fn least_step(&self) -> f64 {
        let steps = |angles: &[f64]| {
            angles
                .windows(2)
                .map(|pair| pair[1] - pair[0])
                .fold(180.0, f64::min)
        };
        steps(&self.vertical).min(steps(&self.horizontal))
    }

    /// Candela in a direction of length 1: x is where horizontal angles of type C begin, z the axis, y is to their left.
    pub fn candela(&self, [x, y, z]: [f64; 3]) -> f64 {
        let degrees = |sine: f64, cosine: f64| libm::atan2(sine, cosine).to_degrees();
        let (vertical, horizontal) = match self.kind {
            Kind::C => (degrees(libm::hypot(x, y), z), degrees(y, x)),
            Kind::B => (degrees(y, z), degrees(x, libm::hypot(y, z))),
            Kind::A => (degrees(y, libm::hypot(x, z)), degrees(x, z)),
        };
        let vertical = match self.kind {
            Kind::C => vertical,
            // From 0 on: both halves are alike.
            _ => mirrored_at_zero(vertical, &self.vertical),
        };
        let horizontal = match self.kind {
            Kind::C => self.folded(horizontal),
            _ => mirrored_at_zero(horizontal, &self.horizontal),
        };
        let (Some(row), Some(column)) = (
            between(&self.vertical, vertical),
            between(&self.horizontal, horizontal),
        ) else {
            return 0.0;
        };
        let value = |row: usize, column: usize| self.candela[column * self.vertical.len() + row];
        let along = |column: usize| {
            let (from, to) = (value(row.0, column), value(row.1, column));
            from + (to - from) * row.2
        };
        let (from, to) = (along(column.0), along(column.1));
        from + (to - from) * column.2
    }

    /// A horizontal angle of type C, -180 to 180, where the table has it: a file has a part of the circle, of which the rest is
    /// its image.
    fn folded(&self, angle: f64) -> f64 {
        let (first, last) = (self.horizontal[0], self.horizontal[self.horizontal.len() - 1]);
        let turn = angle.rem_euclid(360.0);
        let half = if turn > 180.0 { 360.0 - turn } else { turn };
        if self.horizontal.len() == 1 {
            first
        } else if first == 0.0 && last == 90.0 {
            half.min(180.0 - half)
        } else if first == 0.0 && last == 180.0 {
            half
        } else if first == 90.0 && last == 270.0 {
            // Alike on both sides of the plane from 90 to 270 degrees.
            if (90.0..=270.0).contains(&turn) {
                turn
            } else {
                (180.0 - turn).rem_euclid(360.0)
            }
        } else if first < 0.0 && turn > 180.0 {
            turn - 360.0
        } else {
            turn
        }
    }
}

fn mirrored_at_zero(angle: f64, angles: &[f64]) -> f64 {
    if angles[0] >= 0.0 { angle.abs() } else { angle }
}

/// The two angles that `angle` lies between, and the part of the second; none beyond the table. One angle stands for all.
fn between(angles: &[f64], angle: f64) -> Option<(usize, usize, f64)> {
    let last = angles.len() - 1;
    if last == 0 {
        return Some((0, 0, 0.0));
    }
    // The rounding of an angle by arcs.
    let slack = 1.0e-9;
    if !(angles[0] - slack..=angles[last] + slack).contains(&angle) {
        return None;
    }
    let after = angles.partition_point(|own| *own <= angle).clamp(1, last);
    let (from, to) = (angles[after - 1], angles[after]);
    Some((after - 1, after, ((angle - from) / (to - from)).clamp(0.0, 1.0)))
}

/// The numbers of a file.
struct Numbers<I> {
    words: I,
}

impl<'a, I: Iterator<Item = &'a str>> Numbers<I> {
    fn next(&mut self, what: &str) -> Result<f64, String> {
        let word = self.words.find(|word| !word.is_empty());
        let word = word.ok_or_else(|| format!("it ends before its {what}"))?;
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                let shown: String = word.chars().take(20).collect();
                Err(format!("its {what} is `{shown}`, expected a number"))
            }
        }
    }

    fn count(&mut self, what: &str) -> Result<usize, String> {
        let number = self.next(&format!("number of {what}"))?;
        if number >= 1.0 && number <= MAX_ANGLES as f64 && number.fract() == 0.0 {
            Ok(number as usize)
        } else {
            Err(format!("it has {number} {what}, expected 1 to {MAX_ANGLES}"))
        }
    }

    fn angles(&mut self, count: usize, what: &str) -> Result<Vec<f64>, String> {
        let mut angles: Vec<f64> = Vec::with_capacity(count);
        for _ in 0..count {
            let angle = self.next(&format!("{what} angle"))?;
            if angle.abs() > 360.0 || angles.last().is_some_and(|last| *last >= angle) {
                return Err(format!("its {what} angles do not ascend at {angle}"));
            }
            angles.push(angle);
        }
        Ok(angles)
    }
}

#[cfg(test)]
mod tests;
