//! One task of one Rust program a run, one line of JSON: refinement, animation and reading by ogee and by other
//! crates. `cargo xtask bench refine` and its like call it; `bench/peers/README.md` says what is measured.
//!
//! It has the system's allocator, as the programs it is compared with have, and does nothing else: what a task finds
//! in memory is the cage, and what the process holds more afterwards is the task's own.

mod measure;
mod obj;
mod opensubdiv_rs;
mod ours;
mod subdiv_kernels;

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use anyhow::{Context, Result, bail};
use ogee::ControlMesh;
use ogee_bench_cages::{exchange, gyroid};
use serde_json::{Value, json};

const USAGE: &str = "usage: ogee-bench version
       ogee-bench cage small|medium|large|open FILE [OBJ]
       ogee-bench refine  ours|opensubdiv-rs|subdiv-kernels LEVEL CAGE
       ogee-bench animate ours|opensubdiv-rs|subdiv-kernels LEVEL CAGE FRAMES
       ogee-bench obj     ours|tobj - FILE";

#[expect(clippy::print_stdout, reason = "its answer")]
fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["version"] => println!("{}", versions()?),
        ref arguments => println!("{}", answer(arguments)?),
    }
    Ok(())
}

fn answer(arguments: &[&str]) -> Result<Value> {
    match *arguments {
        ["cage", name, ref files @ ..] => write_cage(name, files),
        ["refine", peer, level, cage] => {
            let (depth, mesh) = (level.parse()?, exchange::read_cage(Path::new(cage))?);
            match peer {
                "ours" => ours::refine(&mesh, depth),
                "opensubdiv-rs" => opensubdiv_rs::refine(&mesh, depth),
                "subdiv-kernels" => subdiv_kernels::refine(&mesh, depth),
                _ => bail!("no such peer: {peer}"),
            }
        }
        ["animate", peer, level, cage, frames] => {
            let (depth, mesh) = (level.parse()?, exchange::read_cage(Path::new(cage))?);
            let frames = frames.parse()?;
            match peer {
                "ours" => ours::animate(&mesh, depth, frames),
                "opensubdiv-rs" => opensubdiv_rs::animate(&mesh, depth, frames),
                "subdiv-kernels" => subdiv_kernels::animate(&mesh, depth, frames),
                _ => bail!("no such peer: {peer}"),
            }
        }
        ["obj", "ours", _, file] => obj::ours(Path::new(file)),
        ["obj", "tobj", _, file] => obj::tobj(Path::new(file)),
        _ => bail!("{USAGE}"),
    }
}

/// The crates that take part, as the lock file of the workspace has them.
fn versions() -> Result<String> {
    let lock = include_str!("../../../Cargo.lock");
    let version = |name: &str| {
        let (_, entry) = lock.split_once(&format!("name = \"{name}\"\nversion = \""))?;
        Some(format!("{name} {}", entry.split_once('"')?.0))
    };
    let found: Option<Vec<String>> =
        ["opensubdiv-rs", "subdiv-kernels", "tobj"].map(version).into_iter().collect();
    Ok(found.context("a crate is not in the lock file")?.join(", "))
}

/// A cage as a file for all programs, and as OBJ if there is a second file.
fn write_cage(name: &str, files: &[&str]) -> Result<Value> {
    let mesh = match name {
        "small" => gyroid::SMALL.closed(),
        "medium" => gyroid::MEDIUM.closed(),
        "large" => gyroid::LARGE.closed(),
        "open" => gyroid::OPEN.open(),
        _ => bail!("no such cage: {name}"),
    };
    let [cage, obj @ ..] = files else { bail!("{USAGE}") };
    exchange::write_cage(Path::new(cage), &mesh)?;
    let rounded = |x: f64| (x * 1e6).round() / 1e6;
    for file in obj {
        // Six decimals, as most programs write.
        let points = mesh.points.iter().map(|&point| <[f64; 3]>::from(point).map(rounded).into()).collect();
        let mesh = ControlMesh { points, ..mesh.clone() };
        ogee_formats::obj::write_cage(&mesh, "A gyroid.", BufWriter::new(File::create(file)?))?;
    }
    Ok(json!({
        "faces": mesh.faces.len(), "vertices": mesh.points.len(), "size": mesh.size(),
        "creases": mesh.creases.len(), "corners": mesh.corners.len(),
    }))
}
