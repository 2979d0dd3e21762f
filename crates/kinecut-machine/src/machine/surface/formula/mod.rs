//! The shape-generation function written out: the product of the matrices of the motions with their entries as
//! formulas, and the point multiplied out (Danilchenko et al., equations 2 to 5, right-handed and with the brackets
//! that equation 4 lacks).

mod matrix;
mod page;
mod shape;

pub use matrix::{Matrix, Vector};
pub use shape::ShapeFormula;
pub(super) use shape::{cross, dot};
