//! The halfvector program.
fn main() {}
