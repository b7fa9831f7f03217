//! `cargo xtask bench`: whole commands as a user runs them, on cages of growing size.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use ogee::{ControlMesh, shapes};
use serde_json::Value;

/// Runs of each command; the table shows the median.
const RUNS: usize = 5;

/// One table of all commands and cages, in Markdown.
pub(crate) fn table() -> Result<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let built = Command::new(env!("CARGO"))
        .current_dir(&root)
        .args(["build", "--release", "--bin", "ogee"])
        .status()?;
    ensure!(built.success(), "the command could not be built");
    let program = root.join("target/release/ogee");
    let folder = tempfile::tempdir()?;
    let mut out = String::from(
        "| command | cage | faces out | read s | work s | write s | total s | memory MB | output MB |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    let spot = root.join("../shared/models/spot/spot_control_mesh.obj");
    let mut cages = vec![("mug".to_owned(), root.join("models/mug.obj"))];
    if spot.exists() {
        cages.push(("Spot".to_owned(), spot));
    }
    for (around, across) in [(36, 28), (120, 84), (384, 264)] {
        let mesh = shapes::studded_torus(around, across, 12);
        let name = format!("torus with studs, {} quads", mesh.faces.len());
        cages.push((name, write_cage(folder.path(), &mesh)?));
    }
    for (name, cage) in &cages {
        let part = folder.path().join("part.step");
        let arguments = [Path::new("convert"), cage, Path::new("-o"), &part];
        out += &row(&program, &arguments, name, "convert", &["faces_written"])?;
    }
    for (name, cage) in cages.iter().filter(|(name, _)| name.starts_with("torus")) {
        let fine = folder.path().join("fine.ply");
        let arguments = [Path::new("refine"), cage, Path::new("-l"), Path::new("3"), Path::new("-o"), &fine];
        out += &row(&program, &arguments, name, "refine", &["faces"])?;
    }
    Ok(out)
}

fn write_cage(folder: &Path, mesh: &ControlMesh) -> Result<std::path::PathBuf> {
    let path = folder.join(format!("{}.obj", mesh.faces.len()));
    let file = std::fs::File::create(&path).with_context(|| format!("cannot write {}", path.display()))?;
    ogee_formats::obj::write_cage(mesh, "A torus with studs, one vertex in twenty extraordinary.", file)?;
    Ok(path)
}

/// Runs a command some times and makes a row of the medians.
fn row(program: &Path, arguments: &[&Path], cage: &str, work: &str, faces: &[&str]) -> Result<String> {
    let mut reports = Vec::new();
    for _ in 0..RUNS {
        let output = Command::new(program).args(arguments).args(["--json", "--quiet"]).output()?;
        ensure!(output.status.success(), "{work} of {cage}: {}", String::from_utf8_lossy(&output.stderr));
        reports.push(serde_json::from_slice::<Value>(&output.stdout)?);
    }
    let median = |of: &dyn Fn(&Value) -> f64| {
        let mut values: Vec<f64> = reports.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[RUNS / 2]
    };
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let seconds = |part: &str| median(&|report| number(&report["seconds"][part]));
    let total =
        median(&|report| ["read", work, "write"].iter().map(|part| number(&report["seconds"][*part])).sum());
    let megabytes = |key: &str| median(&|report| number(&report[key])) / 1e6;
    let count = median(&|report| faces.iter().map(|key| number(&report[*key])).sum());
    Ok(format!(
        "| {work} | {cage} | {count} | {:.3} | {:.3} | {:.3} | {total:.3} | {:.0} | {:.1} |\n",
        seconds("read"),
        seconds(work),
        seconds("write"),
        megabytes("peak_bytes"),
        megabytes("file_bytes"),
    ))
}
