//! Cubics: on request what spirals and involutes are written as, and what was read as one.
//!
//! A block says the end, the first control point from the start (I, J) and the second from the end (P, Q). Each is
//! rounded from the exact curve against the *rounded* start and end, so that nothing adds up. The rounded curve leaves the
//! exact one by no more than its control points do: it is their weighted mean.
//!
//! The interpreter wants the word in every block, no Z, G17, and no cutter compensation.

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::geom::{CubicSpan, Curve, PlaneCurve, cubics_along};
use crate::nc::dialect::{OFFSETS, Plane};
use crate::program::Speed;

use super::{Writer, unsupported};

/// The word, and the addresses of the second control point.
const WORD: &str = "G5";
/// See [`WORD`].
const FROM_END: [&str; 2] = ["P", "Q"];
/// Least handle [steps]: below it rounding turns the tangent by more than a tenth, and a handle of no length has none.
const LEAST_HANDLE: f64 = 7.0;

impl Writer<'_> {
    /// Whether a curve to `point` is written as cubics: on request, at a height.
    pub(super) fn takes_cubics(&self, rise: Option<f64>, point: DVec3) -> Result<bool> {
        if !self.settings.cubic || self.modal.comp.is_some() {
            return Ok(false);
        }
        Ok(match rise {
            Some(rise) => rise == 0.0 || self.grid.round(point.z)? == self.written(2)?,
            None => false,
        })
    }

    /// A curve at a height as cubics that leave it by at most the tolerance of arcs.
    pub(super) fn cubics(&mut self, curve: &PlaneCurve, point: DVec3, speed: Speed) -> Result<()> {
        let tolerance = self.settings.arc_tolerance;
        let spans = cubics_along(curve, tolerance)?;
        self.notes.chains += 1;
        self.notes.chain_tolerance = self.notes.chain_tolerance.max(tolerance);
        let last = spans.len().saturating_sub(1);
        for (i, span) in spans.iter().enumerate() {
            let end = if i == last { point } else { span.end().extend(point.z) };
            self.bezier(span, end, speed)?;
        }
        Ok(())
    }

    /// A cubic that ends at `point`: as a cubic if the control takes it, otherwise as arcs.
    pub(super) fn bezier(&mut self, span: &CubicSpan, point: DVec3, speed: Speed) -> Result<()> {
        if self.grid.round(point.z)? != self.written(2)? {
            return Err(unsupported("a cubic stays at its height").help("use a spiral for a rise").into());
        }
        let start = self.written_xy()?;
        let end = [self.grid.round(point.x)?, self.grid.round(point.y)?];
        let stop = DVec2::new(self.grid.value(end[0]), self.grid.value(end[1]));
        let [_, first, second, _] = span.points();
        let count = |v: DVec2| -> Result<[i64; 2]> { Ok([self.grid.round(v.x)?, self.grid.round(v.y)?]) };
        let handles = [count(first - start)?, count(second - stop)?];
        let long = |h: &[i64; 2]| (h[0] as f64).hypot(h[1] as f64) >= LEAST_HANDLE;
        let takes = self.dialect.has_cubic() && self.modal.comp.is_none();
        if !takes || !handles.iter().all(long) {
            return self.cubic_as_arcs(span, point, speed);
        }
        let [first, second] = handles.map(|h| DVec2::new(self.grid.value(h[0]), self.grid.value(h[1])));
        let rounded = CubicSpan::new([start, start + first, stop + second, stop]);
        let speed = self.timed(speed, rounded.map_or_else(|_| span.length(), |rounded| rounded.length()));
        let mut axes = String::new();
        for (axis, value) in point.to_array().into_iter().enumerate() {
            self.axis(&mut axes, axis, value, axis != 2)?;
        }
        for (word, value) in OFFSETS.into_iter().chain(FROM_END).filter(|w| *w != "K").zip(handles.concat()) {
            self.grid.word(&mut axes, word, value);
        }
        self.modal.motion = Some(WORD);
        self.notes.cubics += 1;
        self.emit(Some(Plane::Xy), Some(WORD), &axes, speed)
    }

    fn cubic_as_arcs(&mut self, span: &CubicSpan, point: DVec3, speed: Speed) -> Result<()> {
        let z = point.z;
        let tolerance = self.settings.arc_tolerance;
        let Ok(pieces) = span.arcs(tolerance) else {
            // A cusp has no chain of tangent arcs.
            self.chords(&Curve::cubic(*span, z), tolerance, speed)?;
            return self.line(point.to_array(), speed);
        };
        let last = pieces.len().saturating_sub(1);
        for (i, piece) in pieces.iter().enumerate() {
            let end = if i == last { point } else { piece.end.extend(z) };
            if piece.is_line() {
                self.line(end.to_array(), speed)?;
            } else {
                let arc = crate::geom::Arc {
                    start: piece.start.extend(z),
                    centre: piece.centre.extend(z),
                    axis: DVec3::Z,
                    sweep: piece.sweep,
                    rise: 0.0,
                };
                self.arc(&arc, end, speed)?;
            }
        }
        Ok(())
    }
}
