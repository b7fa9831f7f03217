//! The bytes of a file, without a copy of them where there are many.

use std::fs::File;
use std::io;
use std::ops::Deref;
use std::path::Path;

use memmap2::Mmap;

/// Files of so many bytes and more are mapped: below, reading them is as quick.
const MAPPED_FROM: u64 = 1 << 20;

/// The bytes of a file.
///
/// A large file is mapped into memory: its pages are those that the system keeps of it anyway, and none is copied. So that it can be
/// read by many threads at once, and a file larger than memory as well. While it is mapped the file must not be made shorter: who reads
/// beyond its new end is ended by the system, as with every program that maps files.
///
/// ```no_run
/// # use ogee_formats::{CageFormat, FileBytes, read_cage};
/// let bytes = FileBytes::open("hull.obj".as_ref())?;
/// let cage = read_cage(&bytes, CageFormat::Obj)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FileBytes(Bytes);

#[derive(Debug)]
enum Bytes {
    Read(Vec<u8>),
    Mapped(Mmap),
}

impl FileBytes {
    /// The bytes of the file at `path`; what is no regular file, a pipe for example, is read to its end.
    ///
    /// # Errors
    /// If the file cannot be opened or read.
    pub fn open(path: &Path) -> io::Result<FileBytes> {
        let file = File::open(path)?;
        let about = file.metadata()?;
        let mapped = if about.is_file() && about.len() >= MAPPED_FROM { map(&file) } else { None };
        match mapped {
            Some(bytes) => Ok(FileBytes(Bytes::Mapped(bytes))),
            None => std::fs::read(path).map(FileBytes::from),
        }
    }
}

impl From<Vec<u8>> for FileBytes {
    fn from(bytes: Vec<u8>) -> FileBytes {
        FileBytes(Bytes::Read(bytes))
    }
}

impl Deref for FileBytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match &self.0 {
            Bytes::Read(bytes) => bytes,
            Bytes::Mapped(bytes) => bytes,
        }
    }
}

/// Maps a file, if its file system can.
#[expect(unsafe_code, reason = "there is no safe way to map a file: another program may write to it")]
fn map(file: &File) -> Option<Mmap> {
    // SAFETY: the map is private and never written to, and readers only copy numbers out of it. Should someone else write to the
    // file meanwhile, they find other numbers, or a line that is none; the documentation forbids making the file shorter.
    unsafe { Mmap::map(file) }.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_every_size_are_read_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        for length in [0, 1, MAPPED_FROM as usize - 1, MAPPED_FROM as usize, 3_000_001] {
            let bytes: Vec<u8> = (0..length).map(|i| (i % 251) as u8).collect();
            std::fs::write(&path, &bytes).unwrap();
            let opened = FileBytes::open(&path).unwrap();
            assert!(*opened == bytes[..], "{length}");
            assert_eq!(matches!(opened.0, Bytes::Mapped(_)), length as u64 >= MAPPED_FROM);
        }
        assert_eq!(FileBytes::open(&folder.path().join("none")).unwrap_err().kind(), io::ErrorKind::NotFound);
        assert!(FileBytes::open(folder.path()).is_err());
    }
}
