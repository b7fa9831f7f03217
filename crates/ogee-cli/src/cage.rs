//! Opening and reading a cage, and naming the lines of what is wrong with it.

use std::collections::HashMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use ogee::{Boundary, ControlMesh, Creasing, Defect, LensShape, Place};
use ogee_formats::{CageFile, CageFormat, FileBytes, read_cage};

use crate::error::{Failure, Finding};
use crate::names::{BOUNDARIES, CREASINGS, Format, formats};

/// The options of every command that reads a cage.
#[derive(Debug, Args)]
pub(crate) struct CageArguments {
    /// The cage: OBJ with subdivision tags, OFF, PLY or JSON; - for stdin
    #[arg(value_name = "CAGE")]
    pub(crate) cage: PathBuf,
    /// The format of the cage, where its name does not tell
    #[arg(long, value_name = "FORMAT", value_parser = formats::<CageFormat>())]
    pub(crate) input_format: Option<CageFormat>,
    /// The rule at the boundary [default: what the file says, else edge-and-corner]
    #[arg(long, value_name = "RULE", value_parser = BOUNDARIES)]
    pub(crate) boundary: Option<Boundary>,
    /// How semi-sharp creases fade [default: what the file says, else uniform]
    #[arg(long, value_name = "RULE", value_parser = CREASINGS)]
    pub(crate) creasing: Option<Creasing>,
    /// Weights of neighbours and opposite corners at vertices of valence 2 [default: what the file says, else 0.5,0.125]
    #[arg(long, value_name = "BETA,GAMMA", value_parser = lens_shape)]
    pub(crate) lens_shape: Option<LensShape>,
}

/// Two numbers with a comma between them. Whether they make a smooth rule is asked at the gate.
fn lens_shape(text: &str) -> Result<LensShape, String> {
    let numbers = text.split_once(',').and_then(|(beta, gamma)| {
        Some(LensShape { beta: beta.trim().parse().ok()?, gamma: gamma.trim().parse().ok()? })
    });
    numbers.ok_or_else(|| "two numbers with a comma between them are wanted, as 0.5,0.125".to_owned())
}

impl Format for CageFormat {
    const NAMES: &'static [(&'static str, CageFormat)] = &[
        ("obj", CageFormat::Obj),
        ("off", CageFormat::Off),
        ("ply", CageFormat::Ply),
        ("json", CageFormat::Json),
    ];
    const ELSEWHERE: &'static [&'static str] = &["usd", "usda", "usdc", "usdz"];
    const OPTION: &'static str = "--input-format";
}

/// A cage and the file it came from.
pub(crate) struct Cage {
    /// The file's name in messages.
    pub(crate) name: String,
    /// What was read.
    pub(crate) file: CageFile,
    /// How long that took.
    pub(crate) seconds: f64,
}

impl CageArguments {
    /// Reads the cage and applies the rules that were asked for.
    pub(crate) fn read(&self) -> Result<Cage, Failure> {
        let start = Instant::now();
        let (name, format, bytes) = self.load()?;
        let cage = self.parse(name, format, &bytes)?;
        Ok(Cage { seconds: start.elapsed().as_secs_f64(), ..cage })
    }

    /// The name, the format and the bytes of the file.
    pub(crate) fn load(&self) -> Result<(String, CageFormat, FileBytes), Failure> {
        if self.is_stdin() && self.input_format.is_none() {
            return Err(Failure::usage("reading from stdin wants --input-format"));
        }
        let format = CageFormat::of(self.input_format, &self.cage).map_err(Failure::usage)?;
        let (name, bytes) = read_bytes(&self.cage)?;
        Ok((name, format, bytes))
    }

    /// The cage in these bytes, with the rules that were asked for.
    pub(crate) fn parse(&self, name: String, format: CageFormat, bytes: &[u8]) -> Result<Cage, Failure> {
        let start = Instant::now();
        let mut file = read_cage(bytes, format).map_err(|error| Failure::of_reading(&error, &name))?;
        let scheme = &mut file.mesh.scheme;
        scheme.boundary = self.boundary.unwrap_or(scheme.boundary);
        scheme.creasing = self.creasing.unwrap_or(scheme.creasing);
        scheme.lens = self.lens_shape.unwrap_or(scheme.lens);
        Ok(Cage { name, file, seconds: start.elapsed().as_secs_f64() })
    }

    /// The same rules for another file, whose name tells its format.
    pub(crate) fn for_file(&self, file: &Path) -> CageArguments {
        CageArguments { cage: file.to_owned(), input_format: None, ..*self }
    }

    /// True if the cage comes from stdin.
    pub(crate) fn is_stdin(&self) -> bool {
        self.cage == Path::new("-")
    }

    /// The name of the file without folders and extension.
    pub(crate) fn stem(&self) -> String {
        match self.cage.file_stem() {
            Some(stem) if stem != "-" => stem.to_string_lossy().into_owned(),
            _ => "cage".to_owned(),
        }
    }
}

/// The bytes of a file, or of stdin, and its name in messages.
pub(crate) fn read_bytes(path: &Path) -> Result<(String, FileBytes), Failure> {
    if path == Path::new("-") {
        let mut bytes = Vec::new();
        let read = std::io::stdin().lock().read_to_end(&mut bytes);
        read.map_err(|error| Failure::unreadable("stdin", &error))?;
        return Ok(("stdin".to_owned(), bytes.into()));
    }
    let name = path.display().to_string();
    let bytes = FileBytes::open(path).map_err(|error| Failure::unreadable(&name, &error))?;
    Ok((name, bytes))
}

impl Cage {
    /// The polygons.
    pub(crate) fn mesh(&self) -> &ControlMesh {
        &self.file.mesh
    }

    /// What the reader passed over.
    pub(crate) fn warnings(&self) -> Vec<Finding> {
        self.file.warnings.iter().map(|warning| Finding::of_warning(warning, &self.name)).collect()
    }

    /// Defects with the lines of the faces that they concern.
    pub(crate) fn findings(&self, defects: &[Defect]) -> Vec<Finding> {
        let lines = Lines::new(self);
        let findings = defects.iter().map(|defect| {
            let mut finding = Finding::of_defect(defect, &self.name);
            // The face that came last is the one to look at.
            finding.location.line = defect.place().and_then(|place| lines.of(place));
            finding
        });
        findings.collect()
    }

    /// A refusal for these defects.
    pub(crate) fn refused(&self, defects: &[Defect]) -> Failure {
        Failure::refused(self.findings(defects), 0)
    }

    /// A refusal of the cage as a whole.
    pub(crate) fn failure(&self, code: &'static str, message: impl Into<String>) -> Failure {
        Failure::refused(vec![Finding::in_file(code, message, &self.name)], 0)
    }
}

/// The lines of faces, and the last face at each edge and vertex.
struct Lines<'a> {
    of_faces: &'a [u32],
    last_at_edge: HashMap<[u32; 2], usize>,
    last_at_vertex: HashMap<u32, usize>,
}

impl<'a> Lines<'a> {
    fn new(cage: &'a Cage) -> Lines<'a> {
        let (mut last_at_edge, mut last_at_vertex) = (HashMap::new(), HashMap::new());
        for (f, corners) in cage.mesh().faces.iter().enumerate() {
            for (k, &a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                last_at_edge.insert([a.min(b), a.max(b)], f);
                last_at_vertex.insert(a, f);
            }
        }
        Lines { of_faces: &cage.file.face_lines, last_at_edge, last_at_vertex }
    }

    fn of(&self, place: Place) -> Option<usize> {
        let face = match place {
            Place::Face(face) => face as usize,
            Place::Edge(a, b) => *self.last_at_edge.get(&[a.min(b), a.max(b)])?,
            Place::Vertex(vertex) => *self.last_at_vertex.get(&vertex)?,
        };
        self.of_faces.get(face).map(|&line| line as usize)
    }
}
