//! Helpers of several folders: golden tools and outlines, brute force of a sweep.

pub(crate) mod burr_golden;
pub(crate) mod sweep_brute;
pub(crate) mod sweep_golden;
