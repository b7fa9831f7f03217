//! The programs that are compared: building them, installing them, running them.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

/// One who takes part. `peer` and `level` are what its program calls it and its level, of isolation or refinement.
#[derive(Clone)]
pub(crate) struct Contestant {
    /// For the table.
    pub(crate) name: String,
    program: Vec<PathBuf>,
    peer: String,
    level: i32,
    threads: usize,
}

impl Contestant {
    /// The same under another name.
    pub(crate) fn named(self, name: &str) -> Contestant {
        Contestant { name: name.into(), ..self }
    }

    /// The same on so many threads.
    pub(crate) fn on(self, threads: usize) -> Contestant {
        Contestant { threads, ..self }
    }

    /// Runs one task and reads its answer.
    pub(crate) fn run(&self, task: &str, cage: &Path, rest: &[&str]) -> Result<Value> {
        let mut command = command(&self.program);
        command.args([task, &self.peer, &self.level.to_string()]).arg(cage).args(rest);
        command.env("RAYON_NUM_THREADS", self.threads.to_string());
        answer(&mut command).with_context(|| format!("{task} by {}", self.name))
    }
}

/// Ourselves, in a process of our own.
pub(crate) fn ours(threads: usize) -> Result<Contestant> {
    let program = vec![std::env::current_exe()?, "bench-worker".into()];
    Ok(Contestant { name: "ogee".into(), program, peer: "ours".into(), level: -1, threads })
}

/// Ourselves with one call a sample.
pub(crate) fn ours_single() -> Result<Contestant> {
    Ok(Contestant { peer: "ours-single".into(), ..ours(1)?.named("ogee, one call a sample") })
}

/// A program that is there.
pub(crate) struct Found {
    pub(crate) version: String,
    program: Vec<PathBuf>,
}

impl Found {
    /// `peer` as the program calls it, with a level; -1 is its default.
    pub(crate) fn contestant(&self, name: &str, peer: &str, level: i32) -> Contestant {
        Contestant { name: name.into(), program: self.program.clone(), peer: peer.into(), level, threads: 1 }
    }

    /// Runs the program once, for something that is no measurement, and reads its answer.
    pub(crate) fn ask(&self, arguments: &[&str]) -> Result<Value> {
        answer(command(&self.program).args(arguments))
    }

    fn new(program: Vec<PathBuf>) -> Result<Found, String> {
        let output = command(&program)
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

fn command(program: &[PathBuf]) -> Command {
    let mut command = Command::new(&program[0]);
    command.args(&program[1..]);
    command
}

/// Runs a program that answers with one line of JSON.
fn answer(command: &mut Command) -> Result<Value> {
    let output = command.output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).context("no JSON came back")
}

/// The compiler's flags for the peer: the best there are.
pub(crate) const FLAGS: [&str; 4] = ["-O3", "-march=native", "-DNDEBUG", "-std=c++17"];

/// Builds the program that evaluates with OpenSubdiv; else says what is missing.
pub(crate) fn opensubdiv() -> Result<Found, String> {
    compiled("opensubdiv_limit", &["-losdCPU"], "libosd-dev")
}

/// Builds the program that refines with OpenSubdiv; else says what is missing.
pub(crate) fn opensubdiv_refinement() -> Result<Found, String> {
    compiled("opensubdiv_refine", &["-losdCPU"], "libosd-dev")
}

/// Builds the program that refines with CGAL; else says what is missing.
pub(crate) fn cgal_refinement() -> Result<Found, String> {
    compiled("cgal_refine", &[], "libcgal-dev")
}

/// Builds the program that measures the machine; else says what is missing.
pub(crate) fn machine_limits() -> Result<Found, String> {
    compiled("machine_limits", &["-pthread"], "g++")
}

/// Builds a program of `bench/peers`; else says what is missing, and the package that has it.
fn compiled(name: &str, libraries: &[&str], package: &str) -> Result<Found, String> {
    let program = folder()?.join(name);
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "g++".into());
    let output = Command::new(&compiler)
        .args(FLAGS)
        .arg(sources().join(name).with_extension("cpp"))
        .args(libraries)
        .arg("-o")
        .arg(&program)
        .output()
        .map_err(|error| {
            format!("{compiler}: {error}; `apt-get install g++ {package}` brings what is needed")
        })?;
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        let first = complaint.lines().find(|line| line.contains("error")).unwrap_or_default();
        return Err(format!("{first}; `apt-get install {package}` brings headers and library"));
    }
    Found::new(vec![program])
}

/// Builds our side of refinement, where the other crates are as well.
///
/// # Errors
/// If it cannot be built.
pub(crate) fn rust_refinement() -> Result<Found> {
    let built = Command::new(env!("CARGO"))
        .current_dir(root())
        .args(["build", "--release", "--package", "ogee-bench"])
        .status()?;
    ensure!(built.success(), "our side could not be built");
    let program = std::env::current_exe()?.with_file_name("ogee-bench");
    Found::new(vec![program]).map_err(anyhow::Error::msg)
}

/// Installs Blender as a module of Python, once, in an environment of its own; else says what is missing.
pub(crate) fn blender() -> Result<Found, String> {
    blender_with("blender_limit.py")
}

/// The same for refinement.
pub(crate) fn blender_refinement() -> Result<Found, String> {
    blender_with("blender_refine.py")
}

fn blender_with(script: &str) -> Result<Found, String> {
    let environment = folder()?.join("blender");
    let python = environment.join("bin/python");
    let program = vec![python.clone(), sources().join(script)];
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
