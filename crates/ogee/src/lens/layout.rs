//! The w-plane: which point of a lens's neighbourhood has which number.
