//! The published bi-4 stencils, and what follows from them.
