//! Differences between controls, as data: the words to write, and the meanings of the words read.

use super::tolerated::Functions;
use crate::program::{Blend, StopKind, WorkOffset};
use crate::tool::Hand;

use super::modes::Mode;
use super::multi_axis::MultiAxis;
use super::native::{Native, TapWord};
use super::read::bolt_holes::Pattern;
use super::run::{Arithmetic, Level};

/// A part of the state that is written by a block of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StateWord {
    Blend,
    WorkOffset,
    Spindle,
    Coolant,
}

/// Source of the radius of a control's cutter compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CompWord {
    /// It has no cutter compensation.
    None,
    /// From the register that D names in the block of G41 or G42; without D from that of the tool (LinuxCNC).
    Register,
    /// From the register that D named last, in that block or before (FANUC).
    ModalRegister,
    /// From the tool's cutting edge in force, the same D that holds the length (SINUMERIK).
    Edge,
}

/// Words by which a control turns and shifts the coordinates of a program about Z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TurnWord {
    /// It cannot: the writer turns the coordinates.
    None,
    /// `TRANS`, `ROT`, `ATRANS`, `AROT` (SINUMERIK).
    Programmable,
    /// `G52` and `G68` (FANUC).
    Local,
    /// `G10 L2 P R` turns the work offset, `G52` shifts within it (LinuxCNC).
    Offset,
    /// `CYCL DEF 7` and `CYCL DEF 10` (HEIDENHAIN).
    Cycles,
}

/// The language of variables, branches and calls of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FlowWords {
    /// It has none, or they are not read.
    None,
    /// Parameters, O words, `M98` (LinuxCNC).
    OWords,
    /// Custom macro B, `M98`, `G65` (FANUC).
    MacroB,
}

impl FlowWords {
    #[inline]
    pub(super) fn has_variables(self) -> bool {
        self != FlowWords::None
    }

    /// The rules by which it computes.
    pub(super) fn arithmetic(self) -> Arithmetic {
        if self == FlowWords::MacroB { Arithmetic::MacroB } else { Arithmetic::Ngc }
    }

    /// Local variables of a call, where they hold no value at first.
    pub(super) fn level(self) -> Level {
        match self {
            FlowWords::None => Level::new(0, false),
            FlowWords::OWords => Level::new(30, false),
            FlowWords::MacroB => Level::new(33, true),
        }
    }

    /// Deepest calls: ten levels of subprograms (LinuxCNC `INTERP_SUB_ROUTINE_LEVELS`; FANUC 10, and 5 of macros).
    pub(super) fn depth(self) -> usize {
        if self == FlowWords::MacroB { 15 } else { 10 }
    }
}

/// Words of a control and their meanings.
#[derive(Debug)]
pub(super) struct Dialect {
    // Writing.
    /// Marks around a comment.
    pub(super) comment: [&'static str; 2],
    /// Marks around a message to the operator.
    pub(super) message: Option<[&'static str; 2]>,
    /// Whether comments are in capitals.
    pub(super) capitals: bool,
    /// Longest line that the control reads.
    pub(super) line_limit: Option<usize>,
    /// Whether a number without a decimal point counts least increments, so that the point is always written.
    pub(super) point: bool,
    /// Whether a program begins with its number (`O1234`).
    pub(super) program_number: bool,
    /// Remarks for a person at this control, for the head of the program.
    pub(super) remarks: &'static [&'static str],
    /// Line before and after the program.
    pub(super) tape: Option<&'static str>,
    /// Start and end of the control's own file header.
    pub(super) file_header: Option<[&'static str; 2]>,
    /// Blocks that put the control into a known state.
    pub(super) start: &'static [&'static str],
    /// Order in which changes of state are written.
    pub(super) order: &'static [StateWord],
    /// Blocks for exact stop, continuous path, and before and after the tolerance of a continuous path.
    pub(super) exact_stop: &'static str,
    /// Word for the exact path; none where the control does not tell it from the exact stop.
    pub(super) exact_path: Option<&'static str>,
    pub(super) continuous: &'static str,
    pub(super) rounded: Option<[&'static str; 2]>,
    /// LinuxCNC's meaning of a tolerance: the distance within which lines are merged comes after it, and zero is no tolerance.
    pub(super) merges: bool,
    /// Words before G0, after it and after the axes of a move in machine coordinates.
    pub(super) machine_frame: [&'static str; 3],
    /// Whether that move switches the tool length off until it is called again.
    pub(super) suspends_length: bool,
    /// Whether the length must be called again after a move of Z in machine coordinates.
    pub(super) recalls_length: bool,
    /// Whether it has registers of tool lengths; without, the zero of the work is set with each tool.
    pub(super) has_lengths: bool,
    /// Whether the call of a length moves the axis, and so belongs into the block of the next move of Z.
    pub(super) length_with_z: bool,
    /// Words that switch a length offset on (before the register) and off.
    pub(super) length_on: &'static str,
    pub(super) length_off: &'static str,
    /// Whether one register holds length and radius.
    pub(super) one_register: bool,
    /// Text after the number of a tool that changes it; a stop means a change by hand.
    pub(super) tool_change: &'static str,
    /// Whether it has a feed per revolution, and mist.
    pub(super) per_revolution: bool,
    pub(super) mist: bool,
    /// Whether `M7` and `M8` switch on one coolant each, so that both may be on; otherwise each replaces the other.
    pub(super) both_coolants: bool,
    /// Source of the radius of G41 and G42.
    pub(super) comp: CompWord,
    /// Word by which feeds under compensation are those of the cutter's centre, where the control may take them for those of the contour.
    pub(super) centre_feed: Option<&'static str>,
    /// Word of a dwell, and the unit of its number [s].
    pub(super) dwell: (&'static str, f64),
    /// Word for turns of a helix, and its value for less than one more turn.
    pub(super) turns: Option<(&'static str, u32)>,
    /// Whether an arc without rise may have it.
    pub(super) turns_in_plane: bool,
    /// Largest number of turns in a block.
    pub(super) most_turns: u32,
    /// Involute words clockwise and counter-clockwise, and the word of the base radius.
    pub(super) involute: Option<[&'static str; 3]>,
    /// Largest number of turns of an involute, counted from its base circle.
    pub(super) involute_turns: f64,
    /// Its own drilling cycles.
    pub(super) native: Native,
    /// Its rigid tapping.
    pub(super) tap: TapWord,
    /// Its turned and shifted coordinates, and the decimals of their angle in degrees.
    pub(super) turn: TurnWord,
    pub(super) angle_decimals: u8,
    /// Rotary axes, control of the tool centre point and tilted planes.
    pub(super) axes: MultiAxis,
    /// Last block.
    pub(super) end: &'static str,
    /// Largest block number.
    pub(super) most_blocks: usize,

    // Reading.
    /// Whether addresses may have several letters and a value after `=`.
    pub(super) long_addresses: bool,
    /// Whether blanks are ignored within numbers and `( )` are comments.
    pub(super) round_comments: bool,
    /// G codes (times ten), M codes and words without value.
    pub(super) g_codes: &'static [(u32, Code)],
    /// Further G codes, which it shares with others or has beyond its everyday ones.
    pub(super) further_g_codes: &'static [(u32, Code)],
    /// M codes of the machine that move no axis by custom.
    pub(super) tolerated: Functions,
    pub(super) m_codes: &'static [(u32, Code)],
    pub(super) keywords: &'static [(&'static str, Code)],
    /// Whether cycles return to R before the program says `G98` or `G99`, as the interpreter begins.
    pub(super) starts_at_r: bool,
    /// Answer of the control to a word that it does not have, where it is known.
    pub(super) answer: Option<&'static str>,
    /// Whether it is a Haas, where that differs from FANUC.
    pub(super) haas: bool,
    /// Its variables, branches and calls.
    pub(super) flow: FlowWords,
    /// Which work offsets it has.
    pub(super) has_offset: fn(WorkOffset) -> bool,
    /// Word of an arc's radius.
    pub(super) radius: &'static str,
    /// Words of a dwell with the unit of their number [s].
    pub(super) dwell_words: &'static [(&'static str, f64)],
    /// Whether the end of a cycle (`G80`) may share a block with a motion code.
    pub(super) cancel_beside_motion: bool,
    /// Whether a block says one M code of a modal group at most, and one code at most that uses axis words.
    pub(super) one_of_group: bool,
    /// Whether a number may have several signs.
    pub(super) signs: bool,
    /// Rule by which it runs the later blocks of a series of cycles.
    pub(super) series: SeriesRule,
    /// Word of the repetitions of a cycle.
    pub(super) repeats: &'static str,
    /// Whether a feed is in the units in force before the block.
    pub(super) feed_before_units: bool,
    /// Whether the word of a feed mode forgets the feed even when the mode stays.
    pub(super) mode_forgets_feed: bool,
    /// Whether rapid moves keep to the straight line.
    pub(super) straight_rapid: bool,
    /// Whether the path is continuous before the program says so.
    pub(super) starts_continuous: bool,
    /// Register that a tool change switches on.
    pub(super) register_after_change: Option<u32>,
    /// When an arc is refused.
    pub(super) mismatch: Mismatch,
}

/// The rule by which a control runs the later blocks of a series of cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SeriesRule {
    /// R and Z stay as numbers, and mean what they would mean in that block; the way to the next hole is straight, at the
    /// height of the return (LinuxCNC).
    Interpreter,
    /// R and Z stay the heights that they were where they were given; the way to the next hole is at the present height.
    Fanuc,
    /// As numbers, counted from the height at which the block began, and back to that (grblHAL).
    EachBlock,
}

/// The rule by which a control refuses an arc.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mismatch {
    /// Difference of the radii at start and end above this [mm].
    Constant(f64),
    /// LinuxCNC's: above `100 t`, or above `t` and a thousandth, with `t = 2 sqrt 2 * 0.01 mm` (0.001 in).
    Ngc,
    /// GRBL's: above 0.5 mm, or above 0.005 mm and a thousandth of the radius.
    Grbl,
}

impl Mismatch {
    /// Largest difference of the radii at start and end of an arc that the control takes [mm].
    pub(super) fn bound(self, start: f64, end: f64, inch: bool) -> f64 {
        /// Differences that GRBL always takes, and never [mm].
        const GRBL_LEAST: f64 = 0.005;
        const GRBL_MOST: f64 = 0.5;
        match self {
            Mismatch::Constant(bound) => bound,
            Mismatch::Ngc => {
                let t = 2.0 * std::f64::consts::SQRT_2 * if inch { 0.0254 } else { 0.01 };
                t.max((1e-3 * start.max(end)).min(100.0 * t))
            }
            Mismatch::Grbl => GRBL_LEAST.max((1e-3 * start).min(GRBL_MOST)),
        }
    }

    /// Whether the control keeps the centre and lets the radius change evenly along the arc (LinuxCNC).
    pub(super) fn keeps_centre(self) -> bool {
        matches!(self, Mismatch::Ngc)
    }
}

/// Effect of a G or M code, or of a word without a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Code {
    Rapid,
    Feed,
    Arc {
        ccw: bool,
    },
    Involute {
        ccw: bool,
    },
    /// A cubic Bezier curve in the XY plane.
    Cubic,
    /// `G5.1`.
    Quadratic,
    /// `G6.2`: a control point of a spline with its knot; `G6.3` runs it.
    KnotRow,
    /// `G5.2`: a control point of a spline; `G5.3` runs it.
    ControlPoint,
    RunSpline,
    Cycle(CycleKind),
    /// `M98` and `M99`: a program is called, and returns.
    CallProgram,
    Return,
    /// `M97`: the block of a number is called (Haas).
    CallBlock,
    /// `G92`, `G52` of LinuxCNC's kind: the present position gets these coordinates; `G92.1`, `G92.2` end it, `G92.3` takes
    /// the last again.
    PresetShift,
    ShiftOff {
        keep: bool,
    },
    ShiftAgain,
    /// `G16` (on) and `G15`: X is a radius, Y an angle.
    Polar {
        on: bool,
    },
    /// `M29`: the next `G84` or `G74` is rigid.
    Rigid,
    /// `G33.1`: along the axis with the feed geared to the spindle, and back.
    SynchronisedTap,
    /// `G33`: straight with the feed geared to the spindle.
    Geared,
    /// `G76` of LinuxCNC: the passes of a thread along Z.
    Thread,
    /// `G7`: words of X are diameters; `G8`: radii.
    Diameters(bool),
    /// `M61`: the tool of a number is in the spindle.
    ToolInSpindle,
    /// Calls a cycle after each block that moves, or no more.
    ModalCall,
    NoMotion,
    Dwell,
    Plane(Plane),
    CompOff,
    /// G41 (tool left of the contour) and G42.
    Comp {
        left: bool,
    },
    LengthOn,
    LengthOff,
    MachineFrame,
    /// G28.
    Reference,
    Work(WorkOffset),
    /// G68 (on) and G69.
    Rotation {
        on: bool,
    },
    /// G68.2.
    Tilt,
    /// G68.3.
    TiltByTool,
    /// G53.1.
    Orient,
    /// G43.4, and with the tool axis as a vector G43.5.
    TipControl {
        vector: bool,
    },
    /// TRAORI and TRAFOOF.
    Transformation {
        on: bool,
    },
    /// ORIVECT (the tool axis turns in a plane) and ORIAXES.
    Interpolation {
        vector: bool,
    },
    /// G52.
    LocalShift,
    /// G10.
    SetData,
    /// TRANS (`add`: ATRANS) and ROT (AROT) of SINUMERIK.
    FrameShift {
        add: bool,
    },
    FrameTurn {
        add: bool,
    },
    ExactStop,
    ExactPath,
    Continuous,
    Rounded,
    Absolute(bool),
    CentreAbsolute(bool),
    FeedPerMinute,
    FeedPerRevolution,
    InverseTime,
    Units {
        inch: bool,
        feeds: bool,
    },
    ReturnToStart(bool),
    ToolChange,
    /// `G96`: S is a surface speed, and the spindle turns as the radius asks.
    SurfaceSpeed,
    SpindleClockwise,
    SpindleCounterClockwise,
    SpindleOff,
    Mist,
    Flood,
    CoolantOff,
    Stop(StopKind),
    /// `G43.1`, and `G43.2` which adds: a length as a number (LinuxCNC).
    LengthByNumber {
        add: bool,
    },
    /// `G41.1` and `G42.1`: a compensation with its diameter as a number (LinuxCNC).
    CompByNumber {
        left: bool,
    },
    /// `M19`: the spindle stops at an angle.
    Orientation,
    /// `M70` and `M73`: the state is saved; `M71` forgets it, `M72` takes it again.
    Save {
        returns: bool,
    },
    Forget,
    TakeAgain,
    /// `G28.1` and `G30.1`: the place is stored for `G28` and `G30`.
    StorePlace {
        second: bool,
    },
    /// `G38.2` to `G38.5`.
    Probe {
        kind: u8,
    },
    /// Switches a device, or waits for one; it has words of its own.
    Device(&'static str),
    /// Moves no axis and changes no coordinate; the text says what it does.
    Harmless(&'static str),
    /// A function of the machine that moves no axis by custom, and is passed over.
    Tolerated(&'static str),
    /// `G30`: as G28, to the second, third or fourth reference point.
    FurtherReference,
    /// `G54.1`, `G154`: the work offset of a number.
    ExtendedOffset,
    /// `G51` (on) and `G50`: coordinates are scaled.
    Scale {
        on: bool,
    },
    /// `G51.1` (on) and `G50.1`: coordinates are mirrored.
    Mirror {
        on: bool,
    },
    /// Moves no axis, and has words of its own.
    Mode(&'static Mode),
    /// Known, and refused: the text says why.
    NotRead(&'static str),
    /// `G70` to `G72`: a pattern of holes (Haas).
    Holes(Pattern),
    /// `G12` and `G13`: a round pocket (Haas).
    RoundPocket {
        ccw: bool,
    },
}

/// Canned cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CycleKind {
    Drill,
    DrillDwell,
    Peck,
    ChipBreak,
    Tap(Hand),
    /// `G85`: back at feed.
    Bore,
    /// `G86`: the spindle stops at the bottom, back in rapid.
    BoreStop,
    /// `G89`: a wait at the bottom, back at feed.
    BoreDwell,
    /// `G84` and `G74` with a floating holder: the spindle turns back at the bottom, the way out is at feed (LinuxCNC).
    Floating(Hand),
    /// `G76`: the tool steps aside at the bottom and leaves (FANUC, Haas).
    FineBore,
    /// `G87` of FANUC: the tool steps aside, goes below the work and bores upwards.
    BackBore,
    /// `G88`, `G87` of Haas: the spindle and the program stop at the bottom, the way out is by hand.
    LeftByHand,
}

/// Plane of arcs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Plane {
    /// G17.
    #[default]
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

impl Plane {
    /// First, second and normal axis, right-handed.
    pub(super) fn axes(self) -> [usize; 3] {
        match self {
            Plane::Xy => [0, 1, 2],
            Plane::Zx => [2, 0, 1],
            Plane::Yz => [1, 2, 0],
        }
    }

    pub(super) fn word(self) -> &'static str {
        match self {
            Plane::Xy => "G17",
            Plane::Zx => "G18",
            Plane::Yz => "G19",
        }
    }
}

/// Letters of the axes and of the centre offsets.
pub(super) const AXES: [&str; 3] = ["X", "Y", "Z"];
pub(super) const OFFSETS: [&str; 3] = ["I", "J", "K"];

impl Dialect {
    /// Whether F gives the time of a dwell.
    pub(super) fn feed_is_dwell(&self) -> bool {
        self.dwell_words.iter().any(|w| w.0 == "F")
    }

    /// Whether cycles are a group of their own (09 of FANUC and Haas): behind `G80` the motion goes on that was in force before.
    pub(super) fn cycles_apart(&self) -> bool {
        self.flow == FlowWords::MacroB
    }

    /// Whether it runs cubics.
    pub(super) fn has_cubic(&self) -> bool {
        self.g_codes.iter().any(|(_, code)| *code == Code::Cubic)
    }

    /// Whether tools are changed by hand, at a stop.
    pub(super) fn hand_change(&self) -> bool {
        self.tool_change == " M0"
    }

    /// The control's passage between moves for the one that a program asks for: the same, or one that keeps nearer to
    /// the path.
    pub(super) fn blend(&self, wanted: Blend) -> Blend {
        match wanted {
            // One word for both; a control with a text of its own has neither here.
            _ if self.exact_stop == self.continuous && !self.continuous.is_empty() => Blend::Continuous,
            Blend::Exact if self.exact_path.is_none() => Blend::Stop,
            Blend::Tolerance { .. } if self.rounded.is_none() => self.blend(Blend::Exact),
            // The largest distance from the path stays; zero would be the opposite of what was asked for.
            Blend::Tolerance { path, merge, angle } if !self.merges => {
                Blend::Tolerance { path: path + merge, merge: 0.0, angle }
            }
            Blend::Tolerance { path: 0.0, .. } => self.blend(Blend::Exact),
            other => other,
        }
    }
}

impl Code {
    /// Codes of one group exclude each other in a block; `None` goes with anything.
    pub(super) fn group(self) -> Option<u8> {
        Some(match self {
            Code::Rapid
            | Code::Feed
            | Code::Arc { .. }
            | Code::Involute { .. }
            | Code::Cubic
            | Code::Quadratic
            | Code::ControlPoint
            | Code::KnotRow
            | Code::Probe { .. }
            | Code::RunSpline
            | Code::Cycle(_)
            | Code::SynchronisedTap
            | Code::Geared
            | Code::Thread
            | Code::NoMotion
            | Code::ModalCall => 1,
            Code::Plane(_) => 2,
            Code::Absolute(_) => 3,
            Code::CentreAbsolute(_) => 4,
            Code::FeedPerMinute | Code::FeedPerRevolution | Code::InverseTime => 5,
            Code::Units { .. } => 6,
            Code::CompOff | Code::Comp { .. } | Code::CompByNumber { .. } => 7,
            Code::LengthOn | Code::LengthOff | Code::LengthByNumber { .. } | Code::TipControl { .. } => 8,
            Code::ReturnToStart(_) => 10,
            Code::Work(_) | Code::ExtendedOffset => 12,
            Code::ExactStop | Code::ExactPath | Code::Continuous | Code::Rounded => 13,
            Code::Dwell | Code::MachineFrame | Code::Reference | Code::FurtherReference | Code::Holes(_) => {
                20
            }
            Code::StorePlace { .. } | Code::RoundPocket { .. } => 20,
            Code::Save { .. } | Code::Forget | Code::TakeAgain => 28,
            Code::PresetShift | Code::ShiftOff { .. } | Code::ShiftAgain => 20,
            Code::Polar { .. } => 19,
            Code::LocalShift | Code::SetData | Code::FrameShift { .. } | Code::FrameTurn { .. } => 20,
            Code::Rotation { .. } | Code::Tilt | Code::TiltByTool => 16,
            Code::Orient => 20,
            Code::Transformation { .. } => 17,
            Code::Interpolation { .. } => 18,
            Code::Stop(_) | Code::CallProgram | Code::CallBlock | Code::Return => 21,
            Code::ToolChange | Code::ToolInSpindle => 22,
            Code::SurfaceSpeed => 26,
            Code::Diameters(_) => 29,
            Code::Scale { .. } | Code::Mirror { .. } => 27,
            Code::SpindleClockwise | Code::SpindleCounterClockwise | Code::SpindleOff | Code::Orientation => {
                23
            }
            Code::Mist | Code::Flood | Code::CoolantOff | Code::Rigid => return None,
            Code::Mode(_) | Code::NotRead(_) | Code::Device(_) | Code::Harmless(_) | Code::Tolerated(_) => {
                return None;
            }
        })
    }
}

/// G and M codes that mean the same on every control here.
pub(super) const COMMON_G: &[(u32, Code)] = &[
    (0, Code::Rapid),
    (10, Code::Feed),
    (20, Code::Arc { ccw: false }),
    (30, Code::Arc { ccw: true }),
    (40, Code::Dwell),
    (170, Code::Plane(Plane::Xy)),
    (180, Code::Plane(Plane::Zx)),
    (190, Code::Plane(Plane::Yz)),
    (400, Code::CompOff),
    (410, Code::Comp { left: true }),
    (420, Code::Comp { left: false }),
    (530, Code::MachineFrame),
    (900, Code::Absolute(true)),
    (910, Code::Absolute(false)),
    (930, Code::InverseTime),
    (940, Code::FeedPerMinute),
    (950, Code::FeedPerRevolution),
];

/// See [`COMMON_G`].
pub(super) const COMMON_M: &[(u32, Code)] = &[
    (0, Code::Stop(StopKind::Program)),
    (1, Code::Stop(StopKind::Optional)),
    (2, Code::Stop(StopKind::End)),
    (30, Code::Stop(StopKind::End)),
    (3, Code::SpindleClockwise),
    (4, Code::SpindleCounterClockwise),
    (5, Code::SpindleOff),
    (6, Code::ToolChange),
    (7, Code::Mist),
    (8, Code::Flood),
    (9, Code::CoolantOff),
];
