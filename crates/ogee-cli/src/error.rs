//! `Failure`: why a command stopped, with its place, its name for scripts and its exit code.

use std::io;
use std::path::Path;

use ogee::{Defect, Note, Place};
use ogee_formats::{Fault, ReadError, Warning};
use serde::Serialize;
use serde::ser::SerializeMap;

/// Exit codes, as the command line promises them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// A check that was asked for failed.
    Check = 1,
    /// Something was typed that makes no sense.
    Usage = 2,
    /// The input cannot be read, or is refused.
    Input = 3,
    /// The output was not written.
    Output = 4,
}

/// Where something is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Where {
    /// The file, as it was typed.
    pub(crate) file: Option<String>,
    /// The line, from 1.
    pub(crate) line: Option<usize>,
    /// The place in the cage.
    pub(crate) place: Option<Place>,
    /// The number of the entity of a STEP file.
    pub(crate) id: Option<u64>,
}

impl Serialize for Where {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if let Some(file) = &self.file {
            map.serialize_entry("file", file)?;
        }
        if let Some(line) = self.line {
            map.serialize_entry("line", &line)?;
        }
        match self.place {
            Some(Place::Vertex(vertex)) => map.serialize_entry("vertex", &vertex)?,
            Some(Place::Edge(a, b)) => map.serialize_entry("edge", &[a, b])?,
            Some(Place::Face(face)) => map.serialize_entry("face", &face)?,
            None => {}
        }
        if let Some(id) = self.id {
            map.serialize_entry("id", &id)?;
        }
        map.end()
    }
}

/// One thing worth saying: an error, a defect, a note.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Finding {
    /// A stable name in snake case.
    pub(crate) code: &'static str,
    /// For people, without the place in the file.
    pub(crate) message: String,
    /// The place.
    #[serde(rename = "where")]
    pub(crate) location: Where,
}

impl Finding {
    /// A finding about a file as a whole.
    pub(crate) fn in_file(code: &'static str, message: impl Into<String>, file: &str) -> Finding {
        let location = Where { file: Some(file.to_owned()), ..Where::default() };
        Finding { code, message: message.into(), location }
    }

    /// A fault that a reader found.
    pub(crate) fn of_fault(fault: &Fault, file: &str) -> Finding {
        let mut finding = Finding::in_file(fault.code, &fault.message, file);
        finding.location.line = fault.line.map(|line| line as usize);
        finding.location.place = fault.place;
        finding
    }

    /// What a reader passed over.
    pub(crate) fn of_warning(warning: &Warning, file: &str) -> Finding {
        let mut finding = Finding::in_file(warning.code, &warning.message, file);
        finding.location.line = warning.line.map(|line| line as usize);
        finding
    }

    /// A defect of a cage; its line is for the cage to say.
    pub(crate) fn of_defect(defect: &Defect, file: &str) -> Finding {
        let mut finding = Finding::in_file(defect.code(), defect.to_string(), file);
        finding.location.place = defect.place();
        finding
    }

    /// What the library wants the user to know.
    pub(crate) fn of_note(note: &Note) -> Finding {
        let location = Where { place: note.place, ..Where::default() };
        Finding { code: note.code, message: note.message.clone(), location }
    }

    /// `cage.obj:41: face 12 uses ..`.
    pub(crate) fn line(&self) -> String {
        let id = self.location.id.map(|id| format!("#{id}: ")).unwrap_or_default();
        let message = &self.message;
        match (&self.location.file, self.location.line) {
            (Some(file), Some(line)) => format!("{file}:{line}: {id}{message}"),
            (Some(file), None) => format!("{file}: {id}{message}"),
            (None, _) => format!("{id}{message}"),
        }
    }
}

/// Why a command stopped.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Failure {
    /// The exit code.
    pub(crate) exit: Exit,
    /// What is wrong, the first of it first; never empty, at most one and [`Failure::MOST_OTHERS`].
    findings: Vec<Finding>,
    /// How many more there are.
    pub(crate) unlisted: usize,
    /// Nobody is there to read it: the pipe was closed.
    pub(crate) silent: bool,
}

impl Failure {
    /// How many others are listed at most.
    pub(crate) const MOST_OTHERS: usize = 20;

    /// A failure with one finding.
    pub(crate) fn new(exit: Exit, first: Finding) -> Failure {
        Failure { exit, findings: vec![first], unlisted: 0, silent: false }
    }

    /// Something was typed that makes no sense.
    pub(crate) fn usage(message: impl Into<String>) -> Failure {
        let first = Finding { code: "usage", message: message.into(), location: Where::default() };
        Failure::new(Exit::Usage, first)
    }

    /// The input is refused for all these reasons, of which there is at least one, and `unlisted` more.
    pub(crate) fn refused(mut findings: Vec<Finding>, unlisted: usize) -> Failure {
        let kept = findings.len().min(1 + Failure::MOST_OTHERS);
        let unlisted = unlisted + findings.len() - kept;
        findings.truncate(kept);
        Failure { exit: Exit::Input, findings, unlisted, silent: false }
    }

    /// A reader refused the file.
    pub(crate) fn of_reading(error: &ReadError, file: &str) -> Failure {
        let faults = error.faults.iter().map(|fault| Finding::of_fault(fault, file));
        Failure::refused(faults.collect(), error.unlisted)
    }

    /// What is said in one line.
    pub(crate) fn first(&self) -> &Finding {
        &self.findings[0]
    }

    /// What else is wrong.
    pub(crate) fn others(&self) -> &[Finding] {
        &self.findings[1..]
    }

    /// The input cannot be read.
    pub(crate) fn unreadable(file: &str, error: &io::Error) -> Failure {
        Failure::new(Exit::Input, Finding::in_file("unreadable", plain(error), file))
    }

    /// The output cannot be written.
    pub(crate) fn unwritten(path: &Path, error: &io::Error) -> Failure {
        let file = path.display().to_string();
        let silent = error.kind() == io::ErrorKind::BrokenPipe;
        let finding = Finding::in_file("not_written", format!("not written: {}", plain(error)), &file);
        Failure { silent, ..Failure::new(Exit::Output, finding) }
    }
}

/// The message of the system without its number.
fn plain(error: &io::Error) -> String {
    let whole = error.to_string();
    match whole.rfind(" (os error ") {
        Some(end) => whole[..end].to_owned(),
        None => whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_says_where() {
        let mut finding = Finding::in_file("x", "face 1 is bad", "a.obj");
        assert_eq!(finding.line(), "a.obj: face 1 is bad");
        finding.location = Where { line: Some(4), place: Some(Place::Edge(1, 2)), ..finding.location };
        assert_eq!(finding.line(), "a.obj:4: face 1 is bad");
        let json = serde_json::to_value(&finding).unwrap();
        let place = serde_json::json!({"file": "a.obj", "line": 4, "edge": [1, 2]});
        assert_eq!(json, serde_json::json!({"code": "x", "message": "face 1 is bad", "where": place}));
    }

    #[test]
    fn twenty_others_are_listed_and_the_rest_is_counted() {
        let findings = (0..30).map(|i| Finding::in_file("x", i.to_string(), "a")).collect();
        let failure = Failure::refused(findings, 5);
        assert_eq!((failure.others().len(), failure.unlisted), (20, 14));
    }

    #[test]
    fn the_number_of_a_system_error_is_left_out() {
        assert_eq!(plain(&io::Error::from_raw_os_error(28)), "No space left on device");
    }
}
