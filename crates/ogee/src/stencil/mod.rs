//! Weights: gathered as rows, kept as tables.

mod row;
mod table;

pub use row::Row;
pub use table::StencilTable;
