//! The commands, one to a file.

pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod eval;
pub(crate) mod info;
pub(crate) mod inspect;
pub(crate) mod lens;
pub(crate) mod lines;
mod man;
pub(crate) mod network;
pub(crate) mod refine;
pub(crate) mod render;

use std::process::ExitCode;

use crate::arguments::Command;
use crate::error::Failure;
use crate::report::Console;

/// Runs a command.
pub(crate) fn run(command: &Command, console: &Console) -> Result<ExitCode, Failure> {
    match command {
        Command::Info(info) => info.run(console),
        Command::Refine(refine) => refine.run(console),
        Command::Eval(eval) => eval.run(console),
        Command::Lens(lens) => lens.run(console),
        Command::Lines(lines) => lines.run(console),
        Command::Network(network) => network.run(console),
        Command::Convert(convert) => convert.run(console),
        Command::Inspect(inspect) => inspect.run(console),
        Command::Render(render) => render.run(console),
        Command::Check(check) => check.run(console),
        Command::Completions(completions) => completions.run(console),
        Command::Man => man::run(console),
    }
}

/// For commands whose data is text on stdout.
fn print_text(text: &[u8], console: &Console) -> Result<ExitCode, Failure> {
    use std::io::Write;
    if console.json {
        return Err(Failure::usage("this command prints text on stdout and has no --json"));
    }
    crate::output::Destination::Stdout.write(|out| out.write_all(text))?;
    Ok(ExitCode::SUCCESS)
}
