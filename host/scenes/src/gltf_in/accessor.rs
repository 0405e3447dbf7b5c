//! Accessors, read with every range checked (glTF 2.0, section 3.6.2).

use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, IndexComponentType};
use gltf::json::validation::Checked;
use gltf::json::{self, Index, buffer};

use super::super::error::SceneError;
use super::Document;
use super::attributes::Normalized;

/// Where the elements of an accessor lie.
struct Layout<'a> {
    /// From the first element on; empty for an accessor of zeros.
    bytes: &'a [u8],
    stride: usize,
    components: usize,
    component: ComponentType,
    normalized: bool,
    count: usize,
}

const ADVICE: &str = "the file is damaged; export it again";

impl Document<'_> {
    /// Elements of `N` numbers each, integers converted as glTF says.
    pub(super) fn floats<const N: usize>(
        &self,
        index: Index<Accessor>,
        element: &str,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let accessor = self.get(&self.root.accessors, index, "accessor", element)?;
        let name = format!("accessors[{}] (used by {element})", index.value());
        let layout = self.layout(accessor, &name)?;
        if layout.components != N {
            let problem = format!("has {} numbers per element, expected {N}", layout.components);
            return Err(self.malformed(name, problem, ADVICE));
        }
        let mut values: Vec<[f32; N]> = (0..layout.count).map(|i| layout.element(i)).collect();
        if let Some(sparse) = &accessor.sparse {
            self.substitute(&mut values, sparse, &layout, |of, i| of.element(i), &name)?;
        }
        Ok(values)
    }

    /// Vertex indices: one unsigned integer per element.
    pub(super) fn indices(&self, index: Index<Accessor>, element: &str) -> Result<Vec<u32>, SceneError> {
        let accessor = self.get(&self.root.accessors, index, "accessor", element)?;
        let name = format!("accessors[{}] (used by {element})", index.value());
        let layout = self.layout(accessor, &name)?;
        let unsigned = matches!(
            layout.component,
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32
        );
        if layout.components != 1 || !unsigned {
            return Err(self.malformed(name, "is not a list of unsigned integers", ADVICE));
        }
        let mut values: Vec<u32> = (0..layout.count).map(|i| layout.unsigned(i)).collect();
        if let Some(sparse) = &accessor.sparse {
            self.substitute(&mut values, sparse, &layout, |of, i| of.unsigned(i), &name)?;
        }
        Ok(values)
    }

    /// Checks that all elements lie inside the accessor's view, and takes memory for them.
    fn layout(&self, accessor: &Accessor, name: &str) -> Result<Layout<'_>, SceneError> {
        let (Checked::Valid(GenericComponentType(component)), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(self.malformed(name, "has an unknown component type or element type", ADVICE));
        };
        let components = shape.multiplicity();
        let view = match accessor.buffer_view {
            Some(view) => self.view(view, name)?,
            None => (&[][..], None),
        };
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let layout = self.place(
            name,
            view,
            offset,
            accessor.count.0,
            (component, components, accessor.normalized),
        )?;

        // An accessor without a view holds zeros: of a small file there are few.
        let all_bytes: u64 = self.buffers.iter().map(|buffer| buffer.len() as u64).sum();
        if accessor.buffer_view.is_none() && accessor.count.0 > all_bytes {
            let problem = format!(
                "is {} zeros without a bufferView, more than the {all_bytes} bytes of all buffers",
                accessor.count.0
            );
            return Err(self.malformed(name, problem, "give it a bufferView, or fewer elements"));
        }
        // Every number takes four bytes; many primitives may share one accessor.
        let bytes = accessor.count.0.saturating_mul(4 * components as u64);
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
        (component, components, normalized): (ComponentType, usize, bool),
    ) -> Result<Layout<'b>, SceneError> {
        let size = component.size() * components;
        let stride = stride.unwrap_or(size);
        if stride < size {
            let problem = format!("has elements of {size} bytes at a stride of {stride}");
            return Err(self.malformed(name, problem, ADVICE));
        }
        let end = count.checked_sub(1).map_or(Some(offset), |last| {
            last.checked_mul(stride as u64)?
                .checked_add(size as u64)?
                .checked_add(offset)
        });
        let inside = end.is_some_and(|end| end <= bytes.len() as u64);
        // Zeros of a sparse accessor need no bytes; their count is bounded by the caller.
        if !inside && !bytes.is_empty() {
            let problem = format!(
                "claims {count} elements from byte {offset}, beyond its {} bytes",
                bytes.len()
            );
            return Err(self.malformed(name, problem, ADVICE));
        }
        let bytes = if inside { &bytes[offset as usize..] } else { &[] };
        Ok(Layout {
            bytes,
            stride,
            components,
            component,
            normalized,
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
        let buffer = &self.buffers[index.value()];
        let end = start.checked_add(length);
        let Some(end) = end.filter(|&end| end <= buffer.len() as u64 && length > 0) else {
            let problem = format!(
                "claims {length} bytes from byte {start} of buffer {}, which has {}",
                index.value(),
                buffer.len()
            );
            return Err(self.malformed(name, problem, ADVICE));
        };
        Ok(&buffer[start as usize..end as usize])
    }

    /// Replaces single elements (glTF 2.0, section 3.6.2.3).
    fn substitute<T>(
        &self,
        values: &mut [T],
        sparse: &json::accessor::sparse::Sparse,
        of: &Layout<'_>,
        read: fn(&Layout<'_>, usize) -> T,
        name: &str,
    ) -> Result<(), SceneError> {
        let Checked::Valid(IndexComponentType(component)) = sparse.indices.component_type else {
            return Err(self.malformed(name, "has sparse indices of an unknown type", ADVICE));
        };
        let count = sparse.count.0;
        if count > values.len() as u64 {
            let problem = format!("substitutes {count} of {} elements", values.len());
            return Err(self.malformed(name, problem, ADVICE));
        }
        let view = self.view(sparse.indices.buffer_view, name)?;
        let offset = sparse.indices.byte_offset.0;
        let at = self.place(name, view, offset, count, (component, 1, false))?;
        let view = self.view(sparse.values.buffer_view, name)?;
        let shape = (of.component, of.components, of.normalized);
        let new = self.place(name, view, sparse.values.byte_offset.0, count, shape)?;
        for i in 0..at.count {
            let target = at.unsigned(i) as usize;
            let total = values.len();
            let Some(value) = values.get_mut(target) else {
                let problem = format!("substitutes element {target} of {total}");
                return Err(self.malformed(name, problem, ADVICE));
            };
            *value = read(&new, i);
        }
        Ok(())
    }
}

impl Layout<'_> {
    /// Element `index`; zeros where there are no bytes.
    fn element<const N: usize>(&self, index: usize) -> [f32; N] {
        std::array::from_fn(|component| self.float(index, component))
    }

    /// Four little-endian bytes, missing ones zero.
    fn word(&self, index: usize, component: usize) -> [u8; 4] {
        let size = self.component.size();
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
        let value = match self.component {
            ComponentType::F32 => return f32::from_le_bytes(word),
            ComponentType::I8 => f32::from(word[0] as i8),
            ComponentType::U8 => f32::from(word[0]),
            ComponentType::I16 => f32::from(i16::from_le_bytes([word[0], word[1]])),
            ComponentType::U16 => f32::from(u16::from_le_bytes([word[0], word[1]])),
            ComponentType::U32 => u32::from_le_bytes(word) as f32,
        };
        if self.normalized {
            self.component.normalized(value)
        } else {
            value
        }
    }
}
