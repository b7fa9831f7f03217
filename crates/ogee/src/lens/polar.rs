//! Polar caps: few polynomial patches around a pole, joined C2 to circles of control points.
