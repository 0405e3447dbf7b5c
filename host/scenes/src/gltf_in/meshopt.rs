//! Compressed buffer views: `EXT_meshopt_compression`, and `KHR_meshopt_compression` as it was named later.
//!
//! The decoder is a crate's.

use gltf::json::{Index, buffer};
use serde::Deserialize;

use super::super::error::SceneError;
use super::Document;

/// Both names of the extension.
pub(super) const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// The bytes of a view, and its stride where it has one.
pub(super) type Bytes<'a> = (&'a [u8], Option<usize>);

/// As the extension's object has it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer: u32,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: u64,
    count: u64,
    mode: String,
    #[serde(default)]
    filter: String,
}

impl Document<'_> {
    /// What a compressed view holds, and its stride; `None` for a view that is not compressed.
    pub(super) fn unpacked(
        &self,
        index: Index<buffer::View>,
        view: &buffer::View,
        name: &str,
    ) -> Result<Option<Bytes<'_>>, SceneError> {
        let Some(extensions) = &view.extensions else {
            return Ok(None);
        };
        let mut compressed: Option<Compressed> = None;
        for extension in NAMES {
            if compressed.is_none() {
                compressed = self.extension(&extensions.others, extension, name)?;
            }
        }
        let Some(compressed) = compressed else {
            return Ok(None);
        };
        let cell = &self.unpacked[index.value()];
        if cell.get().is_none() {
            cell.set(self.unpack(&compressed, name)?).unwrap_or_default();
        }
        let stride = Some(compressed.byte_stride as usize);
        Ok(cell.get().map(|bytes| (bytes.as_slice(), stride)))
    }

    fn unpack(&self, view: &Compressed, name: &str) -> Result<Vec<u8>, SceneError> {
        let range = (view.byte_offset, view.byte_length);
        let source = self.bytes(Index::new(view.buffer), range, name)?;
        let size = view.count.saturating_mul(view.byte_stride);
        self.load.take(name, "what a compressed view holds", size)?;
        #[cfg(not(feature = "formats"))]
        return Err(super::super::error::not_compiled(
            self.path,
            &format!("{name} ({})", NAMES[0]),
        ));
        #[cfg(feature = "formats")]
        decode(view, source)
            .map_err(|error| self.malformed(name, format!("cannot be unpacked: {error}"), super::UNPACK))
    }
}

#[cfg(feature = "formats")]
fn decode(view: &Compressed, source: &[u8]) -> Result<Vec<u8>, String> {
    use meshoptimizer_rs::codec::{
        decode_filter_color, decode_filter_exp, decode_filter_oct, decode_filter_quat, decode_index_buffer,
        decode_index_sequence, decode_vertex_buffer,
    };
    use meshoptimizer_rs::{Limits, Workspace};
    let (count, stride) = (view.count as usize, view.byte_stride as usize);
    let workspace = &mut Workspace::new(Limits {
        max_bytes: count.saturating_mul(stride),
        ..Limits::default()
    });
    let decoded = match view.mode.as_str() {
        "ATTRIBUTES" => decode_vertex_buffer(count, stride, source, workspace),
        "TRIANGLES" => decode_index_buffer(count, stride, source, workspace),
        "INDICES" => decode_index_sequence(count, stride, source, workspace),
        mode => return Err(format!("mode `{mode}` is not known")),
    };
    let mut bytes = decoded.map_err(|error| error.to_string())?;
    let filtered = match view.filter.as_str() {
        "" | "NONE" => Ok(()),
        "OCTAHEDRAL" => decode_filter_oct(&mut bytes, count, stride, workspace),
        "QUATERNION" => decode_filter_quat(&mut bytes, count, stride, workspace),
        "EXPONENTIAL" => decode_filter_exp(&mut bytes, count, stride, workspace),
        "COLOR" => decode_filter_color(&mut bytes, count, stride, workspace),
        filter => return Err(format!("filter `{filter}` is not known")),
    };
    filtered.map_err(|error| error.to_string())?;
    Ok(bytes)
}
