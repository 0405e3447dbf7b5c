//! Accessors, read with every range checked (glTF 2.0, section 3.6.2).

use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType};
use gltf::json::validation::Checked;
use gltf::json::{self, Index, buffer};

use super::super::error::SceneError;
use super::{DAMAGED, Document};

/// The elements of an accessor, or of a part of one.
struct Elements<'a> {
    /// From the first element on.
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: ComponentType,
    /// Numbers of an element.
    numbers: usize,
    normalized: bool,
}

impl Document<'_> {
    /// Elements of `N` numbers each, integers converted as glTF says: all, or those of `rows`.
    pub(super) fn floats<const N: usize>(
        &self,
        index: Index<Accessor>,
        element: &str,
        rows: Option<&[u32]>,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let own = self.elements(index, element, rows.map(<[u32]>::len), |own| match own.numbers {
            found if found == N => beyond(rows, own.count),
            found => Err(format!("has {found} numbers per element, expected {N}")),
        })?;
        let read = |i: usize| std::array::from_fn(|k| own.float(i, k));
        Ok(match rows {
            Some(rows) => rows.iter().map(|&row| read(row as usize)).collect(),
            None => (0..own.count).map(read).collect(),
        })
    }

    /// How many elements an accessor has.
    pub(super) fn count(&self, index: Index<Accessor>, element: &str) -> Result<usize, SceneError> {
        self.elements(index, element, Some(0), |_| Ok(()))
            .map(|own| own.count)
    }

    /// Vertex indices: one unsigned integer per element.
    pub(super) fn indices(&self, index: Index<Accessor>, element: &str) -> Result<Vec<u32>, SceneError> {
        use ComponentType::{U8, U16, U32};
        let own = self.elements(index, element, None, |own| match (own.numbers, own.component) {
            (1, U8 | U16 | U32) => Ok(()),
            _ => Err(String::from("is not a list of unsigned integers")),
        })?;
        Ok((0..own.count).map(|i| own.unsigned(i)).collect())
    }

    /// Reserves memory for all elements, or for the given number of them.
    fn elements(
        &self,
        index: Index<Accessor>,
        element: &str,
        taken: Option<usize>,
        check: impl Fn(&Elements<'_>) -> Result<(), String>,
    ) -> Result<Elements<'_>, SceneError> {
        let accessor = self.get(&self.root.accessors, index, "accessor", element)?;
        let name = &format!("accessors[{}] (used by {element})", index.value());
        let (Checked::Valid(GenericComponentType(component)), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(self.malformed(name, "has an unknown component type or element type", DAMAGED));
        };
        let (numbers, count) = (shape.multiplicity(), accessor.count.0);
        // Every number takes four bytes; many primitives may share one accessor.
        let bytes = taken
            .map_or(count, |taken| taken as u64)
            .saturating_mul(4 * numbers as u64);
        let (Some(view), None) = (accessor.buffer_view, &accessor.sparse) else {
            let problem = "has no bufferView, or is sparse, which is not read";
            return Err(self.malformed(name, problem, "export the file without sparse accessors"));
        };
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let mut own = self.within(name, view, offset, count, (component, numbers))?;
        self.load.take(name, "the list of elements", bytes)?;
        own.normalized = accessor.normalized;
        check(&own).map_err(|problem| self.malformed(name, problem, DAMAGED))?;
        Ok(own)
    }

    /// `count` elements of a view from `offset` on, all inside it.
    fn within(
        &self,
        name: &str,
        view: Index<buffer::View>,
        offset: u64,
        count: u64,
        (component, numbers): (ComponentType, usize),
    ) -> Result<Elements<'_>, SceneError> {
        let (bytes, stride) = self.view(view, name)?;
        let size = component.size() * numbers;
        let stride = stride.unwrap_or(size);
        if stride < size {
            let problem = format!("has elements of {size} bytes at a stride of {stride}");
            return Err(self.malformed(name, problem, DAMAGED));
        }
        let end = count.checked_sub(1).map_or(Some(offset), |last| {
            last.checked_mul(stride as u64)?
                .checked_add(size as u64)?
                .checked_add(offset)
        });
        let Some(_) = end.filter(|&end| end <= bytes.len() as u64) else {
            let length = bytes.len();
            let problem = format!("claims {count} elements from byte {offset}, beyond its {length} bytes");
            return Err(self.malformed(name, problem, DAMAGED));
        };
        Ok(Elements {
            bytes: &bytes[offset as usize..],
            stride,
            count: count as usize,
            component,
            numbers,
            normalized: false,
        })
    }

    /// The bytes of a view, unpacked where they are compressed, and its stride.
    pub(super) fn view(
        &self,
        index: Index<buffer::View>,
        element: &str,
    ) -> Result<(&[u8], Option<usize>), SceneError> {
        let view = self.get(&self.root.buffer_views, index, "bufferView", element)?;
        let name = format!("bufferViews[{}] (used by {element})", index.value());
        if let Some(unpacked) = self.unpacked(index, view, &name)? {
            return Ok(unpacked);
        }
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let bytes = self.bytes(view.buffer, (start, view.byte_length.0), &name)?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0)))
    }

    /// `length` bytes of a buffer from `start` on.
    pub(super) fn bytes(
        &self,
        index: Index<json::Buffer>,
        (start, length): (u64, u64),
        name: &str,
    ) -> Result<&[u8], SceneError> {
        self.get(&self.root.buffers, index, "buffer", name)?;
        let (buffer, index) = (&self.buffers[index.value()], index.value());
        let end = start.checked_add(length);
        let Some(end) = end.filter(|&end| end <= buffer.len() as u64 && length > 0) else {
            let has = buffer.len();
            let problem =
                format!("claims {length} bytes from byte {start} of buffer {index}, which has {has}");
            return Err(self.malformed(name, problem, DAMAGED));
        };
        Ok(&buffer[start as usize..end as usize])
    }
}

impl Elements<'_> {
    /// A number in four little-endian bytes.
    fn word(&self, index: usize, number: usize) -> [u8; 4] {
        let size = self.component.size();
        let at = index * self.stride + number * size;
        let mut word = [0; 4];
        word[..size].copy_from_slice(&self.bytes[at..at + size]);
        word
    }

    fn unsigned(&self, index: usize) -> u32 {
        u32::from_le_bytes(self.word(index, 0))
    }

    fn float(&self, index: usize, number: usize) -> f32 {
        let word = self.word(index, number);
        let value = match self.component {
            ComponentType::F32 => f32::from_le_bytes(word),
            ComponentType::I8 => f32::from(word[0] as i8),
            ComponentType::I16 => f32::from(i16::from_le_bytes([word[0], word[1]])),
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32 => u32::from_le_bytes(word) as f32,
        };
        match self.normalized {
            true => normalized(self.component, value),
            false => value,
        }
    }
}

/// An error if a row is beyond `count` elements.
pub(super) fn beyond(rows: Option<&[u32]>, count: usize) -> Result<(), String> {
    match rows.unwrap_or_default().iter().any(|&row| row as usize >= count) {
        true => Err(format!("has {count} elements, fewer than its positions")),
        false => Ok(()),
    }
}

/// What a normalized integer stands for, in [0, 1] or [-1, 1] (glTF 2.0, sections 3.6.2.2 and 3.11).
pub(super) fn normalized(component: ComponentType, value: f32) -> f32 {
    let largest = match component {
        ComponentType::F32 => return value,
        ComponentType::I8 => 127.0,
        ComponentType::U8 => 255.0,
        ComponentType::I16 => 32767.0,
        ComponentType::U16 => 65535.0,
        ComponentType::U32 => 4_294_967_295.0,
    };
    (value / largest).max(-1.0)
}
