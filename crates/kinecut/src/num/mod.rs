//! Numbers: angles, guaranteed root finders, series without cancellation, power series, quadrature.

pub mod angle;
pub mod eigen;
pub mod quadrature;
pub mod root;
pub mod series;
pub mod taylor;
