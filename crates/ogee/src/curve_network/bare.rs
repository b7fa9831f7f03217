//! A network without a cage, cut into arcs at the points where curves meet or end.

use super::check::check_shape;
use super::defect::{NetworkDefect, NetworkError};
use super::network::NetworkCurve;
use super::skin::BareNetwork;
use super::through::control;
use crate::math::Vec3;
use std::collections::{BTreeMap, BTreeSet};

/// A piece of a curve between two points where curves meet.
pub(super) struct Arc {
    pub(super) curve: usize,
    /// Where it begins in the curve.
    pub(super) start: usize,
    pub(super) vertices: Vec<u32>,
}

/// An arc with a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    pub(super) arc: usize,
    pub(super) backward: bool,
}

impl Side {
    pub(super) fn reversed(self) -> Side {
        Side { backward: !self.backward, ..self }
    }
}

/// All arcs, and what leaves the points where curves meet.
pub(super) struct Arcs {
    /// Points are where curves want their control points.
    pub(super) points: Vec<Vec3>,
    /// The curves, without control points of their own.
    pub(super) curves: Vec<NetworkCurve>,
    pub(super) list: Vec<Arc>,
    /// The sides that leave each of these points.
    pub(super) nodes: BTreeMap<u32, Vec<Side>>,
}

impl Arcs {
    pub(super) fn new(network: &BareNetwork) -> Result<Arcs, NetworkError> {
        let defects = check(network);
        if !defects.is_empty() {
            return Err(NetworkError { defects });
        }
        let mut points = network.points.clone();
        let mut curves = network.curves.clone();
        let mut legs: BTreeMap<u32, usize> = BTreeMap::new();
        for curve in &mut curves {
            for (&v, &point) in curve.vertices.iter().zip(curve.control.take().iter().flatten()) {
                points[v as usize] = point;
            }
            curve.legs().flatten().for_each(|v| *legs.entry(v).or_default() += 1);
        }
        let ends: BTreeSet<u32> = curves
            .iter()
            .filter(|curve| !curve.closed)
            .flat_map(|curve| [curve.vertices[0], curve.vertices[curve.vertices.len() - 1]])
            .collect();
        let is_node = |v: u32| legs.get(&v) != Some(&2) || ends.contains(&v);
        for curve in &mut curves {
            let Some(through) = curve.through.take() else { continue };
            let stops = (0..curve.vertices.len()).filter(|&i| is_node(curve.vertices[i])).collect();
            for (&v, point) in curve.vertices.iter().zip(control(curve, &through, stops)) {
                points[v as usize] = point;
            }
        }
        let mut arcs = Arcs { points, curves, list: Vec::new(), nodes: BTreeMap::new() };
        let mut defects = Vec::new();
        for (number, curve) in arcs.curves.iter().enumerate() {
            let count = curve.vertices.len();
            let mut stops: Vec<usize> = (0..count).filter(|&i| is_node(curve.vertices[i])).collect();
            let Some(&first) = stops.first() else {
                defects
                    .push(NetworkDefect::CurveAlone { curve: curve.name.clone(), vertex: curve.vertices[0] });
                continue;
            };
            if curve.closed {
                stops.push(first + count);
            }
            for pair in stops.windows(2) {
                let vertices = (pair[0]..=pair[1]).map(|i| curve.vertices[i % count]).collect();
                arcs.list.push(Arc { curve: number, start: pair[0], vertices });
            }
            let alone = stops.iter().map(|&i| curve.vertices[i % count]).find(|v| legs.get(v) == Some(&1));
            if let Some(vertex) = alone {
                defects.push(NetworkDefect::CurveAlone { curve: curve.name.clone(), vertex });
            }
        }
        if !defects.is_empty() {
            return Err(NetworkError { defects });
        }
        for arc in 0..arcs.list.len() {
            for backward in [false, true] {
                let side = Side { arc, backward };
                let from = arcs.along(side)[0];
                arcs.nodes.entry(from).or_default().push(side);
            }
        }
        Ok(arcs)
    }

    /// The vertices of a side, in its direction.
    pub(super) fn along(&self, side: Side) -> Vec<u32> {
        let mut vertices = self.list[side.arc].vertices.clone();
        if side.backward {
            vertices.reverse();
        }
        vertices
    }

    /// Loops of vertices as loops of sides.
    pub(super) fn given_loops(&self, loops: &[Vec<u32>]) -> Result<Vec<Vec<Side>>, NetworkError> {
        let one = |(number, cycle): (usize, &Vec<u32>)| {
            self.given_loop(cycle).ok_or(NetworkDefect::LoopBroken { number })
        };
        let (good, bad): (Vec<_>, Vec<_>) = loops.iter().enumerate().map(one).partition(Result::is_ok);
        let defects: Vec<NetworkDefect> = bad.into_iter().filter_map(Result::err).collect();
        if defects.is_empty() {
            Ok(good.into_iter().filter_map(Result::ok).collect())
        } else {
            Err(NetworkError { defects })
        }
    }

    fn given_loop(&self, cycle: &[u32]) -> Option<Vec<Side>> {
        let start = cycle.iter().position(|v| self.nodes.contains_key(v))?;
        let mut rest: Vec<u32> = (0..=cycle.len()).map(|i| cycle[(start + i) % cycle.len()]).collect();
        let mut sides = Vec::new();
        while rest.len() > 1 {
            let leaving = self.nodes.get(&rest[0])?;
            let side = leaving.iter().copied().find(|&side| rest.starts_with(&self.along(side)))?;
            rest.drain(..self.along(side).len() - 1);
            sides.push(side);
        }
        (sides.len() >= 2).then_some(sides)
    }
}

/// What is wrong with single curves.
fn check(network: &BareNetwork) -> Vec<NetworkDefect> {
    let mut defects = Vec::new();
    let count = network.points.len();
    let mut owners: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut wanted: BTreeMap<u32, (usize, Vec3)> = BTreeMap::new();
    if let Some(index) = network.points.iter().position(|p| !p.is_finite()) {
        defects.push(NetworkDefect::ConstraintNotFinite { what: "a point", vertex: index as u32 });
    }
    for (number, curve) in network.curves.iter().enumerate() {
        let name = || curve.name.clone();
        let (vertices, least) = (curve.vertices.len(), if curve.closed { 3 } else { 2 });
        if vertices < least {
            defects.push(NetworkDefect::CurveShort { curve: name(), vertices, least });
            continue;
        }
        if let Some(&vertex) = curve.vertices.iter().find(|&&v| v as usize >= count) {
            defects.push(NetworkDefect::PointVertex { vertex, count });
            continue;
        }
        let mut sorted = curve.vertices.clone();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            defects.push(NetworkDefect::CurveRepeats { curve: name(), vertex: pair[0] });
            continue;
        }
        let before = defects.len();
        check_shape(curve, &mut defects);
        if defects.len() > before {
            continue;
        }
        for [from, to] in curve.legs() {
            if let Some(other) = owners.insert([from.min(to), from.max(to)], number) {
                let other = network.curves[other].name.clone();
                defects.push(NetworkDefect::SharedEdge { curve: name(), other, from, to });
            }
        }
        for (&vertex, point) in curve.vertices.iter().zip(curve.target(&network.points)) {
            let before = wanted.insert(vertex, (number, point));
            if let Some((other, at)) = before.filter(|before| before.1 != point) {
                let (other, distance) = (network.curves[other].name.clone(), at.distance(point));
                defects.push(NetworkDefect::MeetingPointMismatch { curve: name(), other, vertex, distance });
            }
        }
    }
    if network.curves.is_empty() {
        defects.push(NetworkDefect::NoCurves);
    }
    defects
}
