//! Stencils of limit points: the surface at fixed places as weights on the cage, for cages that move.

use std::collections::HashMap;

use super::Derivatives;
use super::bicubic::basis;
use super::place::{Patch, Tile, power_of_two};
use crate::math::par;
use crate::patch::{ChainBasis, Location, PatchTable, TURNED, Tail, child};
use crate::stencil::{StencilTable, join};

/// Weights of position, `du`, `dv`, `duu`, `duv`, `dvv` on some points.
type Parts<T> = [T; 6];

impl PatchTable {
    /// Weights of points of the surface over the points of the cage: one row per location, or three (position, `du`,
    /// `dv`), or six (then `duu`, `duv`, `dvv`). [`StencilTable::apply`] evaluates all of them for any pose of the cage,
    /// or for any other data on it.
    ///
    /// Rows of positions sum to one, rows of derivatives to zero. At an extraordinary vertex the rows of `du` and `dv` are
    /// two that span the tangent plane, or empty where there is no mask for them; second derivatives have empty rows.
    /// Which way `du x dv` looks at a re-entrant corner of two faces depends on where points are, which rows do not know.
    ///
    /// Costs some microseconds a location.
    ///
    /// # Panics
    /// If a location is of another table, or if there would be `2^32` weights or more.
    pub fn stencils(&self, at: &[Location], what: Derivatives) -> StencilTable {
        const CHUNK: usize = 1024;
        let count = match what {
            Derivatives::None => 1,
            Derivatives::First => 3,
            Derivatives::Second => 6,
        };
        let chunks = par::map(at.len().div_ceil(CHUNK), |chunk| {
            let mut writer = Writer { table: self, count, rows: HashMap::new() };
            let some = &at[chunk * CHUNK..((chunk + 1) * CHUNK).min(at.len())];
            some.iter().flat_map(|&at| writer.rows_at(at)).collect::<Vec<_>>()
        });
        let mut out = StencilTable::empty();
        for row in chunks.into_iter().flatten() {
            out.append(row);
        }
        out
    }
}

/// Weights over the ring of each fine point of a chain.
type ChainRows = Vec<Vec<(usize, f64)>>;

struct Writer<'a> {
    table: &'a PatchTable,
    /// How many of the parts are wanted.
    count: usize,
    rows: HashMap<u32, ChainRows>,
}

impl Writer<'_> {
    fn rows_at(&mut self, at: Location) -> Vec<Vec<(u32, f64)>> {
        let table = self.table;
        let (patch, x, y) = Patch::at(table, at);
        let (sources, parts) = match patch {
            Patch::Leaf { sources, depth } => {
                let scale = power_of_two(depth);
                (
                    &sources[..],
                    scaled(net_weights(x, y).map(|part| part.to_vec()), [1.0, scale, scale * scale]),
                )
            }
            Patch::Tile(tile) if table.basis(tile.tail).has_quarters() => {
                let (quarter, x, y) = child(x, y);
                (table.ring(tile.tail), self.tile(&tile.quarter(quarter), x, y))
            }
            Patch::Tile(tile) => (table.ring(tile.tail), self.tile(&tile, x, y)),
            Patch::Vertex { tail, .. } => (table.ring(tail), vertex(table, tail)),
        };
        parts.into_iter().take(self.count).map(|part| on_cage(table, sources, &part)).collect()
    }

    /// Weights over the ring of a tail, pulled back step by step.
    fn tile(&mut self, tile: &Tile, x: f64, y: f64) -> Parts<Vec<f64>> {
        let chain = self.table.basis(tile.tail);
        let rows = self.rows.entry(tile.tail.kind).or_insert_with(|| chain.all_rows());
        let wanted = self.count;
        let mut number = 0;
        let mut parts = net_weights(x, y).map(|part| {
            number += 1;
            if number > wanted {
                return Vec::new();
            }
            let mut fine = vec![0.0; rows.len()];
            for (&turned, weight) in TURNED[tile.tail.corner as usize].iter().zip(part) {
                fine[chain.tiles[tile.tile][turned as usize] as usize] += weight;
            }
            for _ in 0..tile.step {
                fine = pulled_back(chain, rows, &fine, number > 1);
            }
            fine
        });
        let scale = power_of_two(tile.step + tile.depth);
        let mut scales = [1.0, scale, scale * scale];
        if tile.beyond > 0 {
            let [shrink, first, second] = chain.growth(tile.beyond);
            let limits = chain.position.iter().chain(std::iter::repeat(&0.0));
            for (weight, limit) in parts[0].iter_mut().zip(limits) {
                *weight = limit + shrink * (*weight - limit);
            }
            scales = [1.0, scale * first, (scale * scale * second).min(f64::MAX)];
        }
        scaled(parts, scales)
    }
}

/// Weights on fine points as weights on the ring. Those of a derivative sum to zero and are kept so: what rounding leaves
/// would not shrink from step to step as they do.
fn pulled_back(basis: &ChainBasis, rows: &ChainRows, fine: &[f64], is_derivative: bool) -> Vec<f64> {
    let mut ring = vec![0.0; basis.ring_count()];
    for (&weight, row) in fine.iter().zip(rows) {
        for &(source, share) in row {
            ring[source] += weight * share;
        }
    }
    if is_derivative {
        let sum: f64 = ring.iter().sum();
        for (weight, limit) in ring.iter_mut().zip(&basis.position) {
            *weight -= sum * limit;
        }
    }
    ring
}

/// Weights of the sixteen points of a net.
fn net_weights(x: f64, y: f64) -> Parts<[f64; 16]> {
    let (along, across) = (basis(x), basis(y));
    [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
        .map(|(i, j)| std::array::from_fn(|point| along[i][point % 4] * across[j][point / 4]))
}

fn vertex(table: &PatchTable, tail: Tail) -> Parts<Vec<f64>> {
    let basis = table.basis(tail);
    let [along, across] = basis.tangents.clone().unwrap_or_default();
    let negative = |weights: Vec<f64>| weights.into_iter().map(|weight| -weight).collect();
    let (du, dv) = match tail.corner {
        0 => (along, across),
        1 => (negative(across), along),
        2 => (negative(along), negative(across)),
        _ => (across, negative(along)),
    };
    [basis.position.clone(), du, dv, Vec::new(), Vec::new(), Vec::new()]
}

/// First and second derivatives in the parameters of the face.
fn scaled(mut parts: Parts<Vec<f64>>, [_, first, second]: [f64; 3]) -> Parts<Vec<f64>> {
    for (part, scale) in parts[1..].iter_mut().zip([first, first, second, second, second]) {
        for weight in part {
            *weight *= scale;
        }
    }
    parts
}

/// Weights on the cage, each vertex once, in order.
fn on_cage(table: &PatchTable, sources: &[u32], weights: &[f64]) -> Vec<(u32, f64)> {
    let cage = table.cage_count() as u32;
    let mut row: Vec<(u32, f64)> = Vec::with_capacity(2 * weights.len());
    for (&source, &weight) in sources.iter().zip(weights).filter(|&(_, &weight)| weight != 0.0) {
        if source < cage {
            row.push((source, weight));
        } else {
            let local = table.local().row((source - cage) as usize);
            row.extend(local.map(|(vertex, share)| (vertex, weight * share)));
        }
    }
    join(&mut row);
    row
}
