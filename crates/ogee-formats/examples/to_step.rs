//! The whole journey: a cage from an OBJ file, a solid in a STEP file, and the figures that belong to it.
//!
//! ```text
//! cargo run --release -p ogee-formats --example to_step [CAGE.obj [OUT.step]]
//! ```

use std::path::Path;

use ogee::convert;
use ogee_formats::{CageFormat, read_cage, step};

#[expect(clippy::print_stdout, reason = "the figures are what one wants to see")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let cage = arguments.next().unwrap_or_else(|| "models/mug.obj".to_owned());
    let out = arguments.next().unwrap_or_else(|| "to_step.step".to_owned());

    // A reader takes bytes: which file they come from is not its business.
    let format = CageFormat::from_path(Path::new(&cage)).ok_or("no cage format has this ending")?;
    let mesh = read_cage(&std::fs::read(&cage)?, format)?.mesh;

    // Checked, refined, smoothed, packed, sewn and measured.
    let part = convert::to_part(&mesh, &convert::Options::default())?;

    // Equal parts and options give equal bytes: the time of day is the caller's to add.
    let options = step::Options { name: "example".to_owned(), ..step::Options::default() };
    let mut text = Vec::new();
    step::write(&part, &options, &mut text)?;

    // Read the text back, trusting nothing.
    let check = step::check(&text);
    assert!(check.is_clean(), "{:?}", check.faults);
    std::fs::write(&out, text)?;

    let report = &part.report;
    println!(
        "{} cage faces, {} patches, {} faces written",
        report.cage_faces, report.patches, report.faces_written
    );
    println!("{} solids, volume {:?}", report.solids, report.volume);
    println!("largest angle over smooth edges {:.1e} degrees", report.max_normal_angle_deg);
    println!("largest gap between two sides of an edge {:.1e}", report.max_gap);
    println!("largest deviation {:.1e} of the size", report.max_deviation_relative);
    Ok(())
}
