//! The whole journey from a cage to a part.

mod part;
mod sew;

pub use part::{Body, Method, Part, Report};
