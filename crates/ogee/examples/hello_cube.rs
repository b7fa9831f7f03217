//! Rounds a cube by refinement, and writes the fine mesh as an OBJ file by hand.
//!
//! ```text
//! cargo run -p ogee --example hello_cube [OUT.obj]
//! ```

use std::fmt::Write;

use ogee::{Level, Refinement, shapes};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).unwrap_or_else(|| "hello_cube.obj".to_owned());

    // Plain data: eight points, six faces.
    let cube = shapes::cube();

    // The gate. A level is connectivity and rules; a mesh with a defect gets no further than this.
    let level = Level::new(&cube)?;

    // Three steps, as weights. No point has been touched yet.
    let refinement = Refinement::uniform(&level, 3)?;

    // Now the points. The same weights serve any pose of the cube, and anything else that it carries.
    let points = refinement.apply(&cube.points);
    let quads = refinement.finest().quads();
    assert_eq!((points.len(), quads.len()), (386, 384));

    let mut text = String::from("# a cube, three refinements on\n");
    for p in &points {
        writeln!(text, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for [a, b, c, d] in &quads {
        // OBJ counts from 1.
        writeln!(text, "f {} {} {} {}", a + 1, b + 1, c + 1, d + 1)?;
    }
    std::fs::write(out, text)?;
    Ok(())
}
