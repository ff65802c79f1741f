//! A glTF file's text and buffers.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::Document;
use gltf::buffer::Source;
use gltf::json::Root;

use super::Fault;

/// How Blender should save.
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
            Fault::new(format!("is not sound glTF 2.0: {error}"), SAVE_AS)
        };
        let root: Root =
            gltf::json::deserialize::from_slice(text).map_err(|error| not_gltf(&error))?;
        uncompressed(&root)?;
        let document = Document::from_json(root).map_err(|error| not_gltf(&told(&error)))?;
        let buffers = document
            .buffers()
            .map(|buffer| load(&buffer.source(), binary, buffer.length()))
            .collect::<Result<_, _>>()?;
        Ok(Self { document, buffers })
    }

    /// The bytes of a buffer; none for one that is not there.
    pub fn buffer(&self, index: usize) -> &[u8] {
        self.buffers.get(index).map_or(&[], Vec::as_slice)
    }
}

/// A file whose meshes are compressed is refused by the name of what did it.
fn uncompressed(root: &Root) -> Result<(), Fault> {
    let compressing = root.extensions_required.iter().find(|name| name.ends_with("compression"));
    compressing.map_or(Ok(()), |name| {
        Err(Fault::new(
            format!("is compressed by {name}"),
            "in Blender, export without Compression",
        ))
    })
}

/// What is not sound, the first few of it: one thing missing may be told for each of many meshes.
fn told(error: &gltf::Error) -> String {
    let gltf::Error::Validation(faults) = error else { return error.to_string() };
    let first: Vec<String> =
        faults.iter().take(3).map(|(path, fault)| format!("{path}: {fault}")).collect();
    let more = faults.len().saturating_sub(first.len());
    let rest = if more > 0 { format!("; and {more} more") } else { String::new() };
    format!("{}{rest}", first.join("; "))
}

/// The text and the numbers of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    let short = || Fault::new("is cut short", "write the file anew");
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
        return Err(Fault::new("does not begin with its text", SAVE_AS));
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
            binary.map(<[u8]>::to_vec).ok_or_else(|| Fault::new("has no binary part", SAVE_AS))?
        }
        Source::Uri(uri) => match uri.split_once(";base64,") {
            Some((head, data)) if head.starts_with("data:") => STANDARD
                .decode(data)
                .map_err(|error| Fault::new(format!("has damaged data: {error}"), SAVE_AS))?,
            _ => {
                return Err(Fault::new(
                    format!("keeps its numbers in another file, `{uri}`"),
                    SAVE_AS,
                ));
            }
        },
    };
    if bytes.len() < length {
        return Err(Fault::new(
            format!("has {} bytes of data, {length} were announced", bytes.len()),
            "write the file anew",
        ));
    }
    Ok(bytes)
}
