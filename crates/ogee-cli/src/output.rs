//! Whole files or none: what is written appears under its name only when it is complete.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use crate::error::Failure;

/// Temporary files begin with this.
const TEMPORARY: &str = ".ogee.tmp-";

/// The temporary file that exists right now.
static PENDING: Mutex<Option<PathBuf>> = Mutex::new(None);

fn pending() -> MutexGuard<'static, Option<PathBuf>> {
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Sees to it that Ctrl-C leaves no temporary file behind, and ends with 130.
pub(crate) fn remove_when_interrupted() {
    // Without a handler Ctrl-C still ends the program.
    let _ = ctrlc::set_handler(|| {
        // The lock is held to the end: no other file can be begun.
        if let Some(path) = pending().as_deref() {
            let _ = fs::remove_file(path);
        }
        std::process::exit(130);
    });
}

/// Where output goes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Destination {
    /// Standard output.
    Stdout,
    /// A file, or a device or pipe that has a name.
    File(PathBuf),
}

impl Destination {
    /// `-` is stdout.
    pub(crate) fn new(path: &Path) -> Destination {
        match path.to_str() {
            Some("-") => Destination::Stdout,
            _ => Destination::File(path.to_owned()),
        }
    }

    /// Its name in messages.
    pub(crate) fn name(&self) -> String {
        match self {
            Destination::Stdout => "stdout".to_owned(),
            Destination::File(path) => path.display().to_string(),
        }
    }

    /// The name of the file without folders and extension.
    pub(crate) fn stem(&self) -> Option<String> {
        match self {
            Destination::Stdout => None,
            Destination::File(path) => path.file_stem().map(|stem| stem.to_string_lossy().into_owned()),
        }
    }

    /// Finds out early what would fail after long work.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let Destination::File(path) = self else { return Ok(()) };
        let outcome = match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(io::Error::from(io::ErrorKind::IsADirectory)),
            Ok(found) if !found.is_file() => Ok(()),
            // What may not be written may not be replaced either.
            Ok(_) => OpenOptions::new().write(true).open(path).map(drop),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let folder = folder(path);
                let missing = |_| io::Error::other(format!("the folder {} does not exist", folder.display()));
                fs::metadata(folder).map(drop).map_err(missing)
            }
            Err(error) => Err(error),
        };
        outcome.map_err(|error| Failure::unwritten(path, &error))
    }

    /// Writes all of it or nothing; returns the number of bytes.
    pub(crate) fn write(&self, content: impl FnOnce(&mut Counter) -> io::Result<()>) -> Result<u64, Failure> {
        let (path, result) = match self {
            Destination::Stdout => {
                let mut out = Counter { inner: Box::new(io::stdout().lock()), bytes: 0 };
                (Path::new("stdout"), content(&mut out).and_then(|()| out.finish()))
            }
            Destination::File(path) => (path.as_path(), to_file(path, content)),
        };
        result.map_err(|error| Failure::unwritten(path, &error))
    }

    /// Writes all of it or nothing, where the content may be refused half-way. What cannot be taken back, on stdout, in
    /// a pipe or on a device, waits in a temporary file until all of it is there. Returns the number of bytes.
    pub(crate) fn write_unless_refused(
        &self,
        content: impl FnOnce(&mut Counter) -> Result<(), Stopped>,
    ) -> Result<u64, Failure> {
        let is_special = |path: &Path| fs::metadata(path).is_ok_and(|found| !found.is_file());
        let result = match self {
            Destination::File(path) if !is_special(path) => to_file(path, content),
            _ => spooled(content).and_then(|mut spool| {
                let copied = self.write(|out| io::copy(&mut spool, out).map(drop));
                copied.map_err(Stopped::Refused)
            }),
        };
        result.map_err(|stopped| match stopped {
            Stopped::Refused(failure) => failure,
            Stopped::Unwritten(error) => Failure::unwritten(Path::new(&self.name()), &error),
        })
    }
}

/// Why content ended before it was complete.
pub(crate) enum Stopped {
    /// What it is made from is no good.
    Refused(Failure),
    /// It cannot be written.
    Unwritten(io::Error),
}

impl From<Failure> for Stopped {
    fn from(failure: Failure) -> Stopped {
        Stopped::Refused(failure)
    }
}

impl From<io::Error> for Stopped {
    fn from(error: io::Error) -> Stopped {
        Stopped::Unwritten(error)
    }
}

/// The content in a file without a name, which nothing has to remove.
fn spooled(content: impl FnOnce(&mut Counter) -> Result<(), Stopped>) -> Result<File, Stopped> {
    let mut spool = tempfile::tempfile()?;
    let mut out = Counter { inner: Box::new(spool.try_clone()?), bytes: 0 };
    content(&mut out)?;
    out.finish()?;
    spool.rewind()?;
    Ok(spool)
}

/// Counts what goes through it.
pub(crate) struct Counter {
    inner: Box<dyn Write>,
    bytes: u64,
}

impl Counter {
    fn finish(mut self) -> io::Result<u64> {
        self.inner.flush()?;
        Ok(self.bytes)
    }
}

impl Write for Counter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn to_file<E: From<io::Error>>(
    path: &Path,
    content: impl FnOnce(&mut Counter) -> Result<(), E>,
) -> Result<u64, E> {
    let existing = fs::metadata(path).ok();
    if existing.as_ref().is_some_and(|found| !found.is_file()) {
        // A rename would replace the device itself.
        let file = OpenOptions::new().write(true).open(path)?;
        let mut out = Counter { inner: Box::new(file), bytes: 0 };
        content(&mut out)?;
        return Ok(out.finish()?);
    }
    // A link stays a link: what it points to is replaced.
    let target = if existing.is_some() { fs::canonicalize(path)? } else { path.to_owned() };
    let temporary = Temporary::new(folder(&target), existing.map(|found| found.permissions()))?;
    let mut out = Counter { inner: Box::new(temporary.handle()?), bytes: 0 };
    content(&mut out)?;
    let bytes = out.finish()?;
    temporary.persist(&target)?;
    Ok(bytes)
}

/// A temporary file that Ctrl-C knows of.
struct Temporary(Option<NamedTempFile>);

impl Temporary {
    fn new(folder: &Path, permissions: Option<fs::Permissions>) -> io::Result<Temporary> {
        let mut pending = pending();
        let mut builder = tempfile::Builder::new();
        builder.prefix(TEMPORARY);
        // As any new file: what the mask of the process leaves of this.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder)?;
        if let Some(permissions) = permissions {
            file.as_file().set_permissions(permissions)?;
        }
        *pending = Some(file.path().to_owned());
        Ok(Temporary(Some(file)))
    }

    fn handle(&self) -> io::Result<File> {
        self.0.as_ref().map_or_else(|| Err(io::ErrorKind::NotFound.into()), |file| file.as_file().try_clone())
    }

    fn persist(mut self, target: &Path) -> io::Result<()> {
        let mut pending = pending();
        if let Some(file) = self.0.take() {
            file.persist(target).map_err(|error| error.error)?;
        }
        *pending = None;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let mut pending = pending();
            drop(file);
            *pending = None;
        }
    }
}
