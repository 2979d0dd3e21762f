//! What a drill meets on its way, against brute force, other forms of the same body, and published numbers.

mod golden;
mod mesh;
mod pre_holes;
mod random_ways;
