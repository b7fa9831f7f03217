//! `TreatedSurface`: the limit surface of a cage with caps in it, at the cage's own addresses.

use super::cover::{CapPoint, Covered};
use super::treat::{Method, Treated};
use crate::limit::{Derivatives, Evaluator, LimitJet, LimitSurface, Samples};
use crate::math::{Curvature, par};
use crate::nurbs::FaceAddress;
use crate::patch::{Location, PatchTable};
use std::collections::HashMap;

/// The limit surface of a cage, but where caps stand for faces of it: there the caps themselves, to all depths. Exact everywhere,
/// and C2 where caps and limit surface meet.
///
/// Addresses are those of the first cage, however often it was refined on the way. A cap takes the parameters of the faces in whose
/// place it is: of a bi-4 lens the coordinates of the w-plane, of a polar cap radius and direction. So beside a slit the side that
/// lies on it is a single point; and in the triangles of a fan, where radius and direction follow from barycentric coordinates,
/// derivatives of second order grow as one over the distance from the pole.
///
/// At a lens and at a pole points are flagged [`AT_EXTRAORDINARY`](crate::Flags::AT_EXTRAORDINARY): `du` and `dv` span the
/// tangent plane and are no derivatives. There is a curvature: [`TreatedSurface::curvature`] has it.
///
/// ```
/// use ogee::lens::{Method, Options, TreatedSurface, treat};
/// use ogee::{FaceId, Level, LimitSurface, PatchTable, shapes};
///
/// let mesh = shapes::lens();
/// let table = PatchTable::new(&Level::new(&mesh)?);
/// let limit = LimitSurface::new(&table, &mesh.points);
/// let treated = treat(&mesh, &Options { method: Method::C2, ..Options::default() })?;
/// let surface = TreatedSurface::new(&limit, &treated).expect("caps alone change no face");
///
/// // Vertex 0 is a lens.
/// let lens = table.locate(FaceId(0), None, 0.0, 0.0)?;
/// assert!(limit.jet(lens).curvature().is_none());
/// assert!(surface.curvature(lens).is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreatedSurface<'a> {
    limit: &'a LimitSurface<'a>,
    /// What caps stand for, by parametric face.
    covered: HashMap<u32, Vec<Covered>>,
}

impl<'a> TreatedSurface<'a> {
    /// The surface of a cage whose limit surface is `limit` and which became `treated`. `None` if lenses were re-meshed, for then
    /// the surface is the limit surface of [`Treated::mesh`]; or if the caps stand for faces that this cage does not have.
    pub fn new(limit: &'a LimitSurface<'a>, treated: &Treated) -> Option<TreatedSurface<'a>> {
        let is_cage = |method: Method| matches!(method, Method::Identify | Method::Remove | Method::Merge);
        if treated.lenses.iter().any(|lens| is_cage(lens.method)) {
            return None;
        }
        let mut surface = TreatedSurface::untreated(limit);
        for covered in &treated.covered {
            let FaceAddress { face, corner, .. } = covered.piece.address;
            let at = limit.table().locate(face, corner, 0.0, 0.0).ok()?;
            surface.covered.entry(at.root).or_default().push(covered.clone());
        }
        Some(surface)
    }

    /// The limit surface as it is.
    pub fn untreated(limit: &'a LimitSurface<'a>) -> TreatedSurface<'a> {
        TreatedSurface { limit, covered: HashMap::new() }
    }

    /// The limit surface of the cage, which this is outside the caps.
    pub fn limit(&self) -> &'a LimitSurface<'a> {
        self.limit
    }

    /// True if the point lies on a cap.
    pub fn is_on_cap(&self, at: Location) -> bool {
        self.on_cap(at).is_some()
    }

    /// Position, first and second derivatives, and normal.
    ///
    /// # Panics
    /// If the location is of a larger table; one of another table of the same size gives a point of no meaning.
    pub fn jet(&self, at: Location) -> LimitJet {
        self.on_cap(at).map_or_else(|| self.limit.jet(at), |point| point.jet())
    }

    /// Curvatures; `None` where there are none. At a lens that rings replace and at the pole of a cap there are.
    ///
    /// # Panics
    /// If the location is of a larger table; one of another table of the same size gives a point of no meaning.
    pub fn curvature(&self, at: Location) -> Option<Curvature> {
        self.on_cap(at).map_or_else(|| self.limit.jet(at).curvature(), |point| point.curvature())
    }

    fn on_cap(&self, at: Location) -> Option<CapPoint<'_>> {
        self.covered.get(&at.root)?.iter().find_map(|covered| covered.point(at.u, at.v))
    }
}

impl Evaluator for TreatedSurface<'_> {
    fn table(&self) -> &PatchTable {
        self.limit.table()
    }

    fn eval_into(&self, at: &[Location], what: Derivatives, out: &mut Samples) {
        self.limit.eval_into(at, what, out);
        if self.covered.is_empty() {
            return;
        }
        let covered: Vec<usize> = (0..at.len()).filter(|&i| self.covered.contains_key(&at[i].root)).collect();
        let jets = par::collect(covered.len(), |k| Some(self.on_cap(at[covered[k]])?.jet()));
        for (i, point) in covered.into_iter().zip(jets) {
            let Some(LimitJet { jet, normal, flags }) = point else { continue };
            out.position[i] = jet.position;
            out.flags[i] = flags;
            if what >= Derivatives::First {
                (out.du[i], out.dv[i], out.normal[i]) = (jet.du, jet.dv, normal);
            }
            if what >= Derivatives::Second {
                (out.duu[i], out.duv[i], out.dvv[i]) = (jet.duu, jet.duv, jet.dvv);
            }
        }
    }
}
