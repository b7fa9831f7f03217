//! Which vertices are lenses, pairs and poles, and what their neighbourhoods allow.
