//! Helpers of several folders.

pub(crate) mod burr_golden;
pub(crate) mod drawing;
pub(crate) mod end_mill;
pub(crate) mod fixture;
pub(crate) mod golden;
pub(crate) mod groove;
pub(crate) mod job;
pub(crate) mod kept;
pub(crate) mod planned;
pub(crate) mod quads;
pub(crate) mod random;
pub(crate) mod setup;
pub(crate) mod stop;
pub(crate) mod sweep_brute;
pub(crate) mod sweep_golden;
