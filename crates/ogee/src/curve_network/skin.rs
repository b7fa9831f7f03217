//! Skinning: a cage for curves that come without one. Loops of the network are found or given ([`BareNetwork::loops`]), and
//! each is filled: one with four sides of fitting numbers of legs by a discrete Coons patch, any other by one patch for each
//! of its corners, around the middle; where numbers do not fit, by a ring of quads and a polygon.

use super::bare::{Arcs, Side};
use super::defect::{NetworkDefect, NetworkError};
use super::loops::find_loops;
use super::network::NetworkCurve;
use super::target_curve::TargetCurve;
use crate::math::Vec3;
use crate::mesh::{ControlMesh, Corner, FaceList, Sharpness, Topology};
use std::collections::BTreeMap;

/// How often curves are refined until numbers of legs fit.
const MOST_ROUNDS: usize = 24;

/// A curve is refined no more when it has so many legs.
const MOST_LEGS: usize = 4096;

/// Curves without a cage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BareNetwork {
    /// Points; curves that name the same one meet there.
    pub points: Vec<Vec3>,
    /// The curves: paths from point to point, whose control points are these points or their own.
    pub curves: Vec<NetworkCurve>,
    /// The loops to fill, each as the points around it along curves, counter-clockwise seen from outside. If there are none
    /// they are found: at every point where curves meet by their directions in their tangent plane. A loop that turns the
    /// other way round than its points is what is outside, and is left open.
    pub loops: Vec<Vec<u32>>,
}

/// A cage for curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Skin {
    /// The cage: points of the network first, with their numbers. Where curves along the border end and no other curve
    /// starts, the vertex is sharp, so that they end there.
    pub mesh: ControlMesh,
    /// The same curves, as paths along its edges. Some have been refined, which adds control points and moves others: the
    /// curves are the same.
    pub curves: Vec<NetworkCurve>,
}

/// Makes a cage for curves, ready to be [embedded](super::embed()) with [`Skin::curves`]. All faces look the same way: outward
/// where the cage is closed, else to the positive side of the axis along which most of it looks; given loops look as they
/// are given.
///
/// ```
/// use ogee::Vec3;
/// use ogee::curve_network::{BareNetwork, NetworkCurve, skin};
///
/// // The edges of a tetrahedron.
/// let points = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(Vec3::from).to_vec();
/// let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
/// let curve = |pair: [u32; 2]| NetworkCurve { name: format!("{pair:?}"), vertices: pair.to_vec(), ..Default::default() };
/// let network = BareNetwork { points, curves: pairs.map(curve).to_vec(), loops: vec![] };
/// let skin = skin(&network)?;
/// // Three quads in each of the four triangles.
/// assert_eq!((skin.mesh.faces.len(), skin.curves[0].vertices.len()), (12, 3));
/// # Ok::<(), ogee::curve_network::NetworkError>(())
/// ```
///
/// # Errors
/// If a path or a loop is none, a curve ends or turns alone, or it cannot be seen how loops run: then vertices are named, and
/// loops have to be given.
pub fn skin(network: &BareNetwork) -> Result<Skin, NetworkError> {
    let mut arcs = Arcs::new(network)?;
    let loops: Vec<Vec<Side>> =
        if network.loops.is_empty() { find_loops(&arcs)? } else { arcs.given_loops(&network.loops)? };
    let mut users = BTreeMap::new();
    for side in loops.iter().flatten() {
        if users.insert((side.arc, side.backward), ()).is_some() {
            let vertex = arcs.list[side.arc].vertices[0];
            return Err(refuse(NetworkDefect::LoopTwice { vertex }));
        }
    }
    fit_legs(&mut arcs, &loops);
    let mut filler = Filler { points: arcs.points.clone(), faces: FaceList::new() };
    for sides in &loops {
        let sides: Vec<Vec<u32>> = sides.iter().map(|side| arcs.along(*side)).collect();
        filler.fill(&sides);
    }
    let mut mesh = ControlMesh::new(filler.points, filler.faces);
    let sharp = |vertex: u32| Corner { vertex, sharpness: Sharpness::Infinite };
    mesh.corners = arcs.border_ends(&loops).into_iter().map(sharp).collect();
    Topology::new(&mesh).map_err(|error| NetworkError {
        defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
    })?;
    Ok(Skin { mesh, curves: arcs.curves })
}

fn refuse(defect: NetworkDefect) -> NetworkError {
    NetworkError { defects: vec![defect] }
}

/// Refines curves until opposite sides of four have as many legs, and sides of others all as many, an even number; where
/// that cannot be had by halving legs, as near as it comes.
fn fit_legs(arcs: &mut Arcs, loops: &[Vec<Side>]) {
    // A point where curves meet inside the surface cuts them.
    let mut uses = vec![0; arcs.list.len()];
    loops.iter().flatten().for_each(|side| uses[side.arc] += 1);
    let is_inner = |arcs: &Arcs, v: u32| {
        arcs.list.iter().zip(&uses).all(|(arc, &uses)| {
            uses == 2 || (arc.vertices[0] != v && arc.vertices[arc.vertices.len() - 1] != v)
        })
    };
    let cuts: Vec<u32> = arcs.nodes.keys().copied().filter(|&v| is_inner(arcs, v)).collect();
    for _ in 0..MOST_ROUNDS {
        let legs = |arcs: &Arcs, side: &Side| arcs.list[side.arc].vertices.len() - 1;
        let short = loops.iter().find_map(|sides| {
            let pairs: Vec<[&Side; 2]> = match &sides[..] {
                [a, b, c, d] => vec![[a, c], [b, d]],
                all => all.iter().zip(all.iter().cycle().skip(1)).map(|(a, b)| [a, b]).collect(),
            };
            let uneven = pairs.into_iter().find_map(|[a, b]| {
                let (one, other) = (legs(arcs, a), legs(arcs, b));
                let doubles = |few: usize, many: usize| {
                    many > few && many.is_multiple_of(few) && (many / few).is_power_of_two()
                };
                if doubles(one, other) {
                    Some(a.arc)
                } else if doubles(other, one) {
                    Some(b.arc)
                } else {
                    None
                }
            });
            let odd = || {
                sides.iter().find(|side| sides.len() != 4 && legs(arcs, side) % 2 == 1).map(|side| side.arc)
            };
            uneven.or_else(odd)
        });
        let Some(arc) = short else { return };
        let curve = arcs.list[arc].curve;
        if arcs.curves[curve].vertices.len() > MOST_LEGS {
            return;
        }
        arcs.refine(curve, &cuts);
    }
}

struct Filler {
    points: Vec<Vec3>,
    faces: FaceList,
}

impl Filler {
    /// Fills a loop of sides, each from one corner to the next.
    fn fill(&mut self, sides: &[Vec<u32>]) {
        let legs: Vec<usize> = sides.iter().map(|side| side.len() - 1).collect();
        match (&legs[..], sides) {
            ([a, b, c, d], [s, t, u, v]) if a == c && b == d => self.coons([s, t, u, v]),
            (all, _) if all.iter().all(|&legs| legs == all[0] && legs % 2 == 0) => self.star(sides),
            _ => self.ring(sides),
        }
    }

    fn add(&mut self, point: Vec3) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    fn at(&self, v: u32) -> Vec3 {
        self.points[v as usize]
    }

    /// A discrete bilinearly blended Coons patch: sides counter-clockwise, opposite ones of equal length.
    fn coons(&mut self, [bottom, right, top, left]: [&[u32]; 4]) {
        let (columns, rows) = (bottom.len() - 1, right.len() - 1);
        let mut grid = vec![vec![0; rows + 1]; columns + 1];
        for i in 0..=columns {
            for j in 0..=rows {
                grid[i][j] = match (i, j) {
                    (_, 0) => bottom[i],
                    (_, j) if j == rows => top[columns - i],
                    (0, _) => left[rows - j],
                    (i, _) if i == columns => right[j],
                    _ => {
                        let (u, v) = (i as f64 / columns as f64, j as f64 / rows as f64);
                        let across = self.at(bottom[i]).lerp(self.at(top[columns - i]), v);
                        let along = self.at(left[rows - j]).lerp(self.at(right[j]), u);
                        let low = self.at(bottom[0]).lerp(self.at(bottom[columns]), u);
                        let high = self.at(top[columns]).lerp(self.at(top[0]), u);
                        self.add(across + along - low.lerp(high, v))
                    }
                };
            }
        }
        for i in 0..columns {
            for j in 0..rows {
                self.faces.push(&[grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]]);
            }
        }
    }

    /// One patch for each corner, between the middles of two sides and the middle of all. Sides have equal, even numbers of
    /// legs.
    fn star(&mut self, sides: &[Vec<u32>]) {
        let half = (sides[0].len() - 1) / 2;
        let center = self.centroid(sides);
        let middle = self.add(center);
        let spokes: Vec<Vec<u32>> = sides
            .iter()
            .map(|side| {
                let start = side[half];
                let inner = (1..half).map(|k| k as f64 / half as f64).map(|s| self.at(start).lerp(center, s));
                let inner: Vec<Vec3> = inner.collect();
                let inner: Vec<u32> = inner.into_iter().map(|point| self.add(point)).collect();
                [&[start], &inner[..], &[middle]].concat()
            })
            .collect();
        for i in 0..sides.len() {
            let before = (i + sides.len() - 1) % sides.len();
            let back: Vec<u32> = spokes[before].iter().rev().copied().collect();
            self.coons([&sides[i][..=half], &spokes[i], &back, &sides[before][half..]]);
        }
    }

    /// Quads along the loop, and a polygon in the middle.
    fn ring(&mut self, sides: &[Vec<u32>]) {
        let center = self.centroid(sides);
        let outer: Vec<u32> = sides.iter().flat_map(|side| side[..side.len() - 1].iter().copied()).collect();
        let halfway: Vec<Vec3> = outer.iter().map(|&v| self.at(v).lerp(center, 0.5)).collect();
        let inner: Vec<u32> = halfway.into_iter().map(|point| self.add(point)).collect();
        for i in 0..outer.len() {
            let j = (i + 1) % outer.len();
            self.faces.push(&[outer[i], outer[j], inner[j], inner[i]]);
        }
        self.faces.push(&inner);
    }

    /// The mean of all points of a loop.
    fn centroid(&self, sides: &[Vec<u32>]) -> Vec3 {
        let points = sides.iter().flat_map(|side| &side[1..]);
        let count = sides.iter().map(|side| side.len() - 1).sum::<usize>();
        points.fold(Vec3::ZERO, |sum, &v| sum + self.at(v)) / count as f64
    }
}

impl Arcs {
    /// Points where curves along the border end, without others.
    fn border_ends(&self, loops: &[Vec<Side>]) -> Vec<u32> {
        let mut uses = vec![0; self.list.len()];
        loops.iter().flatten().for_each(|side| uses[side.arc] += 1);
        let ends_there = |(&v, leaving): (&u32, &Vec<Side>)| {
            let [one, other] = leaving[..] else { return None };
            let apart = self.list[one.arc].curve != self.list[other.arc].curve;
            (apart && uses[one.arc] == 1 && uses[other.arc] == 1).then_some(v)
        };
        self.nodes.iter().filter_map(ends_there).collect()
    }

    /// Refines a curve, piece by piece between the points that cut it.
    fn refine(&mut self, curve: usize, cuts: &[u32]) {
        let old = self.curves[curve].clone();
        let count = old.vertices.len();
        let control: Vec<Vec3> = old.vertices.iter().map(|&v| self.points[v as usize]).collect();
        let mut stops: Vec<usize> =
            (0..count).filter(|&i| cuts.binary_search(&old.vertices[i]).is_ok()).collect();
        if !old.closed {
            stops.extend([0, count - 1]);
            stops.sort_unstable();
            stops.dedup();
        } else if let Some(&first) = stops.first() {
            stops.push(first + count);
        }
        let mut middles: BTreeMap<usize, u32> = BTreeMap::new();
        let pieces: Vec<(usize, usize, bool)> = match stops.is_empty() {
            true => vec![(0, count - 1, true)],
            false => stops.windows(2).map(|pair| (pair[0], pair[1] - pair[0], false)).collect(),
        };
        for (from, legs, closed) in pieces {
            let polygon = (from..=from + legs).map(|i| control[i % count]).collect();
            // Finite and enough: the network has been checked.
            let Ok(target) = TargetCurve::new(polygon, closed) else { continue };
            for (k, &point) in target.refined().control().iter().enumerate() {
                let i = (from + k / 2) % count;
                if k % 2 == 0 {
                    self.points[old.vertices[i] as usize] = point;
                } else {
                    self.points.push(point);
                    middles.insert(i, self.points.len() as u32 - 1);
                }
            }
        }
        let places = 0..count;
        let refined = &mut self.curves[curve];
        let spread = |i: usize| [Some(old.vertices[i]), middles.get(&i).copied()];
        refined.vertices = places.flat_map(spread).flatten().collect();
        let has_middle = |i: usize| usize::from(middles.contains_key(&i));
        let padded = |i: usize| std::iter::repeat_n(i, 1 + has_middle(i)).enumerate();
        let original = |i: usize| padded(i).map(|(k, i)| (k == 0).then_some(i));
        let sources: Vec<Option<usize>> = (0..count).flat_map(original).collect();
        let take = |i: &Option<usize>| i.and_then(|i| old.normals.get(i).copied().flatten());
        refined.normals = if old.normals.is_empty() { vec![] } else { sources.iter().map(take).collect() };
        let take = |i: &Option<usize>| i.and_then(|i| old.cross_curvatures.get(i).copied().flatten());
        refined.cross_curvatures =
            if old.cross_curvatures.is_empty() { vec![] } else { sources.iter().map(take).collect() };
        refined.control = None;
        for arc in self.list.iter_mut().filter(|arc| arc.curve == curve) {
            let legs = arc.vertices.len() - 1;
            let middle = |k: usize| middles.get(&((arc.start + k) % count)).copied();
            let halved = (0..legs).flat_map(|k| [Some(arc.vertices[k]), middle(k)]).flatten();
            let halved: Vec<u32> = halved.chain(arc.vertices.last().copied()).collect();
            arc.vertices = halved;
            arc.start *= 2;
        }
    }
}
