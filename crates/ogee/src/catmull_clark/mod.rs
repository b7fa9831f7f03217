//! The smooth rules of Catmull and Clark, Recursively generated B-spline surfaces on arbitrary topological meshes
//! (1978).

pub(crate) mod rule;
