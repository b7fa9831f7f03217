//! Placing an X-configuration: plane, ports, parameter and ring at one meeting point.

use super::fold::least_turn;
use super::network::{MeetingOptions, Placing};
use super::tangent_plane::{TangentPlane, kink};
use super::warning::NetworkWarning;
use super::x_configuration::{XRing, default_parameter};
use crate::math::Vec3;

/// Angles below this are no fault, in degrees.
const ANGLE_TOLERANCE: f64 = 0.1;

/// The least turn that a parameter passes with.
const MARGIN: f64 = 0.02;

/// Of the longest tangent, how far mirror images may be off.
const SYMMETRIC: f64 = 1e-9;

/// Sines below this are zero.
const ROUNDING: f64 = 1e-12;

/// What is tried when the default parameter folds the surface.
const PARAMETERS: [f64; 8] = [0.3, 0.25, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03];

/// A curve that leaves a meeting point.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// First leg of the control polygon, away from the point.
    pub tangent: Vec3,
    /// The curve's name: two arrivals of one name are one curve that goes through.
    pub curve: String,
}

/// A meeting point about to be placed.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// Its vertex, for warnings.
    pub vertex: u32,
    /// The curves, in the order of their edges around the vertex, counter-clockwise.
    pub arrivals: Vec<Arrival>,
    /// Normal of the mesh there; need not be a unit vector.
    pub ring_normal: Vec3,
    /// The neighbours in the mesh relative to the vertex, counter-clockwise; only for
    /// [`NetworkOptions::fit_mesh`](super::NetworkOptions::fit_mesh), and may be left out without it.
    pub spokes: Vec<Vec3>,
    /// What the user wants; what is `None` has its default.
    pub options: MeetingOptions,
}

/// An X-configuration with its place in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Where ports, free spokes and corners are, relative to the centre. [`Placing::Keep`] keeps those of the mesh and
    /// needs of this only the directions of dummy ports.
    pub ring: XRing,
    /// Parameter of the rules.
    pub parameter: f64,
    /// Unit normal of the plane of the tangents.
    pub normal: Vec3,
    /// Of each port the arrival that takes it; `None` for dummies.
    pub ports: Vec<Option<usize>>,
    /// The smallest sine of the fold test; positive where the surface does not fold.
    pub least_turn: f64,
    /// What is not as it should be.
    pub warnings: Vec<NetworkWarning>,
}

/// Places an X-configuration (Abbas and Nasri 2004; the eigen configuration unless something else is wanted). `None` if a
/// tangent has no length, or there is none.
///
/// The parameter is the default one of the number of ports; where that folds the surface, the first of a list of lower ones
/// that does not. The fold test looks at the tangents alone, whatever the ring.
pub fn place(site: &Site) -> Option<Placement> {
    let tangents: Vec<Vec3> = site.arrivals.iter().map(|arrival| arrival.tangent).collect();
    let options = &site.options;
    let plane = TangentPlane::new(&tangents, site.ring_normal, options.normal)?;
    let (mut tangents, ports): (Vec<Vec3>, Vec<Option<usize>>) = plane.ports(&tangents).into_iter().unzip();
    let mut aside = plane.normal;
    if options.fit_mesh == Some(true) {
        let reach = |direction| reach(&site.spokes, plane.normal, direction);
        for (tangent, _) in tangents.iter_mut().zip(&ports).filter(|(_, port)| port.is_none()) {
            *tangent = reach(*tangent).unwrap_or(1.0) * *tangent;
        }
        if let [first, second] = tangents[..] {
            let free = plane.normal.cross(first - second) / 2.0;
            let both = reach(free).zip(reach(-free)).map_or(1.0, |(one, other)| (one + other) / 2.0);
            aside = both * aside;
        }
    }
    let (parameter, least_turn) = choose_parameter(&tangents, plane.normal, options.parameter);
    let mut ring = match options.placing.unwrap_or_default() {
        Placing::Eigen | Placing::Keep => XRing::eigen(&tangents, parameter, aside),
        Placing::Parallelogram => XRing::parallelogram(&tangents, 1.0, plane.normal),
        Placing::Symmetric => XRing::symmetric(&tangents, parameter, aside),
    };
    let mut warnings = warnings(site, &plane, parameter, ports.len(), least_turn);
    let longest = tangents.iter().fold(0.0_f64, |longest, tangent| longest.max(tangent.length()));
    let distance = ring.asymmetry();
    if options.placing == Some(Placing::Symmetric) && distance > SYMMETRIC * longest {
        warnings.push(NetworkWarning::NotSymmetric { vertex: site.vertex, distance });
    }
    ring.crown(options.crown * plane.normal);
    Some(Placement { ring, parameter, normal: plane.normal, ports, least_turn, warnings })
}

/// How far the polygon of the neighbours reaches in a direction, seen along the normal: times the direction's length. `None` if
/// they do not surround the point.
fn reach(spokes: &[Vec3], normal: Vec3, direction: Vec3) -> Option<f64> {
    let aside = normal.cross(direction);
    let flat: Vec<[f64; 2]> = spokes.iter().map(|spoke| [spoke.dot(direction), spoke.dot(aside)]).collect();
    let next = flat.iter().cycle().skip(1);
    let crossings = flat.iter().zip(next).filter(|([_, before], [_, after])| *before <= 0.0 && *after > 0.0);
    let distances = crossings.map(|([x, y], [to_x, to_y])| x + (to_x - x) * y / (y - to_y));
    distances.filter(|&x| x > 0.0).map(|x| x / direction.dot(direction)).reduce(f64::max)
}

/// The parameter and its smallest sine.
fn choose_parameter(tangents: &[Vec3], normal: Vec3, wanted: Option<f64>) -> (f64, f64) {
    let turn = |t: f64| (t, least_turn(&XRing::eigen(tangents, t, normal), normal));
    let default = default_parameter(tangents.len());
    match wanted {
        Some(t) => turn(t),
        None if tangents.len() == 2 => turn(default),
        None => {
            let lower = PARAMETERS.into_iter().filter(|&t| t < default);
            let mut best = turn(default);
            for t in lower {
                if best.1 >= MARGIN {
                    break;
                }
                let next = turn(t);
                if next.1 > best.1 {
                    best = next;
                }
            }
            best
        }
    }
}

fn warnings(site: &Site, plane: &TangentPlane, t: f64, ports: usize, sine: f64) -> Vec<NetworkWarning> {
    let vertex = site.vertex;
    let mut warnings = Vec::new();
    if plane.deviation_deg > ANGLE_TOLERANCE {
        warnings.push(NetworkWarning::TangentsNotCoplanar { vertex, angle_deg: plane.deviation_deg });
    }
    if (plane.turn_deg - 360.0).abs() > ANGLE_TOLERANCE {
        warnings.push(NetworkWarning::TangentOrder { vertex, turn_deg: plane.turn_deg });
    }
    let degenerate = ports > 2 && t >= 0.5;
    // There the smallest sine is often zero, and its sign is rounding.
    if sine <= if degenerate { -ROUNDING } else { 0.0 } {
        warnings.push(NetworkWarning::XFold { vertex, sine });
    }
    if degenerate {
        warnings.push(NetworkWarning::THalf { vertex, ports, t });
    }
    for (j, one) in site.arrivals.iter().enumerate() {
        let other = site.arrivals[j + 1..].iter().find(|other| other.curve == one.curve);
        let angle = other.and_then(|other| kink(one.tangent, other.tangent));
        if let Some(angle_deg) = angle.filter(|&angle| angle > ANGLE_TOLERANCE) {
            warnings.push(NetworkWarning::CarryKink { vertex, curve: one.curve.clone(), angle_deg });
        }
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UP: Vec3 = Vec3::new(0.0, 0.0, 1.0);

    fn at(degrees: f64) -> Vec3 {
        let angle = degrees.to_radians();
        Vec3::new(angle.cos(), angle.sin(), 0.0)
    }

    fn site(tangents: impl IntoIterator<Item = Vec3>) -> Site {
        let arrivals = tangents
            .into_iter()
            .enumerate()
            .map(|(j, tangent)| Arrival { tangent, curve: format!("c{j}") })
            .collect();
        Site { vertex: 7, arrivals, ring_normal: UP, spokes: Vec::new(), options: MeetingOptions::default() }
    }

    fn codes(placement: &Placement) -> Vec<&'static str> {
        placement.warnings.iter().map(NetworkWarning::code).collect()
    }

    #[test]
    fn good_tangents_need_no_warning() {
        for count in 1..9 {
            let placement =
                place(&site((0..count).map(|j| at(360.0 * f64::from(j) / f64::from(count))))).unwrap();
            assert!(placement.warnings.is_empty(), "{:?}", placement.warnings);
            assert_eq!(placement.parameter, default_parameter(placement.ports.len()));
            assert!(placement.least_turn > 0.1);
        }
    }

    #[test]
    fn every_fault_of_tangents_is_told() {
        let mut lifted = [at(0.0), at(120.0), at(240.0)];
        lifted[0].z = 0.3;
        assert_eq!(codes(&place(&site(lifted)).unwrap()), ["W_TANGENTS_NOT_COPLANAR"]);
        let crossed = [0.0, 200.0, 100.0, 300.0, 310.0, 320.0].map(at);
        // Twice round: no turn is wrong, but the surface covers the plane twice.
        assert_eq!(codes(&place(&site(crossed)).unwrap()), ["W_TANGENT_ORDER"]);
        assert_eq!(codes(&place(&site([0.0, 0.0, 120.0, 240.0].map(at))).unwrap()), ["W_X_FOLD"]);
        let mut half = site([0.0, 120.0, 240.0].map(at));
        half.options.parameter = Some(0.5);
        assert!(codes(&place(&half).unwrap()).contains(&"W_T_HALF"));
        let mut through = site([0.0, 80.0, 170.0, 270.0].map(at));
        for j in [0, 2] {
            through.arrivals[j].curve = "through".to_owned();
        }
        let placement = place(&through).unwrap();
        assert_eq!(codes(&placement), ["W_CARRY_KINK"]);
        assert!((placement.warnings[0].value().unwrap() - 10.0).abs() < 1e-12);
        assert_eq!(placement.warnings[0].vertex(), 7);
        assert!(place(&site([Vec3::ZERO])).is_none());
    }

    #[test]
    fn the_crown_lifts_free_spokes_along_the_normal() {
        let mut lifted = site([0.0, 120.0, 240.0].map(at));
        let flat = place(&lifted).unwrap();
        lifted.options.crown = 0.5;
        let placement = place(&lifted).unwrap();
        for j in 0..3 {
            assert!(placement.ring.free_spoke(j).distance(flat.ring.free_spoke(j) + 0.5 * UP) < 1e-15);
            assert_eq!(placement.ring.port(j), flat.ring.port(j));
        }
    }

    #[test]
    fn what_curves_leave_open_reaches_as_far_as_the_mesh() {
        // A grid four times as long as wide; a curve that ends, one that goes on in another, and a T.
        let spokes = [(4.0, 0.0), (0.0, 1.0), (-4.0, 0.0), (0.0, -1.0)].map(|(x, y)| Vec3::new(x, y, 0.3));
        let lie = |tangents: &[Vec3], fit: bool| {
            let mut site = site(tangents.iter().copied());
            site.spokes = spokes.to_vec();
            site.options.fit_mesh = Some(fit);
            place(&site).unwrap()
        };
        let x = Vec3::new(4.0, 0.0, 0.0);
        for tangents in [&[x][..], &[x, -x]] {
            let [long, fit] = [false, true].map(|fit| lie(tangents, fit));
            assert!((long.ring.free_spoke(0).length() - 4.0).abs() < 1e-14);
            assert!((fit.ring.free_spoke(0).length() - 1.0).abs() < 1e-14);
            assert!(fit.ring.port(1).distance(-x) < 1e-14);
        }
        let t = lie(&[x, -x, Vec3::new(0.0, -1.0, 0.0)], true);
        assert_eq!(t.ports, [Some(0), None, Some(1), Some(2)]);
        assert!(t.ring.port(1).distance(Vec3::new(0.0, 1.0, 0.0)) < 1e-14);
        // Neighbours on one side only: lengths stay those of the curves.
        let mut half = site([x]);
        half.spokes = spokes[..2].to_vec();
        half.options.fit_mesh = Some(true);
        assert_eq!(place(&half).unwrap().ring.free_spoke(0).length(), 4.0);
    }

    /// Directions with gaps of at least 15 degrees, lengths from 1 to 5.
    fn spread() -> impl Strategy<Value = Vec<Vec3>> {
        prop::collection::vec((0.0..1.0, 1.0..5.0), 3..7).prop_map(|parts: Vec<(f64, f64)>| {
            let total: f64 = parts.iter().map(|part| part.0).sum::<f64>().max(1e-9);
            let room = 360.0 - 15.0 * parts.len() as f64;
            let mut angle = 0.0;
            let mut tangents = Vec::new();
            for (gap, length) in parts {
                tangents.push(length * at(angle));
                angle += 15.0 + room * gap / total;
            }
            tangents
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn a_parameter_without_folds_is_found(tangents in spread()) {
            let placement = place(&site(tangents)).unwrap();
            prop_assert!(placement.least_turn > 0.0, "{:?}", placement);
            prop_assert!(placement.warnings.is_empty());
        }
    }
}
