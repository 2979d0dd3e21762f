//! Spirals: no control has them, so they are chains of tangent arcs and helices.

use glam::DVec3;

use crate::base::Result;
use crate::geom::{CurveKind, Rise, Spiral, helices_along};
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
}
