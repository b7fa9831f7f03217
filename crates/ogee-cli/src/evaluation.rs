//! Samples in a stream: a block of addresses, what the surface says there, text.
//!
//! Only one block is held, so memory does not grow with the number of samples.

use std::io::Write;
use std::time::Instant;

use ogee::lens::TreatedSurface;
use ogee::{
    Derivatives, Evaluator, FaceId, Flags, Location, LocationError, Place, Samples, SurfaceJet, Vec3,
};
use ogee_formats::samples::{Address, Sample, SampleFormat, write_header, write_sample};
use rayon::prelude::*;
use serde::Serialize;

use crate::addresses::{Next, Source};
use crate::error::{Failure, Finding};
use crate::output::{Counter, Stopped};

/// Points that are worked on at once: enough for all threads, little beside a cage.
const BLOCK: usize = 8192;

/// Points that one thread writes down in a go.
const CHUNK: usize = 512;

/// How many samples are special.
#[derive(Clone, Copy, Default, Serialize)]
pub(crate) struct Special {
    /// At extraordinary vertices, where there are no derivatives.
    pub(crate) at_extraordinary: u64,
    /// Without a normal: tangents vanish or are parallel.
    pub(crate) normals_undefined: u64,
    /// Where the normal depends on the side one comes from.
    pub(crate) normals_one_sided: u64,
    /// Where curvature grows without bound.
    pub(crate) curvature_unbounded: u64,
}

/// What an evaluation counts.
#[derive(Clone, Copy, Default)]
pub(crate) struct Figures {
    /// How many samples there have been.
    pub(crate) samples: u64,
    /// And how many of them are special.
    pub(crate) special: Special,
    /// Seconds spent on addresses.
    pub(crate) read: f64,
    /// Seconds spent on the surface.
    pub(crate) evaluate: f64,
}

/// What is wrong with the points: the first findings, and how many more there are.
#[derive(Default)]
struct Refusal {
    findings: Vec<Finding>,
    unlisted: usize,
}

impl Refusal {
    fn push(&mut self, finding: Finding) {
        if self.findings.len() <= Failure::MOST_OTHERS {
            self.findings.push(finding);
        } else {
            self.unlisted += 1;
        }
    }
}

/// Evaluates one block after the other, in the same memory.
pub(crate) struct Evaluation<'a> {
    surface: &'a TreatedSurface<'a>,
    format: SampleFormat,
    what: Derivatives,
    addresses: Vec<Address>,
    locations: Vec<Location>,
    values: Samples,
    curvatures: Vec<Option<[f64; 2]>>,
    text: Vec<Vec<u8>>,
    /// What was counted so far.
    pub(crate) figures: Figures,
}

impl<'a> Evaluation<'a> {
    /// Nothing yet.
    pub(crate) fn new(
        surface: &'a TreatedSurface<'a>,
        format: SampleFormat,
        what: Derivatives,
    ) -> Evaluation<'a> {
        Evaluation {
            surface,
            format,
            what,
            addresses: Vec::with_capacity(BLOCK),
            locations: Vec::with_capacity(BLOCK),
            values: Samples::default(),
            curvatures: Vec::new(),
            text: vec![Vec::new(); BLOCK / CHUNK],
            figures: Figures::default(),
        }
    }

    /// Everything from the source, whose name is for messages. After a bad address only others are looked for.
    pub(crate) fn run(
        &mut self,
        mut source: Source<'_>,
        name: &str,
        out: &mut Counter,
    ) -> Result<(), Stopped> {
        let mut header = Vec::new();
        write_header(self.format, self.what, &mut header)?;
        out.write_all(&header)?;
        let mut refusal = Refusal::default();
        let mut has_more = true;
        while has_more {
            let start = Instant::now();
            has_more = self.fill(&mut source, name, &mut refusal)?;
            self.figures.read += start.elapsed().as_secs_f64();
            if !refusal.findings.is_empty() {
                continue;
            }
            let start = Instant::now();
            self.evaluate();
            self.figures.evaluate += start.elapsed().as_secs_f64();
            self.write(out)?;
        }
        if refusal.findings.is_empty() && self.figures.samples == 0 {
            refusal.push(Finding::in_file("no_samples", "there are no points in it", name));
        }
        if refusal.findings.is_empty() {
            return Ok(());
        }
        Err(Failure::refused(refusal.findings, refusal.unlisted).into())
    }

    /// The next block of addresses, checked; false at the end.
    fn fill(&mut self, source: &mut Source<'_>, name: &str, refusal: &mut Refusal) -> Result<bool, Failure> {
        self.addresses.clear();
        self.locations.clear();
        while self.locations.len() < BLOCK {
            let (line, address) = match source.next()? {
                Next::Address(line, address) => (line, address),
                Next::Bad(finding) => {
                    refusal.push(finding);
                    continue;
                }
                Next::End => return Ok(false),
            };
            let Address { face, corner, u, v } = address;
            match self.surface.table().locate(FaceId(face), corner, u, v) {
                Ok(location) => {
                    self.addresses.push(address);
                    self.locations.push(location);
                }
                Err(error) => {
                    let mut finding = Finding::in_file(error.code(), error.to_string(), name);
                    finding.location.line = line;
                    let is_there = !matches!(error, LocationError::MissingFace { .. });
                    finding.location.place = is_there.then_some(Place::Face(face));
                    refusal.push(finding);
                }
            }
        }
        Ok(true)
    }

    fn evaluate(&mut self) {
        self.surface.eval_into(&self.locations, self.what, &mut self.values);
        let values = &self.values;
        self.curvatures.clear();
        if self.what == Derivatives::Second {
            let (surface, locations) = (self.surface, &self.locations);
            let principal = |i: usize| {
                if surface.is_on_cap(locations[i]) {
                    // At lenses and poles too.
                    return surface.curvature(locations[i]).map(|curvature| [curvature.k1, curvature.k2]);
                }
                curvatures(values, i)
            };
            let points = (0..locations.len()).into_par_iter();
            points.map(principal).collect_into_vec(&mut self.curvatures);
        }
        self.figures.samples += self.locations.len() as u64;
        let special = &mut self.figures.special;
        for flags in &values.flags {
            let count = |flag| u64::from(flags.contains(flag));
            special.at_extraordinary += count(Flags::AT_EXTRAORDINARY);
            special.normals_undefined += count(Flags::NORMAL_UNDEFINED);
            special.normals_one_sided += count(Flags::NORMAL_ONE_SIDED);
            special.curvature_unbounded += count(Flags::UNBOUNDED_CURVATURE);
        }
    }

    fn write(&mut self, out: &mut Counter) -> std::io::Result<()> {
        let Evaluation { format, what, addresses, values, curvatures, text, .. } = self;
        let (format, what) = (*format, *what);
        let chunks = addresses.par_chunks(CHUNK).zip(&mut *text).enumerate();
        chunks.try_for_each(|(chunk, (addresses, text))| {
            text.clear();
            for (k, &address) in addresses.iter().enumerate() {
                let i = chunk * CHUNK + k;
                let principal = curvatures.get(i).copied().flatten();
                write_sample(&sample(address, values, i, principal), format, what, &mut *text)?;
            }
            Ok::<(), std::io::Error>(())
        })?;
        text.iter().take(addresses.len().div_ceil(CHUNK)).try_for_each(|text| out.write_all(text))
    }
}

/// The principal curvatures at a point, where they exist.
fn curvatures(values: &Samples, i: usize) -> Option<[f64; 2]> {
    let flags = values.flags[i];
    let without = [Flags::AT_EXTRAORDINARY, Flags::UNBOUNDED_CURVATURE, Flags::NORMAL_UNDEFINED];
    if without.iter().any(|&flag| flags.contains(flag)) {
        return None;
    }
    let at = |values: &[Vec3]| values.get(i).copied();
    let jet = SurfaceJet {
        position: at(&values.position)?,
        du: at(&values.du)?,
        dv: at(&values.dv)?,
        duu: at(&values.duu)?,
        duv: at(&values.duv)?,
        dvv: at(&values.dvv)?,
    };
    jet.curvature().map(|curvature| [curvature.k1, curvature.k2])
}

/// A point as it is written: without what does not exist there.
fn sample(address: Address, values: &Samples, i: usize, curvatures: Option<[f64; 2]>) -> Sample {
    let flags = values.flags[i];
    let is_extraordinary = flags.contains(Flags::AT_EXTRAORDINARY);
    let has_no_normal = flags.contains(Flags::NORMAL_UNDEFINED)
        || is_extraordinary && flags.contains(Flags::NORMAL_ONE_SIDED);
    let at = |values: &[Vec3]| values.get(i).copied();
    let derivative = |values: &[Vec3]| at(values).filter(|_| !is_extraordinary);
    Sample {
        address,
        position: at(&values.position),
        du: derivative(&values.du),
        dv: derivative(&values.dv),
        duu: derivative(&values.duu),
        duv: derivative(&values.duv),
        dvv: derivative(&values.dvv),
        normal: at(&values.normal).filter(|_| !has_no_normal),
        k1: curvatures.map(|[k1, _]| k1),
        k2: curvatures.map(|[_, k2]| k2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_exist_is_not_written() {
        const X: Vec3 = Vec3::new(1.0, 0.0, 0.0);
        const Y: Vec3 = Vec3::new(0.0, 1.0, 0.0);
        const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);
        let address = Address { face: 0, corner: None, u: 0.0, v: 0.0 };
        // Whether there are derivatives, a normal, curvatures.
        let cases = [
            (Flags::NONE, [true, true, true]),
            (Flags::BEYOND_NMAX, [true, true, true]),
            (Flags::UNBOUNDED_CURVATURE, [true, true, false]),
            (Flags::NORMAL_UNDEFINED, [true, false, false]),
            (Flags::NORMAL_ONE_SIDED, [true, true, true]),
            (Flags::AT_EXTRAORDINARY, [false, true, false]),
            (Flags::AT_EXTRAORDINARY.with(Flags::UNBOUNDED_CURVATURE), [false, true, false]),
            (Flags::AT_EXTRAORDINARY.with(Flags::NORMAL_ONE_SIDED), [false, false, false]),
            (Flags::AT_EXTRAORDINARY.with(Flags::NORMAL_UNDEFINED), [false, false, false]),
        ];
        for (flags, [derivatives, normal, curvature]) in cases {
            let mut values = Samples {
                position: vec![X],
                du: vec![X],
                dv: vec![Y],
                normal: vec![Z],
                duu: vec![2.0 * Z],
                duv: vec![Vec3::ZERO],
                dvv: vec![Z],
                flags: vec![flags],
            };
            let row = sample(address, &values, 0, curvatures(&values, 0));
            assert_eq!(row.position, Some(X));
            for (found, expected) in
                [(row.du, X), (row.dv, Y), (row.duu, 2.0 * Z), (row.duv, Vec3::ZERO), (row.dvv, Z)]
            {
                assert_eq!(found, derivatives.then_some(expected), "{flags:?}");
            }
            assert_eq!(row.normal, normal.then_some(Z), "{flags:?}");
            assert_eq!((row.k1, row.k2), (curvature.then_some(2.0), curvature.then_some(1.0)), "{flags:?}");
            // A singular surface has no curvature, whatever its flags.
            values.du[0] = Vec3::ZERO;
            assert_eq!(curvatures(&values, 0), None);
        }
    }
}
