//! The envelope of a move: the boundary of what the tool sweeps, as a closed mesh.
//!
//! It consists of the part of the tool that leaves at the first moment, the grazing curves of all moments, and the part that
//! enters at the last. The mesh cuts the move in slices, which come as close as the strips between them need: no point of the
//! tool leaves the straight way between two of them by more than its part of the tolerance, and every edge of a strip is tried
//! against the moving tool. The mesh may cut itself, where the tool turns about a point near its tip or has hollow forms: what
//! lies inside of the swept volume is not trimmed. Every edge has two faces.
//! By brute force over all moments with a tolerance of 1 um, all points of eight tools and ten kinds of moves keep to
//! it, 1250 each. A longer search found one 2 um off: where the end face of a turning tool nearly slides along itself
//! and its edge comes and goes, a strip may leave the envelope most away from the middle of its edges.

mod cap;
mod cusp;
mod depth;
mod face;
mod point;
mod polygon;
mod refine;
mod second;
mod slice;
mod stray;
mod strip;
mod wall;

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;
use serde::Serialize;

use super::{ChainPiece, PieceShape, ProfileChain, ToolMotion};
use crate::base::{Code, CountBound, Finding, Progress, Result};
use crate::geom::Mesh;
use cap::Cap;
use refine::Refine;
use slice::{Fineness, Slice, step_along, steps_around};
use stray::faces;
use strip::Builder;
use wall::Rail;

pub use depth::{Depth, SweptDepth};
pub use point::EnvelopePoint;

/// The envelope of a move.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    /// Closed, oriented outwards [workpiece coordinates]; it may cut itself.
    pub mesh: Mesh,
    /// The moments at which the grazing curves were taken.
    pub moments: Vec<f64>,
    /// Triangles of the mesh up to each moment: walls first, in the order of time, and both ends after them.
    pub walls: Vec<usize>,
    /// End of the triangles of the tool at the start, behind the walls; those of the tool at the end follow.
    pub start: usize,
    /// Places at which curves are born, join, part or end.
    pub events: Vec<EnvelopeEvent>,
    /// A bound on the distance of points of the tool from straight ways between the moments [mm].
    pub pose_error: f64,
}

/// A change in the number of grazing curves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EnvelopeEvent {
    /// Curves after.
    pub after: usize,
    /// Curves before that take part.
    pub before: usize,
    /// The two moments around the change.
    pub between: [f64; 2],
}

/// Parts of the tolerance: of the straight ways between poses, of chords along a curve, and of both together in the middle of an
/// edge across a strip; inside of a triangle it is up to a third more.
const POSES: f64 = 0.4;
const CHORDS: f64 = 0.3;
const STRIPS: f64 = 0.7;
/// Of chords along and around the tool at both ends, which add.
const CAPS: f64 = 0.4;
/// Most slices of one move.
const MOST_SLICES: f64 = 1e5;
/// Most vertices of a mesh: with slices, triangles and the files that are made of them 412 bytes each were measured, so
/// that these keep within 2 GB.
const MOST_VERTICES: usize = 4_000_000;
/// The same before anything is built.
const VERTICES: CountBound = CountBound {
    what: "vertices of a swept volume",
    most: MOST_VERTICES as f64,
    bytes: 500,
    code: Code::SWEEP_TOO_FINE,
    help: "take a larger tolerance, or divide the move",
};

impl ProfileChain {
    /// A bound on the distance of the tool's points from the origin [mm].
    pub fn bound(&self) -> f64 {
        let of = |shape: &PieceShape, from: f64, to: f64, ends: [f64; 2]| match *shape {
            PieceShape::Arc { centre, radius } if from != to => centre.length() + radius.abs(),
            _ => ends[0].max(ends[1]),
        };
        let bound =
            |p: &ChainPiece| of(&p.shape, p.from, p.to, [p.point(p.from).length(), p.point(p.to).length()]);
        self.pieces().iter().map(bound).fold(0.0, f64::max)
    }

    /// The envelope of a move within a tolerance [mm].
    ///
    /// # Errors
    /// `KC1204` when the tolerance is not positive; `KC1205` when it would need too many facets; `KC0009` when it was cancelled.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::base::Silent;
    /// use kinecut::geom::Line;
    /// use kinecut::sweep::{ProfileChain, ToolMotion};
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let flat = Contour::new(vec![
    ///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ])
    /// .unwrap();
    /// let line = Line { start: DVec3::ZERO, end: DVec3::new(20.0, 0.0, 0.0) };
    /// let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
    /// let swept = ProfileChain::new(&flat).envelope(&motion, 0.001, &Silent).unwrap();
    /// swept.mesh.check_closed().unwrap();
    /// let exact = (25.0 * std::f64::consts::PI + 10.0 * 20.0) * 30.0;
    /// assert!((swept.mesh.volume() / exact - 1.0).abs() < 1e-4);
    /// ```
    pub fn envelope(&self, motion: &ToolMotion, tolerance: f64, progress: &dyn Progress) -> Result<Envelope> {
        self.envelope_by(motion, tolerance, 1, progress)
    }

    /// The envelope, with the ends of `intervals` equal parts of the time among its moments.
    ///
    /// # Errors
    /// As [`ProfileChain::envelope`].
    pub fn envelope_by(
        &self,
        motion: &ToolMotion,
        tolerance: f64,
        intervals: usize,
        progress: &dyn Progress,
    ) -> Result<Envelope> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(Finding::error(
                Code::SWEEP_TOLERANCE,
                "the tolerance of a swept volume is not positive",
            )
            .value_mm(tolerance)
            .bound_mm(0.0)
            .help("give a tolerance such as 0.01 mm")
            .into());
        }
        let reach = self.bound();
        let whole = motion.chord_error(0.0, 1.0, reach);
        // The error falls with the square of the step; unless nothing bends, a middle is needed to see by how much.
        let count = (whole / (POSES * tolerance)).sqrt().ceil();
        let count = if whole == 0.0 { 1.0 } else { count.max(2.0) };
        if count.is_nan() || count > MOST_SLICES {
            return Err(too_fine(count, MOST_SLICES));
        }
        let intervals = intervals.max(1);
        let count = intervals * (count as usize).div_ceil(intervals);
        let fineness = Fineness { chord: CHORDS * tolerance, step: 1.0 / count as f64, cap: f64::INFINITY };
        let refine =
            Refine { chain: self, motion, reach, strip: STRIPS * tolerance, fineness, faces: faces(self) };
        // A curve at its longest, both ends, and then what a moment in the middle really has.
        let ends = self.end_vertices(CAPS * tolerance);
        VERTICES.check(f64::max(self.curve_nodes(fineness.chord), ends))?;
        let middle = refine.slice(0.5, fineness).nodes.len();
        VERTICES.check(2.0 * (middle * (count + 1)) as f64 + ends)?;
        let mut slices: Vec<Slice> = (0..=count)
            .into_par_iter()
            .filter(|_| !progress.cancelled())
            .map(|k| {
                let cap = if k == 0 || k == count { CAPS * tolerance } else { f64::INFINITY };
                refine.slice(k as f64 / count as f64, Fineness { cap, ..fineness })
            })
            .collect();
        stopped(progress)?;
        refine.run(&mut slices, MOST_SLICES as usize, MOST_VERTICES, progress)?;
        let vertices: usize = slices.iter().map(|s| 2 * s.nodes.len()).sum();
        if vertices > MOST_VERTICES {
            return Err(too_fine(vertices as f64, MOST_VERTICES as f64));
        }
        let mut builder = Builder::default();
        builder.mesh.vertices.reserve(vertices);
        builder.mesh.triangles.reserve(2 * vertices);
        let rails: Vec<Rail> = slices.iter().map(|slice| Rail::new(slice, &mut builder)).collect();
        let mut events = Vec::new();
        let mut walls = vec![0];
        for (slice, rail) in slices.windows(2).zip(rails.windows(2)) {
            wall::wall(&mut builder, (&slice[0], &rail[0]), (&slice[1], &rail[1]));
            events.extend(wall::kin(&slice[0], &slice[1]).into_iter().filter(|k| !k.is_plain()).map(|kin| {
                let (before, after) = (kin.before.len(), kin.after.len());
                EnvelopeEvent { between: [slice[0].t, slice[1].t], before, after }
            }));
            walls.push(builder.mesh.triangles.len());
        }
        let mut start = builder.mesh.triangles.len();
        if let (Some(first), Some(last)) =
            (slices.first().zip(rails.first()), slices.last().zip(rails.last()))
        {
            let ends = |p: &ChainPiece| p.point(p.from).x.max(p.point(p.to).x);
            let widest = self.pieces().iter().map(ends).fold(0.0, f64::max);
            for ((slice, rail), entering) in [(first, false), (last, true)] {
                Cap { chain: self, slice, rail, entering, chord: CAPS * tolerance, widest }.add(&mut builder);
                if !entering {
                    start = builder.mesh.triangles.len();
                }
            }
        }
        let pose_error =
            slices.windows(2).map(|s| motion.chord_error(s[0].t, s[1].t, reach)).fold(0.0, f64::max);
        let moments = slices.iter().map(|s| s.t).collect();
        Ok(Envelope { mesh: builder.mesh, moments, walls, start, events, pose_error })
    }
}

impl ProfileChain {
    /// Nodes of a curve along all pieces whose chords keep this distance [mm]: about, and rather too many.
    fn curve_nodes(&self, chord: f64) -> f64 {
        let of = |p: &ChainPiece| {
            let widest = p.point(p.from).length().max(p.point(p.to).length());
            TAU / step_along(widest.max(chord), chord)
        };
        self.pieces().iter().map(of).sum()
    }

    /// Vertices of both ends, whose chords keep this distance [mm].
    fn end_vertices(&self, chord: f64) -> f64 {
        let of = |p: &ChainPiece| {
            let widest = p.point(p.from).x.max(p.point(p.to).x).max(chord);
            let around = f64::from(steps_around(widest, chord));
            match p.shape {
                PieceShape::Arc { radius, .. } => around * (PI / step_along(radius, chord)),
                PieceShape::Line { .. } => around,
            }
        };
        2.0 * self.pieces().iter().map(of).sum::<f64>()
    }
}

/// An error when the caller wants the work to stop.
fn stopped(progress: &dyn Progress) -> Result<()> {
    match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "the work was cancelled").into()),
        false => Ok(()),
    }
}

fn too_fine(value: f64, bound: f64) -> crate::base::Error {
    Finding::error(Code::SWEEP_TOO_FINE, "the swept volume of a move would need too many facets")
        .value(value, "")
        .bound(bound, "")
        .help("take a larger tolerance, or divide the move")
        .into()
}
