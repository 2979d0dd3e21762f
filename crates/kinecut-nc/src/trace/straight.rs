//! Straight moves of a tool that stands, which nearly all moves of a long program are, and what neighbours of them share.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::follow::Follow;
use super::segment::StartAxes;
use crate::base::Result;
use crate::geom::{Curve, Line};
use crate::program::State;

impl Follow<'_> {
    /// A straight move of the tip, the tool along the Z of the frame, without compensation: what [`Follow::motion`] does of it.
    pub(super) fn straight(&mut self, index: usize, point: DVec3, state: &State) -> Result<()> {
        if index < self.compensated_to {
            return Ok(());
        }
        let frame = self.frame_of_moves(index, state)?;
        let end = self.resolve(&frame, point);
        let known = end.iter().all(Option::is_some);
        let path = self.start_in(&frame).filter(|_| known).map(|start| {
            let end = frame.point(filled(point, start));
            Curve::from(Line { start: frame.point(start), end })
        });
        self.run(index, path, end, state)
    }

    /// Axes at the start of a segment: those of the segment before where they are the same.
    pub(super) fn start_axes(&self, index: usize, state: &State) -> Result<Arc<StartAxes>> {
        let last = self.trace.segments.last();
        let tool = self.tool.map(|t| t.number);
        if let Some(last) = last.filter(|s| s.setup == state.setup && s.tool == tool)
            && self.chain.is_none()
            && last.start_axes.rotary == self.rotary
        {
            return Ok(Arc::clone(&last.start_axes));
        }
        let (matrix, shift) = match &self.chain {
            Some(chain) => chain.to_linear(self.rotary).ok_or_else(|| self.not_independent(index))?,
            None => {
                let length = self.tool.and_then(|t| t.gauge_length).unwrap_or(0.0);
                (DMat3::IDENTITY, DVec3::Z * length)
            }
        };
        let placed = self.setup_of(state).part_on_table;
        let to_linear = (matrix * placed.rotation, matrix * placed.translation + shift);
        let axes = StartAxes { rotary: self.rotary, to_linear };
        Ok(match last {
            Some(last) if *last.start_axes == axes => Arc::clone(&last.start_axes),
            _ => Arc::new(axes),
        })
    }
}

/// The end of a move from its start: a coordinate that it does not name stays.
pub(super) fn filled(end: DVec3, start: DVec3) -> DVec3 {
    let fill = |to: f64, from: f64| if to.is_nan() { from } else { to };
    DVec3::new(fill(end.x, start.x), fill(end.y, start.y), fill(end.z, start.z))
}
