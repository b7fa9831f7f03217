//! Figures of several rounds, and tables in Markdown.

use std::fmt::Display;
use std::path::Path;

use anyhow::{Context, Result};
use serde_json::Value;

use super::peers::Contestant;

/// Rounds of a comparison, if nothing else is said; those compared take turns within a round.
pub(crate) const ROUNDS: usize = 5;

/// Answers of one contestant to the same task.
pub(crate) struct Answers(Vec<Value>);

impl Answers {
    /// The median, the least and the greatest of a figure.
    pub(crate) fn spread(&self, of: impl Fn(&Value) -> Option<f64>) -> Result<Spread> {
        let values: Option<Vec<f64>> = self.0.iter().map(of).collect();
        let mut values = values.context("an answer lacks a figure")?;
        values.sort_by(f64::total_cmp);
        Ok(Spread { median: values[values.len() / 2], least: values[0], greatest: values[values.len() - 1] })
    }

    /// The first answer, for what is the same in all.
    pub(crate) fn first(&self) -> Result<&Value> {
        self.0.first().context("no round was run")
    }

    /// Nanoseconds a point.
    pub(crate) fn nanoseconds(&self) -> Result<Spread> {
        self.spread(|answer| Some(answer["seconds"].as_f64()? * 1e9 / answer["points"].as_f64()?))
    }

    /// Nanoseconds a point, preparation left out where it was part of the time.
    pub(crate) fn nanoseconds_prepared(&self) -> Result<Spread> {
        self.spread(|answer| {
            let seconds = answer["seconds"].as_f64()? - answer["prepare_seconds"].as_f64()?;
            Some(seconds * 1e9 / answer["points"].as_f64()?)
        })
    }

    /// The checksum, if all rounds agree on it.
    pub(crate) fn checksum(&self) -> Option<&str> {
        let first = self.0.first()?["checksum"].as_str()?;
        self.0.iter().all(|answer| answer["checksum"] == first).then_some(first)
    }
}

/// A figure that varies.
pub(crate) struct Spread {
    pub(crate) median: f64,
    pub(crate) least: f64,
    pub(crate) greatest: f64,
}

impl Display for Spread {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Spread { median, least, greatest } = *self;
        let places = if median < 10.0 { 2 } else { usize::from(median < 100.0) };
        write!(out, "{median:.places$} ({least:.places$} to {greatest:.places$})")
    }
}

/// The same task for all, one after the other, round after round.
pub(crate) fn rounds(
    contestants: &[&Contestant],
    task: &str,
    cage: &Path,
    rest: &[&str],
) -> Result<Vec<Answers>> {
    rounds_of(ROUNDS, contestants, task, cage, rest)
}

/// So many rounds.
pub(crate) fn rounds_of(
    count: usize,
    contestants: &[&Contestant],
    task: &str,
    cage: &Path,
    rest: &[&str],
) -> Result<Vec<Answers>> {
    let mut answers: Vec<Answers> = contestants.iter().map(|_| Answers(Vec::new())).collect();
    for _ in 0..count {
        for (contestant, answers) in contestants.iter().zip(&mut answers) {
            answers.0.push(contestant.run(task, cage, rest)?);
        }
    }
    Ok(answers)
}

/// A table in Markdown.
pub(crate) struct Table(String);

impl Table {
    pub(crate) fn new(columns: &[&str]) -> Table {
        let line = columns.iter().map(|_| "---");
        let mut table = Table(String::new());
        table.row(columns);
        table.row(&line.collect::<Vec<_>>());
        table
    }

    pub(crate) fn row<T: Display>(&mut self, cells: &[T]) {
        for cell in cells {
            self.0 += &format!("| {cell} ");
        }
        self.0 += "|\n";
    }
}

impl Display for Table {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(&self.0)
    }
}
