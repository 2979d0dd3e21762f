//! FANUC 0i-M and 30i-M, milling, programs in ISO code (G code system of machining centres).
//!
//! * A number without a decimal point counts least increments: `X1` is a micrometre. Every length and feed is written
//!   with its point; what is read without one is taken as 0.001 mm (0.0001 in), feeds per minute as whole units, feeds
//!   per revolution as 0.01 mm.
//! * `G43 H` alone would move Z by the length (parameter 5006 TOS = 0), so it is in the block of the next move of Z,
//!   again after each `G53`, whose effect on the length differs between models. `H` is the tool's number.
//! * No word for turns: a helix of several turns is one block a turn.
//! * No tolerance of a continuous path that a program could ask for without options (`G05.1`): where one is asked for,
//!   `G61` is written.
//! * Involute `G02.2`/`G03.2`: both ends outside the base circle, at most a hundred turns from it, Z stays; the end may
//!   miss the curve by parameter 5610.
//!
//! * `G81`, `G82`, `G83`, `G73`: how far `G73` lifts and how far above the last depth the rapid of `G83` ends are parameters
//!   5114 and 5115 of the machine, in no word of the program. Both are taken as 1 mm; a text that counts on it says so in its
//!   head, and one that is read is noted.
//!
//! * Rigid tapping: `M29 S`, then `G84` (right-hand) or `G74` (left-hand) with the pitch as the feed of `G95`; read under `G94`
//!   the pitch is F over S. Whether the two are rigid without `M29` is parameter 5200: noted. The spindle is off after `G80`.
//!   Source: published code cards and post-processors, not checked against a manual.
//!
//! * Turned coordinates: `G68 X0. Y0. R..` in the local coordinates of `G52`, both before the first move in them and taken
//!   back (`G69`, `G52 X0. Y0. Z0.`) before anything that the rotation forbids: `G53` to `G59`, a change of plane, a tool
//!   change. The least step of the angle is 0.001 degrees (0.00001 only by a parameter). Arcs in `G18` and `G19` become
//!   lines in a rotation (alarm 144).
//!
//! * Rotary axes are `A`, `B`, `C` in degrees, three decimals. `G43.4 H` keeps the tip on the path while they turn, `G43.5 H`
//!   the same with the tool axis as a vector `I J K` in each block (`G2` and `G3` have no place for it then); `G49` ends
//!   both and the length with them, so that `G43 H` is called again with the next Z.
//! * Rotary axes are taken to count turns (parameter 1008 ROA 0): `C370.` is ten degrees beyond a whole turn. A text
//!   that goes beyond one says so in its head.
//! * Tilted planes: `G68.2 X Y Z I J K` (Euler angles Z-X'-Z''), then `G53.1` turns the rotary axes until the tool
//!   stands along Z, in rapid after `G0`; `P1` and `P2` choose the solution with the tilting axis positive and
//!   negative. `G69` ends it. `P1` roll-pitch-yaw is read, about the axes of the work offset, which stay fixed; `P2`
//!   to `P4` and `G68.3` are not.
//!
//! * Corners: `,R` rounds and `,C` chamfers the corner to the next move of the plane (`nc/read/corner.rs`).
//! * `G54.1 P` and `G54 P` are the further work offsets, `G30 P2` to `P4` the further reference points, whose places no program
//!   knows: machine zero is assumed, as a doubt.
//! * `G76`, `G87`, `G88` are moves (`nc/read/boring.rs`).
//! * `G66` and `G67` call a macro after each move (`nc/read/modal_macro.rs`).
//! * `G51` and `G51.1` scale and mirror: read as the moves they are (`nc/read/scaling.rs`).
//!
//! Source of the two before these: general knowledge of the operator's manual of the 30i, and programs and post-processors of others;
//! the sense of `P1` and of `P` of `G53.1` are those of implementations that follow it, not checked against a manual.
//! Source of the rotation: operator's manual of the Series 15i, connection manual of the 0i (parameters 5400, 5410).
//! Source: alarm list of the Series 16/18 for the involute; the rest from general knowledge of the operator's manuals
//! of the 0i and 30i, not checked against a manual.

pub(super) mod arguments;
pub(super) mod statement;

use crate::program::WorkOffset;
use crate::tool::Hand;

use super::dialect::{
    Code, CompWord, CycleKind, Dialect, FlowWords, Mismatch, SeriesRule, StateWord, TurnWord,
};
use super::modes;
use super::multi_axis::{MultiAxis, TcpWord, TiltWord};
use super::native::{Canned, Native, TapWord};

/// G54 to G59, and `G54.1 P1` to `P48` or `P300`, which is an option.
fn has_offset(offset: WorkOffset) -> bool {
    offset.extension().is_some() || matches!(offset.tenths(), 540 | 550 | 560 | 570 | 580 | 590)
}

/// Clearance of `G83` (parameter 5115) and lift of `G73` (parameter 5114) [mm]: the machine's maker sets them, mostly to
/// a millimetre; no program can read or set them without macros.
const CLEARANCE: f64 = 1.0;
const LIFT: f64 = 1.0;

pub(super) const DIALECT: Dialect = Dialect {
    comment: ["(", ")"],
    message: None,
    capitals: true,
    line_limit: None,
    point: true,
    program_number: true,
    remarks: &[],
    tape: Some("%"),
    file_header: None,
    start: &["G17 G21 G40 G49 G80", "G90 G94"],
    order: &[StateWord::Blend, StateWord::WorkOffset, StateWord::Spindle, StateWord::Coolant],
    exact_stop: "G61",
    exact_path: None,
    continuous: "G64",
    rounded: None,
    merges: false,
    machine_frame: ["G53 ", "", ""],
    suspends_length: false,
    recalls_length: true,
    has_lengths: true,
    length_with_z: true,
    length_on: "G43 H",
    length_off: "G49",
    one_register: false,
    comp: CompWord::ModalRegister,
    centre_feed: None,
    tool_change: " M6",
    per_revolution: true,
    mist: true,
    both_coolants: false,
    dwell: ("G4 P", 0.001),
    turns: None,
    turns_in_plane: false,
    most_turns: 999,
    involute: Some(["G2.2", "G3.2", "R"]),
    involute_turns: 100.0,
    native: Native::Canned(Canned { clearance: CLEARANCE, lift: LIFT, subtracts: false, by_parameter: true }),
    tap: TapWord::Canned,
    turn: TurnWord::Local,
    angle_decimals: 3,
    axes: MultiAxis {
        rotary: Some((["A", "B", "C"], 3)),
        whole_turns: "Rotary axes must count turns: no roll-over (parameter 1008 ROA 0)",
        tcp: TcpWord::Length,
        vector: Some((["I", "J", "K"], 6)),
        tilt: TiltWord::Feature,
        tilt_decimals: 3,
    },
    end: "M30",
    most_blocks: 99_999,
    long_addresses: false,
    round_comments: true,
    g_codes: &[
        (90, Code::Harmless("exact stop in the block")),
        (150, Code::Polar { on: false }),
        (160, Code::Polar { on: true }),
        (100, Code::SetData),
        (520, Code::LocalShift),
        (680, Code::Rotation { on: true }),
        (690, Code::Rotation { on: false }),
        (682, Code::Tilt),
        (683, Code::TiltByTool),
        (531, Code::Orient),
        (434, Code::TipControl { vector: false }),
        (435, Code::TipControl { vector: true }),
        (22, Code::Involute { ccw: false }),
        (32, Code::Involute { ccw: true }),
        (200, Code::Units { inch: true, feeds: true }),
        (280, Code::Reference),
        (210, Code::Units { inch: false, feeds: true }),
        (430, Code::LengthOn),
        (490, Code::LengthOff),
        (610, Code::ExactStop),
        (640, Code::Continuous),
        (730, Code::Cycle(CycleKind::ChipBreak)),
        (740, Code::Cycle(CycleKind::Tap(Hand::Left))),
        (800, Code::NoMotion),
        (810, Code::Cycle(CycleKind::Drill)),
        (820, Code::Cycle(CycleKind::DrillDwell)),
        (830, Code::Cycle(CycleKind::Peck)),
        (850, Code::Cycle(CycleKind::Bore)),
        (860, Code::Cycle(CycleKind::BoreStop)),
        (890, Code::Cycle(CycleKind::BoreDwell)),
        (840, Code::Cycle(CycleKind::Tap(Hand::Right))),
        (980, Code::ReturnToStart(true)),
        (990, Code::ReturnToStart(false)),
        (300, Code::FurtherReference),
        (541, Code::ExtendedOffset),
        (500, Code::Scale { on: false }),
        (510, Code::Scale { on: true }),
        (501, Code::Mirror { on: false }),
        (511, Code::Mirror { on: true }),
        (760, Code::Cycle(CycleKind::FineBore)),
        (870, Code::Cycle(CycleKind::BackBore)),
        (880, Code::Cycle(CycleKind::LeftByHand)),
    ],
    further_g_codes: modes::FANUC,
    tolerated: crate::nc::tolerated::MACHINE,
    m_codes: &[
        (29, Code::Rigid),
        (98, Code::CallProgram),
        (99, Code::Return),
        (48, Code::Harmless("overrides")),
        (49, Code::Harmless("overrides off")),
    ],
    keywords: &[],
    starts_at_r: false,
    answer: None,
    haas: false,
    flow: FlowWords::MacroB,
    has_offset,
    radius: "R",
    dwell_words: &[("P", 0.001), ("X", 1.0)],
    cancel_beside_motion: true,
    one_of_group: false,
    signs: false,
    series: SeriesRule::Fanuc,
    repeats: "K",
    feed_before_units: false,
    mode_forgets_feed: true,
    straight_rapid: false,
    starts_continuous: true,
    register_after_change: None,
    mismatch: Mismatch::Constant(0.01),
};
