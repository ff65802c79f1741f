//! Endline.
fn main() {}
