//! The `ogee` command.

fn main() {}
