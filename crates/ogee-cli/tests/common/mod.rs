//! Runs the command in a folder of its own.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, reason = "each file of claims uses some of it")]

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// A cube of side 2; its faces stand on the lines 9 to 14.
pub(crate) const CUBE: &str = "\
v -1 -1 -1
v 1 -1 -1
v -1 1 -1
v 1 1 -1
v -1 -1 1
v 1 -1 1
v -1 1 1
v 1 1 1
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
";

/// What came back.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Run {
    pub(crate) fn first_line(&self) -> &str {
        self.stderr.lines().next().unwrap_or_default()
    }

    /// The one object on stdout.
    pub(crate) fn json(&self) -> Value {
        let text = std::str::from_utf8(&self.stdout).expect("JSON is text");
        let value: Value = serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"));
        assert!(text.starts_with("{\"schema\":1,"), "{text}");
        assert_eq!(text.lines().count(), 1);
        value
    }

    pub(crate) fn expect(self, code: i32) -> Run {
        assert_eq!(self.code, code, "{}", self.stderr);
        self
    }
}

/// A folder to run in.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    /// A folder with a cube in it.
    pub(crate) fn with_cube() -> Folder {
        let folder = Folder::new();
        folder.write("cube.obj", CUBE);
        folder
    }

    /// A folder with a wing in it, whose two tips are zipped: four lenses, two pairs.
    pub(crate) fn with_wing() -> Folder {
        let folder = Folder::new();
        let mut bytes = Vec::new();
        ogee_formats::obj::write_cage(&ogee::shapes::lens(), "a wing", &mut bytes).unwrap();
        folder.write("wing.obj", bytes);
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names of all files, hidden ones as well.
    pub(crate) fn names(&self) -> Vec<String> {
        let names = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> =
            names.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ogee"));
        command.current_dir(self.0.path()).args(arguments.split_whitespace());
        command.env_remove("SOURCE_DATE_EPOCH").env_remove("NO_COLOR").timeout(Duration::from_secs(300));
        command
    }

    /// Runs `ogee` with arguments that are split at spaces.
    pub(crate) fn ogee(&self, arguments: &str) -> Run {
        finish(self.command(arguments))
    }
}

pub(crate) fn finish(mut command: Command) -> Run {
    let output = command.output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(!stderr.contains("panicked"), "{stderr}");
    Run { code: output.status.code().unwrap_or(-1), stdout: output.stdout, stderr }
}

/// The shipped cages.
pub(crate) fn models() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut models: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    models.retain(|path| path.extension().is_some_and(|extension| extension == "obj"));
    models.sort();
    assert!(models.len() >= 10);
    models
}
