//! SINUMERIK 840D (sl, ONE), milling, native language.
//!
//! Machine data that change the meaning of a text are assumed at their defaults: circle end point error 0.01 mm
//! (MD21000), involute end point error 0.01 mm (MD21015), cutting edge D1 after a tool change (MD20270), tool
//! change by M6 (MD22550), exact stop after reset (MD20150, group 10), rapid moves possibly axis by axis.
//!
//! Drilling and tapping cycles are calls with arguments, `CYCLE81` to `CYCLE84`: see [`cycle`].
//!
//! Turned coordinates are programmable frames: `TRANS X Y Z` and `AROT RPL=`, or `ROT RPL=` alone; `TRANS` or `ROT` alone
//! take all of it back.
//!
//! Rotary axes are `A=`, `B=`, `C=` in degrees. `TRAORI` keeps the tip on the path while they turn; under it `ORIAXES` lets
//! them go straight from angle to angle and `ORIVECT` turns the tool axis in a plane, and either takes angles or the
//! tool axis as a vector, `A3= B3= C3=`. They are taken to count turns (MD30310 0): a text that goes beyond a whole one says
//! so in its head. Tilted planes: `CYCLE800`, see [`swivel`].
//!
//! Cutter compensation (G41, G42) takes the radius of the cutting edge in force: geometry and wear. A path of the tool
//! centre that is to be corrected by wear only is therefore run under a second edge, `D2`: length as that of `D1`,
//! radius 0, and the correction as the wear of the radius ($TC_DP15). It is called before the approach; `NORM` (the
//! default) ends the entry square to the contour.

pub(super) mod cycle;
pub(super) mod swivel;

use crate::program::WorkOffset;

use super::dialect::{Code, CompWord, Dialect, FlowWords, Mismatch, SeriesRule, StateWord, TurnWord};
use super::multi_axis::{MultiAxis, TcpWord, TiltWord};
use super::native::{Native, TapWord};

/// G54 to G57 and G505 to G599; G58 and G59 are programmable shifts on this control.
fn has_offset(offset: WorkOffset) -> bool {
    matches!(offset.tenths(), 540..=570 | 5050..=5990)
}

pub(super) const DIALECT: Dialect = Dialect {
    comment: ["; ", ""],
    message: Some(["MSG(\"", "\")"]),
    capitals: false,
    line_limit: None,
    point: false,
    program_number: false,
    remarks: &[],
    tape: None,
    file_header: Some(["%_N_", "_MPF"]),
    start: &["G17 G40 G90 G94 G710"],
    order: &[StateWord::Blend, StateWord::WorkOffset, StateWord::Spindle, StateWord::Coolant],
    exact_stop: "G60",
    exact_path: None,
    continuous: "G64",
    rounded: Some(["G641 ADIS=", ""]),
    merges: false,
    machine_frame: ["", " SUPA", " D0"],
    suspends_length: true,
    recalls_length: false,
    has_lengths: true,
    length_with_z: false,
    length_on: "D",
    length_off: "D0",
    one_register: true,
    comp: CompWord::Edge,
    centre_feed: Some("CFTCP"),
    tool_change: " M6",
    per_revolution: true,
    mist: true,
    both_coolants: false,
    dwell: ("G4 F", 1.0),
    turns: Some(("TURN=", 0)),
    turns_in_plane: false,
    most_turns: 999,
    involute: Some(["INVCW", "INVCCW", "CR="]),
    involute_turns: f64::INFINITY,
    native: Native::Calls,
    tap: TapWord::Called,
    turn: TurnWord::Programmable,
    angle_decimals: 6,
    axes: MultiAxis {
        rotary: Some((["A=", "B=", "C="], 6)),
        whole_turns: "Rotary axes must count turns: no modulo axis (MD30310 0)",
        tcp: TcpWord::Transformation,
        vector: Some((["A3=", "B3=", "C3="], 6)),
        tilt: TiltWord::Swivel,
        tilt_decimals: 6,
    },
    end: "M30",
    most_blocks: 99_999_999,
    long_addresses: true,
    round_comments: false,
    g_codes: &[
        (600, Code::ExactStop),
        (640, Code::Continuous),
        (6410, Code::Rounded),
        (1530, Code::MachineFrame),
        (700, Code::Units { inch: true, feeds: false }),
        (710, Code::Units { inch: false, feeds: false }),
        (7000, Code::Units { inch: true, feeds: true }),
        (7100, Code::Units { inch: false, feeds: true }),
        (6010, Code::Harmless("exact stop fine")),
        (6020, Code::Harmless("exact stop coarse")),
        (6030, Code::Harmless("exact stop at the end of interpolation")),
    ],
    further_g_codes: &[],
    tolerated: crate::nc::tolerated::MACHINE,
    m_codes: &[],
    keywords: &[
        ("INVCW", Code::Involute { ccw: false }),
        ("INVCCW", Code::Involute { ccw: true }),
        ("SUPA", Code::MachineFrame),
        ("MCALL", Code::ModalCall),
        ("TRANS", Code::FrameShift { add: false }),
        ("ATRANS", Code::FrameShift { add: true }),
        ("ROT", Code::FrameTurn { add: false }),
        ("AROT", Code::FrameTurn { add: true }),
        ("TRAORI", Code::Transformation { on: true }),
        ("TRAFOOF", Code::Transformation { on: false }),
        ("ORIAXES", Code::Interpolation { vector: false }),
        ("ORIVECT", Code::Interpolation { vector: true }),
        ("ORIWKS", Code::Harmless("orientations in the workpiece, as usual")),
        ("CFTCP", Code::Harmless("feeds are those of the centre under compensation")),
        ("SOFT", Code::Harmless("jerk limit on")),
        ("BRISK", Code::Harmless("jerk limit off")),
        ("DRIVE", Code::Harmless("acceleration knee")),
        ("FFWON", Code::Harmless("feed forward on")),
        ("FFWOF", Code::Harmless("feed forward off")),
    ],
    starts_at_r: false,
    answer: None,
    haas: false,
    flow: FlowWords::None,
    has_offset,
    radius: "CR",
    dwell_words: &[("F", 1.0)],
    cancel_beside_motion: false,
    one_of_group: false,
    signs: false,
    series: SeriesRule::Fanuc,
    repeats: "L",
    feed_before_units: false,
    mode_forgets_feed: false,
    straight_rapid: false,
    starts_continuous: false,
    register_after_change: Some(1),
    mismatch: Mismatch::Constant(0.01),
};
