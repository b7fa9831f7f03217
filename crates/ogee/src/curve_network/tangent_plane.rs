//! `TangentPlane`: the directions in which curves leave a meeting point, as angles in one plane, and the dummy ports that
//! wide sectors between them need.

use crate::math::Vec3;

/// The widest sector without a dummy port, in degrees.
const WIDEST_SECTOR: f64 = 150.0;

/// How wide a sector has to be above that, in degrees, to be more than rounding.
const SLACK: f64 = 1e-9;

/// Below this length the tangents do not span a plane, and the mesh's ring decides.
const FLAT: f64 = 1e-3;

/// Tangents at a meeting point, seen in their common plane.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentPlane {
    /// Unit normal.
    pub normal: Vec3,
    /// The largest angle of a tangent out of the plane, in degrees.
    pub deviation_deg: f64,
    /// The angle from tangent `j` to the next one, in degrees, counter-clockwise about the normal, in `[0, 360)`; 360 if
    /// there is only one.
    pub sectors_deg: Vec<f64>,
    /// What they add up to: 360, unless the tangents go round in another order than the edges they belong to.
    pub turn_deg: f64,
}

impl TangentPlane {
    /// The plane of tangents in the order of the mesh, counter-clockwise. `ring_normal` points to the outer side of the
    /// mesh and need not be a unit vector; `wanted` is a normal given by the user. `None` if there is no tangent, or one
    /// without a direction.
    pub fn new(tangents: &[Vec3], ring_normal: Vec3, wanted: Option<Vec3>) -> Option<TangentPlane> {
        let units: Vec<Vec3> = tangents.iter().map(|t| t.normalized()).collect::<Option<_>>()?;
        let first = *units.first()?;
        let normal = match wanted.and_then(Vec3::normalized) {
            Some(normal) => normal,
            None => spanned(&units, ring_normal).unwrap_or_else(|| perpendicular(ring_normal, first)),
        };
        let deviation = |t: &Vec3| normal.dot(*t).clamp(-1.0, 1.0).asin().abs().to_degrees();
        let deviation_deg = units.iter().map(deviation).fold(0.0, f64::max);
        let angle = |from: Vec3, to: Vec3| {
            let (from, to) = (from - normal.dot(from) * normal, to - normal.dot(to) * normal);
            let angle = normal.dot(from.cross(to)).atan2(from.dot(to)).to_degrees().rem_euclid(360.0);
            // The same direction, whatever rounding says.
            if angle > 360.0 - SLACK { 0.0 } else { angle }
        };
        let next = units.iter().cycle().skip(1);
        let mut sectors_deg: Vec<f64> = units.iter().zip(next).map(|(&from, &to)| angle(from, to)).collect();
        if let Some(last) = sectors_deg.last_mut().filter(|_| units.iter().all(|&t| angle(first, t) == 0.0)) {
            *last = 360.0;
        }
        Some(TangentPlane { normal, deviation_deg, turn_deg: sectors_deg.iter().sum(), sectors_deg })
    }

    /// Number of dummy ports to put into each sector, so that none is wider than 150 degrees: a single curve gets one,
    /// opposite; two that leave nearly opposite get none.
    pub fn dummies(&self) -> Vec<usize> {
        match self.sectors_deg[..] {
            [_] => vec![1],
            [one, other] if one > WIDEST_SECTOR && other > WIDEST_SECTOR => vec![0, 0],
            _ => {
                let count = |sector: &f64| ((sector - SLACK) / WIDEST_SECTOR).ceil().max(1.0) as usize - 1;
                self.sectors_deg.iter().map(count).collect()
            }
        }
    }

    /// The tangents with those of the dummy ports between them: evenly spaced directions in the plane, lengths in
    /// geometric progression. With each the number of the tangent it was, `None` for dummies.
    pub fn ports(&self, tangents: &[Vec3]) -> Vec<(Vec3, Option<usize>)> {
        let mut ports = Vec::new();
        for (j, &tangent) in tangents.iter().enumerate() {
            let dummies = self.dummies()[j];
            ports.push((tangent, Some(j)));
            let ratio = tangents[(j + 1) % tangents.len()].length() / tangent.length();
            let Some(flat) = (tangent - self.normal.dot(tangent) * self.normal).normalized() else {
                continue;
            };
            let aside = self.normal.cross(flat);
            ports.extend((1..=dummies).map(|k| {
                let share = k as f64 / (dummies + 1) as f64;
                let angle = (share * self.sectors_deg[j]).to_radians();
                let length = tangent.length() * ratio.powf(share);
                (length * (angle.cos() * flat + angle.sin() * aside), None)
            }));
        }
        ports
    }

    /// A tangent turned into the plane, of the same length, and by how many degrees it turned; `None` if it stands
    /// upright. This changes the curve.
    pub fn flatten(&self, tangent: Vec3) -> Option<(Vec3, f64)> {
        let flat = (tangent - self.normal.dot(tangent) * self.normal).normalized()?;
        Some((tangent.length() * flat, tangent.angle(flat).to_degrees()))
    }
}

/// The unit normal that two tangents or more have of their own.
fn spanned(units: &[Vec3], ring_normal: Vec3) -> Option<Vec3> {
    let sum = match *units {
        [_] => return None,
        [a, b] if a.cross(b).dot(ring_normal) < 0.0 => b.cross(a),
        [a, b] => a.cross(b),
        _ => {
            let next = units.iter().cycle().skip(1);
            units.iter().zip(next).fold(Vec3::ZERO, |sum, (a, b)| sum + a.cross(*b))
        }
    };
    sum.normalized().filter(|_| sum.length() >= FLAT)
}

/// The part of a vector perpendicular to a unit one, as a unit vector; any if there is none.
fn perpendicular(v: Vec3, unit: Vec3) -> Vec3 {
    let axes = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    let candidates = v.normalized().into_iter().chain(axes);
    candidates
        .map(|v| v - unit.dot(v) * unit)
        .find(|v| v.length() > FLAT)
        .and_then(Vec3::normalized)
        .unwrap_or(Vec3::new(0.0, 0.0, 1.0))
}

/// The kink of a curve that goes through a meeting point, in degrees: 0 if its two tangents, both leaving the point, are
/// opposite. `None` if one has no direction.
pub fn kink(one: Vec3, other: Vec3) -> Option<f64> {
    Some(one.normalized()?.angle(-other.normalized()?).to_degrees())
}

/// The two tangents of a curve that goes through a meeting point made opposite, each of its own length: parallel to half
/// their difference. `None` if they are equal. This changes the curve.
pub fn straighten(one: Vec3, other: Vec3) -> Option<[Vec3; 2]> {
    let along = (one - other).normalized()?;
    Some([one.length() * along, -other.length() * along])
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: Vec3 = Vec3::new(0.0, 0.0, 1.0);

    fn at(degrees: f64) -> Vec3 {
        let angle = degrees.to_radians();
        Vec3::new(angle.cos(), angle.sin(), 0.0)
    }

    fn plane(degrees: &[f64]) -> TangentPlane {
        let tangents: Vec<Vec3> = degrees.iter().map(|&a| at(a)).collect();
        TangentPlane::new(&tangents, UP, None).unwrap()
    }

    #[test]
    fn dummies_make_every_sector_narrow() {
        assert_eq!(plane(&[10.0]).dummies(), [1]);
        assert_eq!(plane(&[0.0, 180.0]).dummies(), [0, 0]);
        assert_eq!(plane(&[0.0, 155.0]).dummies(), [0, 0]);
        assert_eq!(plane(&[0.0, 90.0]).dummies(), [0, 1]);
        assert_eq!(plane(&[90.0, 0.0]).dummies(), [1, 0]);
        assert_eq!(plane(&[0.0, 10.0, 20.0]).dummies(), [0, 0, 2]);
        assert_eq!(plane(&[0.0, 150.0, 210.0]).dummies(), [0, 0, 0]);
        assert_eq!(plane(&[0.0, 0.0]).dummies(), [0, 2]);
    }

    #[test]
    fn dummies_stand_evenly_between_their_neighbours() {
        let tangents = [at(0.0), 8.0 * at(15.0), at(30.0)];
        let plane = TangentPlane::new(&tangents, UP, None).unwrap();
        let ports = plane.ports(&tangents);
        assert_eq!(
            ports.iter().map(|port| port.1).collect::<Vec<_>>(),
            [Some(0), Some(1), Some(2), None, None]
        );
        assert!(ports[3].0.distance(at(140.0)) < 1e-14 && ports[4].0.distance(at(250.0)) < 1e-14);
        let tangents = [at(0.0), 8.0 * at(90.0)];
        let ports = TangentPlane::new(&tangents, UP, None).unwrap().ports(&tangents);
        assert!(ports[2].0.distance(8.0_f64.sqrt() * at(225.0)) < 1e-14);
        let ports = TangentPlane::new(&tangents[..1], UP, None).unwrap().ports(&tangents[..1]);
        assert!(ports[1].0.distance(at(180.0)) < 1e-15);
    }

    #[test]
    fn order_and_deviation_are_seen() {
        assert!((plane(&[0.0, 100.0, 200.0, 300.0]).turn_deg - 360.0).abs() < 1e-12);
        assert!((plane(&[0.0, 200.0, 100.0, 300.0, 310.0, 320.0]).turn_deg - 360.0).abs() > 100.0);
        let cube = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), UP];
        let corner = TangentPlane::new(&cube, UP, None).unwrap();
        assert!((corner.deviation_deg - 35.26438968275466).abs() < 1e-12);
    }

    #[test]
    fn one_direction_alone_gets_a_plane_from_the_ring() {
        let plane = TangentPlane::new(&[Vec3::new(1.0, 0.0, 1.0)], UP, None).unwrap();
        let half = 0.5_f64.sqrt();
        assert!(plane.normal.distance(Vec3::new(-half, 0.0, half)) < 1e-15);
        for ring_normal in [Vec3::ZERO, at(0.0)] {
            let plane = TangentPlane::new(&[at(0.0), at(180.0)], ring_normal, None).unwrap();
            assert!(plane.normal.dot(at(0.0)).abs() < 1e-15 && (plane.normal.length() - 1.0).abs() < 1e-15);
        }
        assert!(TangentPlane::new(&[at(0.0), Vec3::ZERO], UP, None).is_none());
        assert!(TangentPlane::new(&[], UP, None).is_none());
    }

    #[test]
    fn kinks_are_straightened() {
        let (one, other) = (2.0 * at(10.0), at(150.0));
        assert!((kink(one, other).unwrap() - 40.0).abs() < 1e-12);
        let [one, other] = straighten(one, other).unwrap();
        assert!(kink(one, other).unwrap() < 1e-12);
        assert!((one.length() - 2.0).abs() < 1e-15 && (other.length() - 1.0).abs() < 1e-15);
        assert!(straighten(at(0.0), at(0.0)).is_none());
    }

    #[test]
    fn tangents_are_flattened() {
        let plane = plane(&[0.0, 120.0, 240.0]);
        let (flat, angle) = plane.flatten(Vec3::new(3.0, 0.0, 4.0)).unwrap();
        assert!(flat.distance(Vec3::new(5.0, 0.0, 0.0)) < 1e-14);
        assert!((angle - (4.0_f64 / 5.0).asin().to_degrees()).abs() < 1e-12);
        assert!(plane.flatten(UP).is_none());
    }
}
