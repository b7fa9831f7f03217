//! The same places on every face are what one gets by asking for each of them: to rounding, with the same flags.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use std::ops::Range;
use std::sync::Mutex;

use cages::{locate, visible};
use ogee::{
    ControlMesh, Derivatives, FaceId, Level, LimitSurface, Location, LocationError, PatchTable, Samples,
    Vec3, shapes,
};

const ALL: [Derivatives; 3] = [Derivatives::None, Derivatives::First, Derivatives::Second];

/// Centres of cells.
fn centres(side: u32) -> Vec<[f64; 2]> {
    let centre = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
    (0..side * side).map(|k| [centre(k % side), centre(k / side)]).collect()
}

/// Corners and edges, places close to corners, and of no order; not all fours are full.
fn special() -> Vec<[f64; 2]> {
    let mut places =
        vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5], [0.5, 0.0], [1.0, 0.25]];
    for small in [0.13, 0.06, 0.03, 0.01, 1e-3, 1e-9] {
        places.extend([
            [small, 0.3 * small],
            [1.0 - small, small],
            [1.0 - 0.2 * small, 1.0 - small],
            [0.0, 1.0 - small],
        ]);
    }
    places.extend([[1e-300, 0.0], [0.31, 0.77], [0.77, 0.31]]);
    places
}

/// Corners of rectangles in the order of columns from above, among them narrow ones and places that are given twice.
fn lattice() -> Vec<[f64; 2]> {
    let lines = [1.0, 0.99, 0.8, 0.55, 0.5, 0.3, 0.25];
    let mut places: Vec<[f64; 2]> = lines.iter().flat_map(|&u| lines.map(|v| [u, v])).collect();
    places.extend_from_within(9..13);
    places
}

/// Visible faces that follow one another.
fn runs(table: &PatchTable) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for face in visible(table) {
        match runs.last_mut() {
            Some(run) if run.end == face => run.end += 1,
            _ => runs.push(face..face + 1),
        }
    }
    runs
}

/// False where tangents are parallel or vanish but for rounding, which then decides whether there is a normal: on a fold.
fn has_plane(samples: &Samples, k: usize) -> bool {
    let (du, dv) = (samples.du[k], samples.dv[k]);
    let longest = du.length().max(dv.length());
    du.cross(dv).length() > 1e-12 * longest * longest
}

/// Greatest differences, in roundings of the size: of positions, first derivatives, normals, second derivatives.
fn compare(name: &str, mesh: &ControlMesh, places: &[[f64; 2]], what: Derivatives) -> [f64; 4] {
    let table = PatchTable::new(&Level::new(mesh).unwrap());
    let surface = LimitSurface::new(&table, &mesh.points);
    let pattern = table.pattern(places, what).unwrap();
    assert_eq!((pattern.len(), pattern.is_empty()), (places.len(), places.is_empty()));
    let greatest = mesh.points.iter().fold(0.0, |most: f64, p| most.max(p.length()));
    let mut worst = [0.0_f64; 4];
    let mut got = Samples::default();
    for run in runs(&table) {
        surface.eval_pattern(&pattern, run.clone(), &mut got).unwrap();
        let at: Vec<Location> = run
            .flat_map(|face| places.iter().map(move |&[u, v]| (face, u, v)))
            .map(|(face, u, v)| locate(&table, face, u, v))
            .collect();
        let wanted = surface.eval_batch(&at, what);
        for k in 0..at.len() {
            if what == Derivatives::None || has_plane(&wanted, k) {
                assert_eq!(got.flags[k], wanted.flags[k], "{name}: {:?}", at[k]);
            } else {
                (got.normal[k], got.flags[k]) = (wanted.normal[k], wanted.flags[k]);
            }
        }
        let mut difference = |of: usize, a: &[Vec3], b: &[Vec3], scale: &dyn Fn(usize) -> f64| {
            assert_eq!(a.len(), b.len(), "{name}");
            for k in 0..a.len() {
                let error = if a[k] == b[k] { 0.0 } else { a[k].distance(b[k]) / scale(k) };
                assert!(!error.is_nan(), "{name}: {:?} {:?} at {:?}", a[k], b[k], at[k]);
                worst[of] = worst[of].max(error);
            }
        };
        difference(0, &got.position, &wanted.position, &|_| greatest);
        let first = |k: usize| wanted.du[k].length().max(wanted.dv[k].length());
        difference(1, &got.du, &wanted.du, &first);
        difference(1, &got.dv, &wanted.dv, &first);
        difference(2, &got.normal, &wanted.normal, &|_| 1.0);
        let second = |k: usize| {
            [&wanted.duu, &wanted.duv, &wanted.dvv]
                .into_iter()
                .fold(first(k), |most, part| most.max(part[k].length()))
        };
        difference(3, &got.duu, &wanted.duu, &second);
        difference(3, &got.duv, &wanted.duv, &second);
        difference(3, &got.dvv, &wanted.dvv, &second);
    }
    worst
}

/// What rounding may leave: of positions, first derivatives, normals, second derivatives. These lose most below ten splits.
const TOLERANCES: [f64; 4] = [1e-15, 2e-14, 1e-13, 5e-13];

#[test]
fn on_cages_of_every_kind() {
    let mut cages = cages::all();
    cages.push(("body".into(), cages::body()));
    for (name, mesh) in cages {
        for places in [centres(4), special(), lattice(), centres(8), centres(9), centres(1), vec![]] {
            for what in ALL {
                let worst = compare(&name, &mesh, &places, what);
                assert!(
                    worst.iter().zip(TOLERANCES).all(|(error, most)| *error <= most),
                    "{name}, {} places: {worst:?}",
                    places.len()
                );
            }
        }
    }
}

/// Differences of points that are rounded far from the origin are exact; only the position's last sum sees where it is.
#[test]
fn far_from_the_origin() {
    let far = Vec3::new(1e6, -3e6, 2e6);
    for mut mesh in [cages::body(), cages::disk(7), shapes::torus(9, 7)] {
        mesh.points.iter_mut().for_each(|point| *point += far);
        let worst = compare("far", &mesh, &centres(4), Derivatives::Second);
        assert!(worst.iter().zip(TOLERANCES).all(|(error, most)| *error <= most), "{worst:?}");
    }
}

#[test]
fn on_any_number_of_threads_and_in_any_parts() {
    for mesh in [shapes::studded_torus(40, 30, 5), cages::pyramid()] {
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        let surface = LimitSurface::new(&table, &mesh.points);
        let places = special();
        for what in ALL {
            let mut all: Vec<Samples> = Vec::new();
            for threads in [1, 2, 5] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let mut samples = Samples::default();
                pool.install(|| {
                    let pattern = table.pattern(&places, what).unwrap();
                    surface.eval_pattern(&pattern, 0..table.len(), &mut samples).unwrap();
                });
                all.push(samples);
            }
            assert!(all.iter().all(|samples| *samples == all[0]));
            // Memory that is used again may hold anything.
            let mut samples = all[1].clone();
            let pattern = table.pattern(&places, what).unwrap();
            for faces in [3..7, 0..1, table.len() - 5..table.len(), 2..2] {
                surface.eval_pattern(&pattern, faces.clone(), &mut samples).unwrap();
                let part = faces.start * places.len()..faces.end * places.len();
                assert_eq!(samples.position[..], all[0].position[part.clone()]);
                if what > Derivatives::None {
                    assert_eq!(samples.normal[..], all[0].normal[part.clone()]);
                }
                assert_eq!(samples.flags[..], all[0].flags[part]);
            }
        }
    }
}

#[test]
fn blocks_are_the_whole_in_parts() {
    for mesh in [shapes::studded_torus(40, 30, 5), cages::pyramid()] {
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        let surface = LimitSurface::new(&table, &mesh.points);
        for (places, what) in [(special(), Derivatives::Second), (centres(1), Derivatives::First)] {
            let pattern = table.pattern(&places, what).unwrap();
            let mut wanted = Samples::default();
            for faces in [0..table.len(), 2..table.len() - 1, 3..4, 5..5] {
                surface.eval_pattern(&pattern, faces.clone(), &mut wanted).unwrap();
                let blocks = Mutex::new(Vec::new());
                let take = |some: Range<usize>, samples: &Samples| {
                    blocks.lock().unwrap().push((some.start, some.end, samples.clone()));
                };
                surface.visit_pattern(&pattern, faces.clone(), take).unwrap();
                let mut blocks = blocks.into_inner().unwrap();
                blocks.sort_by_key(|&(first, ..)| first);
                let mut next = faces.start;
                for (first, end, samples) in blocks {
                    assert_eq!(first, next);
                    let part = (first - faces.start) * places.len()..(end - faces.start) * places.len();
                    assert_eq!(samples.position[..], wanted.position[part.clone()]);
                    assert_eq!(samples.normal[..], wanted.normal[part.clone()]);
                    assert_eq!(samples.flags[..], wanted.flags[part]);
                    next = end;
                }
                assert_eq!(next, faces.end);
            }
        }
    }
}

#[test]
fn places_are_checked() {
    let mesh = shapes::cube();
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    for bad in [[f64::NAN, 0.5], [0.5, f64::INFINITY], [-1e-300, 0.0], [0.0, 1.0 + f64::EPSILON]] {
        let places = [[0.0, 1.0], bad, [2.0, 2.0]];
        let error = table.pattern(&places, Derivatives::First).unwrap_err();
        let LocationError::OutsideSquare { u, v } = error else { panic!("{error}") };
        assert_eq!([u, v].map(f64::to_bits), bad.map(f64::to_bits));
    }
}

#[test]
fn hidden_faces_are_refused() {
    let mesh = cages::with_holes(cages::grid(4, 4), &[5, 6]);
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let surface = LimitSurface::new(&table, &mesh.points);
    let pattern = table.pattern(&centres(2), Derivatives::First).unwrap();
    let mut samples = Samples::default();
    surface.eval_pattern(&pattern, 7..16, &mut samples).unwrap();
    let before = samples.clone();
    for (faces, hidden) in [(0..16, 5), (5..6, 5), (6..16, 6), (0..7, 5)] {
        let error = surface.eval_pattern(&pattern, faces.clone(), &mut samples).unwrap_err();
        assert_eq!(error, LocationError::HiddenFace { face: FaceId(hidden) });
        let never = |_, _: &Samples| panic!("a hidden face is no part of the surface");
        assert_eq!(surface.visit_pattern(&pattern, faces, never).unwrap_err(), error);
    }
    assert_eq!(samples, before);
    surface.eval_pattern(&pattern, 0..5, &mut samples).unwrap();
    assert_eq!(samples.position.len(), 20);
}

#[test]
#[should_panic = "the pattern is of another table"]
fn patterns_stay_with_their_table() {
    let mesh = shapes::cube();
    let level = Level::new(&mesh).unwrap();
    let (table, other) = (PatchTable::new(&level), PatchTable::new(&level));
    let pattern = other.pattern(&centres(2), Derivatives::First).unwrap();
    let _ = LimitSurface::new(&table, &mesh.points).eval_pattern(&pattern, 0..1, &mut Samples::default());
}

#[test]
#[should_panic = "there are 6 parametric faces"]
fn faces_are_counted() {
    let mesh = shapes::cube();
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let pattern = table.pattern(&centres(2), Derivatives::First).unwrap();
    let _ = LimitSurface::new(&table, &mesh.points).eval_pattern(&pattern, 0..7, &mut Samples::default());
}
