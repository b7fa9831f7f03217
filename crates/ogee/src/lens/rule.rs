//! The mask of a vertex of valence 2.
