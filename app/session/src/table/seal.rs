//! A seal: the hash of a Parquet file's bytes, kept among its own key-value metadata, so that no damaged byte is taken for
//! a result.
//!
//! The hash is BLAKE3 of all bytes with 64 zeros in the place of its own 64 digits. The file stays one that any reader of Parquet
//! reads; [`checked`] finds the seal in the bytes alone, before anything else reads them.

/// Name of the metadata.
pub(crate) const KEY: &str = "blake3";

/// The text before the digits.
const MARK: &str = "endline-seal:";

/// Digits of a hash.
const DIGITS: usize = 64;

/// Why bytes are not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Broken {
    /// They have no seal: they are cut off, no file of a study, or older than seals.
    None,
    /// They are not those that were sealed.
    Other,
}

impl std::fmt::Display for Broken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::None => "it has no seal: it is cut off, or no file of a study",
            Self::Other => "its bytes are not those that its seal is of",
        })
    }
}

/// The metadata's value before the file is sealed.
pub(crate) fn blank() -> String {
    MARK.to_owned() + &"0".repeat(DIGITS)
}

/// Writes the hash into bytes that hold a blank seal; bytes without one stay.
pub(crate) fn seal(bytes: &mut [u8]) {
    if let Some(digits) = digits_of(bytes) {
        let hash = hash_of(bytes, digits.clone());
        bytes[digits].copy_from_slice(hash.as_bytes());
    }
}

/// Whether bytes are those that were sealed.
pub(crate) fn checked(bytes: &[u8]) -> Result<(), Broken> {
    let digits = digits_of(bytes).ok_or(Broken::None)?;
    let is_own = hash_of(bytes, digits.clone()).as_bytes() == &bytes[digits];
    if is_own { Ok(()) } else { Err(Broken::Other) }
}

/// Where the digits of the last seal in the bytes are: metadata stands behind all rows.
fn digits_of(bytes: &[u8]) -> Option<std::ops::Range<usize>> {
    let mark = MARK.as_bytes();
    let at = bytes.windows(mark.len()).rposition(|window| window == mark)? + mark.len();
    (at + DIGITS <= bytes.len()).then_some(at..at + DIGITS)
}

fn hash_of(bytes: &[u8], digits: std::ops::Range<usize>) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&bytes[..digits.start]);
    hasher.update(&[b'0'; DIGITS]);
    hasher.update(&bytes[digits.end..]);
    hasher.finalize().to_hex().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_sealed_is_known_again_and_every_other_byte_is_refused() {
        let mut bytes = [b"PAR1 rows ".as_slice(), blank().as_bytes(), b" PAR1"].concat();
        seal(&mut bytes);
        assert_eq!(checked(&bytes), Ok(()));
        for at in 0..bytes.len() {
            for bit in 0..8 {
                let mut other = bytes.clone();
                other[at] ^= 1 << bit;
                assert!(checked(&other).is_err(), "bit {bit} of byte {at}");
            }
        }
        assert_eq!(checked(&bytes[..bytes.len() - 1]), Err(Broken::Other));
        assert_eq!(checked(b"PAR1"), Err(Broken::None));
    }
}
