//! What was done at vertices of valence 2 and at poles, in reports.

use ogee::lens::{Method, TreatedLens};
use serde::Serialize;

/// A lens or a pole, for programs.
#[derive(Serialize)]
pub(crate) struct LensReport {
    vertex: u32,
    paired_with: Option<u32>,
    method: &'static str,
    reason: String,
}

impl LensReport {
    pub(crate) fn new(lens: &TreatedLens) -> LensReport {
        LensReport {
            vertex: lens.vertex.0,
            paired_with: lens.paired_with.map(|partner| partner.0),
            method: lens.method.name(),
            reason: lens.reason.clone(),
        }
    }

    /// What was done, and why.
    pub(crate) fn described(&self) -> String {
        let with = self.paired_with.map(|partner| format!(" with {partner}")).unwrap_or_default();
        format!("vertex {}{with}: {}, {}", self.vertex, self.method, self.reason)
    }
}

/// How many of them by what was done.
pub(crate) fn lens_counts(lenses: &[LensReport]) -> String {
    let count = |method: Method| lenses.iter().filter(|lens| lens.method == method.name()).count();
    let counts = Method::ALL.iter().map(|&method| (count(method), method)).filter(|(count, _)| *count > 0);
    let words = counts.map(|(count, method)| match method {
        Method::C1 => format!("{count} left as they are"),
        _ => format!("{count} by {}", method.name()),
    });
    words.collect::<Vec<_>>().join(", ")
}
