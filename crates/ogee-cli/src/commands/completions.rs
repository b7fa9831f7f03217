//! `ogee completions`: a script that completes commands and options in a shell.

use std::process::ExitCode;

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use crate::arguments::Arguments;
use crate::error::Failure;
use crate::report::Console;

/// Print a script for a shell on stdout, which completes commands and options
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        // The generator gives up where its writer fails, and a list cannot.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), "ogee", &mut script);
        super::print_text(&script, console)
    }
}
