//! `cargo xtask bench-worker`: our side of the comparison, with the tasks, arguments and answers of
//! `bench/peers/opensubdiv_limit.cpp`. A process of its own for every measurement, as the peers have.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use ogee::{
    ControlMesh, Derivatives, FaceId, Level, LimitSurface, Location, LocationError, PatchTable, Samples, Vec3,
};
use rayon::prelude::*;
use serde_json::{Value, json};

use ogee_bench_cages::exchange::{self, Sample};

/// Does one task and answers with one line of JSON.
///
/// The arguments are `setup ours -1 CAGE`, `faces ours -1 CAGE ORDER SIDE`, `scattered ours -1 CAGE ORDER SAMPLES` or
/// `values ours -1 CAGE ORDER SAMPLES OUTPUT`; with `ours-single` samples are asked for one at a time. The level of
/// isolation is there for the peers, which have one.
pub(crate) fn run(arguments: &[&str]) -> Result<Value> {
    let [task, side, _, cage, rest @ ..] = arguments else { bail!("too few arguments") };
    let mesh = exchange::read_cage(Path::new(cage))?;
    match (*task, rest) {
        ("setup", []) => set_up(&mesh),
        ("faces", [order, side]) => by_faces(&mesh, derivatives(order)?, side.parse()?),
        ("scattered", [order, samples]) => {
            let samples = exchange::read_samples(Path::new(samples))?;
            if *side == "ours-single" {
                return one_by_one(&mesh, &samples);
            }
            Ok(by_list(&mesh, derivatives(order)?, &samples)?.0)
        }
        ("values", [order, samples, output]) => {
            let samples = exchange::read_samples(Path::new(samples))?;
            let (report, results) = by_list(&mesh, derivatives(order)?, &samples)?;
            let values = results.position.iter().zip(&results.du).zip(&results.dv);
            let vectors = values.flat_map(|((&position, &du), &dv)| [position, du, dv]);
            exchange::write_numbers(Path::new(output), vectors.flat_map(<[f64; 3]>::from))?;
            Ok(report)
        }
        _ => bail!("no such task: {task}"),
    }
}

fn derivatives(order: &str) -> Result<Derivatives> {
    match order {
        "1" => Ok(Derivatives::First),
        "2" => Ok(Derivatives::Second),
        _ => bail!("derivatives of order 1 or 2, not {order}"),
    }
}

fn set_up(mesh: &ControlMesh) -> Result<Value> {
    let before = resident_bytes()?;
    let start = Instant::now();
    let level = Level::new(mesh)?;
    let connect_seconds = start.elapsed().as_secs_f64();
    let connected = resident_bytes()?;
    let start = Instant::now();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let prepare_seconds = start.elapsed().as_secs_f64();
    let prepared = resident_bytes()?;
    // Held until memory has been looked at.
    drop(surface);
    Ok(json!({
        "connect_seconds": connect_seconds, "prepare_seconds": prepare_seconds,
        "connect_bytes": connected - before, "prepare_bytes": prepared - connected,
    }))
}

/// What the process holds in memory.
fn resident_bytes() -> Result<f64> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).context("no resident size")?;
    Ok(line.trim_end_matches("kB").trim().parse::<f64>()? * 1024.0)
}

/// All faces, `side` x `side` cell centres in each, preparation included; results are taken away block by block.
fn by_faces(mesh: &ControlMesh, what: Derivatives, side: u32) -> Result<Value> {
    let level = Level::new(mesh)?;
    let centre = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
    let places: Vec<[f64; 2]> = (0..side * side).map(|k| [centre(k % side), centre(k / side)]).collect();
    let pass = |take: &(dyn Fn(Range<usize>, &Samples) + Sync)| -> Result<[f64; 2]> {
        let start = Instant::now();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let pattern = table.pattern(&places, what)?;
        let prepared = start.elapsed();
        surface.visit_pattern(&pattern, 0..table.len(), take)?;
        Ok([prepared.as_secs_f64(), start.elapsed().as_secs_f64()])
    };
    // Blocks come in any order.
    let blocks = Mutex::new(BTreeMap::new());
    pass(&|faces, results| {
        let mut checksum = Checksum::default();
        checksum.add(results);
        blocks.lock().expect("no block fails").insert(faces.start, checksum.0);
    })?;
    let mut checksum = Checksum::default();
    blocks.into_inner()?.into_values().for_each(|block| checksum.add_bits(block));
    let seconds = pass(&|_, results| {
        std::hint::black_box(results);
    })?;
    Ok(report(mesh.faces.len() * (side * side) as usize, seconds, &checksum))
}

/// A list of samples, into memory that has been written to before. Checking the addresses is part of the time.
fn by_list(mesh: &ControlMesh, what: Derivatives, samples: &[Sample]) -> Result<(Value, Samples)> {
    let level = Level::new(mesh)?;
    let start = Instant::now();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let prepared = start.elapsed().as_secs_f64();
    let locate = |sample: &Sample| table.locate(FaceId(sample.face), sample.corner, sample.u, sample.v);
    let mut places = samples.iter().map(locate).collect::<Result<Vec<Location>, LocationError>>()?;
    let mut results = Samples::default();
    let mut seconds = 0.0;
    for _ in 0..2 {
        let start = Instant::now();
        samples.par_iter().zip(&mut places).try_for_each(|(sample, place)| {
            *place = locate(sample)?;
            Ok::<(), LocationError>(())
        })?;
        surface.eval_into(&places, what, &mut results);
        seconds = start.elapsed().as_secs_f64();
    }
    let mut checksum = Checksum::default();
    checksum.add(&results);
    Ok((report(samples.len(), [prepared, seconds], &checksum), results))
}

/// The same with one call a sample, which gives first derivatives and normals.
fn one_by_one(mesh: &ControlMesh, samples: &[Sample]) -> Result<Value> {
    let level = Level::new(mesh)?;
    let start = Instant::now();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let prepared = start.elapsed().as_secs_f64();
    let mut results = Vec::with_capacity(samples.len());
    let mut seconds = 0.0;
    for _ in 0..2 {
        let start = Instant::now();
        results.clear();
        for sample in samples {
            results.push(surface.eval(table.locate(
                FaceId(sample.face),
                sample.corner,
                sample.u,
                sample.v,
            )?));
        }
        seconds = start.elapsed().as_secs_f64();
    }
    let mut checksum = Checksum::default();
    for point in &results {
        for vector in [point.position, point.du, point.dv, point.normal] {
            checksum.add_vector(vector);
        }
    }
    Ok(report(samples.len(), [prepared, seconds], &checksum))
}

fn report(points: usize, [prepared, seconds]: [f64; 2], checksum: &Checksum) -> Value {
    let checksum = checksum.0.to_string();
    json!({ "points": points, "seconds": seconds, "prepare_seconds": prepared, "checksum": checksum })
}

/// The bits of all results: equal where two runs are equal.
struct Checksum(u64);

impl Default for Checksum {
    fn default() -> Checksum {
        Checksum(14_695_981_039_346_656_037)
    }
}

impl Checksum {
    fn add(&mut self, samples: &Samples) {
        let lists = [
            &samples.position,
            &samples.du,
            &samples.dv,
            &samples.normal,
            &samples.duu,
            &samples.duv,
            &samples.dvv,
        ];
        for i in 0..samples.position.len() {
            lists.iter().filter_map(|list| list.get(i)).for_each(|&vector| self.add_vector(vector));
        }
    }

    fn add_vector(&mut self, vector: Vec3) {
        for number in <[f64; 3]>::from(vector) {
            self.add_bits(number.to_bits());
        }
    }

    fn add_bits(&mut self, bits: u64) {
        self.0 = (self.0 ^ bits).wrapping_mul(1_099_511_628_211);
    }
}
