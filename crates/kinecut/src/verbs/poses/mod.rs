//! Poses and joint positions as letters and numbers in the units of the shop: what `fk`, `ik` and `reach` read and write.

mod text;
mod values;

pub use text::{PoseTexts, PoseWords};
pub use values::AxisValues;
pub(crate) use values::{number, outside, triple};
