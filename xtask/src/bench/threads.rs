//! `cargo xtask bench threads`: what two threads gain, beside what they gain on this machine where nothing but arithmetic is
//! done. Both take turns within one process, so that what else the machine does strikes them alike; the least times
//! are those that were disturbed least.

use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

use anyhow::{Context, Result};
use ogee::{Derivatives, Level, LimitSurface, PatchTable};
use rayon::ThreadPoolBuilder;

use super::cages::{self, BenchCage};
use super::report::Table;

/// Rounds of every row.
const ROUNDS: usize = 81;

/// Samples along each side of a face.
const SIDE: usize = 4;

/// Steps of the arithmetic, some milliseconds.
const STEPS: u64 = 400_000;

/// What is timed.
const TASKS: [&str; 6] =
    ["arithmetic, no memory", "set-up", "order 1", "order 2", "order 1 with set-up", "order 2 with set-up"];

/// Times in milliseconds: of each task with one thread and with two.
type Times = [[Vec<f64>; 2]; TASKS.len()];

/// Writes a table of gains, 16 points a face.
pub(crate) fn compare(out: &mut impl Write) -> Result<()> {
    let mut table = Table::new(&[
        "task",
        "cage",
        "1 thread, ms: least, median",
        "2 threads, ms: least, median",
        "gain by least",
        "gain by median",
    ]);
    for cage in [cages::regular(), cages::valences_3_and_6()?, cages::valences_3_to_8()?, cages::mixed()] {
        for (task, threads) in TASKS.iter().zip(times(&cage)?) {
            let [one, two] = threads.map(|mut times| {
                times.sort_by(f64::total_cmp);
                [times[0], times[times.len() / 2]]
            });
            let shown = |[least, median]: [f64; 2]| format!("{least:.2}, {median:.2}");
            let gain = |k: usize| format!("{:.2}", one[k] / two[k]);
            table.row(&[(*task).to_owned(), cage.name.to_owned(), shown(one), shown(two), gain(0), gain(1)]);
        }
    }
    Ok(write!(out, "{table}")?)
}

fn times(cage: &BenchCage) -> Result<Times> {
    let mut pools = Vec::new();
    for threads in [1, 2] {
        pools.push(ThreadPoolBuilder::new().num_threads(threads).build()?);
    }
    let level = Level::new(&cage.mesh)?;
    let at = |k: usize| (k as f64 + 0.5) / SIDE as f64;
    let places: Vec<[f64; 2]> = (0..SIDE * SIDE).map(|k| [at(k % SIDE), at(k / SIDE)]).collect();
    let mut times = Times::default();
    for _ in 0..ROUNDS {
        for (k, pool) in pools.iter().enumerate() {
            let found = pool.install(|| round(&level, &cage.mesh.points, &places, k + 1))?;
            for (task, milliseconds) in times.iter_mut().zip(found) {
                task[k].push(milliseconds);
            }
        }
    }
    Ok(times)
}

/// All tasks once, on the threads of the pool that this runs in.
fn round(
    level: &Level,
    cage: &[ogee::Vec3],
    places: &[[f64; 2]],
    threads: usize,
) -> Result<[f64; TASKS.len()]> {
    let since = |start: Instant| start.elapsed().as_secs_f64() * 1e3;
    let start = Instant::now();
    match threads {
        1 => arithmetic(STEPS),
        _ => drop(rayon::join(|| arithmetic(STEPS / 2), || arithmetic(STEPS / 2))),
    }
    let mut found = [since(start), 0.0, 0.0, 0.0, 0.0, 0.0];
    for (order, what) in [Derivatives::First, Derivatives::Second].into_iter().enumerate() {
        let start = Instant::now();
        let table = PatchTable::new(level);
        let surface = LimitSurface::new(&table, cage);
        let set_up = since(start);
        let pattern = table.pattern(places, what).context("places in faces")?;
        surface.visit_pattern(&pattern, 0..table.len(), |_, samples| {
            black_box(samples);
        })?;
        let all = since(start);
        found[1] = set_up;
        found[2 + order] = all - set_up;
        found[4 + order] = all;
    }
    Ok(found)
}

/// Multiplications and additions in registers.
fn arithmetic(steps: u64) {
    let mut numbers = black_box([1.0_f64; 40]);
    for _ in 0..steps {
        for x in &mut numbers {
            *x = *x * 0.999_999 + 1e-6;
        }
    }
    black_box(numbers);
}
