//! The sheet as JSON: mm, degrees, mm/min, degrees/min; parameters of arcs in degrees.

use glam::DVec3;
use serde::{Serialize, Serializer};

use super::show::{Band, extent, strips};
use super::{GrazingSheet, MotionSource, PieceOutcome, SpanSheet, piece_words};
use crate::base::Finding;
use crate::geom::Rigid;
use crate::sweep::{
    ChainPiece, EnteredArea, Grazing, GrazingBranch, GrazingPoint, PieceKind, PieceShape, ProfileChain,
    SegmentKind,
};
use crate::tool::ElementRole;

/// Seconds of a minute.
const MINUTE: f64 = 60.0;

/// The fields of all tables stand in the order of their names.
#[derive(Serialize)]
struct SheetJson<'a> {
    bands: Vec<BandJson>,
    circles: Vec<CircleJson>,
    ends: [EndJson; 2],
    entering: EnteringJson,
    findings: &'a [Finding],
    folds: Vec<FoldJson>,
    loops: Vec<LoopJson>,
    motion: &'static str,
    notes: &'a [String],
    pieces: Vec<PieceJson>,
    source: &'a MotionSource,
    spans: Vec<SpanJson>,
    title: &'a str,
    tolerance: f64,
    touching: &'a [usize],
    twist: TwistJson,
    whole: &'a [usize],
}

/// A band of the surface between two parallel circles; `enters`: angles about the axis from which to which it enters, at both
/// circles; null: it enters nowhere. It leaves all round, or, of a piece in `whole`, slides along itself.
#[derive(Serialize)]
struct BandJson {
    enters: Option<[[f64; 2]; 2]>,
    normals: [[f64; 2]; 2],
    piece: usize,
    places: [[f64; 2]; 2],
    u: [f64; 2],
}

/// An end of the tool's axis.
#[derive(Serialize)]
struct EndJson {
    velocity: [f64; 3],
    z: f64,
}

/// A place at which both branches meet.
#[derive(Serialize)]
struct FoldJson {
    piece: usize,
    point: [f64; 3],
    span: usize,
    theta: f64,
    u: f64,
}

#[derive(Serialize)]
struct CircleJson {
    at: f64,
    piece: usize,
    radius: f64,
    z: f64,
}

#[derive(Serialize)]
struct EnteringJson {
    area: f64,
    entering_area: f64,
    gained: f64,
    lost: f64,
}

#[derive(Serialize)]
struct LoopJson {
    closed: bool,
    length: f64,
    points: Vec<PointJson>,
    spans: [usize; 2],
    winding: u8,
}

#[derive(Serialize)]
struct PointJson {
    branch: i8,
    normal: [f64; 3],
    piece: u32,
    point: [f64; 3],
    span: usize,
    theta: f64,
    u: f64,
}

#[derive(Serialize)]
struct SpanJson {
    folds: [bool; 2],
    from: f64,
    kind: SegmentKind,
    lengths: [f64; 2],
    piece: usize,
    role: ElementRole,
    to: f64,
}

#[derive(Serialize)]
struct TwistJson {
    turn: [f64; 3],
    velocity: [f64; 3],
}

/// A piece of the chain; of a tool at one moment with what of it enters.
#[derive(Serialize)]
pub(crate) struct PieceJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    area: Option<f64>,
    body: u16,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<[f64; 2]>,
    end: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    entering_area: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    entering_share: Option<f64>,
    fan: bool,
    from: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    gained: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lost: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    outcome: Option<&'static str>,
    parameter: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    role: ElementRole,
    start: [f64; 2],
    to: f64,
    what: String,
}

impl PieceJson {
    /// A piece of a chain, and what of it enters where that is known.
    pub(crate) fn of(
        chain: &ProfileChain,
        index: usize,
        at_moment: Option<(&EnteredArea, &Grazing)>,
    ) -> PieceJson {
        let p = &chain.pieces()[index];
        let entered = at_moment.map(|(entered, _)| entered);
        let (centre, radius) = match p.shape {
            PieceShape::Arc { centre, radius } => (Some(centre.to_array()), Some(radius)),
            PieceShape::Line { .. } => (None, None),
        };
        PieceJson {
            area: entered.map(|e| e.area),
            body: p.body,
            centre,
            end: p.point(p.to).to_array(),
            entering_area: entered.map(|e| e.entering),
            entering_share: entered.map(|e| e.share),
            fan: p.kind != PieceKind::Element,
            from: parameter(p, p.from),
            gained: entered.map(|e| e.gained * MINUTE),
            lost: entered.map(|e| e.lost * MINUTE),
            outcome: at_moment.map(|(_, grazing)| PieceOutcome::of(grazing, index).words()),
            parameter: if matches!(p.shape, PieceShape::Line { .. }) { "mm" } else { "deg" },
            radius,
            role: p.role,
            start: p.point(p.from).to_array(),
            to: parameter(p, p.to),
            what: piece_words(chain, index),
        }
    }
}

/// The parameter of a piece as JSON has it: mm of a line, degrees of an arc.
pub(crate) fn parameter(piece: &ChainPiece, u: f64) -> f64 {
    if matches!(piece.shape, PieceShape::Line { .. }) { u } else { u.to_degrees() }
}

/// 1 of the plus branch, -1 of the minus branch.
pub(crate) fn sign(branch: GrazingBranch) -> i8 {
    if branch == GrazingBranch::Plus { 1 } else { -1 }
}

/// An angle about the axis of the tool [deg].
pub(crate) fn turned(theta: f64) -> f64 {
    theta.to_degrees().rem_euclid(360.0)
}

/// Rows of the matrix [R p].
pub(crate) fn matrix(p: &Rigid) -> [[f64; 4]; 3] {
    let rows = p.rotation.transpose();
    let t = p.translation;
    [(rows.x_axis, t.x), (rows.y_axis, t.y), (rows.z_axis, t.z)].map(|(r, t)| [r.x, r.y, r.z, t])
}

/// A pose as a field.
pub(super) fn pose<S: Serializer>(p: &Rigid, serializer: S) -> Result<S::Ok, S::Error> {
    matrix(p).serialize(serializer)
}

/// The points of each curve keep its chords to the tolerance.
impl Serialize for GrazingSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let pieces = self.chain.pieces();
        let circle = |&(piece, u): &(usize, f64)| {
            let of = &pieces[piece];
            CircleJson { at: parameter(of, u), piece, radius: of.point(u).x, z: of.point(u).y }
        };
        let loops = self.loops.iter().zip(&self.grazing.loops).map(|(l, of)| {
            let points = self.chain.curve(&self.grazing, of, self.tolerance);
            // The spans of one curve are on pieces of their own.
            let span = |p: &GrazingPoint| {
                let on = |s: &SpanSheet| s.span.piece == p.piece as usize;
                l.spans.start + self.spans[l.spans.clone()].iter().position(on).unwrap_or(0)
            };
            LoopJson {
                closed: l.closed,
                length: l.length,
                points: points.iter().map(|p| point(&pieces[p.piece as usize], p, span(p))).collect(),
                spans: [l.spans.start, l.spans.end],
                winding: l.winding,
            }
        });
        let spans = self.spans.iter().map(|s| {
            let of = &pieces[s.span.piece];
            SpanJson {
                folds: s.span.folds,
                from: parameter(of, s.span.from),
                kind: s.span.kind,
                lengths: s.lengths,
                piece: s.span.piece,
                role: of.role,
                to: parameter(of, s.span.to),
            }
        });
        let entered = |(i, e): (usize, &EnteredArea)| PieceJson::of(&self.chain, i, Some((e, &self.grazing)));
        let [area, entering_area] = self.areas();
        let [gained, lost] = self.rates().map(|rate| rate * MINUTE);
        let sheet = SheetJson {
            bands: (0..pieces.len()).flat_map(|i| bands(self, i)).collect(),
            circles: self.grazing.circles.iter().map(circle).collect(),
            ends: {
                let [_, low, high] = extent(self);
                let velocity = |z: f64| (self.twist.velocity(DVec3::new(0.0, 0.0, z)) * MINUTE).to_array();
                [low, high].map(|z| EndJson { velocity: velocity(z), z })
            },
            entering: EnteringJson { area, entering_area, gained, lost },
            findings: &self.findings,
            folds: self.spans.iter().enumerate().flat_map(|(i, s)| folds(self, i, s)).collect(),
            loops: loops.collect(),
            motion: self.motion_words(),
            notes: &self.notes,
            pieces: self.entering.iter().enumerate().map(entered).collect(),
            source: &self.source,
            spans: spans.collect(),
            title: &self.title,
            tolerance: self.tolerance,
            touching: &self.grazing.touching,
            twist: TwistJson {
                turn: (self.twist.turn * MINUTE).to_array().map(f64::to_degrees),
                velocity: (self.twist.shift * MINUTE).to_array(),
            },
            whole: &self.grazing.whole,
        };
        sheet.serialize(serializer)
    }
}

/// The bands of a piece; their borders are curves to the tolerance, or to [`FINENESS`] of the tool.
fn bands(sheet: &GrazingSheet, index: usize) -> impl Iterator<Item = BandJson> {
    /// Distance of borders from the curve by the size of the tool: below what a screen shows.
    const FINENESS: f64 = 1e-3;
    let piece = sheet.chain.pieces()[index];
    let fine = sheet.tolerance.max(FINENESS * sheet.chain.reach());
    strips(sheet, index, fine).into_iter().map(move |strip| BandJson {
        enters: match strip.band {
            Band::Leaves => None,
            Band::Enters => Some([[0.0, 360.0]; 2]),
            Band::Part(part) => Some(part.map(|ends| ends.map(f64::to_degrees))),
        },
        normals: strip.u.map(|u| piece.normal(u).to_array()),
        piece: index,
        places: strip.u.map(|u| piece.point(u).to_array()),
        u: strip.u.map(|u| parameter(&piece, u)),
    })
}

/// The folds of a span.
fn folds(sheet: &GrazingSheet, index: usize, of: &SpanSheet) -> impl Iterator<Item = FoldJson> {
    let piece = sheet.chain.pieces()[of.span.piece];
    let at = [0.0, 1.0].map(|t| sheet.chain.grazing_points(&of.span, t)[0]);
    let folds = of.span.folds;
    (0..2).filter(move |&k| folds[k]).map(move |k| FoldJson {
        piece: at[k].piece as usize,
        point: at[k].point.to_array(),
        span: index,
        theta: turned(at[k].theta()),
        u: parameter(&piece, at[k].u),
    })
}

fn point(piece: &ChainPiece, p: &GrazingPoint, span: usize) -> PointJson {
    PointJson {
        branch: sign(p.branch),
        normal: p.normal.to_array(),
        piece: p.piece,
        point: p.point.to_array(),
        span,
        theta: turned(p.theta()),
        u: parameter(piece, p.u),
    }
}
