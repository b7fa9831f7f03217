//! Figures for people on stderr, one object for programs on stdout.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use clap::ColorChoice;
use serde::Serialize;

use crate::arguments::Common;
use crate::error::{Exit, Failure, Finding};
use crate::output::Destination;
use crate::progress::Progress;

/// The number of the shape of all reports: it changes when a field is changed or dropped.
const SCHEMA: u32 = 1;

/// Where reports go, and how.
pub(crate) struct Console {
    /// One object is printed on stdout.
    pub(crate) json: bool,
    quiet: bool,
    verbose: bool,
    colored: bool,
}

/// A report with the number of its shape.
#[derive(Serialize)]
struct Numbered<'a, T> {
    schema: u32,
    #[serde(flatten)]
    report: &'a T,
}

/// Figures with their labels.
#[derive(Default)]
pub(crate) struct Table {
    rows: Vec<(&'static str, String)>,
}

impl Table {
    /// Adds a row.
    pub(crate) fn row(&mut self, label: &'static str, value: impl Into<String>) {
        self.rows.push((label, value.into()));
    }
}

impl Console {
    /// As the command line has it.
    pub(crate) fn new(common: &Common) -> Console {
        let colored = match common.color {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => {
                let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
                let simple = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
                !unwanted && !simple && io::stderr().is_terminal()
            }
        };
        Console { json: common.json, quiet: common.quiet, verbose: common.verbose, colored }
    }

    /// True if more figures are wanted.
    pub(crate) fn is_verbose(&self) -> bool {
        self.verbose
    }

    /// A spinner, if there is anybody to see it.
    pub(crate) fn progress(&self) -> Progress {
        Progress::start(!self.quiet)
    }

    /// Prints figures and notes for people.
    pub(crate) fn table(&self, title: &str, table: &Table, notes: &[Finding]) {
        if self.quiet {
            return;
        }
        let width = table.rows.iter().map(|(label, _)| label.len()).max().unwrap_or(0);
        let mut text = format!("{}\n", self.styled(title, BOLD));
        for (label, value) in &table.rows {
            text += &format!("  {}  {value}\n", self.styled(&format!("{label:width$}"), DIM));
        }
        for note in notes {
            text += &format!("{} {}\n", self.styled("note:", YELLOW), note.line());
        }
        say(&text);
    }

    /// Prints findings, one to a line, whether anybody wants figures or not.
    pub(crate) fn findings(&self, findings: &[Finding]) {
        say(&findings.iter().map(|finding| finding.line() + "\n").collect::<String>());
    }

    /// Prints a report for programs, if they asked for it.
    pub(crate) fn json(&self, report: &impl Serialize) -> Result<(), Failure> {
        if self.json { print(report) } else { Ok(()) }
    }

    /// Prints why the command stopped.
    pub(crate) fn fail(&self, failure: &Failure) -> ExitCode {
        if !failure.silent {
            self.refusal(failure);
            if self.json {
                print_error(failure);
            }
        }
        ExitCode::from(failure.exit as u8)
    }

    /// Prints what is wrong, for people.
    pub(crate) fn refusal(&self, failure: &Failure) {
        let prefix = if failure.exit == Exit::Usage { "error: " } else { "" };
        let mut text = self.styled(&format!("{prefix}{}", failure.first().line()), RED) + "\n";
        text.extend(failure.others().iter().map(|other| other.line() + "\n"));
        if failure.unlisted > 0 {
            text += &format!("and {} more\n", failure.unlisted);
        }
        say(&text);
    }

    fn styled(&self, text: &str, style: &str) -> String {
        if self.colored { format!("\x1b[{style}m{text}\x1b[0m") } else { text.to_owned() }
    }
}

const BOLD: &str = "1";
const DIM: &str = "2";
const RED: &str = "1;31";
const YELLOW: &str = "33";

/// Writes to stderr. That nobody reads it is no reason to stop.
fn say(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// A failure as programs see it.
#[derive(Serialize)]
struct Refusal<'a> {
    error: Refused<'a>,
}

#[derive(Serialize)]
struct Refused<'a> {
    #[serde(flatten)]
    first: &'a Finding,
    #[serde(skip_serializing_if = "<[Finding]>::is_empty")]
    others: &'a [Finding],
    /// How many more there are.
    #[serde(skip_serializing_if = "Option::is_none")]
    more: Option<usize>,
}

/// Prints a failure for programs.
pub(crate) fn print_error(failure: &Failure) {
    let more = (failure.unlisted > 0).then_some(failure.unlisted);
    let error = Refused { first: failure.first(), others: failure.others(), more };
    // The exit code says it as well.
    let _ = print(&Refusal { error });
}

/// Prints one object on stdout.
fn print(report: &impl Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_vec(&Numbered { schema: SCHEMA, report })
        .map_err(|error| Failure::unwritten("stdout".as_ref(), &error.into()))?;
    text.push(b'\n');
    Destination::Stdout.write(|out| out.write_all(&text)).map(drop)
}

/// A number with six digits, in powers of ten where it is very large or small.
pub(crate) fn figure(x: f64) -> String {
    rounded(x, 6)
}

/// A number with as many digits, in powers of ten with less than half of them where it is very large or small.
pub(crate) fn rounded(x: f64, digits: i32) -> String {
    let size = x.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e9).contains(&size) {
        let digits = (digits as usize).div_ceil(2) - 1;
        return format!("{x:.digits$e}");
    }
    let digits = (digits - 1 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{x:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// `1 face`, `2 faces`.
pub(crate) fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Bytes for people.
pub(crate) fn bytes(n: u64) -> String {
    match n {
        0..1000 => format!("{n} bytes"),
        1000..1_000_000 => format!("{:.1} kB", n as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", n as f64 / 1e6),
        _ => format!("{:.1} GB", n as f64 / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_short() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (123.456789, "123.457"),
            (-0.0125, "-0.0125"),
            (1.2345e-9, "1.23e-9"),
            (1234567.8, "1234568"),
            (999999.96, "1000000"),
            (4e12, "4.00e12"),
        ];
        for (x, text) in cases {
            assert_eq!(figure(x), text);
        }
    }

    #[test]
    fn one_face_and_many_bytes() {
        assert_eq!(
            (count(1, "face", "faces"), count(2, "face", "faces")),
            ("1 face".into(), "2 faces".into())
        );
        assert_eq!(
            (bytes(999), bytes(1500), bytes(2_500_000)),
            ("999 bytes".into(), "1.5 kB".into(), "2.5 MB".into())
        );
    }
}
