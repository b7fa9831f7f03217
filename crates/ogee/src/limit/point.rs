//! What evaluation gives: points, how much is wanted of them, and flags.

use crate::math::{Curvature, SurfaceJet, Vec3};

/// How many derivatives are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Derivatives {
    /// Positions alone.
    None,
    /// First derivatives, and with them the normal.
    #[default]
    First,
    /// Second derivatives as well.
    Second,
}

/// What is special about a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags(u8);

impl Flags {
    /// Nothing special.
    pub const NONE: Flags = Flags(0);
    /// An extraordinary vertex itself: `du` and `dv` are two vectors that span the tangent plane, `du x dv` along the
    /// normal, not derivatives; second derivatives are zero because there are none.
    pub const AT_EXTRAORDINARY: Flags = Flags(1);
    /// No single tangent plane exists here: the normal is the limit along the middle of this face.
    pub const NORMAL_ONE_SIDED: Flags = Flags(2);
    /// Curvature grows without bound towards this point.
    pub const UNBOUNDED_CURVATURE: Flags = Flags(4);
    /// So close to an extraordinary vertex that the surface is its own limit shape, scaled. Second derivatives may be
    /// infinite here.
    pub const BEYOND_NMAX: Flags = Flags(8);
    /// Tangents vanish or are parallel: the normal is the zero vector.
    pub const NORMAL_UNDEFINED: Flags = Flags(16);

    /// True if all of these are set.
    pub const fn contains(self, other: Flags) -> bool {
        self.0 & other.0 == other.0
    }

    /// Both together.
    #[must_use]
    pub const fn with(self, other: Flags) -> Flags {
        Flags(self.0 | other.0)
    }
}

/// A point of the limit surface with its tangents and normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub position: Vec3,
    /// Derivative along `u`.
    pub du: Vec3,
    /// Derivative along `v`.
    pub dv: Vec3,
    /// Unit normal, outward where faces are counter-clockwise seen from outside; zero where it is undefined.
    pub normal: Vec3,
    /// What is special about the point.
    pub flags: Flags,
}

/// A point of the limit surface to second order.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LimitJet {
    /// Position, first and second derivatives.
    pub jet: SurfaceJet,
    /// Unit normal; zero where it is undefined.
    pub normal: Vec3,
    /// What is special about the point.
    pub flags: Flags,
}

impl LimitJet {
    /// Curvatures; `None` where there are none: at an extraordinary vertex, and where the normal is undefined.
    pub fn curvature(&self) -> Option<Curvature> {
        if self.has_curvature() { self.jet.curvature() } else { None }
    }

    /// Derivatives of the unit normal along `u` and `v`; `None` where there are no curvatures.
    pub fn normal_derivatives(&self) -> Option<[Vec3; 2]> {
        if self.has_curvature() { self.jet.normal_derivatives() } else { None }
    }

    fn has_curvature(&self) -> bool {
        !self.flags.contains(Flags::AT_EXTRAORDINARY) && !self.flags.contains(Flags::NORMAL_UNDEFINED)
    }
}

/// Many points, as arrays in the order in which they were asked for. What was not asked for is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Positions.
    pub position: Vec<Vec3>,
    /// Derivatives along `u`.
    pub du: Vec<Vec3>,
    /// Derivatives along `v`.
    pub dv: Vec<Vec3>,
    /// Unit normals, zero where undefined.
    pub normal: Vec<Vec3>,
    /// Second derivatives along `u`.
    pub duu: Vec<Vec3>,
    /// Mixed derivatives.
    pub duv: Vec<Vec3>,
    /// Second derivatives along `v`.
    pub dvv: Vec<Vec3>,
    /// What is special about each point.
    pub flags: Vec<Flags>,
}
