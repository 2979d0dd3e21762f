//! Numbers: angles, guaranteed root finders, series without cancellation.

pub mod angle;
pub mod eigen;
pub mod root;
pub mod series;
