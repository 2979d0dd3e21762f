//! Spirals: a control that lets the radius of an arc change along it runs one that is nearly an arc; all others are chains of tangent
//! arcs and helices.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::base::Result;
use crate::geom::{CurveKind, Rise, Spiral, helices_along};
use crate::nc::arc_spiral::as_arc;
use crate::nc::dialect::Plane;
use crate::program::Speed;

use super::Writer;

impl Writer<'_> {
    /// A spiral that ends at `point`.
    pub(super) fn spiral(&mut self, spiral: &Spiral, rise: &Rise, point: DVec3, speed: Speed) -> Result<()> {
        let tolerance = self.settings.arc_tolerance;
        let pieces = helices_along(spiral, self.place.exact[2], rise, tolerance)?;
        self.notes.chains += 1;
        self.notes.chain_tolerance = self.notes.chain_tolerance.max(tolerance);
        let last = pieces.len().saturating_sub(1);
        for (i, piece) in pieces.iter().enumerate() {
            let end = if i == last { point } else { piece.end() };
            match piece.kind() {
                CurveKind::Arc(arc) => self.arc(&arc, end, speed)?,
                _ => self.line(end.to_array(), speed)?,
            }
        }
        Ok(())
    }

    /// A spiral as one arc, where the control runs it so; `false` where not.
    pub(super) fn spiral_as_arc(
        &mut self,
        spiral: &Spiral,
        rise: &Rise,
        point: DVec3,
        speed: Speed,
    ) -> Result<bool> {
        let Some((centre, ccw)) = self.runs_as_arc(spiral, rise, point)? else { return Ok(false) };
        let word = if ccw { "G3" } else { "G2" };
        self.arc_block(Plane::Xy, word, point.to_array(), centre, 0, speed)?;
        Ok(true)
    }

    /// Offsets of the centre [steps] and sense of the arc block by which the control runs a spiral.
    fn runs_as_arc(&self, spiral: &Spiral, rise: &Rise, point: DVec3) -> Result<Option<([i64; 2], bool)>> {
        let Some((centre, sweep)) = as_arc(spiral).filter(|_| rise.is_even().is_some()) else {
            return Ok(None);
        };
        let fits = self.dialect.mismatch.keeps_centre() && sweep.abs() < TAU && point.is_finite();
        let [Some(x), Some(y), _] = self.place.written else { return Ok(None) };
        if !fits {
            return Ok(None);
        }
        let offset = [self.grid.round(centre.x)? - x, self.grid.round(centre.y)? - y];
        let start = self.grid.value(1) * (offset[0] as f64).hypot(offset[1] as f64);
        let end = (point.truncate() - centre).length();
        // Nearer to the bound than its rounding the control could refuse it.
        let bound =
            self.dialect.mismatch.bound(start, end, self.settings.units.is_inch()) - 4.0 * self.grid.unit();
        Ok(((start - end).abs() <= bound).then_some((offset, sweep > 0.0)))
    }
}
