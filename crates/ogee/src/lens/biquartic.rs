//! Bi-4 subdivision: the lens that is C2, from 60 points.
