//! Reads the text and the buffers of a glTF file; accesses to buffers are checked.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::accessor::DataType;
use gltf::buffer::Source;
use gltf::json::Root;
use gltf::{Accessor, Document};

use super::Fault;

/// Help on the format of a file.
const SAVE_AS: &str = "save it as glTF Binary (.glb), or as .gltf with its data embedded";

/// An opened file.
pub(super) struct File {
    /// The file without its buffers.
    pub document: Document,
    buffers: Vec<Vec<u8>>,
}

impl File {
    /// Opens a `.glb` or `.gltf` file.
    pub fn open(bytes: &[u8]) -> Result<Self, Fault> {
        let (text, binary) =
            if bytes.starts_with(b"glTF") { chunks(bytes)? } else { (bytes, None) };
        let not_gltf = |error: &dyn std::fmt::Display| {
            Fault::new(format!("is not valid glTF 2.0: {error}"), SAVE_AS)
        };
        let root: Root =
            gltf::json::deserialize::from_slice(text).map_err(|error| not_gltf(&error))?;
        uncompressed(&root)?;
        let document =
            Document::from_json(root).map_err(|error| not_gltf(&first_errors(&error)))?;
        let buffers = document
            .buffers()
            .map(|buffer| load(&buffer.source(), binary, buffer.length()))
            .collect::<Result<_, _>>()?;
        Ok(Self { document, buffers })
    }

    /// The bytes of a buffer; `None` if it does not exist.
    pub fn buffer(&self, index: usize) -> &[u8] {
        self.buffers.get(index).map_or(&[], Vec::as_slice)
    }
}

/// Reports compressed meshes with the name of the compression.
fn uncompressed(root: &Root) -> Result<(), Fault> {
    let compressing = root.extensions_required.iter().find(|name| name.ends_with("compression"));
    compressing.map_or(Ok(()), |name| {
        Err(Fault::new(
            format!("is compressed by {name}"),
            "in Blender, export without Compression",
        ))
    })
}

/// The first few errors of the validation, which may repeat for many meshes.
fn first_errors(error: &gltf::Error) -> String {
    let gltf::Error::Validation(faults) = error else { return error.to_string() };
    let first: Vec<String> =
        faults.iter().take(3).map(|(path, fault)| format!("{path}: {fault}")).collect();
    let more = faults.len().saturating_sub(first.len());
    let rest = if more > 0 { format!("; and {more} more") } else { String::new() };
    format!("{}{rest}", first.join("; "))
}

/// The text and the numbers of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    let short = || Fault::new("is truncated", "export it again");
    let number = |at: usize| {
        bytes.get(at..at + 4).and_then(|four| four.try_into().ok()).map(u32::from_le_bytes)
    };
    let chunk = |at: usize| {
        let end = at.checked_add(8)?.checked_add(number(at)? as usize)?;
        Some((bytes.get(at + 4..at + 8)?, bytes.get(at + 8..end)?, end))
    };
    if number(4) != Some(2) {
        return Err(Fault::new("is binary glTF of another version than 2", SAVE_AS));
    }
    let (kind, text, end) = chunk(12).ok_or_else(short)?;
    if kind != b"JSON" {
        return Err(Fault::new("does not begin with its JSON chunk", SAVE_AS));
    }
    match chunk(end) {
        Some((b"BIN\0", numbers, _)) => Ok((text, Some(numbers))),
        None if end < bytes.len() => Err(short()),
        _ => Ok((text, None)),
    }
}

fn load(source: &Source<'_>, binary: Option<&[u8]>, length: usize) -> Result<Vec<u8>, Fault> {
    let bytes = match source {
        Source::Bin => {
            binary.map(<[u8]>::to_vec).ok_or_else(|| Fault::new("has no binary chunk", SAVE_AS))?
        }
        Source::Uri(uri) => match uri.split_once(";base64,") {
            Some((head, data)) if head.starts_with("data:") => STANDARD
                .decode(data)
                .map_err(|error| Fault::new(format!("has damaged data: {error}"), SAVE_AS))?,
            _ => {
                return Err(Fault::new(format!("has its data in another file, `{uri}`"), SAVE_AS));
            }
        },
    };
    if bytes.len() < length {
        return Err(Fault::new(
            format!("has {} bytes of data instead of {length}", bytes.len()),
            "export it again",
        ));
    }
    Ok(bytes)
}

/// Rows of `N` numbers; integers of a normalised accessor are converted to shares.
pub(super) fn rows<const N: usize>(
    file: &File,
    accessor: &Accessor<'_>,
) -> Result<Vec<[f64; N]>, Fault> {
    let faulty = |what: &str| {
        Fault::new(
            format!("accessor {} {what}", accessor.index()),
            "export it again with a program that conforms to glTF 2.0",
        )
    };
    if accessor.dimensions().multiplicity() != N {
        return Err(faulty(&format!(
            "has rows of {} instead of {N} numbers",
            accessor.dimensions().multiplicity()
        )));
    }
    let view = accessor
        .view()
        .filter(|_| accessor.sparse().is_none())
        .ok_or_else(|| faulty("is sparse, which is not supported"))?;
    let width = accessor.data_type().size();
    let stride = view.stride().unwrap_or(width * N);
    let end = view.offset().saturating_add(view.length());
    let bytes = file
        .buffer(view.buffer().index())
        .get(view.offset()..end)
        .ok_or_else(|| faulty("exceeds its buffer"))?;
    let one = |row: usize| {
        let start = row.checked_mul(stride)?.checked_add(accessor.offset())?;
        let own = bytes.get(start..start.checked_add(width * N)?)?;
        let mut numbers = [0.0; N];
        for (number, bytes) in numbers.iter_mut().zip(own.chunks_exact(width)) {
            *number = value(accessor.data_type(), bytes, accessor.normalized())?;
        }
        Some(numbers)
    };
    // A stride of zero would never end.
    if stride < width * N {
        return Err(faulty("has rows that overlap"));
    }
    (0..accessor.count()).map(|row| one(row).ok_or_else(|| faulty("exceeds its buffer"))).collect()
}

fn value(kind: DataType, bytes: &[u8], normalized: bool) -> Option<f64> {
    let (number, greatest) = match kind {
        DataType::I8 => (f64::from(i8::from_le_bytes(bytes.try_into().ok()?)), f64::from(i8::MAX)),
        DataType::U8 => (f64::from(u8::from_le_bytes(bytes.try_into().ok()?)), f64::from(u8::MAX)),
        DataType::I16 => {
            (f64::from(i16::from_le_bytes(bytes.try_into().ok()?)), f64::from(i16::MAX))
        }
        DataType::U16 => {
            (f64::from(u16::from_le_bytes(bytes.try_into().ok()?)), f64::from(u16::MAX))
        }
        DataType::U32 => {
            (f64::from(u32::from_le_bytes(bytes.try_into().ok()?)), f64::from(u32::MAX))
        }
        DataType::F32 => return Some(f64::from(f32::from_le_bytes(bytes.try_into().ok()?))),
    };
    Some(if normalized { (number / greatest).max(-1.0) } else { number })
}
