//! Chores of the workspace. `models [DIR]` writes the shipped cages, `bench` times whole commands, `bench limit`
//! evaluation beside other programs; `bench-worker` is a part of that.

mod bench;
mod models;

use std::path::PathBuf;

use anyhow::{Result, bail};

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
        ["bench", "limit"] => bench::limit::compare(&mut std::io::stdout()),
        ["bench", "limit", task] => bench::limit::compare_times(&mut std::io::stdout(), task),
        ["bench-worker", ref rest @ ..] => {
            println!("{}", bench::worker::run(rest)?);
            Ok(())
        }
        _ => bail!("usage: cargo xtask models [DIR] | bench [limit [TASK]]"),
    }
}
