//! The kinecut command line.
fn main() {}
