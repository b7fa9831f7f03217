//! What can be typed.

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::commands::{
    check, completions, convert, eval, info, inspect, lens, lines, network, refine, render,
};
use crate::error::{Exit, Failure};
use crate::{names, output, report};

const EXAMPLES: &str = "\
Examples:
  ogee convert cage.obj -o part.step       a cage to a solid of smooth NURBS
  ogee info cage.obj                       what is in a cage, and what is wrong with it
  ogee refine cage.obj -l 3 -o fine.glb    three steps of refinement";

/// Catmull-Clark cages to exact smooth NURBS and STEP
#[derive(Debug, Parser)]
#[command(name = "ogee", version, before_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) common: Common,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What every command takes.
#[derive(Debug, Args)]
pub(crate) struct Common {
    /// Print one JSON object on stdout
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Print no figures for people, only errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Print more figures
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
    /// Threads to work with [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// When to use colours
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: ColorChoice,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Info(info::Info),
    Refine(refine::Refine),
    Eval(eval::Eval),
    Convert(convert::Convert),
    Inspect(inspect::Inspect),
    Render(Box<render::Render>),
    Lines(Box<lines::Lines>),
    Network(Box<network::Network>),
    Lens(Box<lens::Lens>),
    Check(check::Check),
    Completions(completions::Completions),
    /// Print the manual of all commands in roff on stdout
    Man,
}

/// The output file, for commands that write one.
#[derive(Debug, Args)]
pub(crate) struct OutputArguments {
    /// The file to write; - for stdout
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,
}

impl OutputArguments {
    /// Refuses two things that both want stdout.
    pub(crate) fn destination(&self, json: bool) -> Result<output::Destination, Failure> {
        let destination = output::Destination::new(&self.output);
        match destination {
            output::Destination::Stdout if json => {
                Err(Failure::usage("-o - and --json both want stdout; give the output a name"))
            }
            _ => Ok(destination),
        }
    }
}

/// Help, a version or a complaint.
pub(crate) struct Stop(clap::Error);

/// Reads the command line.
pub(crate) fn parse(given: &[OsString]) -> Result<Arguments, Stop> {
    let mut command = Arguments::command().color(color(given));
    let matches = command.try_get_matches_from_mut(given).map_err(Stop)?;
    Arguments::from_arg_matches(&matches).map_err(|error| Stop(error.format(&mut command)))
}

/// The choice of colours, which the parser itself needs before it begins.
fn color(given: &[OsString]) -> ColorChoice {
    let words: Vec<_> = given.iter().map(|word| word.to_string_lossy()).collect();
    let chosen = words.iter().enumerate().find_map(|(i, word)| match word.strip_prefix("--color") {
        Some("") => words.get(i + 1).map(|next| next.to_string()),
        Some(rest) => rest.strip_prefix('=').map(str::to_owned),
        None => None,
    });
    match chosen.as_deref() {
        Some("always") => ColorChoice::Always,
        Some("never") => ColorChoice::Never,
        _ => ColorChoice::Auto,
    }
}

impl Stop {
    /// Prints it where it belongs.
    pub(crate) fn finish(self, given: &[OsString]) -> ExitCode {
        let Stop(error) = self;
        let asked = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
        let elsewhere = names::not_in_this_build(&error);
        // Nobody listens if this fails.
        let _ = match &elsewhere {
            Some(message) => writeln!(std::io::stderr(), "error: {message}"),
            None => error.print(),
        };
        if asked {
            return ExitCode::SUCCESS;
        }
        if given.iter().any(|word| word == "--json") {
            let text = error.render().to_string();
            // The complaint ends where the usage begins.
            let lines = text.lines().map(str::trim).take_while(|line| !line.is_empty());
            let complaint = lines.collect::<Vec<_>>().join(" ");
            let complaint = complaint.strip_prefix("error: ").unwrap_or(&complaint).to_owned();
            report::print_error(&Failure::usage(elsewhere.unwrap_or(complaint)));
        }
        ExitCode::from(Exit::Usage as u8)
    }
}
