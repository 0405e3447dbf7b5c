//! A part of an image.

use std::fmt;

use serde::Serialize;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Region {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Region {
    /// Whether it has a pixel and all of them lie in an image of `size` columns and rows.
    pub fn is_within(&self, size: (u32, u32)) -> bool {
        let inside = |first: u32, count: u32, all: u32| count > 0 && first < all && count <= all - first;
        inside(self.x, self.width, size.0) && inside(self.y, self.height, size.1)
    }

    /// Whether the two share a pixel.
    pub fn overlaps(&self, other: &Self) -> bool {
        let apart = |a: u32, n: u32, b: u32, m: u32| a + n <= b || b + m <= a;
        !apart(self.x, self.width, other.x, other.width) && !apart(self.y, self.height, other.y, other.height)
    }

    /// Its pixels out of those of an image with `columns` columns, which it must lie within.
    pub fn cut<T: Copy>(&self, pixels: &[T], columns: u32) -> Vec<T> {
        let rows = self.y..self.y + self.height;
        rows.flat_map(|row| {
            let first = (row * columns + self.x) as usize;
            &pixels[first..first + self.width as usize]
        })
        .copied()
        .collect()
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}+{}+{}", self.width, self.height, self.x, self.y)
    }
}

#[cfg(test)]
mod tests {
    use super::Region;

    #[test]
    fn a_cut_has_the_rows_and_columns_of_the_region() {
        let pixels: Vec<u32> = (0..20).collect();
        let region = Region {
            x: 1,
            y: 2,
            width: 3,
            height: 2,
        };
        assert_eq!(region.cut(&pixels, 5), [11, 12, 13, 16, 17, 18]);
        assert!(region.is_within((5, 4)));
        assert!(!region.is_within((5, 3)) && !region.is_within((3, 4)));
        let empty = Region { width: 0, ..region };
        let far = Region {
            x: u32::MAX,
            ..region
        };
        assert!(!empty.is_within((5, 4)) && !far.is_within((5, 4)));
    }

    #[test]
    fn regions_overlap_where_they_share_a_pixel() {
        let at = |x, y| Region {
            x,
            y,
            width: 4,
            height: 3,
        };
        assert!(at(0, 0).overlaps(&at(3, 2)));
        assert!(!at(0, 0).overlaps(&at(4, 0)));
        assert!(!at(0, 0).overlaps(&at(0, 3)));
    }
}
