//! JSON text to raw values: the keys of a cage, and everything else counted as unknown.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// Keys of a network of curves that stands in the same file.
const OF_NETWORKS: [&str; 5] = ["curves", "options", "meeting", "points", "loops"];

/// The values of the keys, as the file gives them.
#[derive(Default)]
pub(super) struct RawCage {
    pub(super) vertices: Option<Vec<Numbers<3>>>,
    pub(super) faces: Option<Vec<Vec<i64>>>,
    pub(super) creases: Option<Vec<RawCrease>>,
    pub(super) corners: Option<Vec<RawCorner>>,
    pub(super) holes: Option<Vec<i64>>,
    pub(super) boundary: Option<String>,
    pub(super) creasing: Option<String>,
    pub(super) uvs: Option<Vec<Numbers<2>>>,
    pub(super) face_uvs: Option<Vec<Vec<i64>>>,
    pub(super) face_varying: Option<String>,
    pub(super) meetings: Option<Vec<RawMeeting>>,
    pub(super) lens: Option<RawLens>,
    pub(super) unknown: Vec<String>,
}

#[derive(Deserialize)]
pub(super) struct RawCrease {
    pub(super) vertices: [i64; 2],
    pub(super) sharpness: RawSharpness,
}

#[derive(Deserialize)]
pub(super) struct RawCorner {
    pub(super) vertex: i64,
    pub(super) sharpness: RawSharpness,
}

#[derive(Deserialize)]
pub(super) struct RawMeeting {
    pub(super) vertex: i64,
    pub(super) ports: Vec<i64>,
    pub(super) t: f64,
}

/// The shape of the rule at vertices of valence 2; what is left out is as usual.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawLens {
    pub(super) beta: Option<f64>,
    pub(super) gamma: Option<f64>,
}

/// A number, or the word `infinite` as infinity.
pub(super) struct RawSharpness(pub(super) f64);

/// The first `N` of a list of numbers, and how many there are.
pub(super) struct Numbers<const N: usize> {
    pub(super) values: [f64; N],
    pub(super) count: usize,
}

impl<'de> Deserialize<'de> for RawCage {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<RawCage, D::Error> {
        struct Keys;
        impl<'de> Visitor<'de> for Keys {
            type Value = RawCage;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object with the keys of a cage")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<RawCage, M::Error> {
                let mut cage = RawCage::default();
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "vertices" => once(&mut cage.vertices, &mut map, "vertices")?,
                        "faces" => once(&mut cage.faces, &mut map, "faces")?,
                        "creases" => once(&mut cage.creases, &mut map, "creases")?,
                        "corners" => once(&mut cage.corners, &mut map, "corners")?,
                        "holes" => once(&mut cage.holes, &mut map, "holes")?,
                        "boundary" => once(&mut cage.boundary, &mut map, "boundary")?,
                        "creasing" => once(&mut cage.creasing, &mut map, "creasing")?,
                        "uvs" => once(&mut cage.uvs, &mut map, "uvs")?,
                        "face_uvs" => once(&mut cage.face_uvs, &mut map, "face_uvs")?,
                        "face_varying" => once(&mut cage.face_varying, &mut map, "face_varying")?,
                        "meetings" => once(&mut cage.meetings, &mut map, "meetings")?,
                        "lens" => once(&mut cage.lens, &mut map, "lens")?,
                        _ => {
                            map.next_value::<IgnoredAny>()?;
                            if !OF_NETWORKS.contains(&key.as_str()) {
                                cage.unknown.push(key);
                            }
                        }
                    }
                }
                Ok(cage)
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

/// Reads the value of a key that may stand once; `null` is the same as no key.
pub(crate) fn once<'de, T: Deserialize<'de>, M: MapAccess<'de>>(
    slot: &mut Option<T>,
    map: &mut M,
    key: &'static str,
) -> Result<(), M::Error> {
    if slot.is_some() {
        return Err(M::Error::duplicate_field(key));
    }
    *slot = map.next_value()?;
    Ok(())
}

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Numbers<N>, D::Error> {
        struct List<const N: usize>;
        impl<'de, const N: usize> Visitor<'de> for List<N> {
            type Value = Numbers<N>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of {N} numbers")
            }

            fn visit_seq<S: SeqAccess<'de>>(self, mut list: S) -> Result<Numbers<N>, S::Error> {
                let mut numbers = Numbers { values: [0.0; N], count: 0 };
                while let Some(value) = list.next_element()? {
                    if let Some(slot) = numbers.values.get_mut(numbers.count) {
                        *slot = value;
                    }
                    numbers.count += 1;
                }
                Ok(numbers)
            }
        }
        deserializer.deserialize_seq(List)
    }
}

impl<'de> Deserialize<'de> for RawSharpness {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<RawSharpness, D::Error> {
        struct Value;
        impl Visitor<'_> for Value {
            type Value = RawSharpness;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or \"infinite\"")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<RawSharpness, E> {
                Ok(RawSharpness(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<RawSharpness, E> {
                Ok(RawSharpness(value as f64))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<RawSharpness, E> {
                Ok(RawSharpness(value as f64))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<RawSharpness, E> {
                match value {
                    "infinite" => Ok(RawSharpness(f64::INFINITY)),
                    _ => Err(E::invalid_value(serde::de::Unexpected::Str(value), &self)),
                }
            }
        }
        deserializer.deserialize_any(Value)
    }
}
