//! Faces are bounded by their boundary, the right way round; shells enclose what is inside.

use ogee::Vec3;

use super::boundary::{Step, lay, size};
use super::edges::Path;
use super::model::{Bound, Face, Model, Solid};
use super::spline::Surface;
use super::splines::Splines;
use super::{Fault, Faults};

/// The tolerance relative to the diagonal of the part, at the least and at the most.
const LEAST: f64 = 1e-7;
const MOST: f64 = 1e-5;

/// A trimming edge this far from its surface, relative to the size of the surface, is not on it. Foreign
/// kernels approximate such edges, so it is coarse.
const OFF_SURFACE: f64 = 1e-3;

/// The distance below which two places are one.
pub(super) fn tolerance(model: &Model, splines: &Splines, uncertainty: Option<f64>) -> f64 {
    let vertices = model.edges.iter().flat_map(|edge| edge.places).flatten();
    let surfaces = splines.surfaces.values().flat_map(|surface| surface.net.cells().iter().copied());
    let none = Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
    let (least, greatest) = vertices
        .chain(surfaces)
        .fold((none, -none), |(least, greatest), place| (least.min(place), greatest.max(place)));
    let diagonal = least.distance(greatest);
    let diagonal = if diagonal.is_finite() { diagonal } else { 0.0 };
    uncertainty.unwrap_or(0.0).clamp(LEAST * diagonal, MOST * diagonal)
}

/// Checks all faces and solids; returns the volume of all solids if it can be known.
pub(super) fn check(
    model: &Model,
    splines: &Splines,
    paths: &[Option<Path<'_>>],
    tolerance: f64,
    faults: &mut Faults,
) -> Option<f64> {
    let mut volumes = Vec::with_capacity(model.shells.len());
    for shell in &model.shells {
        let mut volume = Some(0.0);
        // One point for the whole shell: a closed one has the same volume about any, but not the same rounding.
        let first = shell.faces.first().and_then(|face| splines.surfaces.get(&face.surface));
        let origin = first.map_or(Vec3::ZERO, |surface| surface.net[(0, 0)]);
        for face in &shell.faces {
            let flux = check_face(face, splines, paths, origin, tolerance, faults);
            volume = volume.zip(flux).map(|(volume, flux)| volume + flux);
        }
        volumes.push(volume.filter(|_| shell.closed && shell.complete));
    }
    let mut total = (!model.solids.is_empty()).then_some(0.0);
    for solid in &model.solids {
        let volume = check_solid(solid, &volumes, tolerance, faults);
        total = total.zip(volume).map(|(total, volume)| total + volume);
    }
    total
}

/// Checks a face; returns the flux through it, about `origin`, if it is a whole polynomial surface.
fn check_face(
    face: &Face,
    splines: &Splines,
    paths: &[Option<Path<'_>>],
    origin: Vec3,
    tolerance: f64,
    faults: &mut Faults,
) -> Option<f64> {
    let mut rounds = Vec::new();
    for bound in &face.bounds {
        let steps: Option<Vec<Step<'_, '_>>> = bound
            .uses
            .iter()
            .map(|used| Some(Step { path: paths[used.edge].as_ref()?, forward: used.forward }))
            .collect();
        let Some(steps) = steps.filter(|steps| !steps.is_empty()) else { continue };
        if let Some(surface) = splines.surfaces.get(&face.surface) {
            rounds.extend(check_bound(face, bound, surface, &steps, paths, tolerance, faults));
        } else if let Some(normal) = face.plane {
            let outer = bound.outer || face.bounds.len() == 1;
            let area = area_seen(&steps, normal);
            if outer && area.abs() > tolerance * tolerance && (area > 0.0) != face.same_sense {
                clockwise(face, bound, faults);
            }
        }
    }
    match (splines.surfaces.get(&face.surface), face.bounds.len(), rounds.as_slice()) {
        (Some(surface), 1, [()]) => {
            let flux = surface.flux(origin);
            Some(if face.same_sense { flux } else { -flux })
        }
        _ => None,
    }
}

fn clockwise(face: &Face, bound: &Bound, faults: &mut Faults) {
    let message = format!("the loop runs clockwise about the normal of face #{}", face.id);
    faults.push(Fault { code: "loop_clockwise", message, line: Some(face.line), id: Some(bound.id) });
}

/// Compares a loop with the boundary of its surface; `Some` if it is that.
fn check_bound(
    face: &Face,
    bound: &Bound,
    surface: &Surface,
    steps: &[Step<'_, '_>],
    paths: &[Option<Path<'_>>],
    tolerance: f64,
    faults: &mut Faults,
) -> Option<()> {
    let round = lay(surface, steps, tolerance);
    if let Some(round) =
        round.filter(|round| round.cornered || round.strays.iter().all(|&stray| stray <= tolerance))
    {
        for (k, &stray) in round.strays.iter().enumerate().filter(|&(_, &stray)| stray > tolerance) {
            let message = format!(
                "edge {} of the loop is {stray:.3e} away from the boundary of the surface #{}",
                k + 1,
                face.surface
            );
            faults.push(Fault {
                code: "edge_off_boundary",
                message,
                line: Some(face.line),
                id: Some(face.id),
            });
        }
        if (round.area > 0.0) != face.same_sense {
            clockwise(face, bound, faults);
        }
        return Some(());
    }
    let coarse = tolerance.max(OFF_SURFACE * size(surface));
    for used in &bound.uses {
        let Some(path) = &paths[used.edge] else { continue };
        let away = (0..=4).map(|k| surface.distance(path.at(f64::from(k) / 4.0))).fold(0.0, f64::max);
        if away > coarse {
            let message = format!("an edge is {away:.3e} away from the surface #{}", face.surface);
            faults.push(Fault {
                code: "edge_off_surface",
                message,
                line: Some(face.line),
                id: Some(face.id),
            });
        }
    }
    None
}

/// Twice the area of a loop, seen against a normal: positive counter-clockwise.
fn area_seen(steps: &[Step<'_, '_>], normal: Vec3) -> f64 {
    let places: Vec<Vec3> =
        steps.iter().flat_map(|step| (0..8).map(|k| step.at(f64::from(k) / 8.0))).collect();
    let origin = places[0];
    (0..places.len())
        .map(|k| (places[k] - origin).cross(places[(k + 1) % places.len()] - origin).dot(normal))
        .sum()
}

/// The outer shell of a solid encloses it, its hollows are turned; returns its volume.
fn check_solid(solid: &Solid, volumes: &[Option<f64>], tolerance: f64, faults: &mut Faults) -> Option<f64> {
    let signed = |(shell, turned): (usize, bool)| {
        let volume = volumes[shell]?;
        Some(if turned { -volume } else { volume })
    };
    let mut fault = |code, message: &str| {
        faults.push(Fault { code, message: message.to_owned(), line: Some(solid.line), id: Some(solid.id) });
    };
    let mut total = solid.outer.and_then(signed);
    let negligible = tolerance.powi(3);
    if total.is_some_and(|volume| volume < -negligible) {
        fault("inside_out", "the outer shell is inside out: its volume is negative");
    }
    for &void in &solid.voids {
        let volume = signed(void);
        if volume.is_some_and(|volume| volume > negligible) {
            fault("void_inside_out", "a hollow adds to the volume: its shell is to be turned");
        }
        total = total.zip(volume).map(|(total, volume)| total + volume);
    }
    total
}
