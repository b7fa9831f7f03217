//! `fair`: the fairest cage that has what is wanted.

use super::dependence::dependent;
use super::energy::{Rows, gram, knows, second_differences};
use super::rows::{Constraint, Row, rows};
use super::solve::solve;
use crate::limit::limit_vertex;
use crate::math::Vec3;
use crate::mesh::{ControlMesh, Defect, TopologyError, VertexId};
use crate::rules::Level;

/// How well rows are to be met, of the size of the cage.
const MET: f64 = 1e-12;

/// How far a row that follows from others may be off before it contradicts them.
const AGREES: f64 = 1e-9;

/// What may be left of the energy's slope, relative to its terms.
const STATIONARY: f64 = 1e-9;

/// How to make a cage fair.
#[derive(Clone, Debug, PartialEq)]
pub struct FairingOptions {
    /// Vertices that stay where they are.
    pub fixed: Vec<u32>,
    /// How often the cage is split before its second differences are taken, 1 or 2: twice costs ten times as much, and knows
    /// the surface better beside extraordinary vertices.
    pub splits: u32,
}

impl Default for FairingOptions {
    fn default() -> FairingOptions {
        FairingOptions { fixed: Vec::new(), splits: 1 }
    }
}

/// A fair cage.
#[derive(Clone, Debug, PartialEq)]
pub struct Faired {
    /// Its points.
    pub points: Vec<Vec3>,
    /// The thin-plate energy before and after.
    pub energy: [f64; 2],
    /// How far the worst row is from being met, of the size of the cage.
    pub residual: f64,
    /// Numbers of constraints that followed from others, or from fixed vertices, at least in part.
    pub redundant: Vec<usize>,
    /// Numbers of constraints whose normal the surface has with the other sign.
    pub turned_over: Vec<usize>,
}

/// Why a cage cannot be made fair.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FairingError {
    /// The cage has defects.
    #[error("the cage is no sound mesh: {}", .0[0])]
    Mesh(Vec<Defect>),
    /// A number too large.
    #[error("there is no vertex {vertex}, only {count}")]
    MissingVertex {
        /// The vertex named.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// A number of splits out of range.
    #[error("the cage is split once or twice, not {splits} times")]
    Splits {
        /// What was asked for.
        splits: u32,
    },
    /// No face is visible there, the surface has no tangent plane, or a number is not finite.
    #[error(
        "at vertex {vertex} there is no surface, or no tangent plane, to want something of; choose another vertex"
    )]
    NoSurface {
        /// The vertex.
        vertex: u32,
    },
    /// Some of what is wanted excludes the rest.
    #[error(
        "{what} at vertex {vertex} contradicts the rest: it is missed by {residual:e} of the size of the cage"
    )]
    Contradiction {
        /// Number of the constraint.
        constraint: usize,
        /// Its vertex.
        vertex: u32,
        /// What it wants.
        what: &'static str,
        /// By how much it is missed, of the size of the cage.
        residual: f64,
    },
    /// The system could not be solved to rounding.
    #[error("no solution was found: rows or slopes stay at {residual:e}; fix more vertices, or want less")]
    NoSolution {
        /// What is left.
        residual: f64,
    },
}

impl From<TopologyError> for FairingError {
    fn from(error: TopologyError) -> FairingError {
        FairingError::Mesh(error.defects)
    }
}

/// Moves all points that are not fixed to where the surface bends least, of all cages that have what is wanted.
///
/// The energy is that of a thin plate, measured on the split cage. What is wanted is met to 1e-12 of the size of the cage. A
/// constraint that follows from those before it is left out and named; one that contradicts them is an error. Where
/// something is left open the nearest solution is taken.
///
/// Costs a sparse factorisation with three unknowns for each free vertex.
///
/// # Errors
/// If the cage is not sound, something wanted is not there to be wanted, or excludes the rest.
///
/// ```
/// use ogee::fairing::{Constraint, FairingOptions, fair};
/// use ogee::{Level, Vec3, limit_vertices, shapes};
///
/// // A cage whose surface goes through seven corners of a cube; the eighth follows.
/// let cube = shapes::cube();
/// let wanted: Vec<Constraint> =
///     (0..7).map(|vertex| Constraint::Position { vertex, at: cube.points[vertex as usize] }).collect();
/// let faired = fair(&cube, &wanted, &FairingOptions::default())?;
/// let limits = limit_vertices(&Level::new(&cube).unwrap(), &faired.points);
/// assert!(limits[7].position.distance(Vec3::new(1.0, 1.0, 1.0)) < 1e-11);
/// assert!(faired.redundant.is_empty());
/// # Ok::<(), ogee::fairing::FairingError>(())
/// ```
pub fn fair(
    mesh: &ControlMesh,
    wanted: &[Constraint],
    options: &FairingOptions,
) -> Result<Faired, FairingError> {
    let level = Level::new(mesh)?;
    let topology = level.topology();
    let count = topology.vertex_count();
    if !(1..=2).contains(&options.splits) {
        return Err(FairingError::Splits { splits: options.splits });
    }
    let mut is_free = vec![true; count];
    for &vertex in &options.fixed {
        if !knows(topology, vertex) {
            return Err(FairingError::MissingVertex { vertex, count });
        }
        is_free[vertex as usize] = false;
    }
    let all = rows(&level, wanted)?;
    let system = System::new(mesh, &is_free);
    let size = mesh.size().max(f64::MIN_POSITIVE);

    // Rows over what may move, and which of them say something new.
    let free_rows: Rows = all.iter().map(|row| system.over_free(row)).collect();
    let follows = dependent(&free_rows, system.unknowns());
    let kept: Vec<usize> = (0..all.len()).filter(|&i| !follows[i]).collect();
    let kept_rows: Rows = kept.iter().map(|&i| free_rows[i].clone()).collect();
    let lacking: Vec<f64> = kept.iter().map(|&i| all[i].value - value(&all[i], &mesh.points)).collect();

    let differences = second_differences(&level, options.splits);
    let Energy { matrix, slope, steepness } = system.energy(&gram(&differences, count));
    let solution = solve(&matrix, &slope, steepness, &kept_rows, &lacking)
        .ok_or(FairingError::NoSolution { residual: f64::INFINITY })?;
    let points = system.moved(&mesh.points, &solution.change);

    let missed = |i: usize| (all[i].value - value(&all[i], &points)).abs() / size;
    let residual = kept.iter().map(|&i| missed(i)).fold(0.0, f64::max);
    let left = residual.max(if solution.stationarity > STATIONARY { solution.stationarity } else { 0.0 });
    if left > MET || left.is_nan() {
        return Err(FairingError::NoSolution { residual: left });
    }
    let dropped = (0..all.len()).filter(|&i| follows[i]);
    let worst = dropped.clone().max_by(|&a, &b| missed(a).total_cmp(&missed(b)));
    if let Some(row) = worst.filter(|&row| missed(row) > AGREES) {
        let constraint = all[row].constraint;
        let (vertex, what) = (wanted[constraint].vertex(), wanted[constraint].what());
        return Err(FairingError::Contradiction { constraint, vertex, what, residual: missed(row) });
    }
    let mut redundant: Vec<usize> = dropped.map(|row| all[row].constraint).collect();
    redundant.dedup();
    let turned_over = (0..wanted.len()).filter(|&i| match wanted[i] {
        Constraint::Normal { vertex, normal } => {
            let found = limit_vertex(&level, &points, VertexId(vertex)).normal;
            found.is_some_and(|found| found.dot(normal) < 0.0)
        }
        _ => false,
    });
    let turned_over = turned_over.collect();
    let energy = [&mesh.points, &points].map(|points| bending(&differences, points));
    Ok(Faired { points, energy, residual, redundant, turned_over })
}

/// What a row makes of points.
fn value(row: &Row, points: &[Vec3]) -> f64 {
    let coordinate = |at: u32| <[f64; 3]>::from(points[at as usize / 3])[at as usize % 3];
    row.terms.iter().map(|&(at, weight)| weight * coordinate(at)).sum()
}

fn bending(differences: &Rows, points: &[Vec3]) -> f64 {
    let bend = |row: &Vec<(u32, f64)>| {
        let sum = row.iter().fold(Vec3::ZERO, |sum, &(v, weight)| sum + weight * points[v as usize]);
        sum.dot(sum)
    };
    differences.iter().map(bend).sum()
}

/// The numbers of free coordinates.
struct System<'a> {
    mesh: &'a ControlMesh,
    /// Of each vertex its number among those that may move.
    numbers: Vec<Option<u32>>,
    free: Vec<u32>,
}

/// The energy over free coordinates.
struct Energy {
    matrix: Rows,
    /// Its gradient where the points are.
    slope: Vec<f64>,
    /// The largest sum of sizes of the terms that make up a slope.
    steepness: f64,
}

impl System<'_> {
    fn new<'a>(mesh: &'a ControlMesh, is_free: &[bool]) -> System<'a> {
        let free: Vec<u32> = (0..is_free.len() as u32).filter(|&v| is_free[v as usize]).collect();
        let mut numbers = vec![None; is_free.len()];
        for (number, &v) in (0..).zip(&free) {
            numbers[v as usize] = Some(number);
        }
        System { mesh, numbers, free }
    }

    fn unknowns(&self) -> usize {
        3 * self.free.len()
    }

    /// A row without its fixed terms.
    fn over_free(&self, row: &Row) -> Vec<(u32, f64)> {
        let free = |&(at, weight): &(u32, f64)| Some((3 * self.numbers[at as usize / 3]? + at % 3, weight));
        row.terms.iter().filter_map(free).collect()
    }

    /// The energy; `products` are those of second differences, over all vertices.
    fn energy(&self, products: &Rows) -> Energy {
        // Constants do not bend: relative to some point there is less to round.
        let base = self.mesh.points.first().copied().unwrap_or(Vec3::ZERO);
        let mut energy = Energy { matrix: Rows::new(), slope: Vec::new(), steepness: 0.0 };
        for &v in &self.free {
            let row = &products[v as usize];
            let (mut slope, mut size) = (Vec3::ZERO, 0.0);
            for &(u, weight) in row {
                let leg = weight * (self.mesh.points[u as usize] - base);
                slope += leg;
                size += leg.length();
            }
            energy.steepness = energy.steepness.max(size);
            energy.slope.extend(<[f64; 3]>::from(slope));
            let free: Vec<(u32, f64)> =
                row.iter().filter_map(|&(u, weight)| Some((3 * self.numbers[u as usize]?, weight))).collect();
            energy.matrix.extend((0..3).map(|c| free.iter().map(|&(at, weight)| (at + c, weight)).collect()));
        }
        energy
    }

    fn moved(&self, points: &[Vec3], change: &[f64]) -> Vec<Vec3> {
        let mut points = points.to_vec();
        for (&v, change) in self.free.iter().zip(change.chunks_exact(3)) {
            points[v as usize] += Vec3::new(change[0], change[1], change[2]);
        }
        points
    }
}
