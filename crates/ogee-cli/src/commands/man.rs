//! `ogee man`: the manual, a page for the program and one for each command, one after the other.

use std::path::Path;
use std::process::ExitCode;

use clap::CommandFactory;
use clap_mangen::Man;

use crate::arguments::Arguments;
use crate::error::Failure;
use crate::report::Console;

pub(super) fn run(console: &Console) -> Result<ExitCode, Failure> {
    let mut program = Arguments::command();
    program.build();
    let commands = program.get_subcommands().filter(|command| command.get_name() != "help").cloned();
    let mut text = Vec::new();
    for page in std::iter::once(program.clone()).chain(commands) {
        let rendered = Man::new(page).render(&mut text);
        rendered.map_err(|error| Failure::unwritten(Path::new("stdout"), &error))?;
    }
    super::print_text(&text, console)
}
