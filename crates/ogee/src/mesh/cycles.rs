//! `FaceCycles`: which halfedge of a face follows which.

/// The halfedges of each face, one after the other and round again.
pub(crate) trait FaceCycles: Copy + Sync + Send {
    /// The next halfedge of the same face.
    fn next(self, h: u32) -> u32;
    /// The previous halfedge of the same face.
    fn prev(self, h: u32) -> u32;
}

/// Halfedges `4f .. 4f + 4` are those of face `f`.
#[derive(Clone, Copy)]
pub(crate) struct QuadCycles;

/// Halfedges `starts[f] .. starts[f + 1]` are those of face `f`; `face[h]` the other way.
#[derive(Clone, Copy)]
pub(crate) struct PolygonCycles<'a> {
    pub(crate) starts: &'a [u32],
    pub(crate) face: &'a [u32],
}

impl FaceCycles for QuadCycles {
    #[inline]
    fn next(self, h: u32) -> u32 {
        (h & !3) | ((h + 1) & 3)
    }
    #[inline]
    fn prev(self, h: u32) -> u32 {
        (h & !3) | (h.wrapping_sub(1) & 3)
    }
}

impl FaceCycles for PolygonCycles<'_> {
    #[inline]
    fn next(self, h: u32) -> u32 {
        let f = self.face[h as usize] as usize;
        if h + 1 == self.starts[f + 1] { self.starts[f] } else { h + 1 }
    }
    #[inline]
    fn prev(self, h: u32) -> u32 {
        let f = self.face[h as usize] as usize;
        if h == self.starts[f] { self.starts[f + 1] - 1 } else { h - 1 }
    }
}
