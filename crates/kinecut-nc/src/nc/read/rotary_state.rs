//! Rotary axes, plane and tip that are in force.

use glam::DVec3;

use crate::nc::multi_axis::Rotaries;
use crate::program::{FrameId, RotarySolution, Tcp, ToolAxis, WorkOffset};

/// Angle below which a rotary axis is at zero or a whole turn [deg]: rounding of sums of decimal numbers.
pub(super) const ZERO: f64 = 1e-9;

/// A tilted plane along which the tool was turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Along {
    pub(super) offset: WorkOffset,
    pub(super) rotation: glam::DMat3,
    pub(super) branch: RotarySolution,
}

/// Rotary axes, plane and tip.
#[derive(Clone, Debug, Default)]
pub(super) struct RotaryAxes {
    /// Places of the rotary axes [deg].
    pub(super) rotaries: Rotaries<f64>,
    /// Tool axis that was said last as a vector.
    pub(super) vector: Option<DVec3>,
    pub(super) tcp: Tcp,
    /// The tool axis is a vector in each block (FANUC).
    pub(super) by_vector: bool,
    /// Interpolation of orientations, where the program has set it.
    pub(super) interpolation: Option<Tcp>,
    /// The length was ended together with the control of the tip, and Z has not moved since.
    pub(super) lapsed: bool,
    /// Plane in force, and its motion into the work offset.
    pub(super) plane: Option<(FrameId, glam::DMat3)>,
    pub(super) along: Option<Along>,
    /// Tool axis of the move of the block.
    pub(super) next: Option<ToolAxis>,
}

impl RotaryAxes {
    /// The control turns the rotary axes.
    pub(super) fn swing(&mut self, along: Option<Along>) {
        self.rotaries.swing();
        self.vector = None;
        self.along = along;
    }

    /// Whether the move of the block turns the tool axis.
    pub(super) fn turns_next(&self) -> bool {
        match self.next {
            Some(ToolAxis::Rotary(angles)) => angles != [None; 3],
            Some(ToolAxis::Vector(_)) => true,
            _ => false,
        }
    }

    /// The tool axis of a move that names none.
    pub(super) fn kept(&self) -> ToolAxis {
        let whole = |degrees: f64| (degrees - 360.0 * (degrees / 360.0).round()).abs() < ZERO;
        let upright = match self.vector {
            Some(v) => v == DVec3::Z,
            None => self.rotaries.upright(whole),
        };
        if self.plane.is_some() || upright { ToolAxis::Fixed } else { ToolAxis::Rotary([None; 3]) }
    }
}
