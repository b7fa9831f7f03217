//! The memory that a run may use, and what it says beforehand that it will.

use clap::Args;
use ogee::TooDeep;

use crate::cage::Cage;
use crate::error::Failure;
use crate::report::bytes;
use crate::system;

/// The option of commands that need memory in proportion to what they make.
#[derive(Debug, Args)]
pub(crate) struct MemoryArguments {
    /// Refuse what would take more memory than this, the cage included, as in 500M, 4G or 1.5GiB [default: what is free]
    #[arg(long, value_name = "BYTES", value_parser = byte_count)]
    max_memory: Option<u64>,
}

/// What may be used from now on, and what was used before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    /// Held already: the program and the cage, and what threads take to run.
    held: u64,
    /// The most that was held so far.
    peak: u64,
    /// What may come on top of it.
    pub(crate) allowed: u64,
}

impl MemoryArguments {
    /// To be asked for when the cage is there and nothing has been made of it.
    pub(crate) fn budget(&self) -> Budget {
        let held = system::resident_memory().unwrap_or(0) + RUNNING;
        let allowed = match self.max_memory {
            Some(most) => most.saturating_sub(held),
            None => system::available_memory().unwrap_or(u64::MAX),
        };
        Budget { held, peak: system::peak_memory().unwrap_or(0), allowed }
    }

    /// A refusal of what does not fit.
    pub(crate) fn refusal(&self, cage: &Cage, error: &TooDeep) -> Failure {
        let limit = self.max_memory.map(|most| format!(" into the {} of --max-memory", bytes(most)));
        cage.failure("too_deep", format!("{error}{}", limit.unwrap_or_default()))
    }
}

impl Budget {
    /// What the run holds at most, if so much comes on top of what is held already.
    pub(crate) fn stated(self, more: u128) -> u64 {
        let most = u128::from(self.held) + more;
        self.peak.max(u64::try_from(most).unwrap_or(u64::MAX))
    }
}

/// Stacks of threads, and pages and rows that are used in part.
const RUNNING: u64 = 4 << 20;

/// Units that a number of bytes may have.
const UNITS: [(&str, f64); 13] = [
    ("KiB", 1024.0),
    ("MiB", 1048576.0),
    ("GiB", 1073741824.0),
    ("TiB", 1099511627776.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("TB", 1e12),
    ("K", 1e3),
    ("M", 1e6),
    ("G", 1e9),
    ("T", 1e12),
    ("B", 1.0),
];

/// A number of bytes, with or without a unit. Units are powers of 1000, as in every report; with an `i` powers of 1024.
fn byte_count(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let unit = UNITS.iter().find_map(|&(unit, factor)| {
        let start = text.len().checked_sub(unit.len())?;
        let (number, end) = text.split_at_checked(start)?;
        end.eq_ignore_ascii_case(unit).then_some((number, factor))
    });
    let (number, factor) = unit.unwrap_or((text, 1.0));
    match number.trim_end().parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 && number * factor < u64::MAX as f64 => {
            Ok((number * factor) as u64)
        }
        _ => Err("a number of bytes is wanted, as in 500M, 4G or 1.5GiB".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_have_units() {
        for (text, count) in [
            ("1", 1),
            ("500M", 500_000_000),
            ("4g", 4_000_000_000),
            ("1.5 GiB", 1_610_612_736),
            ("12kB", 12_000),
            ("7B", 7),
            ("2TiB", 2_199_023_255_552),
        ] {
            assert_eq!(byte_count(text), Ok(count), "{text}");
        }
        for text in ["", "G", "-1", "0", "1e30T", "4X", "nan", "inf", "1 2M", "\u{e9}M"] {
            assert!(byte_count(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_stated_is_never_less_than_what_was_held() {
        let budget = Budget { held: 100, peak: 400, allowed: 0 };
        assert_eq!((budget.stated(200), budget.stated(500)), (400, 600));
        assert_eq!(budget.stated(u128::MAX / 2), u64::MAX);
    }
}
