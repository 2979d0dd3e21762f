//! Numbers: angles, halving, guaranteed root finders, roots of polynomials, series without cancellation, power series,
//! quadrature, singular values, least values, disjoint sets, random numbers.

pub mod angle;
pub mod bisect;
pub mod eigen;
pub mod minimum;
pub mod polynomial;
pub mod quadrature;
pub mod random;
pub mod root;
pub mod series;
pub mod sets;
pub mod singular;
pub mod taylor;
