//! What the caller of the STEP writer decides.

/// The unit of all lengths in the file. Coordinates are written as they are: a unit says what they mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// Millimetres.
    #[default]
    Millimetre,
    /// Centimetres.
    Centimetre,
    /// Metres.
    Metre,
    /// Inches.
    Inch,
}

impl Unit {
    /// Millimetres in one of it.
    pub fn in_millimetres(self) -> f64 {
        match self {
            Unit::Millimetre => 1.0,
            Unit::Centimetre => 10.0,
            Unit::Metre => 1000.0,
            Unit::Inch => 25.4,
        }
    }

    /// Its short name, as on the command line: `mm`, `cm`, `m`, `in`.
    pub fn name(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Centimetre => "cm",
            Unit::Metre => "m",
            Unit::Inch => "in",
        }
    }

    /// The distance, in this unit, below which readers may take two points for one: 1e-6 mm.
    pub(crate) fn uncertainty(self) -> f64 {
        match self {
            Unit::Millimetre => 1e-6,
            Unit::Centimetre => 1e-7,
            Unit::Metre => 1e-9,
            Unit::Inch => 1e-6 / 25.4,
        }
    }
}

/// The application protocol that the file follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Schema {
    /// AP214, `AUTOMOTIVE_DESIGN`: read everywhere.
    #[default]
    Ap214,
    /// AP242, `AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF`.
    Ap242,
}

/// What a STEP file says besides the shape. Equal options and parts give equal bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The unit of the coordinates.
    pub unit: Unit,
    /// The application protocol.
    pub schema: Schema,
    /// Name of the product, and of its bodies (`name.1`, `name.2`, .. where there are several).
    pub name: String,
    /// Name of the file, without folders, for the header.
    pub file_name: String,
    /// Time of writing for the header, ISO 8601.
    pub timestamp: String,
    /// The program that asks, with its version.
    pub originating_system: String,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            unit: Unit::default(),
            schema: Schema::default(),
            name: "part".to_owned(),
            file_name: "part.step".to_owned(),
            timestamp: "1970-01-01T00:00:00".to_owned(),
            originating_system: concat!("ogee ", env!("CARGO_PKG_VERSION")).to_owned(),
        }
    }
}
