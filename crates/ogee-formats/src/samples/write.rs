//! Writing samples, row after row. Numbers have the fewest digits that read back as the same number.

use std::io::{self, Write};

use ogee::{Derivatives, Vec3};

use super::{ADDRESS, Address, SampleFormat};

/// A point of a surface. What does not exist there is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Which point.
    pub address: Address,
    /// Position.
    pub position: Option<Vec3>,
    /// Derivative along `u`.
    pub du: Option<Vec3>,
    /// Derivative along `v`.
    pub dv: Option<Vec3>,
    /// Second derivative along `u`.
    pub duu: Option<Vec3>,
    /// Mixed derivative.
    pub duv: Option<Vec3>,
    /// Second derivative along `v`.
    pub dvv: Option<Vec3>,
    /// Unit normal.
    pub normal: Option<Vec3>,
    /// The larger principal curvature.
    pub k1: Option<f64>,
    /// The smaller principal curvature.
    pub k2: Option<f64>,
}

/// The fields that are vectors, and which derivatives they come with.
const VECTORS: [(&str, Derivatives); 7] = [
    ("position", Derivatives::None),
    ("du", Derivatives::First),
    ("dv", Derivatives::First),
    ("duu", Derivatives::Second),
    ("duv", Derivatives::Second),
    ("dvv", Derivatives::Second),
    ("normal", Derivatives::First),
];

/// The fields that are numbers; they come with second derivatives.
const CURVATURES: [&str; 2] = ["k1", "k2"];

const AXES: [&str; 3] = ["x", "y", "z"];

/// Writes what stands above the samples: in CSV the names of the columns, in JSON lines nothing.
///
/// # Errors
/// Those of `out`.
pub fn write_header(format: SampleFormat, what: Derivatives, mut out: impl Write) -> io::Result<()> {
    if format == SampleFormat::JsonLines {
        return Ok(());
    }
    out.write_all(ADDRESS.join(",").as_bytes())?;
    for (name, _) in VECTORS.iter().filter(|(_, with)| *with <= what) {
        for axis in AXES {
            match *name {
                "position" => write!(out, ",{axis}")?,
                name => write!(out, ",{name}_{axis}")?,
            }
        }
    }
    for name in CURVATURES.iter().filter(|_| what == Derivatives::Second) {
        write!(out, ",{name}")?;
    }
    out.write_all(b"\n")
}

/// Writes one sample, as far as derivatives were asked for. What is not there, or no finite number, is `null` in JSON
/// and empty in CSV.
///
/// # Errors
/// Those of `out`.
pub fn write_sample(
    sample: &Sample,
    format: SampleFormat,
    what: Derivatives,
    mut out: impl Write,
) -> io::Result<()> {
    let out = &mut out;
    let Sample { address, position, du, dv, duu, duv, dvv, normal, k1, k2 } = *sample;
    let vectors = VECTORS.iter().zip([position, du, dv, duu, duv, dvv, normal]);
    let vectors = vectors.filter(|((_, with), _)| *with <= what);
    let vectors = vectors.map(|((name, _), vector)| (name, vector.filter(|vector| vector.is_finite())));
    let curvatures = CURVATURES.iter().zip([k1, k2]).filter(|_| what == Derivatives::Second);
    let curvatures = curvatures.map(|(name, k)| (name, k.filter(|k| k.is_finite())));
    match format {
        SampleFormat::JsonLines => {
            write!(out, "{{\"face\":{},\"corner\":", address.face)?;
            match address.corner {
                Some(corner) => write!(out, "{corner}")?,
                None => out.write_all(b"null")?,
            }
            out.write_all(b",\"u\":")?;
            number(address.u, out)?;
            out.write_all(b",\"v\":")?;
            number(address.v, out)?;
            for (name, vector) in vectors {
                write!(out, ",\"{name}\":")?;
                let Some(Vec3 { x, y, z }) = vector else {
                    out.write_all(b"null")?;
                    continue;
                };
                for (before, coordinate) in [(b"[", x), (b",", y), (b",", z)] {
                    out.write_all(before)?;
                    number(coordinate, out)?;
                }
                out.write_all(b"]")?;
            }
            for (name, k) in curvatures {
                write!(out, ",\"{name}\":")?;
                match k {
                    Some(k) => number(k, out)?,
                    None => out.write_all(b"null")?,
                }
            }
            out.write_all(b"}\n")
        }
        SampleFormat::Csv => {
            write!(out, "{},", address.face)?;
            if let Some(corner) = address.corner {
                write!(out, "{corner}")?;
            }
            for parameter in [address.u, address.v] {
                out.write_all(b",")?;
                number(parameter, out)?;
            }
            for (_, vector) in vectors {
                let Some(Vec3 { x, y, z }) = vector else {
                    out.write_all(b",,,")?;
                    continue;
                };
                for coordinate in [x, y, z] {
                    out.write_all(b",")?;
                    number(coordinate, out)?;
                }
            }
            for (_, k) in curvatures {
                out.write_all(b",")?;
                k.map_or(Ok(()), |k| number(k, out))?;
            }
            out.write_all(b"\n")
        }
    }
}

/// A finite number. The writer of JSON is several times as fast as `Display`.
fn number(x: f64, out: &mut impl Write) -> io::Result<()> {
    serde_json::to_writer(out, &x).map_err(io::Error::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOTHING: Sample = Sample {
        address: Address { face: 7, corner: None, u: 0.5, v: 0.1 },
        position: Some(Vec3::new(1.0, -2.5, 1e-30)),
        du: None,
        dv: None,
        duu: None,
        duv: None,
        dvv: None,
        normal: None,
        k1: None,
        k2: None,
    };

    fn text(sample: &Sample, format: SampleFormat, what: Derivatives) -> String {
        let mut out = Vec::new();
        write_header(format, what, &mut out).unwrap();
        write_sample(sample, format, what, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn rows_have_what_was_asked_for() {
        let some = Sample {
            address: Address { corner: Some(2), ..NOTHING.address },
            du: Some(Vec3::new(0.0, f64::NAN, 0.0)),
            dv: Some(Vec3::new(0.0, 1.0, 0.0)),
            normal: Some(Vec3::new(0.0, 0.0, 1.0)),
            k1: Some(f64::INFINITY),
            k2: Some(-0.25),
            ..NOTHING
        };
        let csv = |what| text(&some, SampleFormat::Csv, what);
        assert_eq!(csv(Derivatives::None), "face,corner,u,v,x,y,z\n7,2,0.5,0.1,1.0,-2.5,1e-30\n");
        let second = csv(Derivatives::Second);
        let (names, values) = second.split_once('\n').unwrap();
        assert!(names.ends_with("dvv_x,dvv_y,dvv_z,normal_x,normal_y,normal_z,k1,k2"), "{names}");
        assert!(values.ends_with(",,,,0.0,1.0,0.0,,,,,,,,,,0.0,0.0,1.0,,-0.25\n"), "{values}");
        assert_eq!(names.split(',').count(), values.split(',').count());
        assert_eq!(
            text(&some, SampleFormat::JsonLines, Derivatives::First),
            "{\"face\":7,\"corner\":2,\"u\":0.5,\"v\":0.1,\"position\":[1.0,-2.5,1e-30],\"du\":null,\
             \"dv\":[0.0,1.0,0.0],\"normal\":[0.0,0.0,1.0]}\n"
        );
        let json = text(&NOTHING, SampleFormat::JsonLines, Derivatives::Second);
        assert!(json.ends_with("\"dvv\":null,\"normal\":null,\"k1\":null,\"k2\":null}\n"), "{json}");
    }

    #[test]
    fn numbers_read_back_as_the_same() {
        for x in [1.0 / 3.0, -0.0, 5e-324, f64::MAX, 0.1 + 0.2, 1e21, 123_456_789.123_456_79] {
            let sample = Sample { position: Some(Vec3::new(x, 0.0, 0.0)), ..NOTHING };
            let csv = text(&sample, SampleFormat::Csv, Derivatives::None);
            let field: f64 = csv.lines().nth(1).unwrap().split(',').nth(4).unwrap().parse().unwrap();
            assert_eq!(field.to_bits(), x.to_bits());
            let json = text(&sample, SampleFormat::JsonLines, Derivatives::None);
            let row: serde_json::Value = serde_json::from_str(&json).unwrap();
            assert_eq!(row["position"][0].as_f64().map(f64::to_bits), Some(x.to_bits()));
        }
    }
}
