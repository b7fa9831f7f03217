//! Four boxes in a row whose upper rims differ in nothing but sharpness: 0, 1, 2.5 and infinite.
//!
//! ```text
//! cargo run -p ogee --example creases [OUT.obj]
//! ```

use std::fmt::Write;

use ogee::{Crease, Level, Sharpness, Vec3, limit_vertices, shapes};

/// The upper rim of the cube, edge by edge.
const RIM: [[u32; 2]; 4] = [[4, 5], [5, 7], [7, 6], [6, 4]];

/// Steps of refinement: enough for every finite sharpness here to fade.
const DEPTH: u32 = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).unwrap_or_else(|| "creases.obj".to_owned());
    let mut text = String::from("# sharpness 0, 1, 2.5, infinite\n");
    let mut before = 0;
    for (place, sharpness) in [0.0, 1.0, 2.5, f64::INFINITY].into_iter().enumerate() {
        let mut mesh = shapes::cube();
        for point in &mut mesh.points {
            *point += Vec3::new(3.0 * place as f64, 0.0, 0.0);
        }
        // Values of 10 and more never fade.
        let sharpness = Sharpness::from_value(sharpness);
        mesh.creases = RIM.map(|vertices| Crease { vertices, sharpness }).to_vec();

        // Points alone this time: with no table to keep, refinement is quicker.
        let (mut level, mut points) = Level::new(&mesh)?.refine_points(&mesh.points);
        for _ in 1..DEPTH {
            (level, points) = level.refine_points(&points);
        }

        // Every vertex at the place where further refinement would take it, with the surface's own normal.
        let limits = limit_vertices(&level, &points);
        for limit in &limits {
            let (p, n) = (limit.position, limit.normal.unwrap_or(Vec3::ZERO));
            writeln!(text, "v {} {} {}\nvn {} {} {}", p.x, p.y, p.z, n.x, n.y, n.z)?;
        }
        for quad in level.quads() {
            let [a, b, c, d] = quad.map(|v| before + v + 1);
            writeln!(text, "f {a}//{a} {b}//{b} {c}//{c} {d}//{d}")?;
        }
        before += limits.len() as u32;
    }
    std::fs::write(out, text)?;
    Ok(())
}
