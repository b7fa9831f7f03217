//! Curves in a surface: A. Abbas and A. Nasri, *Interpolating multiple intersecting curves using Catmull-Clark subdivision
//! surfaces* (2004), and their generalised scheme.

pub(crate) mod rule;
