//! Codes that several controls share, or that a control has beyond its everyday ones: modes that move no axis, places and probes, and
//! codes that are known and not read.

use super::dialect::Code;
use super::read::bolt_holes::Pattern;

/// A mode of a control that is not followed: what it does, and the words that belong to it.
#[derive(Debug, PartialEq)]
pub(super) struct Mode {
    /// Its effect, for a message.
    pub(super) what: &'static str,
    /// Its words.
    pub(super) words: &'static [&'static str],
    /// Word of the largest distance from the path, if it has one.
    pub(super) tolerance: Option<&'static str>,
    /// Values of its word Q with which the control lays curves through lines, within parameters of its own.
    pub(super) smooths: &'static [u32],
}

const fn mode(what: &'static str, words: &'static [&'static str]) -> Mode {
    Mode { what, words, tolerance: None, smooths: &[] }
}

const CONTOUR: Mode = Mode {
    smooths: &[2, 3],
    ..mode(
        "look-ahead, which rounds corners within parameters of the machine",
        &["Q", "R", "X", "Y", "Z", "A", "B", "C"],
    )
};
const PRECISION: Mode =
    mode("high-speed contour, which rounds corners within parameters of the machine", &["P"]);
const AHEAD: Mode = mode("look-ahead, which rounds corners within parameters of the machine", &["P"]);
const STROKE_ON: Mode = mode("stroke limits, which are not checked", &["X", "Y", "Z", "I", "J", "K"]);
const STROKE_OFF: Mode = mode("stroke limits off", &[]);
const SPINDLE_WATCH: Mode = mode("watches the speed of the spindle", &["P", "Q", "R", "I", "D"]);
const SPINDLE_FREE: Mode = mode("watches the speed of the spindle no more", &[]);
const SMOOTHNESS: Mode = Mode { tolerance: Some("E"), ..mode("how far corners are rounded", &["P", "E"]) };
const BLOCKS_AHEAD: Mode = mode("number of blocks that are read ahead", &["P"]);

/// Further codes of LinuxCNC, GRBL and grblHAL (times ten).
pub(super) const NGC: &[(u32, Code)] = &[
    (100, Code::SetData),
    (280, Code::Reference),
    (281, Code::StorePlace { second: false }),
    (300, Code::FurtherReference),
    (301, Code::StorePlace { second: true }),
    (382, Code::Probe { kind: 2 }),
    (383, Code::Probe { kind: 3 }),
    (384, Code::Probe { kind: 4 }),
    (385, Code::Probe { kind: 5 }),
    (920, Code::PresetShift),
    (921, Code::ShiftOff { keep: false }),
];

/// Further codes of FANUC (times ten).
pub(super) const FANUC: &[(u32, Code)] = &[
    (50, Code::Mode(&PRECISION)),
    (51, Code::Mode(&CONTOUR)),
    (80, Code::Mode(&AHEAD)),
    (220, Code::Mode(&STROKE_ON)),
    (230, Code::Mode(&STROKE_OFF)),
    (250, Code::Mode(&SPINDLE_FREE)),
    (260, Code::Mode(&SPINDLE_WATCH)),
    (620, Code::Continuous),
    (630, Code::Continuous),
    (960, Code::SurfaceSpeed),
    (970, Code::Harmless("S in revolutions a minute")),
    (62, Code::NotRead("a NURBS curve, whose path is not read for this control")),
    (71, Code::NotRead("coordinates wound around a cylinder are not read")),
    (121, Code::NotRead("polar interpolation with a rotary axis is not read")),
    (290, Code::NotRead("the way back over the point of G28 is not read")),
    (310, Code::NotRead("where a probing move ends is known at the machine only")),
    (330, Code::NotRead("a thread with the feed geared to the spindle is not read, but G84 and G74")),
    (440, Code::NotRead("a tool length that is subtracted is not read: write G43")),
    (
        450,
        Code::NotRead(
            "a move that the value of an offset makes longer or shorter is not known from the program",
        ),
    ),
    (
        460,
        Code::NotRead(
            "a move that the value of an offset makes longer or shorter is not known from the program",
        ),
    ),
    (
        470,
        Code::NotRead(
            "a move that the value of an offset makes longer or shorter is not known from the program",
        ),
    ),
    (
        480,
        Code::NotRead(
            "a move that the value of an offset makes longer or shorter is not known from the program",
        ),
    ),
    (600, Code::NotRead("the overrun of a positioning from one side is a parameter of the machine (5440)")),
    (
        920,
        Code::NotRead(
            "the present position gets other coordinates in all work offsets, which is not read for this control",
        ),
    ),
];

/// Further codes of Haas (times ten).
pub(super) const HAAS: &[(u32, Code)] = &[
    (90, Code::Harmless("exact stop in the block")),
    (970, Code::Harmless("S in revolutions a minute")),
    (700, Code::Holes(Pattern::Circle)),
    (710, Code::Holes(Pattern::Arc)),
    (720, Code::Holes(Pattern::Line)),
    (1030, Code::Mode(&BLOCKS_AHEAD)),
    (1870, Code::Mode(&SMOOTHNESS)),
    (120, Code::RoundPocket { ccw: false }),
    (130, Code::RoundPocket { ccw: true }),
    (310, Code::NotRead("where a probing move ends is known at the machine only")),
    (470, Code::NotRead("it engraves text, and the shapes of the control's letters are not published")),
    (770, Code::NotRead("the way of the back boring out of its counterbore is not published")),
    (
        920,
        Code::NotRead(
            "the present position gets other coordinates, by setting 33, which is not read for this control",
        ),
    ),
    (1010, Code::NotRead("the mirror image of this control is not read: write the mirrored half")),
    (1070, Code::NotRead("coordinates wound around a cylinder are not read")),
    (1410, Code::NotRead("compensation along the normal of a surface is not read")),
    (1430, Code::NotRead("the tool length along a tilted tool axis is not read")),
    (
        1500,
        Code::NotRead(
            "the control's own way through a pocket is not published: only its outline is in the program",
        ),
    ),
    (2340, Code::NotRead("control of the tool centre point of this control is not read")),
    (2540, Code::NotRead("a work offset that turns with the table is not read")),
    (2680, Code::NotRead("a tilted plane of this control is not read")),
];
