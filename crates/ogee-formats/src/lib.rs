//! Files of ogee: control meshes in, parts and meshes out.
