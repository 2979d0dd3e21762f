//! The grazing curve: where the velocity of the tool's surface is tangential to it.
//!
//! Every maximal interval of the chain on which the discriminant is not negative is one closed curve: up along the plus
//! branch and back along the minus branch, closed by the folds at both ends. No points are matched, and no tolerance decides
//! what belongs together.

mod branch;
mod length;
mod spans;

use std::ops::Range;

use serde::Serialize;

use super::discriminant::Discriminant;
use super::normal_velocity::PieceVelocity;
use super::{ChainPiece, NormalVelocity, PieceKind, PieceShape, ProfileChain, twist};
use crate::machine::Twist;

pub use branch::GrazingPoint;

/// Type of the motion, for its grazing curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No velocity: no curve, the tool sweeps itself.
    Still,
    /// The tool turns about its own axis: no curve, the tool sweeps itself.
    Spin,
    /// Along the axis of the tool.
    Plunge,
    /// A translation, not along the axis.
    Translation,
    /// A rotation whose axis meets the axis of the tool, or any motion without velocity along the axis: the curve passes both
    /// poles.
    Across,
    /// Any other.
    General,
}

/// The type of a grazing segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SegmentKind {
    /// A straight line of a cone or cylinder, in a translation.
    Generator,
    /// A curve on a cone or cylinder.
    ConeCurve,
    /// A straight line across a disc.
    DiscChord,
    /// Part of a great circle of a sphere.
    SphereArc,
    /// A curve on a torus that bulges outwards.
    TorusOuter,
    /// A curve on a torus that bulges inwards.
    TorusInner,
    /// Part of a convex edge, or a tip.
    EdgeArc,
    /// Part of a concave edge: it joins two curves, and never bounds what the tool sweeps.
    Join,
}

/// An interval of one piece with two grazing points on each parallel circle: two segments of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrazingSpan {
    /// Index of the piece in the chain.
    pub piece: usize,
    /// Parameter at the start.
    pub from: f64,
    /// Parameter at the end.
    pub to: f64,
    /// True if the two branches meet in a fold at the start, and at the end.
    pub folds: [bool; 2],
    /// Type of both segments.
    pub kind: SegmentKind,
    pub(super) velocity: PieceVelocity,
    pub(super) discriminant: Discriminant,
}

/// One closed grazing curve: a range of spans.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GrazingLoop {
    /// Its spans, along the chain.
    pub spans: Range<usize>,
    /// Number of its turns about the axis: 1 when it parts the tip from the top, else 0.
    pub winding: u8,
    /// It closes; false if it ends at a piece that grazes as a whole.
    pub closed: bool,
}

/// The grazing curves of a tool at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Grazing {
    /// Type of the motion.
    pub motion: Motion,
    /// Spans in the order of the chain.
    pub spans: Vec<GrazingSpan>,
    /// Closed curves.
    pub loops: Vec<GrazingLoop>,
    /// Parallel circles that graze as a whole: piece and parameter.
    pub circles: Vec<(usize, f64)>,
    /// Pieces that graze as a whole.
    pub whole: Vec<usize>,
    /// Pieces along which the two points of each parallel circle are one: the surface only touches.
    pub touching: Vec<usize>,
}

impl Grazing {
    /// No curve.
    pub fn none() -> Grazing {
        Grazing {
            motion: Motion::Still,
            spans: Vec::new(),
            loops: Vec::new(),
            circles: Vec::new(),
            whole: Vec::new(),
            touching: Vec::new(),
        }
    }

    /// True with folds that are only touched, or circles or pieces that graze as a whole.
    pub fn is_degenerate(&self) -> bool {
        !(self.circles.is_empty() && self.whole.is_empty() && self.touching.is_empty())
    }
}

impl ProfileChain {
    /// The grazing curves under a twist, in coordinates of the tool: `turn` its angular velocity, `shift` the velocity of
    /// the point at the origin.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::Twist;
    /// use kinecut::sweep::ProfileChain;
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let ball = Contour::new(vec![
    ///     ContourElement::arc([0.0, 5.0], 5.0, -std::f64::consts::FRAC_PI_2, 0.0, ElementRole::Cutting),
    ///     ContourElement::line([5.0, 5.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ])
    /// .unwrap();
    /// let chain = ProfileChain::new(&ball);
    /// let along = Twist { turn: DVec3::ZERO, shift: DVec3::new(0.0, 12.0, 0.0) };
    /// let grazing = chain.grazing(&along);
    /// // Half a great circle, and two generators of the cylinder.
    /// let length: f64 = grazing.loops.iter().map(|l| chain.loop_length(&grazing, l)).sum();
    /// assert!((length - (5.0 * std::f64::consts::PI + 50.0)).abs() < 1e-12);
    /// ```
    pub fn grazing(&self, twist: &Twist) -> Grazing {
        let mut grazing = Grazing::none();
        self.grazing_into(twist, &mut grazing);
        grazing
    }

    /// The same into a value that is there, without new memory when it is large enough.
    pub fn grazing_into(&self, twist: &Twist, grazing: &mut Grazing) {
        let (twist, size) = twist::clean(twist, self.reach());
        grazing.motion = motion(&twist);
        grazing.spans.clear();
        grazing.loops.clear();
        grazing.circles.clear();
        grazing.whole.clear();
        grazing.touching.clear();
        if !matches!(grazing.motion, Motion::Still | Motion::Spin) {
            spans::find(self, &twist, size, grazing);
        }
    }

    /// The normal velocity around the parallel circle of a piece at a parameter.
    pub fn normal_velocity(&self, twist: &Twist, piece: usize, u: f64) -> NormalVelocity {
        PieceVelocity::new(&self.pieces()[piece], twist).at(u)
    }
}

fn motion(twist: &Twist) -> Motion {
    let (v, w) = (twist.shift, twist.turn);
    let still = [v.truncate(), w.truncate()].map(|a| a.length_squared() == 0.0);
    match (still, v.z == 0.0, w.z == 0.0) {
        ([true, true], true, true) => Motion::Still,
        ([true, true], true, false) => Motion::Spin,
        ([true, true], false, _) => Motion::Plunge,
        ([false, true], ..) => Motion::Translation,
        (_, true, _) => Motion::Across,
        _ => Motion::General,
    }
}

fn kind(piece: &ChainPiece, translation: bool) -> SegmentKind {
    match (piece.kind, piece.shape) {
        (PieceKind::Element, PieceShape::Line { normal, .. }) => {
            if normal.x == 0.0 {
                SegmentKind::DiscChord
            } else if translation {
                SegmentKind::Generator
            } else {
                SegmentKind::ConeCurve
            }
        }
        (PieceKind::Element, PieceShape::Arc { centre, radius }) => {
            if centre.x.abs() <= ON_AXIS * radius.abs() {
                SegmentKind::SphereArc
            } else if radius > 0.0 {
                SegmentKind::TorusOuter
            } else {
                SegmentKind::TorusInner
            }
        }
        _ if piece.is_convex() => SegmentKind::EdgeArc,
        _ => SegmentKind::Join,
    }
}

/// Part of its radius by which the centre of a sphere may lie off the axis: rounding.
const ON_AXIS: f64 = 1e-14;
