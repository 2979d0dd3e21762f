//! Involutes: as the control's own where it can run them, otherwise as a chain of tangent arcs.
//!
//! The words of an involute block are rounded one by one; the base radius that fits the *rounded* points is found
//! first and rounded last, because its error is multiplied by the roll angle. What is left of it is measured as
//! the distance of the two involutes through start and end, and a block whose distance is too large for a
//! micrometre of accuracy is not written.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::geom::{InvoluteRecord, arc_chain};
use crate::nc::dialect::OFFSETS;
use crate::program::Speed;

use super::Writer;

/// Least roll angle of an end of a native involute [rad]: there a point lies 0.12 base radii outside the base
/// circle, far from where rounding could put it inside, which is an alarm.
const LEAST_ROLL: f64 = 0.5;
/// Largest distance between the involutes through start and end [mm], besides one step of the resolution.
const LARGEST_DIFFERENCE: f64 = 0.001;
/// Largest difference of turned angle between the block and the record [rad]: more is another number of turns.
const SAME_TURNS: f64 = 0.5;

/// A native block in numbers of the control.
struct Native {
    centre: [i64; 2],
    base_radius: i64,
    ccw: bool,
    difference: f64,
}

impl Writer<'_> {
    /// An involute that ends at `point`.
    pub(super) fn involute(
        &mut self,
        record: &InvoluteRecord,
        rise: f64,
        point: DVec3,
        speed: Speed,
    ) -> Result<()> {
        let start = DVec3::from_array(self.place.exact);
        let level = rise == 0.0 || self.grid.round(point.z)? == self.written(2)?;
        if let Some(native) = if level { self.native(record, point)? } else { None } {
            return self.involute_block(&native, point, speed);
        }
        let arcs = arc_chain(record, self.settings.arc_tolerance)?;
        let length: f64 = arcs.iter().map(piece_length).sum();
        self.notes.chains += u32::from(arcs.len() > 1);
        if arcs.len() > 1 {
            self.notes.chain_tolerance = self.notes.chain_tolerance.max(self.settings.arc_tolerance);
        }
        let last = arcs.len().saturating_sub(1);
        let mut done = 0.0;
        for (i, piece) in arcs.iter().enumerate() {
            let from = self.place.exact[2];
            done += piece_length(piece);
            let end = if i == last { point } else { piece.end.extend(start.z + rise * done / length) };
            if piece.is_line() {
                self.line(end.to_array(), speed)?;
            } else {
                let arc = crate::geom::Arc {
                    start: piece.start.extend(from),
                    centre: piece.centre.extend(from),
                    axis: DVec3::Z,
                    sweep: piece.sweep,
                    rise: end.z - from,
                };
                self.arc(&arc, end, speed)?;
            }
        }
        if arcs.is_empty() { self.line(point.to_array(), speed) } else { Ok(()) }
    }

    /// The block for a record, if the control can run it within the tolerance.
    fn native(&self, record: &InvoluteRecord, point: DVec3) -> Result<Option<Native>> {
        // FANUC refuses it under compensation.
        let compensated = self.modal.comp.is_some();
        if !self.settings.involute_native || self.dialect.involute.is_none() || compensated {
            return Ok(None);
        }
        let Some(block) = record.block() else { return Ok(None) };
        let start = self.written_xy()?;
        let grid = self.grid;
        let end = [grid.value(grid.round(point.x)?), grid.value(grid.round(point.y)?)];
        let offset = record.base_centre() - start;
        let centre = [grid.round(offset.x)?, grid.round(offset.y)?];
        let base = (start + DVec2::new(grid.value(centre[0]), grid.value(centre[1]))).to_array();
        let through = |r: f64| InvoluteRecord::through(start.to_array(), end, base, r, block.ccw);
        let Ok((fitted, _)) = through(block.base_radius) else { return Ok(None) };
        let base_radius = grid.round(fitted.base_radius().abs())?;
        let Ok((written, difference)) = through(grid.value(base_radius)) else { return Ok(None) };
        let turn = |r: &InvoluteRecord| r.turn(r.length()).abs();
        let least_roll = written.block().map_or(0.0, |b| b.least_roll);
        let most_turns = (least_roll + turn(&written)) / TAU;
        let fits = least_roll >= LEAST_ROLL
            && most_turns <= self.dialect.involute_turns
            && centre != [0, 0]
            && difference <= LARGEST_DIFFERENCE + grid.unit()
            && (turn(&written) - turn(record)).abs() < SAME_TURNS;
        Ok(fits.then_some(Native { centre, base_radius, ccw: block.ccw, difference }))
    }

    fn involute_block(&mut self, native: &Native, point: DVec3, speed: Speed) -> Result<()> {
        let Some([cw, ccw, radius]) = self.dialect.involute else { return Ok(()) };
        let mut axes = String::new();
        for (axis, value) in point.to_array().into_iter().enumerate() {
            self.axis(&mut axes, axis, value, axis != 2)?;
        }
        for (word, count) in OFFSETS.into_iter().zip(native.centre) {
            self.grid.word(&mut axes, word, count);
        }
        self.grid.word(&mut axes, radius, native.base_radius);
        let word = if native.ccw { ccw } else { cw };
        self.modal.motion = Some(word);
        self.notes.involutes += 1;
        self.notes.involute_difference = self.notes.involute_difference.max(native.difference);
        self.emit(Some(crate::nc::dialect::Plane::Xy), Some(word), &axes, speed)
    }
}

fn piece_length(piece: &crate::geom::PlanarArc) -> f64 {
    if piece.is_line() { piece.start.distance(piece.end) } else { piece.radius() * piece.sweep.abs() }
}
