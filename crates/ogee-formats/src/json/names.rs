//! What the rules of the scheme are called in JSON.

use ogee::{Boundary, Creasing, FaceVaryingRule};

pub(super) const BOUNDARIES: [(&str, Boundary); 3] = [
    ("edge-and-corner", Boundary::EdgeAndCorner),
    ("edge-only", Boundary::EdgeOnly),
    ("none", Boundary::None),
];

pub(super) const CREASINGS: [(&str, Creasing); 2] =
    [("uniform", Creasing::Uniform), ("chaikin", Creasing::Chaikin)];

pub(super) const FACE_VARYING_RULES: [(&str, FaceVaryingRule); 6] = [
    ("none", FaceVaryingRule::None),
    ("corners-only", FaceVaryingRule::CornersOnly),
    ("corners-plus1", FaceVaryingRule::CornersPlus1),
    ("corners-plus2", FaceVaryingRule::CornersPlus2),
    ("boundaries", FaceVaryingRule::Boundaries),
    ("all", FaceVaryingRule::All),
];

/// The rule of that name, or all names.
pub(super) fn rule<T: Copy>(names: &[(&str, T)], name: &str) -> Result<T, String> {
    names.iter().find(|(known, _)| *known == name).map(|(_, rule)| *rule).ok_or_else(|| {
        let known: Vec<&str> = names.iter().map(|(known, _)| *known).collect();
        known.join(", ")
    })
}

/// The name of a rule.
pub(super) fn name<T: PartialEq>(names: &[(&'static str, T)], rule: &T) -> &'static str {
    names.iter().find(|(_, known)| known == rule).map_or("", |(name, _)| name)
}
