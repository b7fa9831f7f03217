//! A wing whose tips have vertices of valence 2, three ways: polar caps, bi-4 rings, another cage; each a solid in STEP.
//!
//! ```text
//! cargo run -p ogee-formats --example lens [FOLDER]
//! ```

#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use std::fs::File;
use std::path::PathBuf;

use ogee::lens::{self, Method};
use ogee::{convert, shapes};
use ogee_formats::step;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let wing = shapes::lens();
    for method in [Method::Polar, Method::C2, Method::Merge] {
        let options = convert::Options {
            lens: lens::Options { method, ..lens::Options::default() },
            ..convert::Options::default()
        };
        let part = convert::to_part(&wing, &options)?;

        let report = &part.report;
        println!(
            "{}: {} faces, angles to {:.1e} degrees",
            method.name(),
            report.faces_written,
            report.max_normal_angle_deg
        );
        for lens in &report.lenses {
            println!("  vertex {}: {}", lens.vertex, lens.reason);
        }
        let mut out = File::create(folder.join(format!("wing-{}.step", method.name())))?;
        step::write(&part, &step::Options::default(), &mut out)?;
    }
    Ok(())
}
