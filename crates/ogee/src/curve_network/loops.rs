//! The loops of a network without a cage: at every point where curves meet, their directions in order around a normal; from
//! arc to arc, always the next on the left.
//!
//! Normals come from the directions: three or more of them have a plane in which their tips lie best. Which of its two sides is
//! outside is carried along the arcs, turned with them as little as can be. Points with two directions have the normal that is
//! carried there.

use super::bare::{Arcs, Side};
use super::defect::{NetworkDefect, NetworkError};
use crate::math::Vec3;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Cosines and sines below this tell nothing.
const UNCLEAR: f64 = 0.05;

/// How much less tips must differ across their plane than within it.
const FLATTER: f64 = 0.5;

/// Steps towards an eigenvector, at each of which the rest shrinks by a fifth at least where it counts.
const ITERATIONS: usize = 200;

/// The loops to fill, their points on their left as seen from outside.
pub(super) fn find_loops(arcs: &Arcs) -> Result<Vec<Vec<Side>>, NetworkError> {
    let refuse = |vertex: u32| NetworkError { defects: vec![NetworkDefect::LoopAmbiguous { vertex }] };
    let normals = normals(arcs).map_err(refuse)?;
    let mut after: BTreeMap<Side, Side> = BTreeMap::new();
    for (&v, leaving) in &arcs.nodes {
        let order = around(arcs, leaving, normals[&v]).ok_or_else(|| refuse(v))?;
        for (k, side) in order.iter().enumerate() {
            // Arriving against `side`, the next on the left leaves clockwise of it.
            after.insert(side.reversed(), order[(k + order.len() - 1) % order.len()]);
        }
    }
    let mut seen = BTreeSet::new();
    let mut loops: Vec<(Vec<Side>, Vec3)> = Vec::new();
    let mut open = false;
    for &start in after.keys() {
        let mut sides = Vec::new();
        let mut side = start;
        while seen.insert(side) {
            sides.push(side);
            side = after[&side];
        }
        if sides.is_empty() {
            continue;
        }
        let corner = arcs.along(sides[0])[0];
        let (area, outward) = (
            area(arcs, &sides),
            sides.iter().fold(Vec3::ZERO, |sum, &side| sum + normals[&arcs.along(side)[0]]),
        );
        let (Some(area_unit), Some(outward)) = (area.normalized(), outward.normalized()) else {
            return Err(refuse(corner));
        };
        match area_unit.dot(outward) {
            cosine if cosine > UNCLEAR && sides.len() > 1 => loops.push((sides, area)),
            // What is outside of it all.
            cosine if cosine < -UNCLEAR => open = true,
            _ => return Err(refuse(corner)),
        }
    }
    if looks_inward(arcs, &loops, open) {
        for (sides, _) in &mut loops {
            *sides = sides.iter().rev().map(|side| side.reversed()).collect();
        }
    }
    Ok(loops.into_iter().map(|(sides, _)| sides).collect())
}

/// Twice the area vector of a loop (Newell).
fn area(arcs: &Arcs, sides: &[Side]) -> Vec3 {
    let points: Vec<Vec3> = points(arcs, sides);
    let base = points.first().copied().unwrap_or(Vec3::ZERO);
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    pairs.fold(Vec3::ZERO, |sum, (&a, &b)| sum + (a - base).cross(b - base))
}

fn points(arcs: &Arcs, sides: &[Side]) -> Vec<Vec3> {
    let vertices = sides.iter().flat_map(|&side| {
        let mut along = arcs.along(side);
        along.pop();
        along
    });
    vertices.map(|v| arcs.points[v as usize]).collect()
}

/// Closed: the volume is negative. Open: most of it looks down the axis along which most of it looks.
fn looks_inward(arcs: &Arcs, loops: &[(Vec<Side>, Vec3)], open: bool) -> bool {
    if open {
        let sum = loops.iter().fold(Vec3::ZERO, |sum, (_, area)| sum + *area);
        let largest = <[f64; 3]>::from(sum).into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        return largest.is_some_and(|x| x < 0.0);
    }
    let volume = |sides: &[Side], area: Vec3| {
        let points = points(arcs, sides);
        let center = points.iter().fold(Vec3::ZERO, |sum, &p| sum + p) / points.len() as f64;
        (center - arcs.points[0]).dot(area)
    };
    loops.iter().map(|(sides, area)| volume(sides, *area)).sum::<f64>() < 0.0
}

/// The first direction of a side.
fn direction(arcs: &Arcs, side: Side) -> Option<Vec3> {
    let along = arcs.along(side);
    (arcs.points[along[1] as usize] - arcs.points[along[0] as usize]).normalized()
}

/// Sides that leave a point, counter-clockwise about its normal. `None` where that cannot be told.
fn around(arcs: &Arcs, leaving: &[Side], normal: Vec3) -> Option<Vec<Side>> {
    if leaving.len() == 2 {
        return Some(leaving.to_vec());
    }
    let flat = |side: Side| {
        let direction = direction(arcs, side)?;
        let flat = direction - normal.dot(direction) * normal;
        Some(flat).filter(|flat| flat.length() > UNCLEAR)
    };
    let first = flat(leaving[0])?.normalized()?;
    let aside = normal.cross(first);
    let angle = |side: Side| {
        let flat = flat(side)?;
        Some((flat.dot(aside).atan2(flat.dot(first)), side))
    };
    let mut angles: Vec<(f64, Side)> = leaving.iter().map(|&side| angle(side)).collect::<Option<_>>()?;
    angles.sort_by(|a, b| a.0.total_cmp(&b.0));
    let gaps = angles.windows(2).map(|pair| pair[1].0 - pair[0].0);
    let around = std::f64::consts::TAU - (angles[angles.len() - 1].0 - angles[0].0);
    if gaps.chain([around]).any(|gap| gap < UNCLEAR) {
        return None;
    }
    Some(angles.into_iter().map(|(_, side)| side).collect())
}

/// A normal at every point where curves meet, all on one side of the surface; else the point where that goes wrong.
fn normals(arcs: &Arcs) -> Result<BTreeMap<u32, Vec3>, u32> {
    let mut own: BTreeMap<u32, Option<Vec3>> = BTreeMap::new();
    for (&v, leaving) in &arcs.nodes {
        let directions: Option<Vec<Vec3>> = leaving.iter().map(|&side| direction(arcs, side)).collect();
        let directions = directions.ok_or(v)?;
        let plane = if directions.len() > 2 { Some(plane(&directions).ok_or(v)?) } else { None };
        own.insert(v, plane);
    }
    let mut normals: BTreeMap<u32, Vec3> = BTreeMap::new();
    // Points that know their planes first.
    let starts = own.iter().filter(|(_, plane)| plane.is_some()).chain(own.iter());
    let starts: Vec<u32> = starts.map(|(&v, _)| v).collect();
    for start in starts {
        if normals.contains_key(&start) {
            continue;
        }
        let first = match own[&start] {
            Some(plane) => plane,
            None => alone(arcs, start).ok_or(start)?,
        };
        normals.insert(start, first);
        let mut queue = VecDeque::from([start]);
        while let Some(v) = queue.pop_front() {
            for &side in &arcs.nodes[&v] {
                let along = arcs.along(side);
                let to = along[along.len() - 1];
                let carried = carry(arcs, &along, normals[&v]).ok_or(v)?;
                match (normals.get(&to).copied(), own[&to]) {
                    // The other way round: a surface with one side only.
                    (Some(known), Some(_)) if carried.dot(known) < UNCLEAR => return Err(to),
                    (Some(_), _) => {}
                    (None, Some(plane)) => {
                        let cosine = carried.dot(plane);
                        if cosine.abs() < UNCLEAR {
                            return Err(to);
                        }
                        normals.insert(to, if cosine < 0.0 { -plane } else { plane });
                        queue.push_back(to);
                    }
                    (None, None) => {
                        normals.insert(to, carried);
                        queue.push_back(to);
                    }
                }
            }
        }
    }
    Ok(normals)
}

/// The normal of the plane that unit vectors end in best: the direction in which their tips differ least. `None` if there is
/// another in which they differ hardly more.
fn plane(directions: &[Vec3]) -> Option<Vec3> {
    let mean = directions.iter().fold(Vec3::ZERO, |sum, &d| sum + d) / directions.len() as f64;
    let tips: Vec<Vec3> = directions.iter().map(|&d| d - mean).collect();
    let spread = |n: Vec3| tips.iter().fold(Vec3::ZERO, |sum, tip| sum + n.dot(*tip) * *tip);
    let all: f64 = tips.iter().map(|tip| tip.dot(*tip)).sum();
    // The smallest eigenvector of the spread, by iteration; far from others it is found quickly.
    let mut normal = Vec3::new(0.48, 0.6, 0.64);
    for _ in 0..ITERATIONS {
        normal = (all * normal - spread(normal)).normalized()?;
    }
    let least = normal.dot(spread(normal));
    let axis = if normal.x.abs() < 0.6 { Vec3::new(1.0, 0.0, 0.0) } else { Vec3::new(0.0, 1.0, 0.0) };
    let u = normal.cross(axis).normalized()?;
    let v = normal.cross(u);
    let (a, b, c) = (u.dot(spread(u)), u.dot(spread(v)), v.dot(spread(v)));
    let next = (a + c) / 2.0 - ((a - c) * (a - c) / 4.0 + b * b).sqrt();
    (least < FLATTER * next).then_some(normal)
}

/// The normal of a lone loop, from its area.
fn alone(arcs: &Arcs, start: u32) -> Option<Vec3> {
    let mut sides = vec![arcs.nodes[&start][0]];
    loop {
        let last = sides[sides.len() - 1];
        let end = *arcs.along(last).last()?;
        if end == start {
            break;
        }
        sides.push(*arcs.nodes.get(&end)?.iter().find(|&&side| side != last.reversed())?);
    }
    area(arcs, &sides).normalized()
}

/// A normal carried along an arc: made perpendicular to each leg in turn. `None` if it gets lost.
fn carry(arcs: &Arcs, along: &[u32], normal: Vec3) -> Option<Vec3> {
    let mut normal = normal;
    for pair in along.windows(2) {
        let leg = arcs.points[pair[1] as usize] - arcs.points[pair[0] as usize];
        let Some(leg) = leg.normalized() else { continue };
        let flat = normal - leg.dot(normal) * leg;
        normal = Some(flat).filter(|flat| flat.length() > UNCLEAR)?.normalized()?;
    }
    Some(normal)
}
