//! Creases, corners and boundaries: DeRose, Kass and Truong, Subdivision surfaces in character animation (1998),
//! with the details as OpenSubdiv settled them.

pub(crate) mod rule;
