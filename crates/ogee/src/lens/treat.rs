//! A cage with lenses made ready for a method that has no rule for them.
