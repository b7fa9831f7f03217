//! `LimitSurface`: the limit surface of a cage at any point.

use std::borrow::Cow;
use std::ops::Range;

use super::batch::{Batch, Worker};
use super::out::Out;
use super::{Derivatives, Flags, LimitJet, Pattern, Samples, SurfacePoint, faces};
use crate::math::{Interpolate, SurfaceJet, Vec3, par};
use crate::mesh::VertexId;
use crate::patch::{Location, LocationError, PatchTable};

/// The limit surface of a cage: position, derivatives and normal at any point, exact everywhere.
///
/// Derivatives are with respect to the parameters of the [`Location`]. Made from a table and the points of one pose;
/// costs nothing where the table has no points of its own, else one pass over those.
#[derive(Clone, Debug)]
pub struct LimitSurface<'a> {
    table: &'a PatchTable,
    /// The cage's points, then those of the table.
    points: Cow<'a, [Vec3]>,
}

impl<'a> LimitSurface<'a> {
    /// The surface of a cage in one pose. Coordinates of 1e300 and more leave the range of numbers on the way.
    ///
    /// # Panics
    /// If there are fewer points than the cage of the table has vertices.
    pub fn new(table: &'a PatchTable, cage: &'a [Vec3]) -> LimitSurface<'a> {
        let cage = &cage[..table.cage_count()];
        let local = table.local();
        let points = if local.is_empty() {
            Cow::Borrowed(cage)
        } else {
            let mut points = Vec::with_capacity(cage.len() + local.len());
            points.extend_from_slice(cage);
            local.apply_after(cage, &mut points);
            Cow::Owned(points)
        };
        LimitSurface { table, points }
    }

    /// The table it was made with.
    pub fn table(&self) -> &'a PatchTable {
        self.table
    }

    /// The cage's points, then those of the table.
    pub(super) fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Position, tangents and normal. Costs some dozen nanoseconds, and some dozen more for every step into the chain
    /// of an extraordinary vertex.
    ///
    /// # Panics
    /// If the location is of a larger table; one of another table of the same size gives a point of no meaning.
    pub fn eval(&self, at: Location) -> SurfacePoint {
        let ([position, du, dv, ..], normal, flags) = self.lone(at, Derivatives::First);
        SurfacePoint { position, du, dv, normal, flags }
    }

    /// Second derivatives as well.
    ///
    /// # Panics
    /// If the location is of a larger table; one of another table of the same size gives a point of no meaning.
    pub fn jet(&self, at: Location) -> LimitJet {
        let ([position, du, dv, duu, duv, dvv], normal, flags) = self.lone(at, Derivatives::Second);
        LimitJet { jet: SurfaceJet { position, du, dv, duu, duv, dvv }, normal, flags }
    }

    /// Moves one vertex of the cage. Only what it has a part in is computed again, the same way as from the start; the
    /// parametric faces that change are those of [`PatchTable::seen_by`].
    ///
    /// The first call copies the points, and builds an index in the table.
    ///
    /// # Panics
    /// If the cage has no such vertex.
    pub fn move_point(&mut self, vertex: VertexId, to: Vec3) {
        let count = self.table.cage_count();
        assert!(vertex.index() < count, "the cage has {count} vertices");
        let points = self.points.to_mut();
        points[vertex.index()] = to;
        for &number in self.table.local_points_of(vertex) {
            let mut point = Vec3::ZERO;
            for (source, weight) in self.table.local().row(number as usize) {
                point.add_scaled(weight, &points[source as usize]);
            }
            points[count + number as usize] = point;
        }
    }

    fn lone(&self, at: Location, what: Derivatives) -> ([Vec3; 6], Vec3, Flags) {
        let (mut jet, mut normal, mut flags) = ([Vec3::ZERO; 6], Vec3::ZERO, Flags::NONE);
        let [position, du, dv, duu, duv, dvv] = jet.each_mut().map(std::slice::from_mut);
        let (normal_out, flags_out) = (std::slice::from_mut(&mut normal), std::slice::from_mut(&mut flags));
        let mut out = Out { position, du, dv, normal: normal_out, duu, duv, dvv, flags: flags_out };
        Worker::new(self.batch(what)).lone(at, &mut out);
        (jet, normal, flags)
    }

    fn batch(&self, what: Derivatives) -> Batch<'_> {
        Batch { table: self.table, points: &self.points, what }
    }

    /// Many points at once, in the order asked, on all cores. Quickest where samples of the same face stand together,
    /// some thousands at a time.
    ///
    /// # Panics
    /// If a location is of a larger table; one of another table of the same size gives a point of no meaning.
    pub fn eval_batch(&self, at: &[Location], what: Derivatives) -> Samples {
        let mut samples = Samples::default();
        self.eval_into(at, what, &mut samples);
        samples
    }

    /// [`LimitSurface::eval_batch`] into memory that is there already: fresh memory costs more than the arithmetic.
    ///
    /// # Panics
    /// If a location is of a larger table; one of another table of the same size gives a point of no meaning.
    pub fn eval_into(&self, at: &[Location], what: Derivatives, out: &mut Samples) {
        out.resize(at.len(), what);
        self.batch(what).run(at, out.slices());
    }

    /// The places of a pattern on the parametric faces of a range of numbers: face by face, on each in the order of the
    /// pattern, into memory that may be there already. On all cores; what a face gives depends on no other.
    ///
    /// As exact as [`LimitSurface::eval_batch`], and with the same flags, but sums near extraordinary vertices are taken in
    /// another order, so last bits may differ. Costs a half to a third of it where places are few. Quickest in blocks of some
    /// thousand samples a core, which stay in the cache until they are used.
    ///
    /// # Errors
    /// [`LocationError::HiddenFace`] if one of the faces is no part of the surface ([`PatchTable::is_visible`]); `out` is
    /// then as it was.
    ///
    /// # Panics
    /// If there are no such faces, or the pattern is of another table.
    pub fn eval_pattern(
        &self,
        pattern: &Pattern<'_>,
        faces: Range<usize>,
        out: &mut Samples,
    ) -> Result<(), LocationError> {
        self.check(pattern, &faces)?;
        out.resize(faces.len() * pattern.len(), pattern.derivatives());
        faces::run(self.batch(pattern.derivatives()), pattern, faces, out.slices());
        Ok(())
    }

    /// [`LimitSurface::eval_pattern`] block by block: `take` gets some faces of the range and their samples, while these are in
    /// the cache. It is called by all cores at the same time, in no order; together its calls get every face once.
    ///
    /// Memory does not grow with the number of samples. The quickest way through a whole surface.
    ///
    /// # Errors
    /// As [`LimitSurface::eval_pattern`]; `take` is then not called.
    ///
    /// # Panics
    /// If there are no such faces, or the pattern is of another table.
    pub fn visit_pattern(
        &self,
        pattern: &Pattern<'_>,
        faces: Range<usize>,
        take: impl Fn(Range<usize>, &Samples) + Sync + Send,
    ) -> Result<(), LocationError> {
        self.check(pattern, &faces)?;
        let batch = self.batch(pattern.derivatives());
        let step = faces::in_block(pattern);
        par::each_with(faces.len().div_ceil(step), Samples::default, |samples, block| {
            let first = faces.start + block * step;
            let some = first..(first + step).min(faces.end);
            samples.resize(some.len() * pattern.len(), pattern.derivatives());
            faces::run(batch, pattern, some.clone(), samples.slices());
            take(some, samples);
        });
        Ok(())
    }

    /// Refuses faces that are no part of the surface.
    fn check(&self, pattern: &Pattern<'_>, faces: &Range<usize>) -> Result<(), LocationError> {
        assert!(std::ptr::eq(self.table, pattern.table()), "the pattern is of another table");
        let count = self.table.len();
        assert!(faces.start <= faces.end && faces.end <= count, "there are {count} parametric faces");
        match self.table.first_hidden(faces.clone()) {
            Some(hidden) => Err(LocationError::HiddenFace { face: self.table.parametric_face(hidden).face }),
            None => Ok(()),
        }
    }
}
