//! Walking down a chain of rings.
//!
//! A ring is kept relative to a point close to the limit of its corner: rings shrink towards that limit, and taken from
//! anywhere else their points would lose a digit for every digit that they move together. So derivatives and normals keep
//! their relative accuracy at every depth.

use super::bicubic::{self, Net};
use super::normals::unit_normal;
use crate::math::Vec3;
use crate::math::simd::{self, Four};
use crate::patch::{ChainBasis, Kind, PatchTable, TURNED, Tail, Wide};

/// Steps that are taken. Below them the surface is taken for its own limit shape, scaled: parameters of 1e-120 and less.
/// Further down the squares of what is left of a ring of valence 3 would be no numbers any more.
const MAX_STEPS: i32 = 400;

/// Steps that are taken where a ring shrinks faster one way than the other: beside creases, at darts and cones. After
/// more its tangents would be parallel, to rounding.
const FEW_STEPS: i32 = 64;

/// Steps that are taken at a boundary vertex with one face that is no corner: it shrinks by 1/2 along the boundary and by
/// nearly 1/4 across. After so many, rounding of what is along is 1e-6 of what is across, and some 16 later all of it.
const FEWER_STEPS: i32 = 36;

/// Steps that are taken at a lens: rings shrink alike both ways, by 1/4, and are then as small as at valence 3 in the end.
const LENS_STEPS: i32 = 240;

/// How many steps are taken in a chain.
#[inline]
pub(super) fn last_step(basis: &ChainBasis) -> i32 {
    match basis.kind {
        Kind::Smooth { .. } => MAX_STEPS,
        Kind::Lens { crease: None, .. } => LENS_STEPS,
        Kind::Crease { faces: 1, .. } => FEWER_STEPS,
        _ => FEW_STEPS,
    }
}

/// From this step on the limit is subtracted in every step. Before, rings are too large for it to matter.
const RECENTRE_FROM: i32 = 4;

/// A ring and the step it is at; good for one tail after another, without new memory.
#[derive(Debug, Default)]
pub(super) struct Walk {
    tail: Option<u32>,
    step: i32,
    ring: Vec<Wide>,
    fine: Vec<Wide>,
    base: Wide,
}

/// A point with a fourth coordinate of zero.
#[inline(always)]
pub(super) fn wide(p: Vec3) -> Wide {
    [p.x, p.y, p.z, 0.0]
}

#[inline(always)]
pub(super) fn narrow(p: Wide) -> Vec3 {
    Vec3::new(p[0], p[1], p[2])
}

#[inline(always)]
pub(super) fn add(a: Wide, b: Wide) -> Wide {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

#[inline(always)]
pub(super) fn subtract(a: Wide, b: Wide) -> Wide {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
}

impl Walk {
    /// Forgets which tail it was on: its points may have moved.
    pub(super) fn forget(&mut self) {
        self.tail = None;
    }

    /// Goes to the ring of a tail, before any step.
    fn start(&mut self, table: &PatchTable, points: &[Vec3], number: u32, tail: Tail) {
        let sources = table.ring(tail);
        let room = table.basis(tail).work_count();
        self.ring.resize(room.max(self.ring.len()), [0.0; 4]);
        self.fine.resize(room.max(self.fine.len()), [0.0; 4]);
        self.base = wide(points[sources[0] as usize]);
        for (value, &source) in self.ring.iter_mut().zip(sources) {
            *value = subtract(wide(points[source as usize]), self.base);
        }
        self.tail = Some(number);
        self.step = 0;
    }

    /// Goes to a step of a tail, forward if it can.
    pub(super) fn go(&mut self, table: &PatchTable, points: &[Vec3], number: u32, tail: Tail, step: i32) {
        if self.tail != Some(number) || self.step > step {
            self.start(table, points, number, tail);
        }
        let basis = table.basis(tail);
        while self.step < step {
            if self.step > 0 {
                std::mem::swap(&mut self.ring, &mut self.fine);
                if self.step >= RECENTRE_FROM {
                    self.recentre(basis);
                }
            }
            basis.step(&mut self.ring[..basis.work_count()], &mut self.fine);
            self.step += 1;
        }
    }

    fn recentre(&mut self, basis: &ChainBasis) {
        let limit = weighted(&basis.position, &self.ring);
        self.base = add(self.base, limit);
        for value in &mut self.ring[..basis.ring_count()] {
            *value = subtract(*value, limit);
        }
    }

    /// What the points of [`Walk::tile`] are relative to.
    pub(super) fn base(&self) -> Wide {
        self.base
    }

    /// A tile of this step, in the directions of the piece whose irregular corner is `corner`: tile 0 at `(1, 0)` in the
    /// frame of that corner, 1 at `(1, 1)`, 2 at `(0, 1)`.
    #[inline]
    pub(super) fn tile(&self, basis: &ChainBasis, tile: usize, corner: u32, net: &mut Net) {
        let turned = &TURNED[corner as usize];
        simd::dispatch(Tile { fine: &self.fine, numbers: &basis.tiles[tile], turned, net });
    }

    /// The control points of a tile of this step in the frame of the irregular corner, relative to the base.
    pub(super) fn control_net(&self, basis: &ChainBasis, tile: usize) -> [Wide; 16] {
        basis.tiles[tile].map(|number| self.fine[number as usize])
    }

    /// The ring of this step, relative to the base: the surface nearer to the corner than the tiles lies between its
    /// points, since all masks of a chain are averages.
    pub(super) fn rest(&self, basis: &ChainBasis) -> &[Wide] {
        let ring = if self.step == 0 { &self.ring } else { &self.fine };
        &ring[..basis.ring_count()]
    }

    /// Limit position of the corner, and two vectors that span the tangent plane where there are masks for them.
    pub(super) fn corner(
        &mut self,
        table: &PatchTable,
        points: &[Vec3],
        number: u32,
        tail: Tail,
    ) -> (Vec3, Option<[Vec3; 2]>) {
        self.start(table, points, number, tail);
        let basis = table.basis(tail);
        let position = narrow(add(self.base, weighted(&basis.position, &self.ring)));
        let tangents = basis.tangents.as_ref();
        let tangents =
            tangents.map(|[a, b]| [narrow(weighted(a, &self.ring)), narrow(weighted(b, &self.ring))]);
        (position, tangents)
    }

    /// True if all quads at a meeting of curves have this normal there, to 1e-9.
    pub(super) fn agree_on(&self, normal: Vec3, basis: &ChainBasis) -> bool {
        if !matches!(basis.kind, Kind::Meeting { .. }) {
            return true;
        }
        let inner = &self.ring[..basis.kind.inner_count()];
        let ring: Vec<Vec3> = inner[1..].iter().map(|&p| narrow(p) - narrow(inner[0])).collect();
        basis.kind.meeting_tangents(&ring).all(|[first, second]| {
            unit_normal(first, second).is_some_and(|other| other.distance(normal) <= 1e-9)
        })
    }

    /// The sum of the faces' normals around the corner, as large as they are: which way the surface looks.
    pub(super) fn outward(&self, basis: &ChainBasis) -> Vec3 {
        let count = basis.kind.inner_count();
        let at = |i: usize| narrow(self.ring[if i < count { i } else { 1 }]) - narrow(self.ring[0]);
        (0..basis.kind.faces() as usize).fold(Vec3::ZERO, |sum, i| {
            sum + at(1 + 2 * i).cross(at(2 + 2 * i)) + at(2 + 2 * i).cross(at(3 + 2 * i))
        })
    }
}

/// The patch of a tile, for [`simd::dispatch`].
struct Tile<'a> {
    fine: &'a [Wide],
    numbers: &'a [u32; 16],
    turned: &'a [u8; 16],
    net: &'a mut Net,
}

impl simd::Kernel for Tile<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Tile { fine, numbers, turned, net } = self;
        let mut control = [V::splat(0.0); 16];
        for k in 0..16 {
            control[k] = V::load(&fine[numbers[usize::from(turned[k] & 15)] as usize]);
        }
        bicubic::coefficients(&control, net);
    }
}

fn weighted(weights: &[f64], ring: &[Wide]) -> Wide {
    let mut sum = [0.0; 4];
    for (&weight, point) in weights.iter().zip(ring) {
        for c in 0..4 {
            sum[c] += weight * point[c];
        }
    }
    sum
}
