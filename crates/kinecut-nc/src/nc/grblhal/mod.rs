//! grblHAL, and the files that senders of its kind take, read.
//!
//! GRBL with tool changes, registers of lengths, canned cycles, parameters and expressions. In a cycle G98 returns to the height
//! at which its block began. `G64` is read as GRBL's own passage, which keeps to the path. Cutter compensation is an option of
//! few builds, and refused; O words run in files of macros only, and are refused by the control elsewhere: they are read.
//!
//! Source: grblHAL's `gcode.c`, `motion_control.c` and list of errors (2026).

use crate::tool::Hand;

use super::dialect::{Code, CompWord, CycleKind, Dialect, Mismatch, SeriesRule, TurnWord};
use super::linuxcnc;
use super::multi_axis::MultiAxis;
use super::native::{Canned, Native, TapWord};

/// Lift of `G73`, a setting, and clearance of `G83` [mm].
const LIFT: f64 = 0.1;

pub(super) const DIALECT: Dialect = Dialect {
    comp: CompWord::None,
    centre_feed: None,
    exact_stop: "G61",
    exact_path: None,
    continuous: "G61",
    rounded: None,
    native: Native::Canned(Canned { clearance: 0.25, lift: LIFT, subtracts: false, by_parameter: true }),
    tap: TapWord::None,
    turn: TurnWord::None,
    axes: MultiAxis { rotary: Some((["A", "B", "C"], 6)), ..MultiAxis::NONE },
    g_codes: &[
        (50, Code::Cubic),
        (51, Code::Quadratic),
        (200, Code::Units { inch: true, feeds: true }),
        (210, Code::Units { inch: false, feeds: true }),
        (430, Code::LengthOn),
        (490, Code::LengthOff),
        (610, Code::Continuous),
        (640, Code::Continuous),
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
        (911, Code::CentreAbsolute(false)),
        (980, Code::ReturnToStart(true)),
        (990, Code::ReturnToStart(false)),
    ],
    series: SeriesRule::EachBlock,
    starts_at_r: false,
    signs: false,
    mismatch: Mismatch::Grbl,
    ..linuxcnc::DIALECT
};
