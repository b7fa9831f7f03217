//! Indices with names: a face index is not a vertex index.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The index, for arrays.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

id!(
    /// A vertex, numbered from 0 in file order.
    VertexId
);
id!(
    /// One side of an edge: it leaves its origin and has its face on the left.
    HalfedgeId
);
id!(
    /// An edge, numbered in the order of first meeting it while walking the halfedges.
    EdgeId
);
id!(
    /// A face, numbered from 0 in file order.
    FaceId
);
