//! `--lens` of commands that look at surfaces: the surface of a cage whose lenses and poles have been seen to.

use clap::Args;
use ogee::lens::{self, Method, Treated, TreatedSurface, treat};
use ogee::{Level, LimitSurface, PatchTable, Vec3};

use crate::cage::Cage;
use crate::commands::lens::refusal;
use crate::error::{Failure, Finding};
use crate::lenses::{LensReport, lens_counts};
use crate::names::LENS_METHODS;
use crate::report::count;

/// The option.
#[derive(Debug, Args)]
pub(crate) struct LensArguments {
    /// What to do at vertices of valence 2 and at poles: auto and c1 leave the surface as it is; c2, degree-raise and polar put
    /// caps in it, at the addresses of the cage; identify, remove and merge take the cage that ogee lens writes
    #[arg(long, value_name = "METHOD", default_value = "auto", value_parser = LENS_METHODS)]
    pub(crate) lens: Method,
}

/// The surface of a cage.
pub(crate) struct CageSurface {
    cage: Cage,
    treatment: Treatment,
    /// Of the cage in whose terms addresses are.
    level: Level,
    table: PatchTable,
}

/// What was done with lenses and poles.
enum Treatment {
    None,
    /// Another cage takes the place of the first.
    Remeshed(Box<Treated>),
    /// Caps stand in the place of faces.
    Capped(Box<Treated>),
}

impl CageSurface {
    /// Connectivity and tables of a cage after a treatment.
    pub(crate) fn new(cage: Cage, method: Method) -> Result<CageSurface, Failure> {
        let level = Level::new(cage.mesh()).map_err(|error| cage.refused(&error.defects))?;
        let treated = || {
            let options = lens::Options { method, ..lens::Options::default() };
            treat(cage.mesh(), &options).map(Box::new).map_err(|error| refusal(&cage, &error))
        };
        let treatment = match method {
            Method::Auto | Method::C1 => Treatment::None,
            Method::Identify | Method::Remove | Method::Merge => Treatment::Remeshed(treated()?),
            Method::C2 | Method::DegreeRaise | Method::Polar => Treatment::Capped(treated()?),
        };
        let level = match &treatment {
            Treatment::Remeshed(treated) => {
                Level::new(&treated.mesh).map_err(|error| cage.refused(&error.defects))?
            }
            Treatment::None | Treatment::Capped(_) => level,
        };
        let table = PatchTable::new(&level);
        if !(0..table.len()).any(|face| table.is_visible(face)) {
            return Err(cage.failure("no_surface", "no face of the cage is part of the surface"));
        }
        Ok(CageSurface { cage, treatment, level, table })
    }

    /// The cage as it was read.
    pub(crate) fn cage(&self) -> &Cage {
        &self.cage
    }

    /// The level of the cage in whose terms addresses are.
    pub(crate) fn level(&self) -> &Level {
        &self.level
    }

    /// Its table.
    pub(crate) fn table(&self) -> &PatchTable {
        &self.table
    }

    /// True if caps are a part of the surface.
    #[cfg(feature = "gpu")]
    pub(crate) fn has_caps(&self) -> bool {
        matches!(self.treatment, Treatment::Capped(_))
    }

    /// Lets somebody look at the surface.
    pub(crate) fn look<T>(&self, look: impl FnOnce(&TreatedSurface<'_>) -> T) -> T {
        let limit = LimitSurface::new(&self.table, self.points());
        let surface = match &self.treatment {
            Treatment::Capped(treated) => {
                TreatedSurface::new(&limit, treated).expect("caps alone change no face")
            }
            Treatment::None | Treatment::Remeshed(_) => TreatedSurface::untreated(&limit),
        };
        look(&surface)
    }

    fn points(&self) -> &[Vec3] {
        match &self.treatment {
            Treatment::Remeshed(treated) => &treated.mesh.points,
            Treatment::None | Treatment::Capped(_) => &self.cage.mesh().points,
        }
    }

    /// What the reader passed over, what was done with lenses and poles, and what else is worth knowing.
    pub(crate) fn notes(&self) -> Vec<Finding> {
        let mut notes = self.cage.warnings();
        notes.extend(ogee::mesh::notes(self.cage.mesh()).iter().map(Finding::of_note));
        let (treated, whose) = match &self.treatment {
            Treatment::None => return notes,
            Treatment::Remeshed(treated) => (treated, "the cage that ogee lens writes"),
            Treatment::Capped(treated) => (treated, "the cage in the file"),
        };
        let lenses: Vec<LensReport> = treated.lenses.iter().map(LensReport::new).collect();
        let done = if lenses.is_empty() { "none".to_owned() } else { lens_counts(&lenses) };
        let refined = match treated.steps {
            0 => String::new(),
            steps => format!(", refined {} first", count(steps as usize, "time", "times")),
        };
        let message = format!("lenses and poles: {done}{refined}; addresses are those of {whose}");
        notes.push(Finding::in_file("lenses_treated", message, &self.cage.name));
        notes
    }
}
