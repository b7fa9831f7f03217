//! Bicubic polar subdivision: a fan of triangles in the midst of circles of quads.
