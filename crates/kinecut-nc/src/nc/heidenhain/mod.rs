//! HEIDENHAIN klartext, iTNC 530 and TNC 640, milling.
//!
//! Meanings of the words, for writer and reader alike. Source: the user's manuals "HEIDENHAIN conversational
//! programming"; statements that could not be checked against a manual or a program that ran is marked *from memory*.
//!
//! - `TOOL CALL n Z` applies the length and the radius of tool `n` itself; there is no register word. Register 1 is
//!   the tool's own line of the table, register 2 to 9 its line of that index: `TOOL CALL n.2`, which has a length
//!   and a radius of its own and changes no tool (*from memory*). `RL` and `RR` use the radius `R + DR` of the line
//!   that was called. A wear register for a path of the tool centre (`D2` elsewhere) is therefore the line `n.2`:
//!   length as that of `n`, radius `R` 0, and the wear as its `DR`.
//! - Work offsets are the presets of the datum table, `CYCL DEF 247 Q339`: G54 to G57 are presets 1 to 4, G505 to
//!   G599 are presets 5 to 99.
//! - Turned coordinates are a datum shift (`CYCL DEF 7`) and then a rotation (`CYCL DEF 10`), taken back the other way
//!   round; a preset takes both back. The angle has three decimals (*from memory* of the input range, -360.000 to
//!   360.000).
//! - `F` is in mm/min, `FU` in mm/rev, `FT` the seconds of a block (iTNC 530; *from memory*).
//! - `CYCL DEF 32` is the tolerance of a continuous path; without value it is the machine's own. There is no word
//!   for an exact stop.
//! - Moves with `FMAX` keep to the straight line, and a block with `M91` is in machine coordinates without the
//!   length of the tool.
//! - Holes are cycles 1, 200, 201, 203 and 205, with steps counted from the surface; the parts written and read are
//!   listed in `write/klartext/cycle`, `read/drilling` and `read/pecking`. Feeds in cycles are per minute: whether
//!   `Q206` takes a feed per revolution could not be found.
//! - Threads are cycle 207: its pitch `Q239` is negative for a left-hand one, its feed is pitch times speed. The spindle may
//!   be off after it, and is switched on again.
//! - Rotary axes A, B and C are degrees with four decimals. Without `M128` X, Y and Z are positions of the linear axes;
//!   with it they are the tip in the coordinates of the work: see `read/rotary` and `write/klartext/rotary`. A tilted plane
//!   is a datum shift and `PLANE SPATIAL`: see [`plane`], `read/plane` and `write/klartext/plane`.
//! - `C` ends where it says; `CP IPA` ends where its angle leads: see [`polar`].

pub(super) mod plane;
pub(super) mod polar;
mod read;

pub(super) use read::{TIP_CONTROLLED, read};

use crate::program::WorkOffset;

use super::dialect::{CompWord, Dialect, FlowWords, Mismatch, SeriesRule, StateWord, TurnWord};
use super::multi_axis::{MultiAxis, ROTARY};
use super::native::{Native, TapWord};

/// Presets 1 to 4 and 5 to 99.
fn has_offset(offset: WorkOffset) -> bool {
    preset(offset).is_some()
}

/// The preset of a work offset: G54 is 1, G57 is 4, G505 is 5, G599 is 99.
pub(super) fn preset(offset: WorkOffset) -> Option<u16> {
    match offset.tenths() {
        t @ 540..=570 => Some((t - 530) / 10),
        t @ 5050..=5990 => Some((t - 5000) / 10),
        _ => None,
    }
}

/// The work offset of a preset.
pub(super) fn offset(preset: u32) -> Option<WorkOffset> {
    match preset {
        1..=4 => WorkOffset::from_tenths(530 + 10 * preset),
        5..=99 => WorkOffset::from_tenths(5000 + 10 * preset),
        _ => None,
    }
}

/// Components of a tool direction, from the tip to the holder, and their decimals.
pub(super) const TOOL_VECTOR: [&str; 3] = ["TX", "TY", "TZ"];
pub(super) const VECTOR_DECIMALS: usize = 8;

/// Registers of a tool: the tool itself and its indexed lines `.2` to `.9`.
pub(super) const REGISTERS: std::ops::RangeInclusive<u32> = 1..=9;

/// Largest difference of the distances of start and end from the centre of an arc [mm]: machine parameter 7431 at
/// its largest.
pub(super) const CIRCLE_TOLERANCE: f64 = 0.016;
/// Longest dwell [s]: an hour.
pub(super) const LONGEST_DWELL: f64 = 3600.0;

/// The entries of the shared tables that this control uses; its blocks are written and read by functions of their own.
pub(super) const DIALECT: Dialect = Dialect {
    comment: ["; ", ""],
    message: None,
    capitals: false,
    line_limit: None,
    point: false,
    program_number: false,
    remarks: &[],
    tape: None,
    file_header: None,
    start: &[],
    order: &[StateWord::Blend, StateWord::WorkOffset, StateWord::Spindle, StateWord::Coolant],
    exact_stop: "",
    exact_path: None,
    continuous: "",
    rounded: Some(["", ""]),
    merges: false,
    machine_frame: ["", "", ""],
    suspends_length: false,
    recalls_length: false,
    has_lengths: true,
    length_with_z: false,
    length_on: "",
    length_off: "",
    one_register: true,
    comp: CompWord::Edge,
    centre_feed: None,
    tool_change: "",
    per_revolution: true,
    mist: true,
    both_coolants: false,
    dwell: ("", 1.0),
    turns: Some(("", 0)),
    turns_in_plane: false,
    most_turns: 999,
    involute: None,
    involute_turns: 0.0,
    native: Native::Defined,
    tap: TapWord::Defined,
    turn: TurnWord::Cycles,
    angle_decimals: 3,
    // The rest is in functions of its own.
    axes: MultiAxis { rotary: Some((ROTARY, plane::ANGLE_DECIMALS)), ..MultiAxis::NONE },
    end: "M30",
    most_blocks: usize::MAX,
    long_addresses: false,
    round_comments: false,
    g_codes: &[],
    further_g_codes: &[],
    tolerated: &[],
    m_codes: &[],
    keywords: &[],
    starts_at_r: false,
    answer: None,
    haas: false,
    flow: FlowWords::None,
    has_offset,
    radius: "",
    dwell_words: &[],
    cancel_beside_motion: false,
    one_of_group: false,
    signs: false,
    series: SeriesRule::Fanuc,
    repeats: "",
    feed_before_units: false,
    mode_forgets_feed: false,
    straight_rapid: true,
    starts_continuous: true,
    register_after_change: None,
    mismatch: Mismatch::Constant(CIRCLE_TOLERANCE),
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_and_work_offsets_are_one_to_one() {
        for number in 1..=99 {
            let found = offset(number).unwrap();
            assert_eq!(preset(found).map(u32::from), Some(number), "{found}");
        }
        assert_eq!(offset(2).unwrap().to_string(), "G55");
        assert_eq!(offset(17).unwrap().to_string(), "G517");
        assert!(offset(0).is_none() && offset(100).is_none());
        for other in ["G58", "G59", "G59.1"] {
            assert!(preset(WorkOffset::parse(other).unwrap()).is_none());
        }
    }
}
