//! `LimitSurface`, which multiplies, against `stam`, which diagonalises: no code in common but `math`.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and says what it saw"
)]

mod golden;
mod rings;

use golden::{cage, documents, index, list, number, point};
use ogee::stam::Eigenbasis;
use ogee::{FaceId, Flags, Level, LimitSurface, PatchTable, SurfaceJet, VertexId};
use rings::{CornerFrame, DIRECTIONS, bumpy_disk, errors, shown, take};

/// Of positions, on cages of size 4; and of derivatives, relative to the largest of their order. Reached at the valences
/// below: 2e-15, 5e-15 and 2e-13.
const TOLERANCE: [f64; 3] = [1e-13, 1e-12, 1e-11];

#[test]
fn on_random_rings() {
    for valence in [3, 5, 6, 7, 8, 12, 20, 50] {
        let mesh = bumpy_disk(valence, 0.0, u64::from(valence));
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let basis = Eigenbasis::new(valence as usize);
        let mut worst = [0.0_f64; 3];
        for frame in CornerFrame::around(level.topology(), VertexId(0)) {
            let projected = basis.project(&take(&mesh.points, &frame.ring(level.topology())));
            for depth in 0..=20 {
                let scale = 0.5_f64.powi(depth);
                for (x, y) in DIRECTIONS {
                    let ([u, v], [x, y]) = frame.parameters((scale * x, scale * y));
                    let wanted = frame.turned(projected.eval(x, y));
                    let found = surface.jet(table.locate(frame.face, None, u, v).unwrap());
                    for (worst, error) in worst.iter_mut().zip(errors(&found.jet, &wanted)) {
                        *worst = worst.max(error);
                    }
                }
            }
        }
        println!("valence {valence}: position, first, second derivatives differ by {}", shown(&worst));
        for (error, tolerance) in worst.into_iter().zip(TOLERANCE) {
            assert!(error < tolerance, "valence {valence}: {worst:?}");
        }
    }
}

/// As deep as `stam` goes, which is 1e-100, every step is made: no rule takes over, and nothing is left out.
#[test]
fn down_to_the_least_parameter() {
    for valence in [3, 5, 6, 8, 20] {
        let mesh = bumpy_disk(valence, 0.0, u64::from(valence));
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let basis = Eigenbasis::new(valence as usize);
        // Parameters this small exist in one corner frame only.
        let frames = CornerFrame::around(level.topology(), VertexId(0));
        let frame = frames.iter().find(|frame| frame.corner == 0).unwrap();
        let projected = basis.project(&take(&mesh.points, &frame.ring(level.topology())));
        let mut most = [0.0_f64; 4];
        for scale in [1e-19, 1e-20, 1e-25, 1e-40, 1e-60, 1e-90, 1e-100] {
            for (x, y) in DIRECTIONS {
                let (x, y) = (scale * x, scale * y);
                let wanted = projected.eval(x, y);
                let found = surface.jet(table.locate(frame.face, None, x, y).unwrap());
                assert_eq!(found.flags, Flags::NONE);
                let angle = found.normal.angle(wanted.normal().unwrap());
                let [position, first, second] = errors(&found.jet, &wanted);
                for (most, error) in most.iter_mut().zip([position, angle, first, second]) {
                    *most = most.max(error);
                }
            }
        }
        println!("valence {valence}: position, normal, first, second derivatives differ by {}", shown(&most));
        for (error, tolerance) in most.into_iter().zip([1e-15, 1e-12, 1e-12, 1e-11]) {
            assert!(error < tolerance, "valence {valence}: {most:?}");
        }
    }
}

/// The golden samples on faces with one extraordinary vertex, which refinement by a program that is not this one gave.
#[test]
fn the_eigenbasis_gives_the_golden_samples() {
    let mut count = 0;
    for (name, document) in documents("evaluation") {
        if !name.starts_with("star") {
            continue;
        }
        let mesh = cage(&document["mesh"], &serde_json::Value::Null);
        let level = Level::new(&mesh).unwrap();
        let frames = CornerFrame::around(level.topology(), VertexId(0));
        let basis = Eigenbasis::new(frames.len());
        let mut worst = [0.0_f64; 3];
        for sample in list(&document["samples"]) {
            let face = FaceId(index(&sample["face"]));
            let Some(frame) = frames.iter().find(|frame| frame.face == face) else { continue };
            assert_eq!(frame.corner, 0, "the stars have their vertex first");
            let ring = take(&mesh.points, &frame.ring(level.topology()));
            let (u, v) = (number(&sample["u"]), number(&sample["v"]));
            let at = |name: &str| point(&sample[name]);
            let wanted = SurfaceJet {
                position: at("S"),
                du: at("Su"),
                dv: at("Sv"),
                duu: at("Suu"),
                duv: at("Suv"),
                dvv: at("Svv"),
            };
            let error = errors(&basis.eval(&ring, u, v), &wanted);
            // The program that made them worked on points as they lie, which costs derivatives their digits close to
            // the vertex; the claim about normals there looks closer.
            let relative = if u.max(v) < 1e-3 { 1e-6 } else { 1e-10 };
            assert!(error[0] < 1e-12 && error[1].max(error[2]) < relative, "{name} at ({u}, {v}): {error:?}");
            for (worst, error) in worst.iter_mut().zip(error) {
                *worst = worst.max(error);
            }
            count += 1;
        }
        println!("{name}: {}", shown(&worst));
    }
    assert!(count > 50, "only {count} golden samples on faces at the vertex");
}
