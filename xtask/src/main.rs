//! Chores of the workspace. `models [DIR]` writes the shipped cages, `bench` times whole commands, `bench limit`
//! evaluation beside other programs, `bench threads` what a second thread gains; `bench-worker` is a part of that.
//! `bench refine`, `bench animate` and `bench obj` time refinement, animated cages and reading beside other programs.
//! `reproduce interrogation`, `reproduce curve-networks`, `reproduce lens` and `reproduce g2` make figures and tables again,
//! `tables [DIR]` the shipped weights of G2 caps, `bless` the pictures that tests compare with.

mod bench;
mod models;
mod reproduce;
mod tables;

use std::path::PathBuf;

use anyhow::{Result, bail};
use bench::refine::Selection;
use mimalloc::MiMalloc;

/// Keeps memory that is given back for the next who asks, thread by thread, where the system's has its pages cleared anew while
/// both threads wait. Without large pages: measured memory would be that of the last one of each kind.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

#[expect(clippy::print_stdout, reason = "a chore tells what it did")]
fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["models", ref rest @ ..] if rest.len() < 2 => {
            let folder = rest.first().map_or_else(models::folder, PathBuf::from);
            for line in models::write_all(&folder)? {
                println!("{line}");
            }
            Ok(())
        }
        ["bench"] => {
            print!("{}", bench::commands::table()?);
            Ok(())
        }
        ["bench", "threads"] => bench::threads::compare(&mut std::io::stdout()),
        ["bench", "limit"] => bench::limit::compare(&mut std::io::stdout()),
        ["bench", "limit", task] => bench::limit::compare_times(&mut std::io::stdout(), task),
        ["bench", "refine", ref rest @ ..] => {
            bench::refine::refine(&mut std::io::stdout(), &Selection::parse(rest)?)
        }
        ["bench", "animate", ref rest @ ..] => {
            bench::refine::animate(&mut std::io::stdout(), &Selection::parse(rest)?)
        }
        ["bench", "obj"] => bench::refine::obj(&mut std::io::stdout()),
        ["reproduce", "interrogation"] => {
            for line in reproduce::interrogation::write(&root())? {
                println!("{line}");
            }
            Ok(())
        }
        ["reproduce", "curve-networks"] => {
            for line in reproduce::curve_networks::write(&root())? {
                println!("{line}");
            }
            Ok(())
        }
        ["reproduce", "lens"] => {
            for line in reproduce::lens::write(&root())? {
                println!("{line}");
            }
            Ok(())
        }
        ["tables", ref rest @ ..] if rest.len() < 2 => {
            let folder = rest.first().map_or_else(|| tables::folder(&root()), PathBuf::from);
            tables::write_all(&folder, &mut std::io::stdout())
        }
        ["reproduce", "g2"] => {
            for line in reproduce::g2::write(&root())? {
                println!("{line}");
            }
            Ok(())
        }
        ["bless"] => {
            let mut command = std::process::Command::new(env!("CARGO"));
            command.args(["test", "--package", "ogee-render", "--test", "pictures_stay_as_they_were_judged"]);
            let status = command.env("OGEE_BLESS", "1").current_dir(root()).status()?;
            anyhow::ensure!(status.success(), "the pictures were not drawn");
            println!("drawn into testdata/images; look at what changed");
            Ok(())
        }
        ["bench-worker", ref rest @ ..] => {
            println!("{}", bench::worker::run(rest)?);
            Ok(())
        }
        _ => {
            bail!(
                "usage: cargo xtask models [DIR] | bench [limit [TASK] | threads | refine [CAGE [ROUNDS]] | animate [CAGE [ROUNDS]] | obj] | reproduce interrogation|curve-networks|lens|g2 | tables [DIR] | bless"
            )
        }
    }
}

/// The folder of the workspace.
fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}
