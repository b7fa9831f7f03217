//! How normals settle around a meeting point: on the limit surface, ring after ring.

use ogee::{ControlMesh, Derivatives, Level, LimitSurface, Location, PatchTable, Topology, Vec3, VertexId};

/// Places in a slice on the outer rim of a ring, along its two spokes, in units of the ring.
const AROUND: usize = 8;

/// The largest angle, in degrees, of normals on the rim of the ring `2^-level` of the faces around a vertex and their mean,
/// or a given normal. `None` where there are no normals.
pub(super) fn spreads(
    mesh: &ControlMesh,
    center: u32,
    levels: &[u32],
    normal: Option<Vec3>,
) -> Option<Vec<f64>> {
    let level = Level::new(mesh).ok()?;
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let spread = |&ring: &u32| {
        let size = 0.5_f64.powi(ring as i32);
        let rim = (0..=2 * AROUND).map(|i| {
            let x = i as f64 / AROUND as f64;
            [x.min(1.0) * size, (2.0 - x).min(1.0) * size]
        });
        let rim: Vec<[f64; 2]> = rim.collect();
        let slices = slices(level.topology(), center);
        let places: Option<Vec<Location>> =
            slices.iter().flat_map(|slice| rim.iter().map(|&at| slice.locate(&table, at))).collect();
        let normals = surface.eval_batch(&places?, Derivatives::First).normal;
        let mean = normals.iter().fold(Vec3::ZERO, |sum, &normal| sum + normal).normalized();
        let middle = normal.or(mean)?;
        if normals.contains(&Vec3::ZERO) {
            return None;
        }
        let angle = |n: &Vec3| middle.cross(*n).length().atan2(middle.dot(*n));
        Some(normals.iter().map(angle).fold(0.0, f64::max).to_degrees())
    };
    levels.iter().map(spread).collect()
}

/// A quad at a vertex.
pub(super) struct Slice {
    face: ogee::FaceId,
    side: u32,
    /// The other end of the spoke where it begins.
    pub(super) first: u32,
}

/// The quads around a vertex, counter-clockwise.
pub(super) fn slices(topology: &Topology, center: u32) -> Vec<Slice> {
    let slice = |h| {
        let face = topology.face(h);
        Slice { face, side: h.0 - topology.first(face).0, first: topology.target(h).0 }
    };
    topology.ring(VertexId(center)).map(slice).collect()
}

impl Slice {
    /// A place in it: `s` along the spoke where it begins, `t` along that where it ends.
    pub(super) fn locate(&self, table: &PatchTable, [s, t]: [f64; 2]) -> Option<Location> {
        let [u, v] = match self.side {
            0 => [s, t],
            1 => [1.0 - t, s],
            2 => [1.0 - s, 1.0 - t],
            _ => [t, 1.0 - s],
        };
        table.locate(self.face, None, u, v).ok()
    }
}
