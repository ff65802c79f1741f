//! Frames on a pipe: the length of a value's bytes, then the bytes.

use std::io::{self, Read, Write};

use super::wire::Wire;

/// Longest frame that is read [bytes]: room for a library, the longest thing that is ever said.
const LONGEST: u64 = 600 << 20;

/// Writes a frame and sends it off. `room` is used for its bytes.
pub(super) fn send<T: Wire>(
    value: &T,
    pipe: &mut impl Write,
    room: &mut Vec<u8>,
) -> io::Result<()> {
    room.clear();
    0_u64.put(room);
    value.put(room);
    let length = (room.len() - size_of::<u64>()) as u64;
    room[..size_of::<u64>()].copy_from_slice(&length.to_le_bytes());
    pipe.write_all(room)?;
    pipe.flush()
}

/// Reads a frame. `room` is used for its bytes.
///
/// # Errors
/// The end of the pipe; and bytes that are no value of this kind, which is told as invalid data.
pub(super) fn receive<T: Wire>(pipe: &mut impl Read, room: &mut Vec<u8>) -> io::Result<T> {
    let mut length = [0; size_of::<u64>()];
    pipe.read_exact(&mut length)?;
    let length = u64::from_le_bytes(length);
    if length > LONGEST {
        return Err(io::ErrorKind::InvalidData.into());
    }
    room.clear();
    // Memory is taken as bytes come, not as the length says.
    pipe.take(length).read_to_end(room)?;
    if room.len() as u64 != length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    let mut rest = room.as_slice();
    let value = T::take(&mut rest).filter(|_| rest.is_empty());
    value.ok_or_else(|| io::ErrorKind::InvalidData.into())
}
