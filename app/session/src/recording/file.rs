//! The bytes of a recording: a magic word, a format number, then sections, each with its length
//! and its BLAKE3 hash. See `docs/recording.md`.

use std::io::{self, Write};

use endline_sdk::Controls;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Header, Recording};
use crate::hash::{PARTS, StateHash};
use crate::source::Source;

/// First bytes of every recording; the high bit and the line end catch text-mode copies.
const MAGIC: [u8; 8] = *b"\x89ENDLIN\n";
/// Number of this format.
const FORMAT: u32 = 3;
/// Sections in their order in the file, with the names used in messages; the last is empty and marks the end.
const SECTIONS: [([u8; 4], &str); 5] = [
    (*b"HEAD", "header"),
    (*b"MODL", "model source"),
    (*b"INPT", "inputs"),
    (*b"HASH", "state hashes"),
    (*b"DONE", "end mark"),
];
const INPUTS: usize = 2;

/// The payload of a section, in pieces; read twice, because its hash precedes it.
pub(crate) trait Rows {
    /// Its length.
    fn bytes(&self) -> u64;

    /// Passes it on piece by piece.
    fn each(&self, take: &mut dyn FnMut(&[u8]) -> io::Result<()>) -> io::Result<()>;
}

impl Rows for Vec<u8> {
    fn bytes(&self) -> u64 {
        self.len() as u64
    }

    fn each(&self, take: &mut dyn FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        take(self)
    }
}

/// Writes a recording: inputs are the ten floats of each step, hashes the parts of each state, both little-endian.
pub(super) fn write(
    out: &mut dyn Write,
    header: &Header,
    source: &Source,
    [inputs, hashes]: [&dyn Rows; 2],
) -> io::Result<()> {
    let (header, source) = (encode(header)?, encode(source)?);
    let payloads: [&dyn Rows; SECTIONS.len()] = [&header, &source, inputs, hashes, &Vec::new()];
    out.write_all(&MAGIC)?;
    out.write_all(&FORMAT.to_le_bytes())?;
    for ((tag, _), payload) in SECTIONS.iter().zip(payloads) {
        let mut hasher = blake3::Hasher::new();
        payload.each(&mut |piece| {
            hasher.update(piece);
            Ok(())
        })?;
        out.write_all(tag)?;
        out.write_all(&payload.bytes().to_le_bytes())?;
        out.write_all(hasher.finalize().as_bytes())?;
        payload.each(&mut |piece| out.write_all(piece))?;
    }
    Ok(())
}

/// Words in the byte order of a file.
pub(crate) fn bytes<const N: usize>(rows: impl Iterator<Item = [u64; N]>) -> Vec<u8> {
    rows.flatten().flat_map(u64::to_le_bytes).collect()
}

/// Reads a recording from its bytes; an error names the expected content.
pub(super) fn read(bytes: &[u8]) -> Result<Recording, String> {
    let mut reader = Reader { rest: bytes };
    check_start(&mut reader)?;
    let mut payloads = [&[] as &[u8]; SECTIONS.len()];
    let mut damage = None;
    for (index, (tag, name)) in SECTIONS.iter().enumerate() {
        let (payload, sound) = reader.section(*tag, name)?;
        payloads[index] = payload;
        if !sound && index == INPUTS {
            damage = Some(format!(
                "the {name} were changed after the recording was saved (their BLAKE3 hash differs)"
            ));
        } else if !sound {
            return Err(format!(
                "is damaged: the BLAKE3 hash of its {name} differs from the one saved with it"
            ));
        }
    }
    if !reader.rest.is_empty() {
        return Err(format!("has {} bytes after its end mark; expected none", reader.rest.len()));
    }
    let [header, source, inputs, hashes, _] = payloads;
    Ok(Recording {
        header: decode(header, "header")?,
        source: decode(source, "model source")?,
        inputs: numbers::<{ Controls::COUNT }>(inputs, "inputs")?
            .map(|words| Controls::from_array(words.map(f64::from_bits)))
            .collect(),
        hashes: numbers::<PARTS>(hashes, "state hashes")?
            .map(|parts| StateHash { parts })
            .collect(),
        damage,
    })
    .and_then(check_counts)
}

fn check_start(reader: &mut Reader<'_>) -> Result<(), String> {
    let expected = "expected an Endline recording, as `endline run --out` saves it";
    if reader.take(MAGIC.len()) != Some(&MAGIC) {
        return Err(format!("is no recording: {expected}"));
    }
    let format = reader
        .number::<4>()
        .map(u32::from_le_bytes)
        .ok_or_else(|| format!("is cut short in its format number; {expected}"))?;
    if format == FORMAT {
        Ok(())
    } else {
        Err(format!("has recording format {format}; this program reads format {FORMAT}"))
    }
}

/// There is a state before the first input. A run that a step stopped keeps the input of the step refused, so it has as many inputs
/// as hashes; one that was given up between two steps has one less, like any other.
fn check_counts(recording: Recording) -> Result<Recording, String> {
    let (inputs, hashes) = (recording.inputs.len(), recording.hashes.len());
    let of_steps = hashes.saturating_sub(1);
    let was_refused = recording.header.stopped.is_some() && inputs == hashes;
    if hashes == 0 || (inputs != of_steps && !was_refused) {
        return Err(format!(
            "is damaged: {inputs} inputs and {hashes} state hashes do not belong together; expected {of_steps} inputs"
        ));
    }
    Ok(recording)
}

fn encode(value: &impl Serialize) -> io::Result<Vec<u8>> {
    postcard::to_stdvec(value).map_err(io::Error::other)
}

fn decode<T: DeserializeOwned>(bytes: &[u8], name: &str) -> Result<T, String> {
    postcard::from_bytes(bytes)
        .map_err(|error| format!("is damaged: its {name} cannot be decoded ({error})"))
}

/// Rows of `N` 64-bit words.
fn numbers<'a, const N: usize>(
    bytes: &'a [u8],
    name: &str,
) -> Result<impl Iterator<Item = [u64; N]> + use<'a, N>, String> {
    if !bytes.len().is_multiple_of(8 * N) {
        return Err(format!(
            "is damaged: its {name} take {} bytes; expected a multiple of {}",
            bytes.len(),
            8 * N
        ));
    }
    let (words, _) = bytes.as_chunks::<8>();
    let (rows, _) = words.as_chunks::<N>();
    Ok(rows.iter().map(|row| row.map(u64::from_le_bytes)))
}

/// The rest of the bytes.
struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn number<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    /// The payload of the next section, and whether it has the hash saved with it.
    fn section(&mut self, tag: [u8; 4], name: &str) -> Result<(&'a [u8], bool), String> {
        let short = |what: &str| format!("is cut short: expected {what} of its {name}");
        let found = self.number::<4>().ok_or_else(|| short("the start"))?;
        if found != tag {
            return Err(format!(
                "is damaged: expected the section `{}` ({name}), found `{}`",
                tag.escape_ascii(),
                found.escape_ascii()
            ));
        }
        let length =
            self.number::<8>().map(u64::from_le_bytes).ok_or_else(|| short("the length"))?;
        let hash = self.number::<32>().ok_or_else(|| short("the hash"))?;
        let left = self.rest.len();
        let payload =
            usize::try_from(length).ok().and_then(|length| self.take(length)).ok_or_else(|| {
                format!("is cut short: expected {length} bytes of its {name}, {left} are left")
            })?;
        Ok((payload, *blake3::hash(payload).as_bytes() == hash))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(recording: &Recording) -> Vec<u8> {
        let mut bytes = Vec::new();
        recording.write(&mut bytes).unwrap();
        bytes
    }

    fn sample() -> Recording {
        let input = |step: u32| Controls {
            speed: f64::from(step) / 8.0,
            yaw: -0.25,
            ..Controls::default()
        };
        let hash =
            |step: u64| StateHash { parts: std::array::from_fn(|part| step * 100 + part as u64) };
        Recording {
            header: Header { program: "0.1.0".into(), seed: 7, dt_s: 0.01, ..Header::default() },
            source: crate::source::sample::source(),
            inputs: (0..5).map(input).collect(),
            hashes: (0..6).map(hash).collect(),
            damage: None,
        }
    }

    #[test]
    fn a_recording_survives_the_round_trip() {
        assert_eq!(read(&written(&sample())).unwrap(), sample());
    }

    #[test]
    fn every_cut_is_found() {
        let whole = written(&sample());
        for length in 0..whole.len() {
            let message = read(&whole[..length]).unwrap_err();
            assert!(
                message.contains("cut short") || message.contains("no recording"),
                "{length}: {message}"
            );
        }
    }

    #[test]
    fn every_changed_byte_is_found() {
        let whole = written(&sample());
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 0x10;
            // Refused, or taken with the damage reported: never read as if nothing had happened.
            assert!(
                read(&changed).map_or(true, |recording| recording.damage.is_some()),
                "byte {place}"
            );
        }
    }

    #[test]
    fn a_longer_file_and_another_format_are_refused() {
        let mut longer = written(&sample());
        longer.push(0);
        assert!(read(&longer).unwrap_err().contains("after its end mark"));
        let mut newer = written(&sample());
        newer[8] = 9;
        assert!(read(&newer).unwrap_err().contains("format 9"));
    }
}
