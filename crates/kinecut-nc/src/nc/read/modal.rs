//! State that a control keeps from block to block.

use glam::DVec2;

use crate::nc::dialect::{Code, Dialect, Plane};
use crate::nc::sinumerik::cycle::Read;
use crate::program::{Blend, Comp, Coolant, FrameId, SetupId, Spindle, ToolNumber, WorkOffset};

use super::place::Bytes;
use super::rotary_state::RotaryAxes;
use super::sticky::Sticky;
use super::turned::Turned;

/// Unit of feeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum FeedMode {
    #[default]
    PerMinute,
    PerRevolution,
    InverseTime,
}

/// The tool in the spindle and its registers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ToolState {
    pub(super) id: Option<ToolNumber>,
    pub(super) length: Option<u32>,
}

/// Modal state of a reader; mm, s, rad.
#[derive(Clone, Debug)]
pub(super) struct Modal {
    /// Motion code in force.
    pub(super) motion: Option<Code>,
    /// The last one that is no cycle, where it goes on behind the end of a cycle (group 01 of FANUC and Haas).
    pub(super) path_code: Option<Code>,
    /// Whether the program has said one.
    pub(super) motion_said: bool,
    pub(super) plane: Plane,
    /// Factors from the program's lengths and feeds to mm.
    pub(super) length_unit: f64,
    pub(super) feed_unit: f64,
    pub(super) units_said: bool,
    /// The unit of the last move, and where the unit in force was said.
    pub(super) moved_in: Option<f64>,
    pub(super) unit_said_at: Option<Bytes>,
    pub(super) absolute: bool,
    /// Whether words of X are diameters.
    pub(super) diameters: bool,
    pub(super) centre_absolute: bool,
    pub(super) feed_mode: FeedMode,
    /// Feed in force [mm/s or mm]; none in inverse time.
    pub(super) feed: Option<f64>,
    /// Spindle speed [rad/s].
    pub(super) speed: Option<f64>,
    pub(super) spindle: Spindle,
    pub(super) coolant: Coolant,
    pub(super) comp: Comp,
    /// Radius register that was named last.
    pub(super) radius: Option<u32>,
    /// The compensation was switched, and no move was made since.
    pub(super) comp_turned: Option<Bytes>,
    pub(super) blend: Blend,
    /// The program has said it, or every control begins so.
    pub(super) blend_said: bool,
    /// Tolerance of the last rounded path [mm].
    pub(super) rounding: f64,
    pub(super) offset: Option<WorkOffset>,
    pub(super) frame: FrameId,
    /// Shift and rotation within the work offset.
    pub(super) turned: Turned,
    pub(super) setup: SetupId,
    /// Tool chosen for the next change.
    pub(super) chosen: Option<u32>,
    pub(super) tool: ToolState,
    /// Offsets of the length in force along X, Y and Z [mm], as far as they are known.
    pub(super) tool_offsets: [Option<f64>; 3],
    /// Whether a register from which the length in force counts has changed since, and its offsets are not known.
    pub(super) length_stale: bool,
    /// State in the program's last tool item.
    pub(super) told: ToolState,
    /// Tool of the program's last tool item.
    pub(super) called: Option<ToolNumber>,
    /// The last tool item, as long as Z has not moved in the frame since.
    pub(super) tool_item: Option<usize>,
    /// The length was switched off for a move in machine coordinates only.
    pub(super) length_hidden: bool,
    /// Cycles return to the height where they began, otherwise to R.
    pub(super) return_to_start: bool,
    /// The program has said which.
    pub(super) return_said: bool,
    pub(super) sticky: Sticky,
    /// Cycle that is called after each block that moves.
    pub(super) modal_call: Option<Read>,
    /// Second control point of the last cubic [mm from its end]; kept until another motion is given.
    pub(super) cubic_end: Option<DVec2>,
    /// Rotary axes, tilted plane and control of the tip.
    pub(super) rotary_axes: RotaryAxes,
    /// Tip in the frame of the state [mm]; `None` where the program has not said it.
    pub(super) position: [Option<f64>; 3],
}

impl Modal {
    pub(super) fn new(dialect: &Dialect) -> Modal {
        Modal {
            motion: dialect.cycles_apart().then_some(Code::Rapid),
            path_code: dialect.cycles_apart().then_some(Code::Rapid),
            motion_said: false,
            plane: Plane::Xy,
            length_unit: 1.0,
            feed_unit: 1.0,
            units_said: false,
            moved_in: None,
            unit_said_at: None,
            absolute: true,
            diameters: false,
            centre_absolute: false,
            feed_mode: FeedMode::PerMinute,
            feed: None,
            speed: None,
            spindle: Spindle::Off,
            coolant: Coolant::Off,
            comp: Comp::Off,
            radius: None,
            comp_turned: None,
            blend_said: dialect.starts_continuous,
            blend: if dialect.starts_continuous { Blend::Continuous } else { Blend::Stop },
            rounding: 0.0,
            offset: None,
            frame: FrameId(0),
            turned: Turned::default(),
            setup: SetupId(0),
            chosen: None,
            tool: ToolState::default(),
            told: ToolState::default(),
            tool_offsets: [Some(0.0); 3],
            length_stale: false,
            called: None,
            tool_item: None,
            length_hidden: false,
            return_to_start: !dialect.starts_at_r,
            return_said: false,
            sticky: Sticky::default(),
            modal_call: None,
            cubic_end: None,
            rotary_axes: RotaryAxes::default(),
            position: [None; 3],
        }
    }
}
