//! Why a file was refused, and what was passed over in one that was not.
//!
//! A refusal names every fault that was found, each with its line where the format has lines and its place in
//! the cage where it has one. Vertices and faces are numbered from 0 in every message, whatever the file does.

use std::fmt;

use ogee::Place;

/// Why a file was refused. Displays its first fault, without the line: the caller knows the name of the file
/// and writes both in front.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", .faults[0])]
pub struct ReadError {
    /// What is wrong, in the order of the file; never empty, at most [`ReadError::MOST_FAULTS`].
    pub faults: Vec<Fault>,
    /// How many more were found and not kept.
    pub unlisted: usize,
}

/// One thing that is wrong with a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// A stable name in snake case. Where the fault is also a defect of control meshes, the name is that of
    /// [`ogee::Defect::code`].
    pub code: &'static str,
    /// For people, without the line.
    pub message: String,
    /// The line of the file, counted from 1; `None` in formats without lines.
    pub line: Option<u32>,
    /// The place in the cage, where there is one.
    pub place: Option<Place>,
}

/// Something in a file that was passed over.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// The line of the file, counted from 1; `None` in formats without lines.
    pub line: Option<u32>,
    /// A stable name in snake case.
    pub code: &'static str,
    /// For people, without the line.
    pub message: String,
}

impl ReadError {
    /// How many faults are kept at most; the rest is only counted.
    pub const MOST_FAULTS: usize = 1000;

    /// A refusal for one reason.
    pub(crate) fn single(fault: Fault) -> ReadError {
        ReadError { faults: vec![fault], unlisted: 0 }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Fault {
    /// A fault of the file as a whole.
    pub(crate) fn new(code: &'static str, message: impl Into<String>) -> Fault {
        Fault { code, message: message.into(), line: None, place: None }
    }

    /// The same fault on a line.
    pub(crate) fn on_line(self, line: impl Into<Option<u32>>) -> Fault {
        Fault { line: line.into(), ..self }
    }

    /// The same fault at a place of the cage.
    pub(crate) fn at(self, place: Place) -> Fault {
        Fault { place: Some(place), ..self }
    }
}

/// Faults found so far: a bounded list, so that a file of nothing but faults costs no more than its size.
#[derive(Default)]
pub(crate) struct Faults {
    list: Vec<Fault>,
    unlisted: usize,
}

impl Faults {
    pub(crate) fn push(&mut self, fault: Fault) {
        if self.list.len() < ReadError::MOST_FAULTS {
            self.list.push(fault);
        } else {
            self.unlisted += 1;
        }
    }

    /// The faults of several readers that shared the lines of one file, as one reader would have found them.
    pub(crate) fn merged(parts: impl IntoIterator<Item = Faults>) -> Faults {
        let mut all = Faults::default();
        for part in parts {
            all.list.extend(part.list);
            all.unlisted += part.unlisted;
        }
        all.list.sort_by_key(|fault| fault.line);
        all.unlisted += all.list.len().saturating_sub(ReadError::MOST_FAULTS);
        all.list.truncate(ReadError::MOST_FAULTS);
        all
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The refusal, if there is any fault.
    pub(crate) fn into_result(mut self) -> Result<(), ReadError> {
        if self.list.is_empty() {
            return Ok(());
        }
        // Some faults are found only when all is read; a reader of the list walks through the file once.
        self.list.sort_by_key(|fault| fault.line);
        Err(ReadError { faults: self.list, unlisted: self.unlisted })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_come_in_the_order_of_the_file_and_are_bounded() {
        let mut faults = Faults::default();
        for line in (1..=1500).rev() {
            faults.push(Fault::new("x", format!("fault {line}")).on_line(line));
        }
        let error = faults.into_result().unwrap_err();
        assert_eq!((error.faults.len(), error.unlisted), (ReadError::MOST_FAULTS, 500));
        assert_eq!(error.faults[0].line, Some(501));
        assert_eq!(error.to_string(), "fault 501");
        assert!(Faults::default().into_result().is_ok());
    }
}
