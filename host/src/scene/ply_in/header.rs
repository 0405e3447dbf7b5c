//! The header of a PLY file: its format, its elements and their properties.

use super::super::error::SceneError;
use super::malformed;

/// Longest header, elements and properties that are read.
const MAX_HEADER: usize = 1 << 20;
const MAX_PROPERTIES: usize = 1024;

const ADVICE: &str = "export the file again as PLY 1.0";

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Text,
    LittleEndian,
    BigEndian,
}

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// In binary.
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// What each element of a kind has.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Property {
    pub name: String,
    pub number: Number,
    /// Of a list, the type of its length.
    pub length: Option<Number>,
}

/// Elements of a kind, as `vertex` or `face`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

impl Element {
    /// Fewest bytes that one takes.
    pub fn least_bytes(&self, format: Format) -> u64 {
        let bytes = |property: &Property| match format {
            // A digit, and what parts it from the next.
            Format::Text => 2,
            _ => property.length.unwrap_or(property.number).bytes() as u64,
        };
        self.properties.iter().map(bytes).sum()
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Header {
    pub format: Format,
    pub elements: Vec<Element>,
}

/// The header, and the bytes after it.
pub(super) fn read<'a>(path: &str, bytes: &'a [u8]) -> Result<(Header, &'a [u8]), SceneError> {
    let mut rest = bytes;
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut properties = 0;
    let mut number = 0;
    loop {
        number += 1;
        let broken =
            |problem: String| malformed(path, format!("line {number} of the header"), problem, ADVICE);
        if bytes.len() - rest.len() > MAX_HEADER {
            return Err(broken(format!("it has more than {MAX_HEADER} bytes")));
        }
        let Some(end) = rest.iter().position(|&byte| byte == b'\n') else {
            return Err(broken(String::from("the file ends before `end_header`")));
        };
        let line = String::from_utf8_lossy(&rest[..end]).into_owned();
        rest = &rest[end + 1..];
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        if number == 1 && words != ["ply"] {
            return Err(broken(String::from("it does not begin with `ply`")));
        }
        match words[..] {
            ["format", name, version] => {
                if version != "1.0" {
                    return Err(broken(format!("version `{version}` is not known")));
                }
                format = Some(match name {
                    "ascii" => Format::Text,
                    "binary_little_endian" => Format::LittleEndian,
                    "binary_big_endian" => Format::BigEndian,
                    _ => return Err(broken(format!("format `{name}` is not known"))),
                });
            }
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| broken(format!("`{count}` is no number of elements")))?;
                elements.push(Element {
                    name: name.to_owned(),
                    count,
                    properties: Vec::new(),
                });
                properties += 1;
            }
            ["property", "list", length, item, name] => {
                properties += 1;
                add(&mut elements, Some(length), item, name).map_err(broken)?;
            }
            ["property", item, name] => {
                properties += 1;
                add(&mut elements, None, item, name).map_err(broken)?;
            }
            ["end_header"] => {
                let format = format.ok_or_else(|| broken(String::from("no format is named before it")))?;
                return Ok((Header { format, elements }, rest));
            }
            // Comments, and what else applications note.
            _ => {}
        }
        if properties > MAX_PROPERTIES {
            return Err(broken(format!("it has more than {MAX_PROPERTIES} properties")));
        }
    }
}

fn add(elements: &mut [Element], length: Option<&str>, item: &str, name: &str) -> Result<(), String> {
    let number = |name: &str| Number::named(name).ok_or_else(|| format!("type `{name}` is not known"));
    let property = Property {
        name: name.to_owned(),
        number: number(item)?,
        length: length.map(number).transpose()?,
    };
    let element = elements
        .last_mut()
        .ok_or_else(|| String::from("a property comes before the first element"))?;
    element.properties.push(property);
    Ok(())
}
