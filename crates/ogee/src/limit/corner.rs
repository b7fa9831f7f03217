//! Extraordinary vertices themselves.

use super::evaluate::tangents_at_origin;
use super::normals::unit_normal;
use super::walk::{Walk, last_step};
use super::{Flags, SurfacePoint};
use crate::math::Vec3;
use crate::patch::{ChainBasis, Kind, PatchTable, Tail};

/// The point at the irregular corner of a tail, by masks; where there is no mask for its tangent plane, the limit along
/// the middle of the tail.
pub(super) fn at_corner(
    walk: &mut Walk,
    table: &PatchTable,
    points: &[Vec3],
    number: u32,
    tail: Tail,
) -> SurfacePoint {
    let (position, masks) = walk.corner(table, points, number, tail);
    let basis = table.basis(tail);
    let outward = walk.outward(basis);
    let mut flags = flags_at(basis);
    // Sharp edges in line span no plane, though there is one. The masks of a lens see all that there is.
    let masks =
        masks.filter(|[a, b]| matches!(basis.kind, Kind::Lens { .. }) || unit_normal(*a, *b).is_some());
    let mut tangents = masks.unwrap_or_else(|| {
        let mut net = [[0.0; 4]; 16];
        walk.go(table, points, number, tail, last_step(basis));
        walk.tile(basis, 1, 0, &mut net);
        tangents_at_origin(&net).map(|tangent| tangent.normalized().unwrap_or(Vec3::ZERO))
    });
    let mut normal = unit_normal(tangents[0], tangents[1]);
    // The sharp edges of a reflex corner span the plane the wrong way round.
    let is_corner = matches!(basis.kind, Kind::Corner { faces: 2, .. });
    if is_corner && normal.is_some_and(|n| n.dot(outward) < 0.0) {
        tangents = [tangents[1], tangents[0]];
        normal = normal.map(|n| -n);
    }
    if let (Kind::Meeting { .. }, Some(normal)) = (basis.kind, normal)
        && !walk.agree_on(normal, basis)
    {
        flags = flags.with(Flags::NORMAL_ONE_SIDED);
    }
    if normal.is_none() {
        flags = flags.with(Flags::NORMAL_UNDEFINED);
    }
    let [du, dv] = match tail.corner {
        0 => tangents,
        1 => [-tangents[1], tangents[0]],
        2 => [-tangents[0], -tangents[1]],
        _ => [tangents[1], -tangents[0]],
    };
    SurfacePoint { position, du, dv, normal: normal.unwrap_or(Vec3::ZERO), flags }
}

/// What is known about an irregular vertex (`docs/methods/exact_evaluation.md`).
fn flags_at(basis: &ChainBasis) -> Flags {
    let flags = Flags::AT_EXTRAORDINARY;
    let (one_sided, unbounded) = match basis.kind {
        Kind::Smooth { valence } => (false, valence > 4),
        Kind::Lens { .. } => (basis.tangents.is_none(), true),
        Kind::Cone { .. } => (true, true),
        Kind::Meeting { .. } => (false, true),
        Kind::Dart { .. } => (basis.tangents.is_none(), true),
        Kind::Crease { faces, .. } => (faces > 3, faces > 2),
        Kind::Corner { faces, .. } => (faces > 2, faces > 2),
    };
    let flags = if one_sided { flags.with(Flags::NORMAL_ONE_SIDED) } else { flags };
    if unbounded { flags.with(Flags::UNBOUNDED_CURVATURE) } else { flags }
}
