//! LinuxCNC, RS274/NGC, version 2.9.
//!
//! Canned cycles: `G73` lifts and `G83` comes back to 0.254 mm whatever the program says; steps are found by subtracting Q
//! until the bottom is passed, so that a Q which is no binary fraction may leave a step without depth; a lift larger
//! than Q leads above R. (The interpreter's own source and its stand-alone version, which runs them at exact path.)
//!
//! Rigid tapping: `G33.1 Z K` runs down along the turning spindle, K a revolution, reverses it, runs back to where it began and
//! turns it back again; the sense of the spindle says the hand. It needs an encoder on the spindle, and runs on below Z until
//! the spindle has reversed. `G84` and `G74` are for floating holders: read as moves, with the spindle turning back at the bottom.
//!
//! Threads: `G33` and `G76` are read as feeds per revolution, with a warning (`read/thread.rs`).
//!
//! Turned coordinates: `G10 L2 P R` sets the rotation of a work offset about its zero, which stays in the control beyond the
//! program; `G52` shifts in the turned coordinates (measured on the stand-alone interpreter). Both are taken back before
//! the program stops or ends, and its head says what an abort leaves behind.
//!
//! Path: `G64 P Q` has two distances, see `read/path_mode`. A second `M6` stops the spindle and goes to the place for changes; the tool
//! that is in the spindle is not loaded again. Cutter compensation begins on a straight move or an arc, in the block of `G41`
//! or later, from a place that is known, and ends on a straight move.
//!
//! Rotary axes are `A`, `B`, `C` in degrees, as positions of the axes: control of the tool centre point and tilted planes are
//! switched by words that each machine defines for itself (`M428`), which are refused.
//!
//! Source: the G-code reference of LinuxCNC 2.9 and its interpreter's own test-suite.

pub(super) mod o_word;
pub(super) mod parameters;
pub(super) mod tool_table;

use crate::program::{StopKind, WorkOffset};
use crate::tool::Hand;

use super::dialect::{
    Code, CompWord, CycleKind, Dialect, FlowWords, Mismatch, SeriesRule, StateWord, TurnWord,
};
use super::modes;
use super::multi_axis::MultiAxis;
use super::native::{Canned, Native, TapWord};

/// G54 to G59.3.
fn has_offset(offset: WorkOffset) -> bool {
    matches!(offset.tenths(), 540..=593)
}

/// Lift of `G73` and clearance of `G83` [mm]: 0.010 in, fixed in the interpreter.
const LIFT: f64 = 0.254;

pub(super) const DIALECT: Dialect = Dialect {
    comment: ["( ", " )"],
    message: Some(["(MSG,", ")"]),
    capitals: false,
    line_limit: None,
    point: false,
    program_number: false,
    remarks: &[],
    tape: Some("%"),
    file_header: None,
    start: &["G17 G21 G40 G49 G80", "G90 G91.1 G94"],
    order: &[StateWord::Blend, StateWord::WorkOffset, StateWord::Spindle, StateWord::Coolant],
    exact_stop: "G61.1",
    exact_path: Some("G61"),
    continuous: "G64",
    // Q is always said: left out it is P, and with Q0 no lines are merged, so that what was proven is what runs.
    rounded: Some(["G64 P", " Q"]),
    merges: true,
    machine_frame: ["G53 ", "", ""],
    suspends_length: false,
    recalls_length: false,
    has_lengths: true,
    length_with_z: false,
    length_on: "G43 H",
    length_off: "G49",
    one_register: false,
    comp: CompWord::Register,
    centre_feed: None,
    tool_change: " M6",
    per_revolution: true,
    mist: true,
    both_coolants: true,
    dwell: ("G4 P", 1.0),
    turns: Some(("P", 1)),
    turns_in_plane: true,
    most_turns: 999,
    involute: None,
    involute_turns: 0.0,
    native: Native::Canned(Canned { clearance: LIFT, lift: LIFT, subtracts: true, by_parameter: false }),
    tap: TapWord::Synchronised,
    turn: TurnWord::Offset,
    angle_decimals: 6,
    axes: MultiAxis { rotary: Some((["A", "B", "C"], 6)), ..MultiAxis::NONE },
    end: "M2",
    most_blocks: 99_999,
    long_addresses: false,
    round_comments: true,
    g_codes: &[
        (520, Code::LocalShift),
        (50, Code::Cubic),
        (51, Code::Quadratic),
        (52, Code::ControlPoint),
        (53, Code::RunSpline),
        (62, Code::KnotRow),
        (63, Code::RunSpline),
        (200, Code::Units { inch: true, feeds: true }),
        (210, Code::Units { inch: false, feeds: true }),
        (430, Code::LengthOn),
        (431, Code::LengthByNumber { add: false }),
        (432, Code::LengthByNumber { add: true }),
        (411, Code::CompByNumber { left: true }),
        (421, Code::CompByNumber { left: false }),
        (490, Code::LengthOff),
        (610, Code::ExactPath),
        (640, Code::Continuous),
        (611, Code::ExactStop),
        (70, Code::Diameters(true)),
        (80, Code::Diameters(false)),
        (330, Code::Geared),
        (331, Code::SynchronisedTap),
        (760, Code::Thread),
        (730, Code::Cycle(CycleKind::ChipBreak)),
        (800, Code::NoMotion),
        (810, Code::Cycle(CycleKind::Drill)),
        (820, Code::Cycle(CycleKind::DrillDwell)),
        (830, Code::Cycle(CycleKind::Peck)),
        (740, Code::Cycle(CycleKind::Floating(Hand::Left))),
        (840, Code::Cycle(CycleKind::Floating(Hand::Right))),
        (850, Code::Cycle(CycleKind::Bore)),
        (860, Code::Cycle(CycleKind::BoreStop)),
        (890, Code::Cycle(CycleKind::BoreDwell)),
        (922, Code::ShiftOff { keep: true }),
        (923, Code::ShiftAgain),
        (901, Code::CentreAbsolute(true)),
        (911, Code::CentreAbsolute(false)),
        (960, Code::SurfaceSpeed),
        (970, Code::Harmless("S in revolutions a minute")),
        (980, Code::ReturnToStart(true)),
        (990, Code::ReturnToStart(false)),
    ],
    further_g_codes: modes::NGC,
    tolerated: crate::nc::tolerated::LINUXCNC,
    m_codes: &[
        (19, Code::Orientation),
        (50, Code::Device("feed override")),
        (51, Code::Device("spindle override")),
        (52, Code::Device("adaptive feed")),
        (53, Code::Device("feed hold")),
        (60, Code::Stop(StopKind::Pallet)),
        (61, Code::ToolInSpindle),
        (62, Code::Device("output on, with the motion")),
        (63, Code::Device("output off, with the motion")),
        (64, Code::Device("output on")),
        (65, Code::Device("output off")),
        (66, Code::Device("waits for an input")),
        (67, Code::Device("analogue output, with the motion")),
        (68, Code::Device("analogue output")),
        (70, Code::Save { returns: false }),
        (71, Code::Forget),
        (72, Code::TakeAgain),
        (73, Code::Save { returns: true }),
        (48, Code::Harmless("overrides on")),
        (49, Code::Harmless("overrides off")),
        (98, Code::CallProgram),
        (99, Code::Return),
    ],
    keywords: &[],
    starts_at_r: true,
    answer: None,
    haas: false,
    flow: FlowWords::OWords,
    has_offset,
    radius: "R",
    dwell_words: &[("P", 1.0)],
    cancel_beside_motion: true,
    one_of_group: true,
    signs: true,
    series: SeriesRule::Interpreter,
    repeats: "L",
    feed_before_units: true,
    mode_forgets_feed: true,
    straight_rapid: true,
    starts_continuous: true,
    register_after_change: None,
    mismatch: Mismatch::Ngc,
};
