//! What every program measures, in the same way: passes, memory, and figures of the result that do not depend on the
//! order of its vertices. `bench/peers/measure.h` is the same in C++.

use std::time::Instant;

use anyhow::{Context, Result};
use ogee::{ControlMesh, Vec3};
use serde_json::{Value, json};

/// Peak of resident memory over what was resident at its start.
pub(crate) struct Peak {
    before: f64,
}

impl Peak {
    /// Forgets earlier peaks.
    pub(crate) fn start() -> Result<Peak> {
        // Where the kernel does not let this be reset, the peak of reading the cage is part of it: no more than the
        // cage itself, which is resident anyway.
        let _ = std::fs::write("/proc/self/clear_refs", "5");
        Ok(Peak { before: status_bytes("VmRSS:")? })
    }

    pub(crate) fn growth(&self) -> Result<f64> {
        Ok(status_bytes("VmHWM:")? - self.before)
    }
}

/// A line of `/proc/self/status` in bytes.
fn status_bytes(key: &str) -> Result<f64> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(key)).context("no such line of status")?;
    Ok(line.trim_end_matches("kB").trim().parse::<f64>()? * 1024.0)
}

/// Times of the same task three times.
pub(crate) struct Passes {
    fresh_seconds: f64,
    reused_seconds: f64,
    peak_bytes: f64,
}

/// Does a task into fresh memory, and twice into the same again, of which the last counts.
pub(crate) fn passes<R: Default>(mut task: impl FnMut(&mut R) -> Result<()>) -> Result<(R, Passes)> {
    let mut result = R::default();
    let peak = Peak::start()?;
    let mut timed = |result: &mut R| {
        let start = Instant::now();
        task(result)?;
        anyhow::Ok(start.elapsed().as_secs_f64())
    };
    let fresh_seconds = timed(&mut result)?;
    let peak_bytes = peak.growth()?;
    timed(&mut result)?;
    let reused_seconds = timed(&mut result)?;
    Ok((result, Passes { fresh_seconds, reused_seconds, peak_bytes }))
}

/// A mesh of quads, whatever holds it.
pub(crate) struct Shape<P, Q> {
    pub(crate) vertices: usize,
    pub(crate) faces: usize,
    /// The place of a vertex.
    pub(crate) point: P,
    /// The corners of a face.
    pub(crate) quad: Q,
}

impl<P: Fn(usize) -> [f64; 3], Q: Fn(usize) -> [u32; 4]> Shape<P, Q> {
    /// Means of the coordinates and of their products, area and volume: all there is to a mesh but its order.
    fn figures(&self) -> [f64; 11] {
        let mut sums = [0.0; 11];
        for [x, y, z] in (0..self.vertices).map(&self.point) {
            let terms = [x, y, z, x * x, y * y, z * z, x * y, y * z, z * x];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term / self.vertices as f64;
            }
        }
        for corners in (0..self.faces).map(&self.quad) {
            let [a, b, c, d] = corners.map(|corner| Vec3::from((self.point)(corner as usize)));
            let normal = (c - a).cross(d - b);
            sums[9] += normal.length() / 2.0;
            sums[10] += normal.dot(a + b + c + d) / 24.0;
        }
        sums
    }

    /// The answer to a task of refinement.
    pub(crate) fn refinement(&self, passes: &Passes) -> Value {
        json!({
            "vertices": self.vertices, "faces": self.faces, "figures": self.figures(),
            "fresh_seconds": passes.fresh_seconds, "reused_seconds": passes.reused_seconds,
            "peak_bytes": passes.peak_bytes,
        })
    }

    /// The answer to a task of animation.
    pub(crate) fn animation(&self, set_up: &SetUp, frame_seconds: f64) -> Value {
        json!({
            "vertices": self.vertices, "faces": self.faces, "figures": self.figures(),
            "set_up_seconds": set_up.seconds, "set_up_bytes": set_up.peak_bytes,
            "frame_seconds": frame_seconds,
        })
    }
}

/// What comes before the first frame.
pub(crate) struct SetUp {
    seconds: f64,
    peak_bytes: f64,
}

/// Prepares an animation.
pub(crate) fn set_up<S>(make: impl FnOnce() -> Result<S>) -> Result<(S, SetUp)> {
    let peak = Peak::start()?;
    let start = Instant::now();
    let state = make()?;
    let seconds = start.elapsed().as_secs_f64();
    Ok((state, SetUp { seconds, peak_bytes: peak.growth()? }))
}

/// The median time of so many poses, after one that brings memory. The cage is sheared, more from frame to frame;
/// `apply` is given the posed cage as points that `convert` makes of it.
pub(crate) fn animate<T>(
    mesh: &ControlMesh,
    frames: usize,
    convert: impl Fn([f64; 3]) -> T,
    mut apply: impl FnMut(&[T]) -> Result<()>,
) -> Result<f64> {
    let mut times = Vec::new();
    for frame in 0..=frames {
        let shear = frame as f64 / 16.0;
        let posed: Vec<T> =
            mesh.points.iter().map(|point| convert([point.x + shear * point.y, point.y, point.z])).collect();
        let start = Instant::now();
        apply(&posed)?;
        if frame > 0 {
            times.push(start.elapsed().as_secs_f64());
        }
    }
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().context("an animation has a frame")
}
