//! Many points at once are the same as one after the other, to the last bit, in any order and on any number of
//! threads.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{locate, noise, visible};
use ogee::{ControlMesh, Derivatives, Level, LimitSurface, Location, PatchTable, Samples, Vec3};

fn bits(v: Vec3) -> [u64; 3] {
    <[f64; 3]>::from(v).map(f64::to_bits)
}

/// Random places, corners and edges among them.
fn places(table: &PatchTable, count: usize) -> Vec<Location> {
    let mut next = noise(count as u64);
    let faces = visible(table);
    let parameter = |x: f64| match (x * 64.0) as u32 {
        0..5 => 0.0,
        5..8 => 1.0,
        8..14 => x * x * x * 1e-6,
        _ => x,
    };
    (0..count)
        .map(|_| {
            let [f, u, v] = [next(), next(), next()].map(|x| x + 0.5);
            let number = faces[((f * faces.len() as f64) as usize).min(faces.len() - 1)];
            locate(table, number, parameter(u), parameter(v))
        })
        .collect()
}

fn assert_same(name: &str, surface: &LimitSurface, at: &[Location], what: Derivatives, got: &Samples) {
    let full =
        |list: &[Vec3], wanted: bool| assert_eq!(list.len(), if wanted { at.len() } else { 0 }, "{name}");
    full(&got.position, true);
    assert_eq!(got.flags.len(), at.len());
    let (first, second) = (what >= Derivatives::First, what >= Derivatives::Second);
    [&got.du, &got.dv, &got.normal].into_iter().for_each(|list| full(list, first));
    [&got.duu, &got.duv, &got.dvv].into_iter().for_each(|list| full(list, second));
    for (k, &place) in at.iter().enumerate() {
        let wanted = surface.jet(place);
        let lone = surface.eval(place);
        let same = |list: &[Vec3], v: Vec3, of: &str| {
            assert_eq!(bits(list[k]), bits(v), "{name}: {of} of {place:?}: {:?}, not {v:?}", list[k]);
        };
        same(&got.position, wanted.jet.position, "position");
        same(&got.position, lone.position, "position");
        if first {
            same(&got.du, wanted.jet.du, "du");
            same(&got.dv, wanted.jet.dv, "dv");
            same(&got.normal, wanted.normal, "normal");
            same(&got.du, lone.du, "du");
            same(&got.dv, lone.dv, "dv");
            same(&got.normal, lone.normal, "normal");
            assert_eq!(got.flags[k], wanted.flags, "{name}: {place:?}");
            assert_eq!(got.flags[k], lone.flags, "{name}: {place:?}");
        }
        if second {
            same(&got.duu, wanted.jet.duu, "duu");
            same(&got.duv, wanted.jet.duv, "duv");
            same(&got.dvv, wanted.jet.dvv, "dvv");
        }
    }
}

const ALL: [Derivatives; 3] = [Derivatives::None, Derivatives::First, Derivatives::Second];

fn cages_of_all_kinds() -> Vec<(String, ControlMesh)> {
    let wanted =
        ["body", "pyramid", "sectors of 1 to 4", "uneven Chaikin crease", "dart at valence 5", "fan 3"];
    let mut cages = cages::all();
    cages.push(("body".into(), cages::body()));
    cages.retain(|(name, _)| wanted.contains(&name.as_str()));
    assert_eq!(cages.len(), wanted.len());
    cages
}

#[test]
fn in_any_order() {
    for (name, mesh) in cages_of_all_kinds() {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        for count in [0, 1, 2, 3, 4, 5, 7, 8, 9, 63, 64, 65, 1000] {
            let scattered = places(&table, count);
            let mut by_face = scattered.clone();
            by_face.sort_by_key(|place| place.parametric_face());
            let mut backwards = by_face.clone();
            backwards.reverse();
            let repeated: Vec<Location> = scattered.iter().flat_map(|&place| [place; 3]).collect();
            for at in [scattered, by_face, backwards, repeated] {
                for what in ALL {
                    assert_same(&name, &surface, &at, what, &surface.eval_batch(&at, what));
                }
            }
        }
    }
}

#[test]
fn on_any_number_of_threads() {
    let mesh = cages::body();
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    for count in [100, 20_011] {
        let at = places(&table, count);
        for what in ALL {
            for threads in [1, 2, 5] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let (table, surface) = pool.install(|| (PatchTable::new(&level), &surface));
                let other = LimitSurface::new(&table, &mesh.points);
                let got = pool.install(|| surface.eval_batch(&at, what));
                assert_same(&format!("{threads} threads"), &other, &at, what, &got);
            }
        }
    }
}

/// Memory that is there already may hold anything.
#[test]
fn into_used_memory() {
    let mesh = cages::pyramid();
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let mut samples = Samples::default();
    for (count, what) in [(500, ALL[2]), (20, ALL[0]), (300, ALL[1]), (0, ALL[2]), (301, ALL[2])] {
        let at = places(&table, count);
        surface.eval_into(&at, what, &mut samples);
        assert_same("used memory", &surface, &at, what, &samples);
    }
}
