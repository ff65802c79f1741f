//! The buffer of a glTF file and the binary container, for all glTF files that are written.

use serde_json::{Value, json};

/// Targets of buffer views: vertex data and index data.
const VERTICES: u32 = 34_962;
const INDICES: u32 = 34_963;
/// Component types.
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

/// The buffer with its views and accessors. Each method adds an accessor and returns its number.
#[derive(Default)]
pub struct Pack {
    /// The buffer.
    pub bytes: Vec<u8>,
    /// The list `bufferViews` of the file.
    pub views: Vec<Value>,
    /// The list `accessors` of the file.
    pub accessors: Vec<Value>,
}

impl Pack {
    /// Adds rows of floats for vertices.
    pub fn vertices<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        self.add(le(rows.iter().flatten().map(|number| number.to_le_bytes())), Some(VERTICES));
        self.accessor(F32, rows.len(), kind(N))
    }

    /// Adds places with their bounds, which glTF requires.
    pub fn places(&mut self, rows: &[[f32; 3]]) -> usize {
        let index = self.vertices(rows);
        let bound = |pick: fn(f32, f32) -> f32| {
            let start = rows.first().copied().unwrap_or_default();
            rows.iter()
                .fold(start, |bound, row| std::array::from_fn(|axis| pick(bound[axis], row[axis])))
        };
        self.accessors[index]["min"] = json!(bound(f32::min));
        self.accessors[index]["max"] = json!(bound(f32::max));
        index
    }

    /// Adds the joints of vertices.
    pub fn joints(&mut self, rows: &[[u16; 4]]) -> usize {
        self.add(le(rows.iter().flatten().map(|number| number.to_le_bytes())), Some(VERTICES));
        self.accessor(U16, rows.len(), "VEC4")
    }

    /// Adds the corners of triangles.
    pub fn indices(&mut self, corners: &[u32]) -> usize {
        self.add(le(corners.iter().map(|number| number.to_le_bytes())), Some(INDICES));
        self.accessor(U32, corners.len(), "SCALAR")
    }

    /// Adds matrices, column by column.
    pub fn matrices(&mut self, rows: &[[f32; 16]]) -> usize {
        self.add(le(rows.iter().flatten().map(|number| number.to_le_bytes())), None);
        self.accessor(F32, rows.len(), "MAT4")
    }

    /// Adds rows of floats of other data than vertices, such as an animation.
    pub fn numbers<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        self.add(le(rows.iter().flatten().map(|number| number.to_le_bytes())), None);
        self.accessor(F32, rows.len(), kind(N))
    }

    fn add(&mut self, data: Vec<u8>, target: Option<u32>) {
        let offset = self.bytes.len().next_multiple_of(4);
        self.bytes.resize(offset, 0);
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": data.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.bytes.extend(data);
    }

    fn accessor(&mut self, component: u32, count: usize, kind: &str) -> usize {
        let view = self.views.len() - 1;
        self.accessors.push(
            json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }),
        );
        self.accessors.len() - 1
    }
}

fn kind(columns: usize) -> &'static str {
    match columns {
        2 => "VEC2",
        3 => "VEC3",
        4 => "VEC4",
        _ => "SCALAR",
    }
}

fn le<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> Vec<u8> {
    numbers.flatten().collect()
}

/// A binary glTF file from the document and the buffer. Both chunks are padded to a multiple of four bytes.
pub fn binary(mut document: Value, mut bytes: Vec<u8>) -> Vec<u8> {
    document["buffers"] = json!([{ "byteLength": bytes.len() }]);
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let number = |size: usize| u32::try_from(size).unwrap_or(u32::MAX).to_le_bytes();
    let mut out = Vec::with_capacity(28 + text.len() + bytes.len());
    out.extend(b"glTF");
    out.extend(number(2));
    out.extend(number(28 + text.len() + bytes.len()));
    for (kind, chunk) in [(b"JSON", text), (b"BIN\0", bytes)] {
        out.extend(number(chunk.len()));
        out.extend(kind);
        out.extend(chunk);
    }
    out
}
