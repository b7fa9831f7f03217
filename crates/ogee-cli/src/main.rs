//! The `ogee` command: Catmull-Clark cages to CAD.
//!
//! | file | holds |
//! | --- | --- |
//! | `arguments` | what can be typed |
//! | `names` | values by name, and what this build does not have |
//! | `commands/*` | one file per command |
//! | `addresses` | where to evaluate: files of points, grids |
//! | `cage` | opening and reading a cage |
//! | `comparison` | one cage by several methods |
//! | `evaluation` | samples in a stream |
//! | `inspection` | figures on quality: as JSON, as a table, as a page |
//! | `lenses` | what was done at vertices of valence 2 |
//! | `output` | whole files or none |
//! | `part` | making and writing parts |
//! | `error` | failures, with their place and exit code |
//! | `report` | figures as text and as JSON |
//! | `progress` | a spinner for long work |
//! | `treatment` | the surface of a cage whose lenses have been seen to |
//! | `timestamp` | the time that is written into files |
//! | `drawing` | curves in a picture |
//! | `view` | options of cameras and lights |
//! | `system` | what the machine has and what was used of it |

mod addresses;
mod arguments;
mod cage;
mod commands;
mod comparison;
mod curves;
mod drawing;
mod error;
mod evaluation;
#[cfg(feature = "gpu")]
mod gpu;
mod inspection;
mod lenses;
mod memory;
mod names;
mod nodes;
mod output;
mod part;
mod progress;
mod report;
mod subject;
mod system;
mod timestamp;
mod treatment;
mod view;

use std::ffi::OsString;
use std::process::ExitCode;

use arguments::Arguments;
use error::Failure;
use report::Console;

fn main() -> ExitCode {
    let given: Vec<OsString> = std::env::args_os().collect();
    let arguments = match arguments::parse(&given) {
        Ok(arguments) => arguments,
        Err(stop) => return stop.finish(&given),
    };
    let console = Console::new(&arguments.common);
    match run(&arguments, &console) {
        Ok(code) => code,
        Err(failure) => console.fail(&failure),
    }
}

fn run(arguments: &Arguments, console: &Console) -> Result<ExitCode, Failure> {
    output::remove_when_interrupted();
    if let Some(threads) = arguments.common.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads as usize);
        pool.build_global().map_err(|error| Failure::usage(format!("--threads {threads}: {error}")))?;
    }
    commands::run(&arguments.command, console)
}
