//! Haas milling controls (Classic and NGC), read.
//!
//! Words and macros are those of FANUC, with these differences:
//! * `L` is the word of repetitions. A cycle without R takes that of the cycle before, also behind `G80` (seen in a program
//!   that ran; not in a manual): said where it happens.
//! * `M97 P` calls the block of a number in the same program. The number of a program has five digits: none of them counts
//!   calls.
//! * `G4 P` with a point is in seconds, without one in milliseconds.
//! * `,R` and `,C` stand between straight moves only.
//! * `G154 P1` to `P99` are the further work offsets, `G110` to `G129` the first twenty of them.
//! * `G73` and `G83` with I, J and K have a first step, each shorter by J, none below K; P waits at the bottom. `G84` and `G74` are
//!   rigid by themselves. `G76` steps aside, behind `G87` and `G88` the tool is taken out by hand. `G77` is refused: the way from Z
//!   out of the counterbore is not in the pages that are public.
//! * `G51 P` scales, with a point in P; there is no `G51.1`, and `G101` is not read. `G68` without X and Y is about the present place, and
//!   said.
//! * A feed without a point may count ten-thousandths of an inch by setting 77: it is read in whole units, and said.
//!
//! * `G28` cancels the tool length: Z without `G43` behind it is an error.
//! * `G70`, `G71`, `G72` make the holes of the cycle in force on a circle, an arc, a line (`nc/read/bolt_holes.rs`).
//! * `G187 P E` says how far corners may be rounded, which is said and not followed.
//!
//! * `G12` and `G13` make a round pocket (`nc/read/round_pocket.rs`); the ways from its centre to the circles are a doubt.
//!
//! `G47`, `G77` and `G150` move axes in ways that no public page says to the last move: refused with that reason.
//!
//! Source: pages of the operator's manual 96-8000 as quoted publicly, and programs of others.

use super::dialect::{Code, CycleKind, Dialect, FlowWords};
use super::fanuc;
use super::modes;
use super::multi_axis::MultiAxis;
use crate::program::WorkOffset;
use crate::tool::Hand;

/// G54 to G59, and `G154 P1` to `P99`, of which the first twenty are G110 to G129 too.
fn has_offset(offset: WorkOffset) -> bool {
    offset.extension().is_some_and(|number| number <= 99)
        || matches!(offset.tenths(), 540 | 550 | 560 | 570 | 580 | 590)
}

pub(super) const DIALECT: Dialect = Dialect {
    involute: None,
    axes: MultiAxis { rotary: Some((["A", "B", "C"], 3)), ..MultiAxis::NONE },
    g_codes: &[
        (100, Code::SetData),
        (520, Code::LocalShift),
        (680, Code::Rotation { on: true }),
        (690, Code::Rotation { on: false }),
        (200, Code::Units { inch: true, feeds: true }),
        (280, Code::Reference),
        (210, Code::Units { inch: false, feeds: true }),
        (430, Code::LengthOn),
        (490, Code::LengthOff),
        (610, Code::ExactStop),
        (640, Code::Continuous),
        (730, Code::Cycle(CycleKind::ChipBreak)),
        (800, Code::NoMotion),
        (810, Code::Cycle(CycleKind::Drill)),
        (820, Code::Cycle(CycleKind::DrillDwell)),
        (830, Code::Cycle(CycleKind::Peck)),
        (850, Code::Cycle(CycleKind::Bore)),
        (860, Code::Cycle(CycleKind::BoreStop)),
        (890, Code::Cycle(CycleKind::BoreDwell)),
        (980, Code::ReturnToStart(true)),
        (990, Code::ReturnToStart(false)),
        (1540, Code::ExtendedOffset),
        (500, Code::Scale { on: false }),
        (510, Code::Scale { on: true }),
        (740, Code::Cycle(CycleKind::Tap(Hand::Left))),
        (760, Code::Cycle(CycleKind::FineBore)),
        (840, Code::Cycle(CycleKind::Tap(Hand::Right))),
        (870, Code::Cycle(CycleKind::LeftByHand)),
        (880, Code::Cycle(CycleKind::LeftByHand)),
    ],
    further_g_codes: modes::HAAS,
    tolerated: crate::nc::tolerated::HAAS,
    m_codes: &[
        (19, Code::Harmless("orients the spindle")),
        (31, Code::Harmless("chip conveyor")),
        (33, Code::Harmless("chip conveyor")),
        (88, Code::Harmless("coolant through the spindle")),
        (89, Code::Harmless("coolant through the spindle off")),
        (97, Code::CallBlock),
        (98, Code::CallProgram),
        (99, Code::Return),
        (48, Code::Harmless("overrides")),
        (49, Code::Harmless("overrides")),
        (130, Code::Harmless("shows a picture")),
        (131, Code::Harmless("shows a picture no more")),
    ],
    repeats: "L",
    flow: FlowWords::MacroB,
    haas: true,
    has_offset,
    ..fanuc::DIALECT
};
