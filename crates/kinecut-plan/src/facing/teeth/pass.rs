//! One straight pass of a cutter with real teeth.

use std::f64::consts::TAU;

use glam::DVec2;
use serde::Serialize;

use super::pieces::{CrossedPiece, Form, PlacedEdge, Trochoid};
use super::{ToothCrossing, arc, line};
use crate::base::unit::computed_degrees;
use crate::base::{Code, Finding, Result};
use crate::facing::{FaceCase, Placement};
use crate::geom::Outline;

/// A tooth of the cutter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tooth {
    /// Its angle on the cutter, in the sense of rotation [rad], in JSON degrees: the greater, the earlier it is where the
    /// first one goes.
    #[serde(serialize_with = "computed_degrees")]
    pub phase: f64,
    /// Its radius at the finished plane, run-out included [mm].
    pub radius: f64,
}

/// A straight pass of real teeth over a part that lies at a placement.
///
/// *Frame of the pass*: that of the turned part, shifted by `along` in the direction of feed. At the time `t`, in
/// radians of the spindle's turn, the cutter centre is at (feed t, offset), and a tooth at
/// (feed t - radius sin(t + phase), offset - radius cos(t + phase)).
#[derive(Clone, Debug, PartialEq)]
pub struct ToothedPass {
    /// The teeth; pitch and radius may be uneven.
    pub teeth: Vec<Tooth>,
    /// Feed in a radian of the spindle's turn [mm].
    pub feed_per_radian: f64,
    /// Placement of the part.
    pub placement: Placement,
    /// Shift of the part along the feed [mm]: it only moves where between two teeth the outline lies.
    pub along: f64,
}

impl ToothedPass {
    /// Least feed per radian, per radius: below it, revolutions are no longer told apart.
    pub const LEAST_FEED: f64 = 1e-7;
    /// Largest feed per radian, per radius: beyond it nothing is left of the cutter's circle.
    pub const LARGEST_FEED: f64 = 0.5;

    /// A pass of `teeth` teeth of even pitch and without run-out, the part's origin at x = 0.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::facing::{Placement, ToothedPass};
    /// let pass = ToothedPass::even(6, 50.0, 0.15, Placement { angle: 0.0, offset: 0.0 })?;
    /// assert!((pass.feed_per_radian - 0.9 / std::f64::consts::TAU).abs() < 1e-15);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`ToothedPass::checked`].
    pub fn even(teeth: u32, radius: f64, feed_per_tooth: f64, placement: Placement) -> Result<ToothedPass> {
        let z = f64::from(teeth);
        let feed_per_radian = feed_per_tooth * z / TAU;
        crate::tool::TEETH.check(z).map_err(|e| e.under("teeth"))?;
        let teeth = (0..teeth).map(|k| Tooth { phase: TAU * f64::from(k) / z, radius }).collect();
        ToothedPass { teeth, feed_per_radian, placement, along: 0.0 }.checked()
    }

    /// The pass, if it makes sense.
    ///
    /// # Errors
    /// `KC1001` when there is no tooth, a number is not finite, a radius is not positive, or the feed per radian is
    /// not between [`LEAST_FEED`](ToothedPass::LEAST_FEED) and [`LARGEST_FEED`](ToothedPass::LARGEST_FEED) of each
    /// tooth's radius.
    pub fn checked(self) -> Result<ToothedPass> {
        self.check()?;
        Ok(self)
    }

    fn check(&self) -> Result<()> {
        let refuse = |what: &str, value: f64, bound: f64| {
            Err(Finding::error(Code::FACE_CASE, what).value_mm(value).bound_mm(bound).into())
        };
        let placed = [self.placement.angle, self.placement.offset, self.along];
        if let Some(&odd) = placed.iter().find(|v| !v.is_finite()) {
            return refuse("the placement under the cutter must be finite", odd, 0.0);
        }
        if self.teeth.is_empty() {
            return Err(Finding::error(Code::FACE_CASE, "a cutter has at least one tooth")
                .value(0.0, "teeth")
                .bound(1.0, "teeth")
                .into());
        }
        for tooth in &self.teeth {
            if !(tooth.radius > 0.0 && tooth.radius.is_finite() && tooth.phase.is_finite()) {
                return refuse("the radius of a tooth must be positive", tooth.radius, 0.0);
            }
            let (least, most) =
                (ToothedPass::LEAST_FEED * tooth.radius, ToothedPass::LARGEST_FEED * tooth.radius);
            if !(self.feed_per_radian >= least) {
                return refuse("the feed per radian is too small", self.feed_per_radian, least);
            }
            if !(self.feed_per_radian <= most) {
                return refuse("the feed per radian is too large for the cutter", self.feed_per_radian, most);
            }
        }
        Ok(())
    }

    /// Feed in a radian of the spindle's turn per radius of the cutter of `case`.
    pub fn rho(&self, case: &FaceCase) -> f64 {
        self.feed_per_radian / case.radius
    }

    /// Mean feed per tooth [mm].
    pub fn feed_per_tooth(&self) -> f64 {
        self.feed_per_radian * TAU / self.teeth.len() as f64
    }
}

impl ToothedPass {
    /// Most crossings that [`ToothedPass::crossings`] keeps.
    pub const MOST_CROSSINGS: u64 = 50_000_000;

    /// Calls `found` with every crossing of every tooth with every edge of the outline: edge after edge, tooth after
    /// tooth, revolution after revolution of each piece of the edge. Nothing is allocated for straight edges.
    ///
    /// A crossing at a vertex belongs to the edge that starts there. A tooth that only grazes an edge does not cross. A
    /// pass that makes no sense, see [`ToothedPass::checked`], crosses nothing.
    pub fn visit(&self, outline: &Outline, mut found: impl FnMut(ToothCrossing)) {
        if self.check().is_err() {
            return;
        }
        let mut pieces = Vec::new();
        for edge in 0..outline.edges().len() {
            let next = next_edge(outline, edge);
            self.visit_edge(outline, [edge, next], [true, true], &mut pieces, &mut found);
        }
    }

    /// Number of crossings; none of them is computed.
    pub fn count(&self, outline: &Outline) -> u64 {
        if self.check().is_err() {
            return 0;
        }
        let mut count = 0.0;
        let mut pieces = Vec::new();
        for edge in 0..outline.edges().len() {
            let placed = self.placed(outline, edge, next_edge(outline, edge));
            let mut of_radius = f64::NAN;
            for tooth in &self.teeth {
                if tooth.radius != of_radius {
                    of_radius = tooth.radius;
                    pieces.clear();
                    self.trochoid(tooth).pieces(&placed, &mut pieces);
                }
                for piece in &pieces {
                    let [first, last] = piece.revolutions(tooth.phase / TAU);
                    count += if first <= last { last - first + 1.0 } else { 0.0 };
                }
            }
        }
        count as u64
    }

    /// Every crossing, sorted by tooth and time.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use glam::dvec2;
    /// use kinecut::facing::{Placement, ToothedPass};
    /// use kinecut::geom::Outline;
    /// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
    /// let pass = ToothedPass::even(1, 50.0, 10.0, Placement { angle: 0.0, offset: 30.0 })?;
    /// let crossings = pass.crossings(&plate)?;
    /// assert_eq!(crossings.len(), 48);
    /// // Each tooth enters, leaves, enters.
    /// assert!(crossings.windows(2).all(|w| w[0].exit != w[1].exit));
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`ToothedPass::checked`]; `KC1001` for more than [`MOST_CROSSINGS`](ToothedPass::MOST_CROSSINGS).
    pub fn crossings(&self, outline: &Outline) -> Result<Vec<ToothCrossing>> {
        let count = self.few(outline)?;
        let mut all = Vec::with_capacity(count as usize);
        self.visit(outline, |c| all.push(c));
        all.sort_by(|a, b| (a.tooth.cmp(&b.tooth)).then(a.time.total_cmp(&b.time)).then(a.edge.cmp(&b.edge)));
        Ok(all)
    }

    /// Number of crossings, if they are not too many.
    pub(super) fn few(&self, outline: &Outline) -> Result<u64> {
        self.check()?;
        let count = self.count(outline);
        if count > ToothedPass::MOST_CROSSINGS {
            return Err(Finding::error(
                Code::FACE_CASE,
                "there are too many crossings of teeth with the outline",
            )
            .value(count as f64, "crossings")
            .bound(ToothedPass::MOST_CROSSINGS as f64, "crossings")
            .help("take a greater feed per tooth, or the limit of many teeth")
            .into());
        }
        Ok(count)
    }

    /// The crossings of the first of two edges that follow one another, in the front half or not, in the back half or
    /// not.
    pub(super) fn visit_edge(
        &self,
        outline: &Outline,
        [edge, next]: [usize; 2],
        [front, back]: [bool; 2],
        pieces: &mut Vec<CrossedPiece>,
        found: &mut impl FnMut(ToothCrossing),
    ) {
        let placed = self.placed(outline, edge, next);
        let straight = matches!(placed.form, Form::Line);
        let offset = self.placement.offset;
        let mut of_radius = f64::NAN;
        for (index, tooth) in self.teeth.iter().enumerate() {
            let trochoid = self.trochoid(tooth);
            if tooth.radius != of_radius {
                of_radius = tooth.radius;
                pieces.clear();
                trochoid.pieces(&placed, pieces);
            }
            for piece in pieces.iter().filter(|p| if p.front { front } else { back }) {
                let mut place = |c: ToothCrossing| {
                    let point = DVec2::new(c.point.x, c.point.y + offset);
                    found(ToothCrossing { tooth: index as u32, edge: edge as u32, point, ..c });
                };
                if straight {
                    line::crossings(trochoid, tooth.phase, &placed, piece, &mut place);
                } else {
                    arc::crossings(trochoid, tooth.phase, &placed, piece, &mut place);
                }
            }
        }
    }

    fn trochoid(&self, tooth: &Tooth) -> Trochoid {
        Trochoid { radius: tooth.radius, feed: self.feed_per_radian }
    }

    fn placed(&self, outline: &Outline, edge: usize, next: usize) -> PlacedEdge {
        let (sin, cos) = self.placement.angle.sin_cos();
        let place = |p: DVec2| {
            DVec2::new(cos * p.x - sin * p.y + self.along, sin * p.x + cos * p.y - self.placement.offset)
        };
        let one = &outline.edges()[edge];
        PlacedEdge {
            start: place(one.start),
            end: place(outline.edges()[next].start),
            form: match one.turn {
                None => Form::Line,
                Some(t) => Form::Arc {
                    centre: place(t.centre),
                    radius: t.radius,
                    from: t.from + self.placement.angle,
                    sweep: t.sweep,
                },
            },
        }
    }
}

/// The edge that starts where this one ends.
pub(super) fn next_edge(outline: &Outline, edge: usize) -> usize {
    let own = outline.loops().iter().find(|l| l.edges.contains(&edge));
    own.map_or(edge, |l| if edge + 1 < l.edges.end { edge + 1 } else { l.edges.start })
}
