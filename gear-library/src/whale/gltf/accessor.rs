//! Numbers out of a glTF file's buffers, whatever their type; nothing is read past an end.

use gltf::Accessor;
use gltf::accessor::DataType;

use super::Fault;
use super::file::File;

/// Rows of `N` numbers; whole numbers of a normalised accessor become shares.
pub(super) fn rows<const N: usize>(
    file: &File,
    accessor: &Accessor<'_>,
) -> Result<Vec<[f64; N]>, Fault> {
    let faulty = |what: &str| {
        Fault::new(
            format!("accessor {} {what}", accessor.index()),
            "write the file anew with a program that keeps to glTF 2.0",
        )
    };
    if accessor.dimensions().multiplicity() != N {
        return Err(faulty(&format!(
            "has rows of {}, not {N} numbers",
            accessor.dimensions().multiplicity()
        )));
    }
    let view = accessor
        .view()
        .filter(|_| accessor.sparse().is_none())
        .ok_or_else(|| faulty("is sparse, which is not read here"))?;
    let width = accessor.data_type().size();
    let stride = view.stride().unwrap_or(width * N);
    let end = view.offset().saturating_add(view.length());
    let bytes = file
        .buffer(view.buffer().index())
        .get(view.offset()..end)
        .ok_or_else(|| faulty("reaches past its buffer"))?;
    let one = |row: usize| {
        let start = row.checked_mul(stride)?.checked_add(accessor.offset())?;
        let own = bytes.get(start..start.checked_add(width * N)?)?;
        let mut numbers = [0.0; N];
        for (number, bytes) in numbers.iter_mut().zip(own.chunks_exact(width)) {
            *number = value(accessor.data_type(), bytes, accessor.normalized())?;
        }
        Some(numbers)
    };
    // A stride of nothing would count rows without end.
    if stride < width * N {
        return Err(faulty("has rows that overlap"));
    }
    (0..accessor.count())
        .map(|row| one(row).ok_or_else(|| faulty("reaches past its buffer")))
        .collect()
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
