//! What a command looks at: the limit surface of a cage, or the patches of a part.

use std::borrow::Cow;
use std::ops::RangeInclusive;
use std::path::Path;
use std::time::Instant;

use ogee::Vec3;
use ogee::lens::Method;
use ogee::quality::{LimitView, PatchView, Surface, bounding_box};
use ogee_formats::CageFormat;
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::cage::{Cage, CageArguments};
use crate::error::{Failure, Finding};
use crate::report::figure;
use crate::treatment::CageSurface;

/// A surface to look at, and the file it came from.
pub(crate) struct Subject {
    /// The file's name in messages.
    pub(crate) name: String,
    kind: Kind,
    /// How long reading took.
    pub(crate) read_seconds: f64,
    /// How long connectivity and tables took.
    pub(crate) prepare_seconds: f64,
}

enum Kind {
    Cage(Box<CageSurface>),
    Patches(Box<PatchView>),
}

/// The argument of a command that looks at parts as well as at cages.
pub(crate) fn or_part(cage: clap::Arg) -> clap::Arg {
    cage.value_name("CAGE|PART.json").help(
        "A cage: OBJ with subdivision tags, OFF, PLY or JSON; or the patches of a part in JSON; - for stdin",
    )
}

/// True if a text is a part in JSON and no cage.
fn is_part(bytes: &[u8]) -> bool {
    #[derive(Deserialize)]
    struct Probe {
        #[serde(rename = "patches")]
        _patches: IgnoredAny,
    }
    serde_json::from_slice::<Probe>(bytes).is_ok()
}

impl Subject {
    /// Reads a cage, or a part in JSON.
    pub(crate) fn read(arguments: &CageArguments) -> Result<Subject, Failure> {
        let (name, format, bytes) = arguments.load()?;
        Subject::parse(arguments, name, format, &bytes, Method::Auto)
    }

    /// The cage or the part in these bytes; lenses of a cage are seen to by `method`.
    pub(crate) fn parse(
        arguments: &CageArguments,
        name: String,
        format: CageFormat,
        bytes: &[u8],
        method: Method,
    ) -> Result<Subject, Failure> {
        let start = Instant::now();
        if format == CageFormat::Json && is_part(bytes) {
            let refused =
                |code, message: String| Failure::refused(vec![Finding::in_file(code, message, &name)], 0);
            let patches = ogee_formats::patches::read(bytes)
                .map_err(|error| refused(error.code(), error.to_string()))?;
            let read_seconds = start.elapsed().as_secs_f64();
            let start = Instant::now();
            let patches = patches.into_iter().map(|patch| (patch.surface, patch.quads)).collect();
            let view = PatchView::new(patches).map_err(|error| refused("no_surface", error.to_string()))?;
            let prepare_seconds = start.elapsed().as_secs_f64();
            return Ok(Subject { name, kind: Kind::Patches(Box::new(view)), read_seconds, prepare_seconds });
        }
        let cage = arguments.parse(name, format, bytes)?;
        let read_seconds = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let name = cage.name.clone();
        let kind = Kind::Cage(Box::new(CageSurface::new(cage, method)?));
        let prepare_seconds = start.elapsed().as_secs_f64();
        Ok(Subject { name, kind, read_seconds, prepare_seconds })
    }

    /// Refuses rules of subdivision for a part, which has none.
    pub(crate) fn check_rules(&self, arguments: &CageArguments) -> Result<(), Failure> {
        if self.cage().is_none() && (arguments.boundary.is_some() || arguments.creasing.is_some()) {
            let name = &self.name;
            return Err(Failure::usage(format!(
                "{name} has patches: --boundary and --creasing are for cages"
            )));
        }
        Ok(())
    }

    /// Refuses a treatment of lenses for a part, which has none any more.
    pub(crate) fn check_lens(&self, method: Method) -> Result<(), Failure> {
        if self.cage().is_none() && method != Method::Auto {
            return Err(Failure::usage(format!("{} has patches: --lens is for cages", self.name)));
        }
        Ok(())
    }

    /// The file's name without its folders.
    pub(crate) fn file_name(&self) -> Cow<'_, str> {
        Path::new(&self.name).file_name().map_or(Cow::Borrowed(&*self.name), |name| name.to_string_lossy())
    }

    /// The cage, if it is one.
    pub(crate) fn cage(&self) -> Option<&Cage> {
        match &self.kind {
            Kind::Cage(surface) => Some(surface.cage()),
            Kind::Patches(_) => None,
        }
    }

    /// How many faces the cage has, or how many patches there are.
    pub(crate) fn faces(&self) -> usize {
        match &self.kind {
            Kind::Cage(surface) => surface.cage().mesh().faces.len(),
            Kind::Patches(view) => view.patches().len(),
        }
    }

    /// Lets somebody look at the surface.
    pub(crate) fn look<T>(&self, look: impl FnOnce(&dyn Surface) -> T) -> T {
        match &self.kind {
            Kind::Cage(cage) => cage.look(|surface| look(&LimitView::new(cage.level(), surface))),
            Kind::Patches(view) => look(view.as_ref()),
        }
    }

    /// True if caps are a part of the surface.
    #[cfg(feature = "gpu")]
    pub(crate) fn has_caps(&self) -> bool {
        matches!(&self.kind, Kind::Cage(surface) if surface.has_caps())
    }

    /// Lets somebody look at the limit surface, if it is one.
    #[cfg(feature = "gpu")]
    pub(crate) fn look_at_limit<T>(&self, look: impl FnOnce(&LimitView<'_>) -> T) -> Option<T> {
        match &self.kind {
            Kind::Cage(cage) if !cage.has_caps() => {
                Some(cage.look(|surface| look(&LimitView::new(cage.level(), surface.limit()))))
            }
            Kind::Cage(_) | Kind::Patches(_) => None,
        }
    }

    /// What the reader passed over, and what else is worth knowing.
    pub(crate) fn notes(&self) -> Vec<Finding> {
        match &self.kind {
            Kind::Cage(surface) => surface.notes(),
            Kind::Patches(_) => Vec::new(),
        }
    }

    /// A refusal of what is looked at as a whole.
    pub(crate) fn failure(&self, code: &'static str, message: impl Into<String>) -> Failure {
        Failure::refused(vec![Finding::in_file(code, message, &self.name)], 0)
    }

    /// The box around the surface; a failure if it is none to compute with.
    pub(crate) fn bounds(&self, surface: &dyn Surface) -> Result<[Vec3; 2], Failure> {
        /// Longest sides whose fourth powers neither overflow nor vanish.
        const SIZES: RangeInclusive<f64> = 1e-60..=1e60;
        let bounds = bounding_box(surface).filter(|bounds| bounds[0] != bounds[1]);
        let [lower, upper] = bounds.ok_or_else(|| {
            self.failure("no_size", "the surface has no size, or points that are not finite")
        })?;
        let sides = upper - lower;
        let longest = sides.x.max(sides.y).max(sides.z);
        if !SIZES.contains(&longest) {
            let (found, least, most) = (figure(longest), SIZES.start(), SIZES.end());
            let message = format!("the surface is {found} long; scale it to between {least:e} and {most:e}");
            return Err(self.failure("size_out_of_range", message));
        }
        Ok([lower, upper])
    }
}
