//! Re-meshing of lenses: figures 10, 11 and 12 of the paper.
