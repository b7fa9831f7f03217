//! Where to evaluate: a file of addresses, stdin, or a grid over every face.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use ogee::ParametricFace;
use ogee_formats::samples::{Address, AddressReader, AddressesError, SampleFormat};

use crate::error::{Failure, Finding};
use crate::names::Format;

/// The format of points that are read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointsFormat(pub(crate) SampleFormat);

impl Format for PointsFormat {
    const NAMES: &'static [(&'static str, PointsFormat)] = &[
        ("jsonl", PointsFormat(SampleFormat::JsonLines)),
        ("ndjson", PointsFormat(SampleFormat::JsonLines)),
        ("json", PointsFormat(SampleFormat::JsonLines)),
        ("csv", PointsFormat(SampleFormat::Csv)),
    ];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--points-format";
}

/// Where addresses come from.
pub(crate) enum Source<'a> {
    Points(Points),
    Grid(Grid<'a>),
}

impl Source<'_> {
    /// What comes next.
    pub(crate) fn next(&mut self) -> Result<Next, Failure> {
        match self {
            Source::Grid(grid) => Ok(grid.next().map_or(Next::End, |address| Next::Address(None, address))),
            Source::Points(Points { name, reader }) => {
                let next = reader.next_address().map_err(|error| Failure::unreadable(name, &error))?;
                Ok(match next {
                    Some(Ok((line, address))) => Next::Address(Some(line as usize), address),
                    Some(Err(fault)) => Next::Bad(Finding::of_fault(&fault, name)),
                    None => Next::End,
                })
            }
        }
    }
}

/// What a source has to give.
pub(crate) enum Next {
    /// An address, and the line that it stands on.
    Address(Option<usize>, Address),
    /// What is wrong with a line.
    Bad(Finding),
    /// Nothing more.
    End,
}

/// A file of points, or stdin.
pub(crate) struct Points {
    /// Its name in messages.
    pub(crate) name: String,
    reader: AddressReader<Box<dyn BufRead>>,
}

impl Points {
    /// Opens the file, and reads the names of columns.
    pub(crate) fn open(path: &Path, format: SampleFormat) -> Result<Points, Failure> {
        let (name, source): (String, Box<dyn BufRead>) = if path == Path::new("-") {
            ("stdin".to_owned(), Box::new(std::io::stdin().lock()))
        } else {
            let name = path.display().to_string();
            let file = File::open(path).map_err(|error| Failure::unreadable(&name, &error))?;
            (name, Box::new(BufReader::with_capacity(READ_AHEAD, file)))
        };
        let reader = AddressReader::new(source, format).map_err(|error| match error {
            AddressesError::Refused(error) => Failure::of_reading(&error, &name),
            AddressesError::Unreadable(error) => Failure::unreadable(&name, &error),
            other => Failure::refused(vec![Finding::in_file("unreadable", other.to_string(), &name)], 0),
        })?;
        Ok(Points { name, reader })
    }
}

/// Bytes that are read from a file at once.
const READ_AHEAD: usize = 1 << 16;

/// The same grid over every face: along u, then along v, then from face to face.
pub(crate) struct Grid<'a> {
    faces: &'a [ParametricFace],
    cells: u32,
    /// How many addresses there have been.
    count: u64,
}

impl<'a> Grid<'a> {
    /// As many cells along both sides.
    pub(crate) fn new(faces: &'a [ParametricFace], cells: u32) -> Grid<'a> {
        Grid { faces, cells, count: 0 }
    }
}

impl Iterator for Grid<'_> {
    type Item = Address;

    fn next(&mut self) -> Option<Address> {
        let side = u64::from(self.cells) + 1;
        let (number, i, j) = (self.count / (side * side), self.count % side, self.count / side % side);
        let ParametricFace { face, corner } = *self.faces.get(usize::try_from(number).ok()?)?;
        self.count += 1;
        let parameter = |i: u64| i as f64 / f64::from(self.cells);
        Some(Address { face: face.0, corner, u: parameter(i), v: parameter(j) })
    }
}

#[cfg(test)]
mod tests {
    use ogee::FaceId;

    use super::*;

    #[test]
    fn a_grid_runs_along_u_then_v_then_over_the_faces() {
        let faces = [(0, None), (3, Some(2))].map(|(f, corner)| ParametricFace { face: FaceId(f), corner });
        let found: Vec<Address> = Grid::new(&faces, 3).collect();
        assert_eq!(found.len(), 32);
        assert_eq!(found[1], Address { face: 0, corner: None, u: 1.0 / 3.0, v: 0.0 });
        assert_eq!(found[7], Address { face: 0, corner: None, u: 1.0, v: 1.0 / 3.0 });
        assert_eq!(found[16], Address { face: 3, corner: Some(2), u: 0.0, v: 0.0 });
        assert_eq!(found[31], Address { face: 3, corner: Some(2), u: 1.0, v: 1.0 });
    }
}
