//! `CapClass`: what kind of vertex a cap surrounds; the weights depend on it alone.

/// The class of a vertex with a cap.
///
/// Columns, the order of the points that a cap is made of, begin with the vertex itself. Around an interior vertex follow
/// for each sector `P10 P11 P20 P21 P12 P22`; for all others `P10 P20` of each edge, then `P11 P21 P12 P22` of each sector. Edge `i`
/// leaves between sectors `i - 1` and `i`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CapClass {
    /// Smooth all round, with so many faces, not 4.
    Interior {
        /// How many faces and edges.
        valence: u32,
    },
    /// On a smooth boundary, or on one side of a crease.
    Boundary {
        /// How many faces, at least 3.
        faces: u32,
    },
    /// At a corner of a boundary, or between two sharp edges that form one.
    Corner {
        /// How many faces, at least 2.
        faces: u32,
        /// For which angle the cap is designed.
        angle: CornerAngle,
    },
    /// Where one crease ends: the fan is cut open along it, which is edge 0.
    Dart {
        /// How many faces, 4 among them.
        valence: u32,
    },
}

/// The angle that a corner's cap is designed for. The real one may be another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CornerAngle {
    /// 90 degrees.
    Convex,
    /// 270 degrees.
    Concave,
}

impl CornerAngle {
    /// In radians.
    pub fn radians(self) -> f64 {
        match self {
            CornerAngle::Convex => std::f64::consts::FRAC_PI_2,
            CornerAngle::Concave => 3.0 * std::f64::consts::FRAC_PI_2,
        }
    }
}

impl CapClass {
    /// How many sectors, one for each face.
    pub fn sectors(self) -> usize {
        let (CapClass::Interior { valence: faces }
        | CapClass::Boundary { faces }
        | CapClass::Corner { faces, .. }
        | CapClass::Dart { valence: faces }) = self;
        faces as usize
    }

    /// How many edges have points of their own.
    pub fn edges(self) -> usize {
        match self {
            CapClass::Interior { .. } | CapClass::Dart { .. } => self.sectors(),
            CapClass::Boundary { .. } | CapClass::Corner { .. } => self.sectors() + 1,
        }
    }

    /// How many points a cap is made of.
    pub fn columns(self) -> usize {
        1 + 2 * self.edges() + 4 * self.sectors()
    }
}
