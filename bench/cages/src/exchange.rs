//! What is handed to the programs that are compared, as files of little-endian numbers: cages, places, results.

use std::fs::{self, File};
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use anyhow::{Context, Result, ensure};
use ogee::{Boundary, ControlMesh, Corner, Crease, FaceList, Sharpness, Vec3};

/// A place on the surface, by face and parameters; the corner where the face is no quad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The face.
    pub face: u32,
    /// The corner of a face that is no quad.
    pub corner: Option<u32>,
    /// First parameter, from 0 to 1.
    pub u: f64,
    /// Second parameter, from 0 to 1.
    pub v: f64,
}

/// Header of six counts, points, face sizes, corners, creases and sharp vertices with their sharpness.
///
/// # Errors
/// If the file cannot be written.
pub fn write_cage(path: &Path, mesh: &ControlMesh) -> Result<()> {
    let mut out = Vec::new();
    let boundary = u32::from(mesh.scheme.boundary != Boundary::EdgeAndCorner);
    let counts = [
        mesh.points.len(),
        mesh.faces.len(),
        mesh.faces.corners().len(),
        mesh.creases.len(),
        mesh.corners.len(),
    ];
    words(&mut out, counts.iter().map(|&count| count as u32).chain([boundary]));
    out.extend(mesh.points.iter().flat_map(|&p| <[f64; 3]>::from(p)).flat_map(f64::to_le_bytes));
    words(&mut out, mesh.faces.iter().map(|face| face.len() as u32));
    words(&mut out, mesh.faces.corners().iter().copied());
    words(&mut out, mesh.creases.iter().flat_map(|crease| crease.vertices));
    out.extend(mesh.creases.iter().flat_map(|crease| sharpness(crease.sharpness).to_le_bytes()));
    words(&mut out, mesh.corners.iter().map(|corner| corner.vertex));
    out.extend(mesh.corners.iter().flat_map(|corner| sharpness(corner.sharpness).to_le_bytes()));
    fs::write(path, out).with_context(|| format!("cannot write {}", path.display()))
}

/// In these files 10 is infinite, as it is for OpenSubdiv.
fn sharpness(value: Sharpness) -> f32 {
    value.value().min(10.0) as f32
}

fn words(out: &mut Vec<u8>, values: impl Iterator<Item = u32>) {
    out.extend(values.flat_map(u32::to_le_bytes));
}

/// A cage that [`write_cage`] wrote. No memory is taken but the cage's own, so that what a program holds after this
/// is where its measured memory starts.
///
/// # Errors
/// If the file cannot be read, or is shorter than its header says.
pub fn read_cage(path: &Path) -> Result<ControlMesh> {
    let mut file = Numbers::open(path)?;
    let header: [u32; 6] = file.words(6)?.as_slice().try_into()?;
    let [vertices, faces, corners, creases, sharp_vertices, boundary] = header.map(|count| count as usize);
    let point = |p: [u8; 24]| {
        let coordinate = |k: usize| f64::from_le_bytes(std::array::from_fn(|byte| p[8 * k + byte]));
        Vec3::new(coordinate(0), coordinate(1), coordinate(2))
    };
    let points = file.take(vertices, point)?;
    let mesh = ControlMesh::new(points, file.faces(path, faces, corners)?);
    let ends = file.words(2 * creases)?;
    let values = file.words(creases)?;
    let creases = std::iter::zip(ends.chunks_exact(2), values)
        .map(|(ends, value)| Crease { vertices: [ends[0], ends[1]], sharpness: sharpness_of(value) })
        .collect();
    let numbers = file.words(sharp_vertices)?;
    let values = file.words(sharp_vertices)?;
    let corners = std::iter::zip(numbers, values)
        .map(|(vertex, value)| Corner { vertex, sharpness: sharpness_of(value) })
        .collect();
    let mut mesh = ControlMesh { creases, corners, ..mesh };
    if boundary != 0 {
        mesh.scheme.boundary = Boundary::EdgeOnly;
    }
    Ok(mesh)
}

fn sharpness_of(bits: u32) -> Sharpness {
    Sharpness::from_value(f64::from(f32::from_bits(bits)))
}

/// A count, then for each place its face, its corner or -1, and its parameters.
///
/// # Errors
/// If the file cannot be written.
pub fn write_samples(path: &Path, samples: &[Sample]) -> Result<()> {
    let mut out = (samples.len() as u64).to_le_bytes().to_vec();
    for sample in samples {
        words(&mut out, [sample.face, sample.corner.unwrap_or(u32::MAX)].into_iter());
        out.extend([sample.u, sample.v].into_iter().flat_map(f64::to_le_bytes));
    }
    fs::write(path, out).with_context(|| format!("cannot write {}", path.display()))
}

/// Places that [`write_samples`] wrote.
///
/// # Errors
/// If the file cannot be read, or is shorter than its header says.
pub fn read_samples(path: &Path) -> Result<Vec<Sample>> {
    let mut file = Numbers::open(path)?;
    let count = file.words(2)?[0];
    let mut samples = Vec::with_capacity(count as usize);
    for _ in 0..count {
        let place = file.words(2)?;
        let parameters = file.numbers(2)?;
        let corner = (place[1] != u32::MAX).then_some(place[1]);
        samples.push(Sample { face: place[0], corner, u: parameters[0], v: parameters[1] });
    }
    Ok(samples)
}

/// Numbers one after the other.
///
/// # Errors
/// If the file cannot be written.
pub fn write_numbers(path: &Path, numbers: impl Iterator<Item = f64>) -> Result<()> {
    let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    fs::write(path, bytes).with_context(|| format!("cannot write {}", path.display()))
}

/// All numbers of a file.
///
/// # Errors
/// If the file cannot be read.
pub fn read_numbers(path: &Path) -> Result<Vec<f64>> {
    let length = fs::metadata(path).with_context(|| format!("cannot read {}", path.display()))?.len();
    Numbers::open(path)?.numbers(length as usize / 8)
}

/// A file that is read from its beginning.
struct Numbers(BufReader<File>);

impl Numbers {
    fn open(path: &Path) -> Result<Numbers> {
        let file = File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(Numbers(BufReader::new(file)))
    }

    fn words(&mut self, count: usize) -> Result<Vec<u32>> {
        self.take(count, u32::from_le_bytes)
    }

    fn numbers(&mut self, count: usize) -> Result<Vec<f64>> {
        self.take(count, f64::from_le_bytes)
    }

    fn take<const SIZE: usize, T>(&mut self, count: usize, from: impl Fn([u8; SIZE]) -> T) -> Result<Vec<T>> {
        let mut taken = Vec::with_capacity(count);
        for _ in 0..count {
            taken.push(from(self.next()?));
        }
        Ok(taken)
    }

    fn next<const SIZE: usize>(&mut self) -> Result<[u8; SIZE]> {
        let mut bytes = [0; SIZE];
        self.0.read_exact(&mut bytes).context("a file ends too early")?;
        Ok(bytes)
    }

    /// Sizes of faces and then their corners, of the file that this is: read side by side.
    fn faces(&mut self, path: &Path, count: usize, corner_count: usize) -> Result<FaceList> {
        let mut corners = Numbers::open(path)?;
        let start = self.0.stream_position()? + 4 * count as u64;
        corners.0.seek(SeekFrom::Start(start))?;
        let mut faces = FaceList::with_capacity(count, corner_count);
        let mut face = Vec::new();
        for _ in 0..count {
            let size = u32::from_le_bytes(self.next()?);
            face.clear();
            for _ in 0..size {
                face.push(u32::from_le_bytes(corners.next()?));
            }
            faces.push(&face);
        }
        ensure!(faces.corners().len() == corner_count, "sizes of faces and the number of corners disagree");
        self.0.seek_relative(4 * corner_count as i64)?;
        Ok(faces)
    }
}

/// `count` places, faces and parameters uniformly random, the same in every run.
pub fn scattered(faces: usize, count: usize) -> Vec<Sample> {
    let mut state = 1_u64;
    // SplitMix64.
    let mut next = move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    };
    let mut fraction = move || (next() >> 11) as f64 / (1_u64 << 53) as f64;
    (0..count)
        .map(|_| Sample {
            face: (fraction() * faces as f64) as u32,
            corner: None,
            u: fraction(),
            v: fraction(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cages_and_places_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        let mut mesh = ogee::shapes::cube();
        mesh.creases.push(Crease { vertices: [0, 1], sharpness: Sharpness::Infinite });
        mesh.creases.push(Crease { vertices: [1, 3], sharpness: Sharpness::Finite(1.5) });
        mesh.corners.push(Corner { vertex: 7, sharpness: Sharpness::Finite(2.25) });
        mesh.scheme.boundary = Boundary::EdgeOnly;
        write_cage(&path, &mesh).unwrap();
        assert_eq!(read_cage(&path).unwrap(), mesh);

        let samples = [
            Sample { face: 3, corner: None, u: 0.25, v: 0.5 },
            Sample { face: 1, corner: Some(4), u: 1.0, v: 0.1 },
        ];
        write_samples(&path, &samples).unwrap();
        let again = read_samples(&path).unwrap();
        assert_eq!(again.len(), 2);
        assert_eq!((again[0].face, again[0].corner, again[0].u, again[0].v), (3, None, 0.25, 0.5));
        assert_eq!((again[1].face, again[1].corner, again[1].u, again[1].v), (1, Some(4), 1.0, 0.1));
    }
}
