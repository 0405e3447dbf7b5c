//! Accessors, read with every range checked (glTF 2.0, section 3.6.2).

use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, IndexComponentType};
use gltf::json::validation::Checked;
use gltf::json::{self, Index, buffer};

use super::super::error::SceneError;
use super::{DAMAGED, Document};

/// What the elements of an accessor are.
#[derive(Clone, Copy)]
struct Shape {
    components: usize,
    component: ComponentType,
    normalized: bool,
}

/// Where the elements of an accessor lie.
struct Layout<'a> {
    /// From the first element on; empty for an accessor of zeros.
    bytes: &'a [u8],
    stride: usize,
    shape: Shape,
    count: usize,
}

impl Document<'_> {
    /// Elements of `N` numbers each, integers converted as glTF says.
    pub(super) fn floats<const N: usize>(
        &self,
        index: Index<Accessor>,
        element: &str,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let read = |of: &Layout<'_>, i| std::array::from_fn(|component| of.float(i, component));
        self.elements(index, element, read, |shape| match shape.components {
            own if own == N => Ok(()),
            own => Err(format!("has {own} numbers per element, expected {N}")),
        })
    }

    /// Vertex indices: one unsigned integer per element.
    pub(super) fn indices(&self, index: Index<Accessor>, element: &str) -> Result<Vec<u32>, SceneError> {
        use ComponentType::{U8, U16, U32};
        self.elements(
            index,
            element,
            |of, i| of.unsigned(i),
            |shape| match (shape.components, shape.component) {
                (1, U8 | U16 | U32) => Ok(()),
                _ => Err(String::from("is not a list of unsigned integers")),
            },
        )
    }

    fn elements<T>(
        &self,
        index: Index<Accessor>,
        element: &str,
        read: fn(&Layout<'_>, usize) -> T,
        check: impl Fn(Shape) -> Result<(), String>,
    ) -> Result<Vec<T>, SceneError> {
        let accessor = self.get(&self.root.accessors, index, "accessor", element)?;
        let name = format!("accessors[{}] (used by {element})", index.value());
        let layout = self.layout(accessor, &name)?;
        check(layout.shape).map_err(|problem| self.malformed(&name, problem, DAMAGED))?;
        let mut values: Vec<T> = (0..layout.count).map(|i| read(&layout, i)).collect();
        if let Some(sparse) = &accessor.sparse {
            self.substitute(&mut values, sparse, layout.shape, read, &name)?;
        }
        Ok(values)
    }

    /// Checks that all elements lie inside the accessor's view, and takes memory for them.
    fn layout(&self, accessor: &Accessor, name: &str) -> Result<Layout<'_>, SceneError> {
        let (Checked::Valid(GenericComponentType(component)), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(self.malformed(name, "has an unknown component type or element type", DAMAGED));
        };
        let shape = Shape {
            components: shape.multiplicity(),
            component,
            normalized: accessor.normalized,
        };
        let view = match accessor.buffer_view {
            Some(view) => self.view(view, name)?,
            None => (&[][..], None),
        };
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let count = accessor.count.0;
        let layout = self.place(name, view, offset, count, shape)?;

        // An accessor without a view holds zeros: of a small file there are few.
        let all_bytes: u64 = self.buffers.iter().map(|buffer| buffer.len() as u64).sum();
        if accessor.buffer_view.is_none() && count > all_bytes {
            let problem = format!(
                "is {count} zeros without a bufferView, more than the {all_bytes} bytes of all buffers"
            );
            return Err(self.malformed(name, problem, "give it a bufferView, or fewer elements"));
        }
        // Every number takes four bytes; many primitives may share one accessor.
        let bytes = count.saturating_mul(4 * shape.components as u64);
        self.load.take(name, "the list of elements", bytes)?;
        Ok(layout)
    }

    /// `count` elements from `offset` on, all inside `bytes` unless `bytes` is empty for want of a view.
    fn place<'b>(
        &self,
        name: &str,
        (bytes, stride): (&'b [u8], Option<usize>),
        offset: u64,
        count: u64,
        shape: Shape,
    ) -> Result<Layout<'b>, SceneError> {
        let size = shape.component.size() * shape.components;
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
        let inside = end.is_some_and(|end| end <= bytes.len() as u64);
        // Zeros of a sparse accessor need no bytes; their count is bounded by the caller.
        if !inside && !bytes.is_empty() {
            let length = bytes.len();
            let problem = format!("claims {count} elements from byte {offset}, beyond its {length} bytes");
            return Err(self.malformed(name, problem, DAMAGED));
        }
        Ok(Layout {
            bytes: if inside { &bytes[offset as usize..] } else { &[] },
            stride,
            shape,
            count: count as usize,
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

    /// Replaces single elements (glTF 2.0, section 3.6.2.3).
    fn substitute<T>(
        &self,
        values: &mut [T],
        sparse: &json::accessor::sparse::Sparse,
        shape: Shape,
        read: fn(&Layout<'_>, usize) -> T,
        name: &str,
    ) -> Result<(), SceneError> {
        let Checked::Valid(IndexComponentType(component)) = sparse.indices.component_type else {
            return Err(self.malformed(name, "has sparse indices of an unknown type", DAMAGED));
        };
        let (count, total) = (sparse.count.0, values.len());
        if count > total as u64 {
            let problem = format!("substitutes {count} of {total} elements");
            return Err(self.malformed(name, problem, DAMAGED));
        }
        let one = Shape {
            components: 1,
            component,
            normalized: false,
        };
        let view = self.view(sparse.indices.buffer_view, name)?;
        let at = self.place(name, view, sparse.indices.byte_offset.0, count, one)?;
        let view = self.view(sparse.values.buffer_view, name)?;
        let new = self.place(name, view, sparse.values.byte_offset.0, count, shape)?;
        for i in 0..at.count {
            let target = at.unsigned(i) as usize;
            let Some(value) = values.get_mut(target) else {
                let problem = format!("substitutes element {target} of {total}");
                return Err(self.malformed(name, problem, DAMAGED));
            };
            *value = read(&new, i);
        }
        Ok(())
    }
}

impl Layout<'_> {
    /// Four little-endian bytes, missing ones zero.
    fn word(&self, index: usize, component: usize) -> [u8; 4] {
        let size = self.shape.component.size();
        let at = index * self.stride + component * size;
        let mut word = [0; 4];
        if let Some(bytes) = self.bytes.get(at..at + size) {
            word[..size].copy_from_slice(bytes);
        }
        word
    }

    fn unsigned(&self, index: usize) -> u32 {
        u32::from_le_bytes(self.word(index, 0))
    }

    fn float(&self, index: usize, component: usize) -> f32 {
        let word = self.word(index, component);
        let value = match self.shape.component {
            ComponentType::F32 => return f32::from_le_bytes(word),
            ComponentType::I8 => f32::from(word[0] as i8),
            ComponentType::U8 => f32::from(word[0]),
            ComponentType::I16 => f32::from(i16::from_le_bytes([word[0], word[1]])),
            ComponentType::U16 => f32::from(u16::from_le_bytes([word[0], word[1]])),
            ComponentType::U32 => u32::from_le_bytes(word) as f32,
        };
        match self.shape.normalized {
            true => normalized(self.shape.component, value),
            false => value,
        }
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
