//! The whole journey from a cage to a part.

mod part;

pub use part::{Body, Method, Part, Report};
