//! The programs that are compared: building them, installing them, running them.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

/// One who takes part. `peer` and `level` are what its program calls it and its level of isolation.
#[derive(Clone)]
pub(crate) struct Contestant {
    /// For the table.
    pub(crate) name: String,
    program: Vec<PathBuf>,
    peer: &'static str,
    level: i32,
    threads: usize,
}

impl Contestant {
    /// The same under another name.
    pub(crate) fn named(self, name: &str) -> Contestant {
        Contestant { name: name.into(), ..self }
    }

    /// Runs one task and reads its answer.
    pub(crate) fn run(&self, task: &str, cage: &Path, rest: &[&str]) -> Result<Value> {
        let output = Command::new(&self.program[0])
            .args(&self.program[1..])
            .args([task, self.peer, &self.level.to_string()])
            .arg(cage)
            .args(rest)
            .env("RAYON_NUM_THREADS", self.threads.to_string())
            .output()?;
        let complaint = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "{task} by {}: {complaint}", self.name);
        serde_json::from_slice(&output.stdout).with_context(|| format!("{task} by {}", self.name))
    }
}

/// Ourselves, in a process of our own.
pub(crate) fn ours(threads: usize) -> Result<Contestant> {
    let program = vec![std::env::current_exe()?, "bench-worker".into()];
    Ok(Contestant { name: "ogee".into(), program, peer: "ours", level: -1, threads })
}

/// Ourselves with one call a sample.
pub(crate) fn ours_single() -> Result<Contestant> {
    Ok(Contestant { peer: "ours-single", ..ours(1)?.named("ogee, one call a sample") })
}

/// A program that is there.
pub(crate) struct Found {
    pub(crate) version: String,
    program: Vec<PathBuf>,
}

impl Found {
    /// `peer` as the program calls it, with a level of isolation; -1 is its default.
    pub(crate) fn contestant(&self, name: &str, peer: &'static str, level: i32) -> Contestant {
        Contestant { name: name.into(), program: self.program.clone(), peer, level, threads: 1 }
    }

    fn new(program: Vec<PathBuf>) -> Result<Found, String> {
        let output = Command::new(&program[0])
            .args(&program[1..])
            .arg("version")
            .output()
            .map_err(|error| format!("{}: {error}", program[0].display()))?;
        if !output.status.success() {
            return Err(last_line(&output.stderr));
        }
        let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        Ok(Found { version, program })
    }
}

/// The compiler's flags for the peer: the best there are.
pub(crate) const FLAGS: [&str; 4] = ["-O3", "-march=native", "-DNDEBUG", "-std=c++17"];

/// Builds the program that speaks to OpenSubdiv; else says what is missing.
pub(crate) fn opensubdiv() -> Result<Found, String> {
    let program = folder()?.join("opensubdiv_limit");
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "g++".into());
    let output = Command::new(&compiler)
        .args(FLAGS)
        .arg(sources().join("opensubdiv_limit.cpp"))
        .args(["-losdCPU", "-o"])
        .arg(&program)
        .output()
        .map_err(|error| {
            format!("{compiler}: {error}; `apt-get install g++ libosd-dev` brings what is needed")
        })?;
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        let first = complaint.lines().find(|line| line.contains("error")).unwrap_or_default();
        return Err(format!("{first}; `apt-get install libosd-dev` brings headers and library"));
    }
    Found::new(vec![program])
}

/// Installs Blender as a module of Python, once, in an environment of its own; else says what is missing.
pub(crate) fn blender() -> Result<Found, String> {
    let environment = folder()?.join("blender");
    let python = environment.join("bin/python");
    let program = vec![python.clone(), sources().join("blender_limit.py")];
    if let Ok(found) = Found::new(program.clone()) {
        return Ok(found);
    }
    let wanted = "it wants `python3.11` with `venv` and a package index that has `bpy`";
    // Wheels are made for one version of Python only.
    let made = Command::new("python3.11").args(["-m", "venv"]).arg(&environment).output();
    let made = made.map_err(|error| format!("python3.11: {error}; {wanted}"))?;
    if !made.status.success() {
        return Err(format!("{}; {wanted}", last_line(&made.stderr)));
    }
    let installed = Command::new(&python)
        .args(["-m", "pip", "install", "--quiet", "bpy>=4.2"])
        .output()
        .map_err(|error| format!("{}: {error}", python.display()))?;
    if !installed.status.success() {
        return Err(format!("{}; {wanted}", last_line(&installed.stderr)));
    }
    Found::new(program)
}

fn last_line(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).lines().last().unwrap_or_default().to_owned()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn sources() -> PathBuf {
    root().join("bench/peers")
}

/// Where programs are built and installed: nothing in it is kept in the repository.
fn folder() -> Result<PathBuf, String> {
    let folder = root().join("target/bench/peers");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}
