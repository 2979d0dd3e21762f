//! GRBL 1.1, the firmware of small machines.
//!
//! * No tool table and no `M6` (error 20). A tool is called by `T2 M0`: GRBL keeps the number and waits, a person
//!   changes the tool and sets the zero of Z with it. So the zero of the work *is* the tip of the tool in the spindle,
//!   and there is no length offset to switch: `G43.1 Z` would need a measured length in the text, and a nominal one
//!   would be wrong by what the collet leaves. A program that switches lengths off is refused.
//! * No canned cycles, no turns of a helix in one block, no involute, no cutter compensation, no feed per revolution, no
//!   parameters. `M7` only in firmware built with ENABLE_M7: mist is refused.
//! * No spindle that the feed is geared to: tapping is refused.
//! * No rotation of coordinates: the writer turns them.
//! * Path mode is `G61` and nothing else: the path is kept, corners are slowed down by the junction deviation (`$11`).
//!   It replaces every passage between moves.
//! * A line has at most 79 characters; `%` is an error.
//! * Arcs become chords of the firmware's own tolerance (`$12`, 0.002 mm).
//!
//! Source: GRBL 1.1 documentation and error list.

use crate::program::WorkOffset;

use super::dialect::{Code, CompWord, Dialect, FlowWords, Mismatch, SeriesRule, StateWord, TurnWord};
use super::modes;
use super::multi_axis::MultiAxis;
use super::native::{Native, TapWord};

/// G54 to G59.
fn has_offset(offset: WorkOffset) -> bool {
    matches!(offset.tenths(), 540 | 550 | 560 | 570 | 580 | 590)
}

pub(super) const DIALECT: Dialect = Dialect {
    comment: ["(", ")"],
    message: Some(["(MSG,", ")"]),
    capitals: false,
    line_limit: Some(79),
    point: false,
    program_number: false,
    remarks: &["Each T M0 is a tool change by hand: set the zero of Z with the new tool"],
    tape: None,
    file_header: None,
    start: &["G17 G21 G40 G49 G80", "G90 G91.1 G94"],
    order: &[StateWord::Blend, StateWord::WorkOffset, StateWord::Spindle, StateWord::Coolant],
    exact_stop: "G61",
    exact_path: None,
    continuous: "G61",
    rounded: None,
    merges: false,
    machine_frame: ["G53 ", "", ""],
    suspends_length: false,
    recalls_length: false,
    has_lengths: false,
    length_with_z: false,
    length_on: "",
    length_off: "",
    one_register: false,
    comp: CompWord::None,
    centre_feed: None,
    tool_change: " M0",
    per_revolution: false,
    mist: false,
    both_coolants: true,
    dwell: ("G4 P", 1.0),
    turns: None,
    turns_in_plane: false,
    most_turns: 999,
    involute: None,
    involute_turns: 0.0,
    native: Native::None,
    tap: TapWord::None,
    turn: TurnWord::None,
    angle_decimals: 0,
    axes: MultiAxis::NONE,
    end: "M30",
    most_blocks: 99_999,
    long_addresses: false,
    round_comments: true,
    g_codes: &[
        (200, Code::Units { inch: true, feeds: true }),
        (210, Code::Units { inch: false, feeds: true }),
        (490, Code::LengthOff),
        (610, Code::Continuous),
        (800, Code::NoMotion),
        (911, Code::CentreAbsolute(false)),
    ],
    further_g_codes: modes::NGC,
    tolerated: &[],
    m_codes: &[],
    keywords: &[],
    starts_at_r: false,
    answer: Some(
        "GRBL answers error 20 here (unsupported); files of senders with more words are read with --control grblhal",
    ),
    haas: false,
    flow: FlowWords::None,
    has_offset,
    radius: "R",
    dwell_words: &[("P", 1.0)],
    cancel_beside_motion: false,
    one_of_group: true,
    signs: false,
    series: SeriesRule::Interpreter,
    repeats: "L",
    feed_before_units: true,
    mode_forgets_feed: true,
    straight_rapid: true,
    starts_continuous: true,
    register_after_change: Some(1),
    mismatch: Mismatch::Grbl,
};
