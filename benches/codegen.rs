//! Time from document to WGSL, with and without validation.
fn main() {}
