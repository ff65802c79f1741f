//! Whether a library file is all there: a download that broke off crashes the system's loader.
//!
//! An ELF file (Linux and most others) says in its header where its table of sections ends, which linkers put last. Files of other
//! formats are left to the loader, in the child process.

/// How many bytes a library should have, where it has fewer.
pub(super) fn missing_from(bytes: &[u8]) -> Option<u64> {
    const ELF_64_LITTLE: [u8; 6] = [0x7f, b'E', b'L', b'F', 2, 1];
    if !bytes.starts_with(&ELF_64_LITTLE) {
        return None;
    }
    let Some(header) = bytes.get(..64) else { return Some(64) };
    let number = |from: usize, length: usize| {
        header[from..from + length]
            .iter()
            .rev()
            .fold(0_u64, |number, byte| number << 8 | u64::from(*byte))
    };
    let (sections_at, each, count) = (number(0x28, 8), number(0x3a, 2), number(0x3c, 2));
    let whole = sections_at.saturating_add(each * count);
    (whole > bytes.len() as u64).then_some(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_cut_anywhere_is_known() {
        let program = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        if program.starts_with(b"\x7fELF") {
            assert_eq!(missing_from(&program), None);
            for share in [5, 63, 64, 4096, program.len() / 2, program.len() - 1] {
                assert!(missing_from(&program[..share]).is_some() == (share >= 6), "{share} bytes");
            }
        }
        assert_eq!(missing_from(b"not a library"), None);
    }
}
