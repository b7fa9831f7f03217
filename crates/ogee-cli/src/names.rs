//! Values by name, and names that are known but not to this build.

use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, Error};
use ogee::convert::{Method, UpAxis};
use ogee::curve_network::{Crossing, Placing};
use ogee::lens;
use ogee::{Boundary, Creasing, Derivatives};
use ogee_formats::step::{Schema, Unit};

use crate::comparison::Way;

/// A parser of values that go by one or more names.
#[derive(Clone)]
pub(crate) struct Names<T: Clone + Send + Sync + 'static> {
    /// Names with their values.
    values: &'static [(&'static str, T)],
    /// Names that the program has but not this build.
    elsewhere: &'static [&'static str],
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for Names<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<T, Error> {
        let name = value.to_string_lossy();
        if let Some((_, known)) = self.values.iter().find(|(known, _)| known.eq_ignore_ascii_case(&name)) {
            return Ok(known.clone());
        }
        let option = argument.map_or_else(String::new, |argument| format!(" for {argument}"));
        let known: Vec<&str> = self.values.iter().map(|(name, _)| *name).collect();
        let known = known.join(", ");
        let why = if self.elsewhere.iter().any(|later| later.eq_ignore_ascii_case(&name)) {
            format!("this build does not have '{name}'{option}; it has {known}\n")
        } else {
            format!("unknown value '{name}'{option}; known are {known}\n")
        };
        Err(Error::raw(ErrorKind::InvalidValue, why).with_cmd(command))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.values.iter().map(|(name, _)| PossibleValue::new(*name))))
    }
}

pub(crate) const METHODS: Names<Method> = Names {
    values: &[
        ("pccm", Method::Pccm),
        ("pccm-first", Method::PccmFirst),
        ("bi5", Method::Bi5),
        ("g2", Method::G2),
    ],
    elsewhere: &[],
};

pub(crate) const WAYS: Names<Way> = Names {
    values: &[
        ("limit", Way::Limit),
        ("pccm", Way::Part(Method::Pccm)),
        ("pccm-first", Way::Part(Method::PccmFirst)),
        ("bi5", Way::Part(Method::Bi5)),
        ("g2", Way::Part(Method::G2)),
    ],
    elsewhere: &[],
};

pub(crate) const LENS_METHODS: Names<lens::Method> = Names {
    values: &[
        ("auto", lens::Method::Auto),
        ("c1", lens::Method::C1),
        ("c2", lens::Method::C2),
        ("degree-raise", lens::Method::DegreeRaise),
        ("identify", lens::Method::Identify),
        ("remove", lens::Method::Remove),
        ("merge", lens::Method::Merge),
        ("polar", lens::Method::Polar),
    ],
    elsewhere: &[],
};

pub(crate) const UNITS: Names<Unit> = Names {
    values: &[("mm", Unit::Millimetre), ("cm", Unit::Centimetre), ("m", Unit::Metre), ("in", Unit::Inch)],
    elsewhere: &[],
};

pub(crate) const SCHEMAS: Names<Schema> =
    Names { values: &[("214", Schema::Ap214), ("242", Schema::Ap242)], elsewhere: &[] };

pub(crate) const UP_AXES: Names<UpAxis> =
    Names { values: &[("y", UpAxis::Y), ("z", UpAxis::Z)], elsewhere: &[] };

pub(crate) const BOUNDARIES: Names<Boundary> = Names {
    values: &[
        ("edge-and-corner", Boundary::EdgeAndCorner),
        ("edge-only", Boundary::EdgeOnly),
        ("none", Boundary::None),
    ],
    elsewhere: &[],
};

pub(crate) const CREASINGS: Names<Creasing> =
    Names { values: &[("uniform", Creasing::Uniform), ("chaikin", Creasing::Chaikin)], elsewhere: &[] };

pub(crate) const DERIVATIVES: Names<Derivatives> = Names {
    values: &[("0", Derivatives::None), ("1", Derivatives::First), ("2", Derivatives::Second)],
    elsewhere: &[],
};

pub(crate) const PLACINGS: Names<Placing> = Names {
    values: &[
        ("eigen", Placing::Eigen),
        ("parallelogram", Placing::Parallelogram),
        ("symmetric", Placing::Symmetric),
        ("keep", Placing::Keep),
    ],
    elsewhere: &[],
};

/// The papers' own forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    AbbasNasri2004,
    Generalised,
}

pub(crate) const SCHEMES: Names<Scheme> = Names {
    values: &[("abbas-nasri-2004", Scheme::AbbasNasri2004), ("generalised", Scheme::Generalised)],
    elsewhere: &[],
};

pub(crate) const CROSSINGS: Names<Crossing> =
    Names { values: &[("pin", Crossing::Pin), ("smooth", Crossing::Smooth)], elsewhere: &[] };

/// A format, told by a name that is also the extension of its files.
pub(crate) trait Format: Copy + 'static {
    /// All names; the first of a format is the usual one.
    const NAMES: &'static [(&'static str, Self)];
    /// Names that other builds have.
    const ELSEWHERE: &'static [&'static str];
    /// The option that says the format.
    const OPTION: &'static str;

    /// The format of a file: the one that was named, or what the extension tells.
    fn of(named: Option<Self>, path: &std::path::Path) -> Result<Self, String> {
        if let Some(format) = named {
            return Ok(format);
        }
        let known: Vec<&str> = Self::NAMES.iter().map(|(name, _)| *name).collect();
        let (known, option) = (known.join(", "), Self::OPTION);
        let Some(extension) = path.extension().map(|extension| extension.to_string_lossy()) else {
            return Err(format!("{}: no extension tells the format; say {option} {known}", path.display()));
        };
        let is_it = |name: &str| name.eq_ignore_ascii_case(&extension);
        if let Some((_, format)) = Self::NAMES.iter().find(|(name, _)| is_it(name)) {
            return Ok(*format);
        }
        let path = path.display();
        Err(if Self::ELSEWHERE.iter().any(|name| is_it(name)) {
            format!("{path}: this build does not have the format {extension} here; it has {known}")
        } else {
            format!("{path}: unknown format {extension}; say {option} {known}")
        })
    }
}

/// The parser of a format's names.
pub(crate) fn formats<F: Format + Send + Sync>() -> Names<F> {
    Names { values: F::NAMES, elsewhere: F::ELSEWHERE }
}

/// Commands and options that the program has but not this build.
const ELSEWHERE: [&str; 3] = ["batch", "view", "--iges"];

/// What to say where an unknown word is one of another build.
pub(crate) fn not_in_this_build(error: &Error) -> Option<String> {
    let kind = match error.kind() {
        ErrorKind::UnknownArgument => ContextKind::InvalidArg,
        ErrorKind::InvalidSubcommand => ContextKind::InvalidSubcommand,
        _ => return None,
    };
    let Some(ContextValue::String(word)) = error.get(kind) else { return None };
    let word = word.split('=').next().unwrap_or_default();
    ELSEWHERE.contains(&word).then(|| format!("this build does not have '{word}'"))
}
