//! What a conversion by PCCM holds at most, known from counts before the first patch is made.
//!
//! With `F` faces converted, `N` of them next to irregular corners or to semi-sharp creases, `C` coefficients of a patch on its level
//! and `B` faces in the largest block, these are
//!
//! ```text
//! 24 (16 (F - N) + C N)    coefficients of the surfaces that are kept
//! 2100 F                   the levels of the cage, outlines, edges, loops, shells
//! 1300 F                   points of all shells, where one may be inside another
//! 160 (2^level + 7)^2 B    a block on its way: the refined mesh, nets of all levels, patches as inserted and as smoothed
//! ```

use super::{ConvertError, Options, Packing};
use crate::mesh::{FaceId, HalfedgeId};
use crate::pccm::{self, Blocks, Group, Plan};
use crate::refine::TooDeep;
use crate::rules::Level;

/// Measured on studded tori of 10 000 and 100 000 quads at levels 2 to 5 (82 to 148), rounded up.
const BYTES_PER_COEFFICIENT: u128 = 160;

/// Measured on a studded torus of a million quads, 2 000 beside the coefficients, rounded up.
const BYTES_PER_FACE: u128 = 2_100;

/// Forty-nine points of every face, to ask whether a shell is inside another.
const BYTES_PER_SAMPLED_FACE: u128 = 1_300;

/// Coefficients of a face that is one bicubic piece.
const REGULAR_COEFFICIENTS: u128 = 16;

/// Bytes of a point.
const BYTES_PER_POINT: u128 = 24;

/// Faces that are converted at once: few enough that what is needed on the way does not count, enough that not much is made twice
/// around them.
pub(super) fn block_size(group: &Group, options: &Options) -> usize {
    const COEFFICIENTS: usize = 1 << 18;
    const LEAST: usize = 1 << 10;
    match options.packing {
        // A rectangle of quads wants all of them at hand.
        Packing::Packed => group.faces.len(),
        Packing::Unpacked => (COEFFICIENTS >> (2 * group.level)).max(LEAST),
    }
}

/// The most that a plan will hold.
///
/// # Errors
/// If that is more than is allowed.
pub(super) fn stated(cage: &Level, plan: &Plan, options: &Options) -> Result<u64, ConvertError> {
    let counts = Counts::new(cage, plan);
    let greatest = plan.groups.iter().map(|group| group.level).max().unwrap_or(0);
    let bytes = |most: u32| counts.bytes(cage, plan, options, most);
    let needed = bytes(greatest);
    let allowed = options.memory.unwrap_or(u64::MAX);
    if needed <= u128::from(allowed) {
        return Ok(u64::try_from(needed).unwrap_or(u64::MAX));
    }
    match (LEAST_LEVEL..greatest).rev().find(|&shallower| bytes(shallower) <= u128::from(allowed)) {
        Some(deepest) => {
            let cells = |group: &Group| (group.faces.len() as u128) << (2 * group.level);
            Err(TooDeep { depth: greatest, faces: plan.groups.iter().map(cells).sum(), deepest }.into())
        }
        None => Err(ConvertError::Memory {
            patches: counts.faces as u64,
            bytes: u64::try_from(bytes(greatest.min(LEAST_LEVEL))).unwrap_or(u64::MAX),
            allowed,
        }),
    }
}

/// No patches are made on a level below.
const LEAST_LEVEL: u32 = 2;

/// What memory depends on.
struct Counts {
    faces: u128,
    /// For each group the faces that are more than one bicubic piece.
    irregular: Vec<u128>,
    /// True if there may be several shells.
    is_in_pieces: bool,
}

impl Counts {
    fn new(cage: &Level, plan: &Plan) -> Counts {
        let is_irregular = pccm::irregular_faces(cage);
        let of_group = |group: &Group| match group.steps {
            0 => group.faces.iter().filter(|face| is_irregular[face.index()]).count() as u128,
            // The middles of polygons are irregular as well.
            _ => group.faces.len() as u128,
        };
        Counts {
            faces: plan.groups.iter().map(|group| group.faces.len() as u128).sum(),
            irregular: plan.groups.iter().map(of_group).collect(),
            is_in_pieces: is_in_pieces(cage),
        }
    }

    /// With no group on a level greater than `most`.
    fn bytes(&self, cage: &Level, plan: &Plan, options: &Options, most: u32) -> u128 {
        let (mut kept, mut on_the_way) = (0, 0);
        for (group, &irregular) in plan.groups.iter().zip(&self.irregular) {
            let side = (1u128 << group.level.min(most)) + 7;
            let regular = group.faces.len() as u128 - irregular;
            kept += BYTES_PER_POINT * (REGULAR_COEFFICIENTS * regular + side * side * irregular);
            let block = Blocks::new(cage, group, block_size(group, options)).largest() as u128;
            on_the_way = on_the_way.max(block * side * side * BYTES_PER_COEFFICIENT);
        }
        let sampled = if self.is_in_pieces { BYTES_PER_SAMPLED_FACE } else { 0 };
        kept + on_the_way + self.faces * (BYTES_PER_FACE + sampled)
    }
}

/// True if not all faces hang together.
fn is_in_pieces(cage: &Level) -> bool {
    let topology = cage.topology();
    let mut seen = vec![false; topology.face_count()];
    let mut waiting: Vec<FaceId> = (0..topology.face_count().min(1) as u32).map(FaceId).collect();
    waiting.iter().for_each(|face| seen[face.index()] = true);
    while let Some(face) = waiting.pop() {
        for across in topology.halfedges(face).filter_map(|h: HalfedgeId| topology.twin(h)) {
            let across = topology.face(across);
            if !std::mem::replace(&mut seen[across.index()], true) {
                waiting.push(across);
            }
        }
    }
    seen.contains(&false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{ControlMesh, VertexId, shapes};

    fn asked(mesh: &ControlMesh, level: u32, memory: u64) -> Result<u64, ConvertError> {
        let options = Options {
            level: Some(level),
            packing: Packing::Unpacked,
            memory: Some(memory),
            ..Options::default()
        };
        let cage = Level::new(mesh).unwrap_or_else(|error| panic!("{error}"));
        let plan = pccm::plan(&cage, pccm::Layer::Second, Some(level))?;
        stated(&cage, &plan, &options)
    }

    #[test]
    fn what_does_not_fit_is_refused_with_the_level_that_does() {
        let mesh = shapes::studded_torus(12, 12, 4);
        let at = |level: u32| asked(&mesh, level, u64::MAX).unwrap_or_else(|error| panic!("{error}"));
        for (level, deepest) in [(4, 3), (5, 3), (3, 2)] {
            match asked(&mesh, level, at(deepest)) {
                Err(ConvertError::TooDeep(error)) => {
                    assert_eq!((error.depth, error.deepest), (level, deepest))
                }
                other => panic!("{other:?}"),
            }
        }
        assert_eq!(asked(&mesh, 3, at(3)).ok(), Some(at(3)));
        match asked(&mesh, 3, at(2) - 1) {
            Err(ConvertError::Memory { bytes, allowed, .. }) => {
                assert_eq!((bytes, allowed), (at(2), at(2) - 1))
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn pieces_are_counted() {
        let level = |mesh: &ControlMesh| Level::new(mesh).unwrap_or_else(|error| panic!("{error}"));
        let cube = shapes::cube();
        assert!(!is_in_pieces(&level(&cube)));
        let mut two = cube.clone();
        two.points.extend(cube.points.iter().map(|&p| p * 3.0));
        for face in cube.faces.iter() {
            two.faces.push(&face.iter().map(|v| v + 8).collect::<Vec<_>>());
        }
        assert!(is_in_pieces(&level(&two)));
    }

    #[test]
    fn a_vertex_is_irregular_to_all_faces_around_it() {
        let level = Level::new(&shapes::studded_torus(12, 12, 4)).unwrap_or_else(|error| panic!("{error}"));
        let irregular = pccm::irregular_faces(&level);
        let topology = level.topology();
        for f in (0..topology.face_count() as u32).map(FaceId) {
            let touches = topology.halfedges(f).any(|h| {
                let v: VertexId = topology.origin(h);
                topology.ring(v).count() != 4
            });
            assert_eq!(irregular[f.index()], touches);
        }
    }
}
