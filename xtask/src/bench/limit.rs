//! `cargo xtask bench limit`: evaluation of the limit surface beside OpenSubdiv and Blender, on the same cages, in
//! turns. `bench/peers/README.md` says what is measured.

use std::borrow::Cow;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};

use super::cages::{self, BenchCage};
use super::peers::{self, Contestant, FLAGS, Found};
use super::report::{Table, rounds};
use super::{accuracy, machine, speed};
use ogee_bench_cages::exchange;

/// Samples along each side of a face, where all faces have the same.
const SIDE: &str = "4";

/// Random places of a scattered task.
const SCATTERED: usize = 1_000_000;

/// The same where a peer takes microseconds for each.
const FEW: usize = 50_000;

/// Level of isolation of Far's tables in timings: deep enough for pictures, and its smaller tables are the faster.
pub(super) const FAR_LEVEL: i32 = 3;

/// Greatest difference of positions on the regular cage, where everybody is exact, relative to its size.
const AGREEMENT: f64 = 1e-12;

/// A cage and its files.
pub(super) struct Course {
    pub(super) cage: BenchCage,
    pub(super) file: PathBuf,
    /// Random places.
    scattered: PathBuf,
    /// The first of them.
    few: PathBuf,
}

/// Where a surface is evaluated.
#[derive(Clone, Copy)]
pub(super) enum Places {
    /// The same in every face, face by face.
    Faces,
    Scattered,
    FewScattered,
}

impl Course {
    /// The task of those who take part, and its last argument.
    pub(super) fn task(&self, places: Places) -> (&'static str, Cow<'_, str>) {
        match places {
            Places::Faces => ("faces", SIDE.into()),
            Places::Scattered => ("scattered", self.scattered.to_string_lossy()),
            Places::FewScattered => ("scattered", self.few.to_string_lossy()),
        }
    }
}

/// Those who are there besides us.
pub(super) struct Peers {
    pub(super) opensubdiv: Result<Found, String>,
    pub(super) blender: Result<Found, String>,
}

/// Builds what is needed, compares, and writes tables in Markdown as they are finished.
///
/// # Errors
/// If something cannot be run, or results differ that should be the same.
pub(crate) fn compare(out: &mut impl Write) -> Result<()> {
    let (peers, folder) = (Peers::find(), tempfile::tempdir()?);
    let courses = courses(folder.path())?;
    heading(&peers, &courses, out)?;
    let mut faults = Vec::new();
    let (opensubdiv, blender) = (peers.opensubdiv.as_ref().ok(), peers.blender.as_ref().ok());
    writeln!(out, "\n{}", accuracy::table(opensubdiv, blender, folder.path())?)?;
    if let Some(opensubdiv) = opensubdiv {
        writeln!(out, "{}", agreement(opensubdiv, &courses, folder.path(), &mut faults)?)?;
    }
    writeln!(out, "{}", set_up(&peers, &courses)?)?;
    writeln!(out, "{}", speed::ratios(&peers, &courses, "")?)?;
    writeln!(out, "{}", speed::threads(&courses, &mut faults)?)?;
    ensure!(faults.is_empty(), "{}", faults.join("\n"));
    Ok(())
}

/// Times beside the peers alone, of the tasks whose names begin so.
///
/// # Errors
/// If something cannot be run.
pub(crate) fn compare_times(out: &mut impl Write, task: &str) -> Result<()> {
    let (peers, folder) = (Peers::find(), tempfile::tempdir()?);
    let courses = courses(folder.path())?;
    heading(&peers, &courses, out)?;
    writeln!(out, "\n{}", speed::ratios(&peers, &courses, task)?)?;
    Ok(())
}

impl Peers {
    fn find() -> Peers {
        Peers { opensubdiv: peers::opensubdiv(), blender: peers::blender() }
    }
}

fn courses(folder: &Path) -> Result<Vec<Course>> {
    [cages::regular(), cages::valences_3_and_6()?, cages::valences_3_to_8()?, cages::mixed()]
        .into_iter()
        .map(|cage| course(folder, cage))
        .collect()
}

fn course(folder: &Path, cage: BenchCage) -> Result<Course> {
    let path = |what: &str| folder.join(format!("{} {what}", cage.name));
    let (file, scattered, few) = (path("cage"), path("scattered"), path("few"));
    exchange::write_cage(&file, &cage.mesh)?;
    let samples = exchange::scattered(cage.mesh.faces.len(), SCATTERED);
    exchange::write_samples(&scattered, &samples)?;
    exchange::write_samples(&few, &samples[..FEW])?;
    Ok(Course { cage, file, scattered, few })
}

/// The machine, and who takes part in which version.
fn heading(peers: &Peers, courses: &[Course], out: &mut impl Write) -> Result<()> {
    writeln!(out, "{}\n", machine::description()?)?;
    match &peers.opensubdiv {
        Ok(found) => {
            writeln!(
                out,
                "- OpenSubdiv {}; our side of it built with `{}`.",
                found.version,
                FLAGS.join(" ")
            )?;
        }
        Err(missing) => writeln!(out, "- OpenSubdiv is missing: {missing}.")?,
    }
    match &peers.blender {
        Ok(found) => writeln!(out, "- Blender {} as a Python module.", found.version)?,
        Err(missing) => writeln!(out, "- Blender is missing: {missing}.")?,
    }
    for Course { cage, .. } in courses {
        writeln!(out, "- Cage \"{}\": {}.", cage.name, cage.about)?;
    }
    Ok(())
}

/// Time and memory before the first point.
fn set_up(peers: &Peers, courses: &[Course]) -> Result<Table> {
    let mut contestants = vec![peers::ours(1)?, peers::ours(2)?.named("ogee, 2 threads")];
    if let Ok(found) = &peers.opensubdiv {
        contestants.push(found.contestant("Bfr, all surfaces kept", "bfr-prepared", -1));
        contestants.push(found.contestant(&format!("Far, isolation {FAR_LEVEL}"), "far", FAR_LEVEL));
        contestants.push(found.contestant("Far, isolation 10, its default", "far", -1));
    }
    let contestants: Vec<&Contestant> = contestants.iter().collect();
    let mut table = Table::new(&[
        "set-up",
        "cage",
        "connectivity ms",
        "the rest ms",
        "the rest, µs a quad",
        "bytes a quad, connectivity",
        "the rest",
    ]);
    // Where every face is extraordinary, Far's default takes gigabytes.
    for course in [&courses[0], &courses[3]] {
        let quads = course.cage.mesh.faces.len() as f64;
        for (contestant, answers) in contestants.iter().zip(rounds(&contestants, "setup", &course.file, &[])?)
        {
            let figure = |key: &str, scale: f64| answers.spread(|answer| Some(answer[key].as_f64()? * scale));
            table.row(&[
                contestant.name.clone(),
                course.cage.name.to_owned(),
                figure("connect_seconds", 1e3)?.to_string(),
                figure("prepare_seconds", 1e3)?.to_string(),
                format!("{:.3}", figure("prepare_seconds", 1e6 / quads)?.median),
                format!("{:.0}", figure("connect_bytes", 1.0 / quads)?.median),
                format!("{:.0}", figure("prepare_bytes", 1.0 / quads)?.median),
            ]);
        }
    }
    Ok(table)
}

/// How far positions and unit normals of the peers are from ours at the random places.
fn agreement(found: &Found, courses: &[Course], folder: &Path, faults: &mut Vec<String>) -> Result<Table> {
    let others = [
        found.contestant("Bfr", "bfr", -1),
        found.contestant(&format!("Far, isolation {FAR_LEVEL}"), "far", FAR_LEVEL),
    ];
    let ours = peers::ours(1)?;
    let output = folder.join("values");
    let values = |contestant: &Contestant, course: &Course| {
        let samples = course.scattered.to_string_lossy();
        contestant.run("values", &course.file, &["1", &samples, &output.to_string_lossy()])?;
        exchange::read_numbers(&output)
    };
    let mut table = Table::new(&[
        "other",
        "cage",
        "greatest distance from ogee / size",
        "greatest angle of normals, degrees",
    ]);
    for course in courses {
        let own = accuracy::points(&values(&ours, course)?);
        for other in &others {
            let its = accuracy::points(&values(other, course)?);
            ensure!(own.len() == its.len(), "{} gave another number of points", other.name);
            let error = accuracy::greatest(own.iter().copied().zip(its), course.cage.mesh.size());
            if course.cage.name == "regular" && error.distance > AGREEMENT {
                faults.push(format!(
                    "{} and ogee differ by {:.1e} where both are exact",
                    other.name, error.distance
                ));
            }
            let [distance, degrees] = [error.distance, error.degrees].map(|figure| format!("{figure:.1e}"));
            table.row(&[&other.name, course.cage.name, &distance, &degrees]);
        }
    }
    Ok(table)
}
