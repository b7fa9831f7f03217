//! Reading a network in JSON.

use std::collections::BTreeMap;
use std::fmt;

use ogee::Vec3;
use ogee::curve_network::{Crossing, MeetingOptions, NetworkOptions, Placing, PointConstraint, PreSplit};
use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, Visitor};

use super::{Draft, NetworkFile, Shape, finish};
use crate::error::{Fault, Faults, ReadError, Warning};
use crate::json::{once, syntax};
use crate::text::{check_is_text, without_mark};

/// Keys of a cage that may stand in the same file, and of the golden networks.
const PASSED_OVER: [&str; 12] = [
    "creases",
    "corners",
    "holes",
    "boundary",
    "creasing",
    "uvs",
    "face_uvs",
    "face_varying",
    "meetings",
    "lens",
    "name",
    "description",
];

/// The values of the keys, as the file gives them.
#[derive(Default)]
struct RawNetwork {
    vertices: Option<Vec<[f64; 3]>>,
    faces: Option<Vec<IgnoredAny>>,
    loops: Option<Vec<Vec<u32>>>,
    curves: Option<Vec<RawCurve>>,
    options: Option<RawOptions>,
    meeting: Option<BTreeMap<String, RawMeeting>>,
    points: Option<Vec<RawPoint>>,
    unknown: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCurve {
    name: Option<String>,
    vertices: Vec<i64>,
    #[serde(default)]
    closed: bool,
    control: Option<Vec<[f64; 3]>>,
    through: Option<Vec<[f64; 3]>>,
    #[serde(default)]
    refit: bool,
    #[serde(default)]
    normals: Vec<Option<[f64; 3]>>,
    #[serde(default)]
    cross_curvatures: Vec<Option<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawOptions {
    scheme: Option<RawScheme>,
    x_mode: Option<RawPlacing>,
    t: Option<f64>,
    pre_split: Option<RawPreSplit>,
    crossing: Option<RawCrossing>,
    force_ribbons: Option<bool>,
    theta: Option<f64>,
    repair: Option<bool>,
    flatten: Option<bool>,
    straighten: Option<bool>,
    fit_mesh: Option<bool>,
    fair: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMeeting {
    mode: Option<RawPlacing>,
    t: Option<f64>,
    normal: Option<[f64; 3]>,
    crown: Option<f64>,
    flatten: Option<bool>,
    straighten: Option<bool>,
    fit_mesh: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPoint {
    vertex: u32,
    position: Option<[f64; 3]>,
    normal: Option<[f64; 3]>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum RawScheme {
    #[serde(rename = "abbas-nasri-2004")]
    AbbasNasri2004,
    Generalised,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum RawPlacing {
    Eigen,
    Parallelogram,
    Symmetric,
    Keep,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum RawCrossing {
    Pin,
    Smooth,
}

/// A number, or the word `auto`.
struct RawPreSplit(PreSplit);

impl From<RawPlacing> for Placing {
    fn from(raw: RawPlacing) -> Placing {
        match raw {
            RawPlacing::Eigen => Placing::Eigen,
            RawPlacing::Parallelogram => Placing::Parallelogram,
            RawPlacing::Symmetric => Placing::Symmetric,
            RawPlacing::Keep => Placing::Keep,
        }
    }
}

/// Reads a network.
pub(super) fn read(bytes: &[u8]) -> Result<NetworkFile, ReadError> {
    check_is_text(bytes, "JSON")?;
    let raw: RawNetwork =
        serde_json::from_slice(without_mark(bytes)).map_err(|error| ReadError::single(syntax(&error)))?;
    let mut faults = Faults::default();
    let mut file = NetworkFile::default();
    for key in raw.unknown {
        let message = format!("unknown key \"{}\", passed over", key.escape_debug());
        file.warnings.push(Warning { line: None, code: "unknown_key", message });
    }
    file.points = vectors(raw.vertices.unwrap_or_default());
    file.has_faces = raw.faces.is_some_and(|faces| !faces.is_empty());
    file.loops = raw.loops.unwrap_or_default();
    for (number, curve) in raw.curves.unwrap_or_default().into_iter().enumerate() {
        let outcome = draft(number, curve).and_then(finish);
        match outcome {
            Ok((curve, warning)) => {
                file.network.curves.push(curve);
                file.warnings.extend(warning);
            }
            Err(fault) => faults.push(fault),
        }
    }
    if let Some(raw) = raw.options {
        file.network.options = options(&raw).map_err(ReadError::single)?;
    }
    for (key, raw) in raw.meeting.unwrap_or_default() {
        let Ok(vertex) = key.parse() else {
            let message = format!("\"meeting\" has a key \"{}\", which is no vertex", key.escape_debug());
            faults.push(Fault::new("bad_curve", message));
            continue;
        };
        file.network.meetings.insert(vertex, meeting(&raw));
    }
    let points = raw.points.unwrap_or_default().into_iter().map(|raw| PointConstraint {
        vertex: raw.vertex,
        position: raw.position.map(Vec3::from),
        normal: raw.normal.map(Vec3::from),
    });
    file.network.points = points.collect();
    faults.into_result()?;
    Ok(file)
}

fn draft(number: usize, raw: RawCurve) -> Result<Draft, Fault> {
    let name = raw.name.unwrap_or_else(|| format!("curve{}", number + 1));
    let wrong = |message: String| Fault::new("bad_curve", format!("curve {name}: {message}"));
    let vertex = |&v: &i64| u32::try_from(v).map_err(|_| wrong(format!("{v} is no vertex")));
    let vertices = raw.vertices.iter().map(vertex).collect::<Result<_, Fault>>()?;
    let shape = match (raw.control, raw.through) {
        (None, None) => Shape::Vertices,
        (None, Some(points)) => Shape::Through(vectors(points)),
        (Some(control), None) if raw.refit => Shape::Refit(vectors(control)),
        (Some(control), None) => Shape::Control(vectors(control)),
        (Some(_), Some(_)) => {
            return Err(wrong("it has \"control\" and \"through\"; give one of them".into()));
        }
    };
    let normals = raw.normals.into_iter().map(|normal| normal.map(Vec3::from)).collect();
    let cross_curvatures = raw.cross_curvatures;
    Ok(Draft { vertices, closed: raw.closed, shape, normals, cross_curvatures, ..Draft::new(None, name) })
}

fn options(raw: &RawOptions) -> Result<NetworkOptions, Fault> {
    let usual = match (raw.scheme, raw.t) {
        (None, _) => NetworkOptions::default(),
        (Some(RawScheme::Generalised), _) => NetworkOptions::generalised(),
        (Some(RawScheme::AbbasNasri2004), Some(t)) => NetworkOptions::abbas_nasri_2004(t),
        (Some(RawScheme::AbbasNasri2004), None) => {
            return Err(Fault::new("bad_curve", "the scheme of 2004 has a parameter: give \"t\""));
        }
    };
    Ok(NetworkOptions {
        placing: raw.x_mode.map_or(usual.placing, Placing::from),
        parameter: raw.t.or(usual.parameter),
        pre_split: raw.pre_split.as_ref().map_or(usual.pre_split, |pre_split| pre_split.0),
        crossing: match raw.crossing {
            Some(RawCrossing::Pin) => Crossing::Pin,
            Some(RawCrossing::Smooth) => Crossing::Smooth,
            None => usual.crossing,
        },
        force_ribbons: raw.force_ribbons.unwrap_or(usual.force_ribbons),
        ribbon_width: raw.theta.unwrap_or(usual.ribbon_width),
        repair: raw.repair.unwrap_or(usual.repair),
        flatten: raw.flatten.unwrap_or(usual.flatten),
        straighten: raw.straighten.unwrap_or(usual.straighten),
        fit_mesh: raw.fit_mesh.unwrap_or(usual.fit_mesh),
        fair: raw.fair.unwrap_or(usual.fair),
    })
}

fn meeting(raw: &RawMeeting) -> MeetingOptions {
    MeetingOptions {
        placing: raw.mode.map(Placing::from),
        parameter: raw.t,
        normal: raw.normal.map(Vec3::from),
        crown: raw.crown.unwrap_or(0.0),
        flatten: raw.flatten,
        straighten: raw.straighten,
        fit_mesh: raw.fit_mesh,
    }
}

fn vectors(points: Vec<[f64; 3]>) -> Vec<Vec3> {
    points.into_iter().map(Vec3::from).collect()
}

impl<'de> Deserialize<'de> for RawNetwork {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<RawNetwork, D::Error> {
        struct Keys;
        impl<'de> Visitor<'de> for Keys {
            type Value = RawNetwork;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object with the keys of a network of curves")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<RawNetwork, M::Error> {
                let mut network = RawNetwork::default();
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "vertices" => once(&mut network.vertices, &mut map, "vertices")?,
                        "faces" => once(&mut network.faces, &mut map, "faces")?,
                        "loops" => once(&mut network.loops, &mut map, "loops")?,
                        "curves" => once(&mut network.curves, &mut map, "curves")?,
                        "options" => once(&mut network.options, &mut map, "options")?,
                        "points" => once(&mut network.points, &mut map, "points")?,
                        "meeting" => once(&mut network.meeting, &mut map, "meeting")?,
                        _ => {
                            map.next_value::<IgnoredAny>()?;
                            if !PASSED_OVER.contains(&key.as_str()) {
                                network.unknown.push(key);
                            }
                        }
                    }
                }
                Ok(network)
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

impl<'de> Deserialize<'de> for RawPreSplit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<RawPreSplit, D::Error> {
        struct Value;
        impl Visitor<'_> for Value {
            type Value = RawPreSplit;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number of splits or \"auto\"")
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<RawPreSplit, E> {
                let splits = u32::try_from(value).map_err(|_| E::custom("too many splits"))?;
                Ok(RawPreSplit(PreSplit::Fixed(splits)))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<RawPreSplit, E> {
                match value {
                    "auto" => Ok(RawPreSplit(PreSplit::Auto)),
                    _ => Err(E::invalid_value(serde::de::Unexpected::Str(value), &self)),
                }
            }
        }
        deserializer.deserialize_any(Value)
    }
}
