//! `ControlMesh`: the polygons a designer moves, as plain data. Nothing is promised about it until a
//! [`crate::Level`] is built from it.

use crate::math::Vec3;

/// A Catmull-Clark control mesh (cage) with its tags.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlMesh {
    /// Vertex positions, in file order.
    pub points: Vec<Vec3>,
    /// Vertex indices of each face, counter-clockwise seen from outside.
    pub faces: FaceList,
    /// Sharp and semi-sharp edges. If an edge is named twice the last one counts.
    pub creases: Vec<Crease>,
    /// Sharp and semi-sharp vertices. If a vertex is named twice the last one counts.
    pub corners: Vec<Corner>,
    /// Faces that take part in refinement but are no part of the surface.
    pub holes: Vec<u32>,
    /// Vertices at which curves of a network meet. If a vertex is named twice the last one counts.
    pub meetings: Vec<Meeting>,
    /// Choices of the subdivision scheme.
    pub scheme: Scheme,
    /// Texture coordinates, if there are any.
    pub uv: Option<FaceVarying>,
}

/// Faces of any number of corners, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceList {
    starts: Vec<u32>,
    vertices: Vec<u32>,
}

/// Face-varying values: a second mesh over the same faces, whose vertices are the values.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceVarying {
    /// The values.
    pub values: Vec<[f64; 2]>,
    /// For each corner of each face, in the order of the face list, the index of its value.
    pub indices: Vec<u32>,
    /// Which values stay where they are.
    pub rule: FaceVaryingRule,
}

/// Which face-varying values are interpolated linearly, that is, never move (`docs/methods/catmull_clark.md`, Theory).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceVaryingRule {
    /// None by rule.
    None,
    /// Values held by one face.
    CornersOnly,
    /// Also every value of a vertex that has three or more, and both of two where one's faces are not
    /// consecutive. The default of USD and of this library.
    #[default]
    CornersPlus1,
    /// Also the value at the inner end of a seam, and both of two if one is held by one face.
    CornersPlus2,
    /// Every value on a seam or boundary; their edge points are midpoints.
    Boundaries,
    /// Everything is bilinear.
    All,
}

/// What a file says about the subdivision scheme.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scheme {
    /// Rule at the boundary.
    pub boundary: Boundary,
    /// How semi-sharp creases fade.
    pub creasing: Creasing,
    /// Shape of the rule at interior vertices of valence 2.
    pub lens: LensShape,
}

/// Shape of the rule at an interior vertex of valence 2, where Catmull and Clark's own has no tangent plane: of the new
/// vertex, the rest is the weight of the old one. The rule is that of Karciauskas and Peters, *Lens-shaped surfaces and C2
/// subdivision* (`docs/methods/lens.md`, The rule).
///
/// [`crate::Level`] takes shapes for which the surface has a tangent plane and weights are not negative, see
/// [`LensShape::is_smooth`]. Curvature grows without bound at the vertex for all of them; for `gamma` from 3/16 to 1/4 at
/// the usual `beta` about half as fast as usual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensShape {
    /// Weight of the two neighbours together; 1/2 usually.
    pub beta: f64,
    /// Weight of the two opposite corners together, where both faces are quads; 1/8 usually.
    pub gamma: f64,
}

impl Default for LensShape {
    fn default() -> LensShape {
        LensShape { beta: 0.5, gamma: 0.125 }
    }
}

impl LensShape {
    /// True if the limit has a tangent plane at the vertex and lies between the points around it: `beta > 0`, `gamma >= 0`,
    /// `beta + gamma <= 1`, `2 beta + 4 gamma > 1` and `6 beta + 4 gamma < 5`. The last two, and `0 < beta < 1`, say that the
    /// eigenvalues that depend on the shape, the roots of `16 x^2 + 4 x (4 beta + 4 gamma - 3) + 1 - 2 beta`, are smaller than
    /// that of the tangents, 1/4. Catmull and Clark's own rule, 3/4 and 1/8, has -1/4 among them.
    pub fn is_smooth(self) -> bool {
        let LensShape { beta, gamma } = self;
        beta > 0.0
            && gamma >= 0.0
            && beta + gamma <= 1.0
            && 2.0 * beta + 4.0 * gamma > 1.0
            && 6.0 * beta + 4.0 * gamma < 5.0
    }
}

/// Rule at the boundary of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Boundary {
    /// Boundary edges are infinitely sharp, and so are boundary vertices with a single face.
    #[default]
    EdgeAndCorner,
    /// Boundary edges are infinitely sharp.
    EdgeOnly,
    /// Faces that touch a boundary vertex are no part of the surface.
    None,
}

/// How semi-sharp creases fade from level to level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Creasing {
    /// Sharpness falls by one per level.
    #[default]
    Uniform,
    /// Chaikin's averaging along the crease, less one.
    Chaikin,
}

/// How long an edge or vertex is kept sharp.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Sharpness {
    /// For so many levels; fractions blend. Between 0 and 10.
    Finite(f64),
    /// For ever.
    Infinite,
}

impl Sharpness {
    /// The value a file gives: 10 and more are infinite, 0 and less are smooth.
    ///
    /// ```
    /// # use ogee::Sharpness;
    /// assert_eq!(Sharpness::from_value(10.0), Sharpness::Infinite);
    /// assert_eq!(Sharpness::from_value(-1.0), Sharpness::Finite(0.0));
    /// ```
    pub fn from_value(value: f64) -> Sharpness {
        if value >= 10.0 { Sharpness::Infinite } else { Sharpness::Finite(value.max(0.0)) }
    }

    /// As a number; `f64::INFINITY` where it never fades.
    pub fn value(self) -> f64 {
        match self {
            Sharpness::Finite(value) => value,
            Sharpness::Infinite => f64::INFINITY,
        }
    }
}

/// An edge that is kept sharp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    /// The ends of the edge, in either order.
    pub vertices: [u32; 2],
    /// For how long.
    pub sharpness: Sharpness,
}

/// A vertex that is kept sharp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The vertex.
    pub vertex: u32,
    /// For how long.
    pub sharpness: Sharpness,
}

/// A vertex at which curves of a network meet: it never moves, and the quads around it follow a rule of their own
/// (`docs/methods/curve_network.md`).
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// The vertex: inside, with an even number of faces, all quads.
    pub vertex: u32,
    /// The neighbours through which curves arrive, counter-clockwise: every second one.
    pub ports: Vec<u32>,
    /// The parameter `t` of Abbas and Nasri, above 0 and at most 1/2.
    pub t: f64,
}

impl Default for FaceList {
    fn default() -> FaceList {
        FaceList { starts: vec![0], vertices: Vec::new() }
    }
}

impl FaceList {
    /// No faces.
    pub fn new() -> FaceList {
        FaceList::default()
    }

    /// Room for `faces` faces with `corners` corners in all.
    pub fn with_capacity(faces: usize, corners: usize) -> FaceList {
        let mut starts = Vec::with_capacity(faces + 1);
        starts.push(0);
        FaceList { starts, vertices: Vec::with_capacity(corners) }
    }

    /// The faces whose corners these are, one face after the other: face `f` has those from `starts[f]` up to
    /// `starts[f + 1]`, so that there is one start more than there are faces. `None` if the starts do not begin with 0,
    /// fall, or do not end with the number of corners.
    ///
    /// ```
    /// # use ogee::FaceList;
    /// let faces = FaceList::from_arrays(vec![0, 3, 7], vec![0, 1, 2, 0, 2, 3, 4]).expect("a triangle and a quad");
    /// assert_eq!(faces.face(1), [0, 2, 3, 4]);
    /// assert!(FaceList::from_arrays(vec![0, 3, 8], vec![0, 1, 2, 0, 2, 3, 4]).is_none());
    /// ```
    pub fn from_arrays(starts: Vec<u32>, corners: Vec<u32>) -> Option<FaceList> {
        let fits = starts.first() == Some(&0)
            && starts.last().is_some_and(|&end| end as usize == corners.len())
            && starts.is_sorted();
        fits.then_some(FaceList { starts, vertices: corners })
    }

    /// Adds a face.
    ///
    /// # Panics
    /// If the list would have `2^32` corners or more.
    pub fn push(&mut self, corners: &[u32]) {
        self.vertices.extend_from_slice(corners);
        self.starts.push(u32::try_from(self.vertices.len()).expect("fewer than 2^32 corners of faces"));
    }

    /// Number of faces.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// True if there is no face.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The corners of face `f`, in order.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn face(&self, f: usize) -> &[u32] {
        &self.vertices[self.starts[f] as usize..self.starts[f + 1] as usize]
    }

    /// All faces in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + '_ {
        (0..self.len()).map(|f| self.face(f))
    }

    /// The corners of all faces, one face after the other.
    pub fn corners(&self) -> &[u32] {
        &self.vertices
    }

    /// Where each face begins in [`FaceList::corners`]; one entry more than there are faces.
    pub fn starts(&self) -> &[u32] {
        &self.starts
    }
}

impl<const N: usize> FromIterator<[u32; N]> for FaceList {
    fn from_iter<I: IntoIterator<Item = [u32; N]>>(faces: I) -> FaceList {
        let mut list = FaceList::new();
        for face in faces {
            list.push(&face);
        }
        list
    }
}

impl ControlMesh {
    /// A mesh of points and faces, with no tags.
    pub fn new(points: Vec<Vec3>, faces: FaceList) -> ControlMesh {
        ControlMesh { points, faces, ..ControlMesh::default() }
    }

    /// The bounding box of all points, `[least, greatest]`; `None` without points.
    pub fn bounding_box(&self) -> Option<[Vec3; 2]> {
        let first = *self.points.first()?;
        Some(self.points.iter().fold([first, first], |[low, high], &p| [low.min(p), high.max(p)]))
    }

    /// The diagonal of the bounding box: the size that tolerances are relative to.
    pub fn size(&self) -> f64 {
        self.bounding_box().map_or(0.0, |[low, high]| low.distance(high))
    }
}
