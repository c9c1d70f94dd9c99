//! phytomer
fn main() {}
