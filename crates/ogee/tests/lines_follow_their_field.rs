//! Lines of a field: every point has the line's value, chords are as close as asked, and lines end only where they may.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;
mod views;

use ogee::quality::{Field, LevelLine, Levels, LineOptions, Side, Surface, level_lines};
use ogee::{ControlMesh, Derivatives, Flags, Location, Samples, Vec3, shapes};
use views::{TOLERANCE, every_field, size, trace, with_view};

/// Of the size of the surface, or of the field where it is a cosine.
const RESIDUAL: f64 = 1e-12;

fn field_size(field: &Field, view: &dyn Surface) -> f64 {
    if matches!(field, Field::Plane { .. }) { size(view) } else { 1.0 }
}

/// A field on a plane without an end: rounding may put a point beyond the end of one that has it.
fn unbounded(field: &Field) -> Field {
    let mut field = *field;
    if let Field::Plane { light, .. } = &mut field {
        light.half = [f64::INFINITY; 2];
    }
    field
}

/// How far the field is from the value of the line at its points.
fn residual(view: &dyn Surface, field: &Field, line: &LevelLine) -> f64 {
    let field = unbounded(field);
    let at: Vec<_> = line.points.iter().map(|point| point.at).collect();
    let mut samples = Samples::default();
    view.evaluate(&at, Derivatives::First, &mut samples);
    let rest = |k: usize| {
        assert_eq!(samples.position[k], line.points[k].position);
        assert!(!samples.flags[k].contains(Flags::NORMAL_UNDEFINED));
        (field.value(samples.position[k], samples.normal[k]).unwrap() - line.value).abs()
    };
    (0..at.len()).map(rest).fold(0.0, f64::max)
}

#[test]
fn every_point_has_the_value_of_its_line() {
    let (mut most, mut lines) = (0.0_f64, 0);
    let cages = cages::all();
    let count = cages.len();
    for (name, mesh) in cages {
        with_view(&mesh, |view| {
            for (kind, field, levels) in every_field(view) {
                let found = trace(view, &field, &levels);
                for line in &found.lines {
                    let rest = residual(view, &field, line) / field_size(&field, view);
                    assert!(rest <= RESIDUAL, "{name}, {kind}: {rest:e}");
                    most = most.max(rest);
                    assert!(line.points.len() > 1);
                    assert_eq!(line.closed, line.points[0] == line.points[line.points.len() - 1]);
                }
                lines += found.lines.len();
                let size = field_size(&field, view);
                assert!(found.max_residual <= RESIDUAL * size, "{name}, {kind}");
            }
        });
    }
    println!("{lines} lines on {count} cages, largest residual {most:e}");
    assert!(lines > 5_000);
}

/// The distance from a chord to the line in the direction across it, found by halving; `None` where the ends are on
/// different faces, or the line is not met within a hundred tolerances.
fn off_chord(
    view: &dyn Surface,
    field: &Field,
    value: f64,
    chord: [(Location, Vec3); 2],
    share: f64,
) -> Option<f64> {
    let [(from, p), (to, q)] = chord;
    if from.parametric_face() != to.parametric_face() {
        return None;
    }
    let ([a, b], [c, d]) = (from.parameters(), to.parameters());
    let (u, v) = (a + share * (c - a), b + share * (d - b));
    let mut samples = Samples::default();
    let mut at = |x: f64| {
        // Across the chord in the plane of parameters.
        let location = from.at(u - x * (d - b), v + x * (c - a)).ok()?;
        view.evaluate(&[location], Derivatives::First, &mut samples);
        Some((samples.position[0], field.value(samples.position[0], samples.normal[0])? - value))
    };
    let (position, middle) = at(0.0)?;
    let chord_point = p.lerp(q, share);
    let mut best = None;
    for side in [-0.5, 0.5] {
        let Some((_, end)) = at(side) else { continue };
        if (end < 0.0) == (middle < 0.0) {
            continue;
        }
        let (mut near, mut far, mut found) = (0.0, side, position);
        for _ in 0..60 {
            let half = 0.5 * (near + far);
            let (there, rest) = at(half)?;
            found = there;
            if (rest < 0.0) == (middle < 0.0) { near = half } else { far = half }
        }
        let away = found - chord_point;
        let along = (q - p).normalized()?;
        let off = (away - away.dot(along) * along).length();
        best = Some(best.map_or(off, |best: f64| best.min(off)));
    }
    best
}

#[test]
fn chords_are_as_close_as_asked() {
    let meshes = [
        cages::cube(),
        cages::disk(5),
        cages::pyramid(),
        shapes::torus(6, 5),
        cages::voxels(&[[0, 0, 0], [1, 0, 0], [1, 1, 0]]),
    ];
    let (mut worst, mut looked) = (0.0_f64, 0);
    for mesh in meshes {
        with_view(&mesh, |view| {
            for (kind, field, levels) in every_field(view) {
                // Where cells alone are not fine enough.
                for share in [0.3, 0.03] {
                    let tolerance = share * TOLERANCE * size(view);
                    let found = level_lines(view, &field, &levels, &LineOptions::new(tolerance)).unwrap();
                    assert_eq!(found.straight, 0);
                    let field = unbounded(&field);
                    for line in &found.lines {
                        for pair in line.points.windows(2).step_by(5) {
                            let chord = [0, 1].map(|k| (pair[k].at, pair[k].position));
                            for part in [0.21, 0.5, 0.63] {
                                let Some(off) = off_chord(view, &field, line.value, chord, part) else {
                                    continue;
                                };
                                looked += 1;
                                worst = worst.max(off / tolerance);
                                assert!(off <= tolerance, "{kind}: {off:e} of {tolerance:e}");
                            }
                        }
                    }
                }
            }
        });
    }
    println!("{looked} places looked at, at most {worst} of the tolerance");
    assert!(looked > 50_000 && worst > 0.5);
}

/// True if a line may end at a place: on a border or a sharp crease, or less than a hundredth of
/// a face from a vertex without a tangent plane.
fn may_end(view: &dyn Surface, at: Location) -> bool {
    let layout = view.layout();
    let is_end = |square: u32, side: u32| match layout.joint_of(Side { square, side }) {
        Some(joint) => layout.joints()[joint].is_sharp,
        None => true,
    };
    let has_plane = |corner: Location| {
        let mut samples = Samples::default();
        view.evaluate(&[corner], Derivatives::First, &mut samples);
        let flags = samples.flags[0];
        !flags.contains(Flags::NORMAL_UNDEFINED) && !flags.contains(Flags::NORMAL_ONE_SIDED)
    };
    let [u, v] = at.parameters();
    let squares = (0..).zip(layout.squares());
    let mine = squares.filter(|(_, square)| square.corner.parametric_face() == at.parametric_face());
    mine.into_iter().any(|(number, square)| {
        let [a, b] = square.corner.parameters();
        let (s, t) = ((u - a) / square.size[0], (v - b) / square.size[1]);
        let on = [t == 0.0, s == 1.0, t == 1.0, s == 0.0];
        let beside = |x: f64, y: f64| (x - y).abs() < 0.01;
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        (0..4).any(|side| on[side as usize] && is_end(number, side))
            || corners.iter().any(|&[x, y]| beside(s, x) && beside(t, y) && !has_plane(square.at(x, y)))
    })
}

#[test]
fn isophotes_end_only_at_borders_and_sharp_creases() {
    let (mut open, mut closed) = (0, 0);
    // The rim of two faces on the same four vertices is a fold, where normals leap; so they may at a sharp vertex.
    // And where curves meet that are not in a plane.
    let has_leaps = |name: &str, mesh: &ControlMesh| {
        name == "pillow" || !mesh.corners.is_empty() || !mesh.meetings.is_empty()
    };
    for (name, mesh) in cages::all().into_iter().filter(|(name, mesh)| !has_leaps(name, mesh)) {
        with_view(&mesh, |view| {
            let (_, field, levels) = every_field(view).swap_remove(2);
            for line in trace(view, &field, &levels).lines {
                if line.closed {
                    closed += 1;
                    continue;
                }
                open += 1;
                for end in [line.points[0], line.points[line.points.len() - 1]] {
                    assert!(may_end(view, end.at), "{name}: {:?}", end.at);
                }
            }
        });
    }
    assert!(open > 20 && closed > 20, "{open} {closed}");
}

#[test]
fn on_a_closed_convex_body_isophotes_are_closed() {
    for mesh in [shapes::cube(), cages::prism(6), cages::octahedron()] {
        with_view(&mesh, |view| {
            let (_, field, levels) = every_field(view).swap_remove(2);
            let found = trace(view, &field, &levels);
            assert_eq!(found.lines.len(), 11, "one for every fifteen degrees");
            assert!(found.lines.iter().all(|line| line.closed));
            assert!(found.lines.windows(2).all(|pair| pair[0].value < pair[1].value));
        });
    }
}

#[test]
fn lines_end_on_each_side_of_a_sharp_crease() {
    let mesh = cages::creased(shapes::cube(), &cages::TOP, 10.0);
    with_view(&mesh, |view| {
        let (_, field, levels) = every_field(view).swap_remove(2);
        let found = trace(view, &field, &levels);
        let open: Vec<&LevelLine> = found.lines.iter().filter(|line| !line.closed).collect();
        assert!(open.len() > 3, "{}", open.len());
        for line in open {
            for end in [line.points[0], line.points[line.points.len() - 1]] {
                assert!(may_end(view, end.at));
            }
        }
    });
}

/// All points of all lines, in the order of their values, then from bottom to top.
fn places(mesh: &ControlMesh, field: &Field, levels: &Levels) -> (usize, Vec<(i64, Vec3)>) {
    with_view(mesh, |view| {
        let options = LineOptions::new(2.0 * TOLERANCE);
        let lines = level_lines(view, field, levels, &options).unwrap().lines;
        let mut places: Vec<(i64, Vec3)> = Vec::new();
        for line in &lines {
            let points = &line.points[usize::from(line.closed)..];
            places.extend(points.iter().map(|point| (line.index, point.position)));
        }
        (lines.len(), places)
    })
}

#[test]
fn numbering_a_cage_otherwise_changes_no_line() {
    for mesh in [cages::cube(), cages::pyramid(), cages::grid(4, 3)] {
        // The faces from the last to the first, each begun at its third corner.
        let mut other = mesh.clone();
        let mut faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
        faces.reverse();
        faces.iter_mut().for_each(|face| face.rotate_left(2));
        other.faces = ogee::FaceList::new();
        faces.iter().for_each(|face| other.faces.push(face));
        for (_, field, levels) in with_view(&mesh, |view| every_field(view)) {
            let (count, one) = places(&mesh, &field, &levels);
            let (others, two) = places(&other, &field, &levels);
            assert_eq!((count, one.len()), (others, two.len()));
            let gap = |&(index, p): &(i64, Vec3)| {
                let same = two.iter().filter(|(other, _)| *other == index);
                same.map(|(_, q)| p.distance(*q)).fold(f64::INFINITY, f64::min)
            };
            let gaps = one.iter().map(gap).fold(0.0, f64::max);
            assert!(gaps < 1e-9, "{gaps:e}");
        }
    }
}

#[test]
fn turning_a_cage_with_its_light_turns_its_lines() {
    let (sine, cosine) = 0.7_f64.sin_cos();
    let turned = |p: Vec3| Vec3::new(cosine * p.x - sine * p.z, p.y, sine * p.x + cosine * p.z);
    let mesh = cages::cube();
    let mut other = mesh.clone();
    other.points.iter_mut().for_each(|p| *p = turned(*p));
    let light = Vec3::new(0.36, 0.48, 0.8);
    let levels = Levels::Every { first: 0.03, period: 0.11 };
    let (count, one) = places(&mesh, &Field::Isophote { light }, &levels);
    let (others, two) = places(&other, &Field::Isophote { light: turned(light) }, &levels);
    assert_eq!((count, one.len()), (others, two.len()));
    for ((_, p), (_, q)) in one.iter().zip(&two) {
        assert!(turned(*p).distance(*q) < 1e-9);
    }
}
