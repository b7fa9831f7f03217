//! Weights: gathered as rows, kept as tables.

mod row;
mod table;

pub use row::Row;
pub(crate) use row::join;
pub use table::StencilTable;
