//! Colours of bodies by what they do.

use crate::page::Tint;

/// Stands still.
pub(super) const BED: Tint = Tint::Grey;
/// Carries the work.
pub(super) const WORK: Tint = Tint::Blue;
/// Carries the tool.
pub(super) const TOOL: Tint = Tint::Orange;
/// The workpiece.
pub(super) const PART: Tint = Tint::Sand;
/// Spindle and cutter.
pub(super) const STEEL: Tint = Tint::Steel;
