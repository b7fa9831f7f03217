//! `cargo xtask bench refine`, `bench animate` and `bench obj`: refinement, animated cages and reading beside
//! OpenSubdiv, CGAL, Blender and other crates, in turns, and beside what the machine itself can do.
//! `bench/peers/README.md` says what is measured.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use super::figures::{Figures, Precision};
use super::machine;
use super::peers::{self, Contestant, FLAGS, Found};
use super::report::{Answers, ROUNDS, Spread, Table, rounds_of};

/// A cage refined to a level.
struct Course {
    /// As `ogee-bench` calls it.
    cage: &'static str,
    level: i32,
    /// Whether edges and vertices are sharp.
    tags: Tags,
}

#[derive(Clone, Copy, PartialEq)]
enum Tags {
    None,
    Sharp,
}

const COURSES: [Course; 4] = [
    Course { cage: "small", level: 5, tags: Tags::None },
    Course { cage: "medium", level: 3, tags: Tags::None },
    Course { cage: "open", level: 3, tags: Tags::Sharp },
    Course { cage: "large", level: 1, tags: Tags::None },
];

/// Poses of an animated cage; the median of their times is one answer.
const FRAMES: &str = "9";

/// What of a comparison is run.
pub(crate) struct Selection {
    /// The cages whose names begin so.
    pub(crate) cages: String,
    /// How often everybody runs.
    pub(crate) rounds: usize,
}

impl Default for Selection {
    fn default() -> Selection {
        Selection { cages: String::new(), rounds: ROUNDS }
    }
}

impl Selection {
    /// The beginning of a cage's name, and a number of rounds.
    ///
    /// # Errors
    /// If there is something else, or no round.
    pub(crate) fn parse(arguments: &[&str]) -> Result<Selection> {
        let rounds_of = |text: &str| text.parse().ok().filter(|&rounds| rounds > 0);
        match *arguments {
            [] => Ok(Selection::default()),
            [cages] => Ok(Selection { cages: cages.into(), ..Selection::default() }),
            [cages, rounds] => {
                let rounds = rounds_of(rounds).context("the number of rounds is 1 or more")?;
                Ok(Selection { cages: cages.into(), rounds })
            }
            _ => bail!("a cage and a number of rounds are all that can be chosen"),
        }
    }

    fn courses(&self) -> impl Iterator<Item = &'static Course> + use<'_> {
        COURSES.iter().filter(|course| course.cage.starts_with(&self.cages))
    }
}

/// Who is there.
struct Programs {
    rust: Found,
    opensubdiv: Result<Found, String>,
    cgal: Result<Found, String>,
    blender: Result<Found, String>,
    machine: Result<Found, String>,
}

/// One who takes part, and how exactly it computes.
struct Entry {
    contestant: Contestant,
    precision: Precision,
}

fn single(contestant: Contestant) -> Entry {
    Entry { contestant, precision: Precision::Single }
}

fn double(contestant: Contestant) -> Entry {
    Entry { contestant, precision: Precision::Double }
}

/// Times of refinement, a table for each cage, in Markdown, as they are finished.
///
/// # Errors
/// If something cannot be run.
pub(crate) fn refine(out: &mut impl Write, selection: &Selection) -> Result<()> {
    let (programs, folder) = (Programs::find()?, tempfile::tempdir()?);
    programs.describe(out)?;
    for course in selection.courses() {
        let (cage, about) = programs.write_cage(course, folder.path())?;
        let entries = programs.refiners(course);
        let reference = Figures::read(&entries[0].contestant.run("refine", &cage, &[])?)?;
        writeln!(out, "\n**{about}, level {}: {} faces.**\n", course.level, reference.faces)?;
        let limits = programs.limits(reference.bytes());
        let all: Vec<&Contestant> = entries.iter().map(|entry| &entry.contestant).chain(&limits).collect();
        let answers = rounds_of(selection.rounds, &all, "refine", &cage, &[])?;
        let table = Refined { reference: &reference, entries: &entries, answers: &answers, limits: &limits };
        write!(out, "{}", table.table()?)?;
    }
    Ok(())
}

/// Times of animated cages: set-up, and a frame.
///
/// # Errors
/// If something cannot be run.
pub(crate) fn animate(out: &mut impl Write, selection: &Selection) -> Result<()> {
    let (programs, folder) = (Programs::find()?, tempfile::tempdir()?);
    programs.describe(out)?;
    for course in selection.courses().filter(|course| course.level > 1) {
        let (cage, about) = programs.write_cage(course, folder.path())?;
        let entries = programs.animators(course);
        let contestants: Vec<&Contestant> = entries.iter().map(|entry| &entry.contestant).collect();
        let answers = rounds_of(selection.rounds, &contestants, "animate", &cage, &[FRAMES])?;
        let reference = Figures::read(answers[0].first()?)?;
        writeln!(out, "\n**{about}, level {}, animated: {} vertices.**\n", course.level, reference.vertices)?;
        let mut table = Table::new(&[
            "program",
            "set-up ms",
            "set-up MB",
            "a frame, ms: median",
            "least",
            "greatest",
            "ns a vertex",
            "/ ogee",
            "result",
        ]);
        let own = answers[0].milliseconds("frame_seconds")?.median;
        for (entry, answers) in entries.iter().zip(&answers) {
            let frame = answers.milliseconds("frame_seconds")?;
            let set_up = answers.milliseconds("set_up_seconds")?;
            let set_up_bytes = answers.spread(|answer| answer["set_up_bytes"].as_f64())?.median;
            let [median, least, greatest] = frame.cells();
            table.row(&[
                entry.contestant.name.clone(),
                places(set_up.median),
                places(set_up_bytes / 1e6),
                median,
                least,
                greatest,
                places(frame.median * 1e6 / reference.vertices as f64),
                format!("{:.2}", frame.median / own),
                verdict(entry, answers, &reference)?,
            ]);
        }
        write!(out, "{table}")?;
    }
    Ok(())
}

/// Times of reading a large cage from OBJ.
///
/// # Errors
/// If something cannot be run.
pub(crate) fn obj(out: &mut impl Write) -> Result<()> {
    let (programs, folder) = (Programs::find()?, tempfile::tempdir()?);
    writeln!(out, "{}", machine::description()?)?;
    let file = folder.path().join("large.obj");
    let [cage, text] =
        [folder.path().join("large"), file.clone()].map(|file| file.to_string_lossy().into_owned());
    programs.rust.ask(&["cage", "large", &cage, &text])?;
    let ours = programs.rust.contestant("ogee", "ours", -1);
    let entries = [
        double(ours.clone()),
        double(ours.on(2).named("ogee, 2 threads")),
        single(programs.rust.contestant("tobj, f32", "tobj", -1)),
    ];
    let contestants: Vec<&Contestant> = entries.iter().map(|entry| &entry.contestant).collect();
    let answers = rounds_of(ROUNDS, &contestants, "obj", &file, &[])?;
    let reference = Figures::read(answers[0].first()?)?;
    let bytes = answers[0].first()?["file_bytes"].as_f64().context("an answer lacks the size of its file")?;
    writeln!(
        out,
        "\n**OBJ of {} quads, {:.1} MB, from a path to points and faces.**\n",
        reference.faces,
        bytes / 1e6
    )?;
    let columns = ["program", "ms: median", "least", "greatest", "MB/s", "peak MB", "/ ogee", "result"];
    let mut table = Table::new(&columns);
    let own = answers[0].milliseconds("fresh_seconds")?.median;
    for (entry, answers) in entries.iter().zip(&answers) {
        let time = answers.milliseconds("fresh_seconds")?;
        let peak = answers.spread(|answer| answer["peak_bytes"].as_f64())?.median;
        let [median, least, greatest] = time.cells();
        table.row(&[
            entry.contestant.name.clone(),
            median,
            least,
            greatest,
            places(bytes / 1e3 / time.median),
            places(peak / 1e6),
            format!("{:.2}", time.median / own),
            verdict(entry, answers, &reference)?,
        ]);
    }
    write!(out, "{table}")?;
    Ok(())
}

/// How an entry's mesh compares with ours.
fn verdict(entry: &Entry, answers: &Answers, reference: &Figures) -> Result<String> {
    Ok(reference.compare(&Figures::read(answers.first()?)?, entry.precision))
}

impl Programs {
    fn find() -> Result<Programs> {
        Ok(Programs {
            rust: peers::rust_refinement()?,
            opensubdiv: peers::opensubdiv_refinement(),
            cgal: peers::cgal_refinement(),
            blender: peers::blender_refinement(),
            machine: peers::machine_limits(),
        })
    }

    /// The machine, and who takes part in which version.
    fn describe(&self, out: &mut impl Write) -> Result<()> {
        writeln!(out, "{}\n", machine::description()?)?;
        writeln!(out, "- Crates {}.", self.rust.version)?;
        let flags = FLAGS.join(" ");
        for (name, found, how) in [
            ("OpenSubdiv", &self.opensubdiv, format!("our side of it built with `{flags}`")),
            (
                "CGAL",
                &self.cgal,
                format!("built with `{flags}`; it knows no semi-sharp creases and is left out there"),
            ),
            ("Blender", &self.blender, "as a Python module; its modifier, connectivity made anew".to_owned()),
        ] {
            match found {
                Ok(found) => writeln!(out, "- {name} {}, {how}.", found.version)?,
                Err(missing) => writeln!(out, "- {name} is missing: {missing}.")?,
            }
        }
        if let Err(missing) = &self.machine {
            writeln!(out, "- The machine's own limits are missing: {missing}.")?;
        }
        Ok(())
    }

    /// Writes a cage for all, and says what it is.
    fn write_cage(&self, course: &Course, folder: &Path) -> Result<(PathBuf, String)> {
        let file = folder.join(course.cage);
        let written = self.rust.ask(&["cage", course.cage, &file.to_string_lossy()])?;
        let count = |key: &str| written[key].as_u64().context("an answer lacks a count");
        let mut about = format!("Gyroid of {} quads", count("faces")?);
        if course.tags == Tags::Sharp {
            about += &format!(", open, {} edges and {} vertices sharp", count("creases")?, count("corners")?);
        }
        Ok((file, about))
    }

    /// All who refine this; ourselves on one thread come first.
    fn refiners(&self, course: &Course) -> Vec<Entry> {
        let level = course.level;
        let ours = self.rust.contestant("ogee", "ours", level);
        let kernels = self.rust.contestant("subdiv-kernels, single", "subdiv-kernels", level);
        let mut entries = vec![double(ours.clone()), double(ours.on(2).named("ogee, 2 threads"))];
        if let Ok(found) = &self.opensubdiv {
            entries.push(single(found.contestant("OpenSubdiv, single", "float", level)));
            entries.push(double(found.contestant("OpenSubdiv, double", "double", level)));
        }
        entries.push(single(self.rust.contestant("opensubdiv-rs, single", "opensubdiv-rs", level)));
        entries.push(single(kernels.clone()));
        entries.push(single(kernels.on(2).named("subdiv-kernels, single, 2 threads")));
        if let (Ok(found), Tags::None) = (&self.cgal, course.tags) {
            entries.push(double(found.contestant("CGAL, double", "cgal", level)));
        }
        if let Ok(found) = &self.blender {
            entries.push(single(found.contestant("Blender, single", "blender", level)));
        }
        entries
    }

    /// All who can move a cage without making its connectivity anew; ourselves on one thread come first.
    fn animators(&self, course: &Course) -> Vec<Entry> {
        let level = course.level;
        let ours = self.rust.contestant("ogee", "ours", level);
        let mut entries = vec![double(ours.clone()), double(ours.on(2).named("ogee, 2 threads"))];
        if let Ok(found) = &self.opensubdiv {
            for (name, peer) in [
                ("OpenSubdiv, stencils, single", "stencils"),
                ("OpenSubdiv, stencils, single, 4 numbers a point", "stencils-4"),
                ("OpenSubdiv, level by level, single", "primvar"),
            ] {
                entries.push(single(found.contestant(name, peer, level)));
            }
            entries.push(double(found.contestant("OpenSubdiv, stencils, double", "stencils-double", level)));
        }
        entries.push(single(self.rust.contestant("opensubdiv-rs, stencils, single", "opensubdiv-rs", level)));
        entries.push(single(self.rust.contestant(
            "subdiv-kernels, stencils, single",
            "subdiv-kernels",
            level,
        )));
        if let Ok(found) = &self.blender {
            entries.push(single(found.contestant("Blender, single", "blender", level)));
        }
        entries
    }

    /// The machine on one thread and two, with so many bytes.
    fn limits(&self, bytes: u64) -> Vec<Contestant> {
        let on = |found: &Found, name: &str, threads| found.contestant(name, &bytes.to_string(), threads);
        self.machine
            .iter()
            .flat_map(|found| [on(found, "the machine", 1), on(found, "the machine, 2 threads", 2)])
            .collect()
    }
}

/// What became of one cage.
struct Refined<'a> {
    reference: &'a Figures,
    entries: &'a [Entry],
    /// Of the entries, then of the limits.
    answers: &'a [Answers],
    limits: &'a [Contestant],
}

impl Refined<'_> {
    fn table(&self) -> Result<Table> {
        let mut table = Table::new(&[
            "program",
            "memory",
            "ms: median",
            "least",
            "greatest",
            "ns a face",
            "bytes a face",
            "/ ogee",
            "result",
        ]);
        let (answers, machine) = self.answers.split_at(self.entries.len());
        let own = &answers[0];
        for (memory, key) in [("fresh", "fresh_seconds"), ("reused", "reused_seconds")] {
            let base = own.milliseconds(key)?.median;
            for (entry, answers) in self.entries.iter().zip(answers) {
                // Who keeps its connectivity has another task the second time.
                let Ok(time) = answers.milliseconds(key) else { continue };
                let peak = answers.spread(|answer| answer["peak_bytes"].as_f64())?.median;
                let bytes = if memory == "fresh" {
                    places(peak / self.reference.faces as f64)
                } else {
                    String::new()
                };
                let verdict = verdict(entry, answers, self.reference)?;
                table.row(&self.row(&entry.contestant.name, memory, &time, base, [bytes, verdict]));
            }
            let limits = match memory {
                "fresh" => {
                    vec![("writes", "fresh", key), ("writes", "fresh, large pages", "fresh_large_seconds")]
                }
                _ => vec![("writes", "reused", key), ("reads", "reused", "read_seconds")],
            };
            for (contestant, answers) in self.limits.iter().zip(machine) {
                for (deed, memory, key) in &limits {
                    let time = answers.milliseconds(key)?;
                    let name = format!("{} {deed} as many bytes", contestant.name);
                    table.row(&self.row(&name, memory, &time, base, [String::new(), String::new()]));
                }
            }
        }
        Ok(table)
    }

    fn row(
        &self,
        name: &str,
        memory: &str,
        time: &Spread,
        base: f64,
        [bytes, verdict]: [String; 2],
    ) -> [String; 9] {
        let [median, least, greatest] = time.cells();
        [
            name.to_owned(),
            memory.to_owned(),
            median,
            least,
            greatest,
            places(time.median * 1e6 / self.reference.faces as f64),
            bytes,
            format!("{:.2}", time.median / base),
            verdict,
        ]
    }
}

/// A figure with three digits that count.
fn places(figure: f64) -> String {
    let places = if figure < 10.0 { 2 } else { usize::from(figure < 100.0) };
    format!("{figure:.places$}")
}

impl Answers {
    /// A time that answers give in seconds.
    fn milliseconds(&self, key: &str) -> Result<Spread> {
        self.spread(|answer| Some(answer[key].as_f64()? * 1e3))
    }
}

impl Spread {
    /// Median, least and greatest for three columns.
    fn cells(&self) -> [String; 3] {
        [self.median, self.least, self.greatest].map(places)
    }
}
