//! Reads regular files up to a size: pipes may never end, and devices such as `/dev/zero` would use all memory.

use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

use crate::limits::{FILE_BYTES, MESH_FILE_BYTES, TEXT_FILE_BYTES};

/// The text of a regular file in UTF-8 of at most [`TEXT_FILE_BYTES`].
pub fn text(path: &Path) -> Result<String> {
    utf8(at_most(path, TEXT_FILE_BYTES)?)
}

/// The text of a stream in UTF-8 of at most [`TEXT_FILE_BYTES`], such as standard input.
pub fn stream(stream: impl Read) -> Result<String> {
    utf8(to_its_end(stream, TEXT_FILE_BYTES)?)
}

/// The bytes of a mesh or an animation, a regular file of at most [`MESH_FILE_BYTES`].
pub fn mesh(path: &Path) -> Result<Vec<u8>> {
    at_most(path, MESH_FILE_BYTES)
}

/// The bytes of a recording, a table of results or any other regular file of at most [`FILE_BYTES`].
pub fn bytes(path: &Path) -> Result<Vec<u8>> {
    at_most(path, FILE_BYTES)
}

/// The bytes of a regular file of at most `most` bytes.
pub fn at_most(path: &Path, most: u64) -> Result<Vec<u8>> {
    let file = open(path)?;
    // A stated length is checked before memory is allocated.
    if file.metadata()?.len() > most {
        return Err(too_long(most));
    }
    to_its_end(file, most)
}

/// Opens a regular file for reading.
pub fn open(path: &Path) -> Result<File> {
    // Checked before it is opened, because opening a pipe waits for its other end.
    regular(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    regular(&file.metadata()?)?;
    Ok(file)
}

fn utf8(bytes: Vec<u8>) -> Result<String> {
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, "it is not UTF-8"))
}

fn to_its_end(stream: impl Read, most: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_long(most));
    }
    Ok(bytes)
}

fn too_long(most: u64) -> Error {
    let mebibytes = most >> 20;
    let message = format!("it is longer than the limit of {mebibytes} MiB");
    Error::new(ErrorKind::FileTooLarge, message)
}

fn regular(about: &fs::Metadata) -> Result<()> {
    if about.is_file() {
        return Ok(());
    }
    let message = if about.is_dir() {
        "it is a folder"
    } else {
        "it is not a regular file, but a pipe or a device"
    };
    Err(Error::new(ErrorKind::InvalidInput, message))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn devices_folders_and_long_files_are_refused() {
        let folder = std::env::temp_dir().join(format!("endline-read-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let link = folder.join("zero.toml");
        std::os::unix::fs::symlink("/dev/zero", &link).unwrap();
        for refused in [link.as_path(), folder.as_path()] {
            assert!(text(refused).is_err());
        }
        let long = folder.join("long.toml");
        File::create(&long).unwrap().set_len(TEXT_FILE_BYTES + 1).unwrap();
        assert_eq!(text(&long).unwrap_err().kind(), ErrorKind::FileTooLarge);
        fs::write(&long, "format = 1").unwrap();
        assert_eq!(text(&long).unwrap(), "format = 1");
        fs::remove_dir_all(&folder).unwrap();
    }
}
