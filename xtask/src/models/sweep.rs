//! Tubes of four sides: handles, loops, branches.

use ogee::Vec3;

use super::builder::Builder;

/// One station of a tube: its middle, half its width, half its thickness.
pub(super) type Station = (Vec3, f64, f64);

/// Leads a tube in the plane across `side` from one four-sided opening through all stations to another. At
/// `start` the ring begins with its two vertices on the inside of the bend, first the one away from `side`;
/// `end` lists the vertices that these four arrive at.
pub(super) fn tube(b: &mut Builder, start: &[u32], stations: &[Station], end: &[u32], side: Vec3) {
    let mut middles = vec![b.centre(start)];
    middles.extend(stations.iter().map(|station| station.0));
    middles.push(b.centre(end));
    let mut rings = vec![start.to_vec()];
    for (k, &(middle, wide, thick)) in stations.iter().enumerate() {
        let ahead = (middles[k + 2] - middles[k]).normalized().unwrap_or(Vec3::ZERO);
        let (inner, right) = (ahead.cross(side) * -thick, side * wide);
        rings.push(b.points([
            middle + inner - right,
            middle + inner + right,
            middle - inner + right,
            middle - inner - right,
        ]));
    }
    rings.push(end.to_vec());
    b.loft(&rings);
}
