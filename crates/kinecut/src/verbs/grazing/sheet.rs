//! One tool at one moment, computed.

use std::f64::consts::PI;

use super::GrazingTable;
use super::given_motion::MotionSource;
use super::motion::motion;
use crate::base::{Code, Finding, Loader, Result};
use crate::job::contour::{chosen_contour, given_contour};
use crate::machine::Twist;
use crate::sweep::{EnteredArea, Grazing, GrazingSpan, Motion, ProfileChain};
use crate::tool::Contour;

/// Tolerance of the points in JSON where none is wanted [mm].
const TOLERANCE: f64 = 0.01;
/// Least tolerance, by the reach of the tool: what is finer is rounding, and has millions of points.
const FINEST: f64 = 1e-9;

/// A span with its lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanSheet {
    /// The span.
    pub span: GrazingSpan,
    /// Lengths of the plus and the minus branch [mm].
    pub lengths: [f64; 2],
}

/// A curve with its length.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopSheet {
    /// Indices of its spans.
    pub spans: std::ops::Range<usize>,
    /// Whether it closes.
    pub closed: bool,
    /// Number of times that it goes about the axis.
    pub winding: u8,
    /// Length [mm].
    pub length: f64,
}

/// The grazing curve of a tool at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct GrazingSheet {
    /// Title.
    pub title: String,
    /// The tool.
    pub contour: Contour,
    /// Its chain of pieces.
    pub chain: ProfileChain,
    /// The motion in coordinates of the tool [rad/s, mm/s].
    pub twist: Twist,
    /// Source of the motion.
    pub source: MotionSource,
    /// The curves.
    pub grazing: Grazing,
    /// All spans with their lengths.
    pub spans: Vec<SpanSheet>,
    /// All curves.
    pub loops: Vec<LoopSheet>,
    /// Areas and volumes that enter, for each piece.
    pub entering: Vec<EnteredArea>,
    /// Tolerance of points [mm].
    pub tolerance: f64,
    /// Notes of the tool's reader.
    pub notes: Vec<String>,
    /// Findings.
    pub findings: Vec<Finding>,
}

/// The sheet of a table; files come through `loader`.
///
/// # Errors
/// `KC1211` when the motion is not given once, `KC1201` when there is none, `KC1202` for a pose that is not rigid, `KC0103`
/// for invalid numbers; those of the tool.
pub fn grazing_sheet(table: &GrazingTable, loader: &dyn Loader) -> Result<GrazingSheet> {
    crate::job::check::numbers::within(table)?;
    let given = given_contour(table.tool.as_ref(), table.tool_file.as_deref(), loader)?;
    let moving = motion(table, loader, given.is_none())?;
    let (name, contour, notes) = chosen_contour(given, moving.tool)?;
    let title = table.title.clone().unwrap_or(name);
    let chain = ProfileChain::new(&contour);
    let tolerance = table.tolerance.unwrap_or(TOLERANCE);
    let finest = FINEST * chain.reach();
    if !(tolerance >= finest && tolerance.is_finite()) {
        return Err(Finding::error(
            Code::JOB_VALUE,
            "the tolerance of the points is no length, or finer than rounding",
        )
        .value_mm(tolerance)
        .bound_mm(finest)
        .key("tolerance")
        .into());
    }
    let mut sheet = GrazingSheet::new(title, contour, moving.twist);
    if sheet.grazing.motion == Motion::Still {
        let error =
            Finding::error(Code::NO_MOTION, "the tool does not move: it sweeps itself, and no curve grazes");
        return Err(error.help("give a velocity, or a turning that is not about the tool's own axis").into());
    }
    sheet.source = moving.source;
    sheet.tolerance = tolerance;
    sheet.notes = notes;
    Ok(sheet)
}

impl GrazingSheet {
    /// The sheet of a contour under a twist [rad/s, mm/s].
    pub(crate) fn new(title: String, contour: Contour, twist: Twist) -> GrazingSheet {
        let chain = ProfileChain::new(&contour);
        let grazing = chain.grazing(&twist);
        let span = |s: &GrazingSpan| SpanSheet { span: *s, lengths: chain.span_lengths(s) };
        let spans: Vec<SpanSheet> = grazing.spans.iter().map(span).collect();
        let length = |range: &std::ops::Range<usize>| -> f64 {
            spans[range.clone()].iter().map(|s| s.lengths[0] + s.lengths[1]).sum()
        };
        let loops = grazing.loops.iter().map(|l| LoopSheet {
            spans: l.spans.clone(),
            closed: l.closed,
            winding: l.winding,
            length: length(&l.spans),
        });
        let loops = loops.collect();
        let entering = chain.entered_areas(&twist, &grazing);
        let mut findings = Vec::new();
        if grazing.motion == Motion::Spin {
            let what = "the tool turns about its own axis alone: it sweeps itself, and no curve grazes";
            findings.push(Finding::warning(Code::NO_MOTION, what));
        }
        GrazingSheet {
            title,
            contour,
            chain,
            twist,
            source: MotionSource::Twist,
            grazing,
            spans,
            loops,
            entering,
            tolerance: TOLERANCE,
            notes: Vec::new(),
            findings,
        }
    }

    /// Area of the tool and the part of it that enters [mm2].
    pub fn areas(&self) -> [f64; 2] {
        self.entering.iter().fold([0.0; 2], |a, e| [a[0] + e.area, a[1] + e.entering])
    }

    /// Volume that the tool enters, and that it leaves [mm3/s]: the same, but for rounding.
    pub fn rates(&self) -> [f64; 2] {
        self.entering.iter().fold([0.0; 2], |a, e| [a[0] + e.gained, a[1] + e.lost])
    }

    /// The kind of motion, in words.
    pub fn motion_words(&self) -> &'static str {
        match self.grazing.motion {
            Motion::Still => "none: the tool stands still and sweeps itself",
            Motion::Spin => "spin about the tool's own axis: it sweeps itself",
            Motion::Plunge => "plunge along the axis of the tool",
            Motion::Translation if self.twist.shift.z == 0.0 => {
                "translation across the axis: bottom and top do not leave their planes"
            }
            Motion::Translation => "translation oblique to the axis (ramp)",
            Motion::Across => "no velocity along the axis: the curve passes through both poles",
            Motion::General => "general",
        }
    }

    /// A piece in words: its number in the chain and what it is.
    pub fn piece_words(&self, index: usize) -> String {
        piece_words(&self.chain, index)
    }

    /// The parameter of a piece as shown: the way along a line [mm], the normal angle of an arc [deg].
    pub fn shown_parameter(&self, piece: usize, u: f64) -> String {
        use crate::sweep::PieceShape;
        match self.chain.pieces().get(piece).map(|p| p.shape) {
            // A zero is added, so that a rounded one has no sign.
            Some(PieceShape::Line { .. }) => format!("{:.4} mm", rounded(u)),
            Some(PieceShape::Arc { .. }) => format!("{:.4}\u{b0}", rounded(u * 180.0 / PI)),
            None => String::new(),
        }
    }
}

/// A piece of a chain in words: its number and what it is.
pub(crate) fn piece_words(chain: &ProfileChain, index: usize) -> String {
    use crate::sweep::{PieceKind, PieceShape};
    let Some(piece) = chain.pieces().get(index) else { return String::new() };
    let word = match (piece.kind, piece.shape) {
        (PieceKind::Element, PieceShape::Line { normal, .. }) => {
            if normal.x == 0.0 {
                "disc"
            } else if normal.y == 0.0 {
                "cylinder"
            } else {
                "cone"
            }
        }
        (PieceKind::Element, PieceShape::Arc { centre, radius }) => {
            if centre.x.abs() <= AXIS * radius.abs() {
                "sphere"
            } else if radius < 0.0 {
                "torus inward"
            } else if centre.x < 0.0 {
                "barrel"
            } else {
                "torus outward"
            }
        }
        (PieceKind::Edge, _) if piece.is_convex() => "edge",
        (PieceKind::Edge, _) => "concave edge",
        (PieceKind::Pole, _) if piece.is_convex() => "tip",
        (PieceKind::Pole, _) => "pit",
    };
    format!("{} {word}", index + 1)
}

/// To the four decimals that are shown, without the sign of a zero.
fn rounded(v: f64) -> f64 {
    (v * 1e4).round() / 1e4 + 0.0
}

/// Part of its radius by which a sphere's centre may lie off the axis: rounding.
const AXIS: f64 = 1e-12;
