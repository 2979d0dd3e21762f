//! Moves made ready for cutting: checked, with their tools.

use std::ops::Range;
use std::sync::Arc;

use super::run::check;
use super::task::Tool;
use super::{CutMove, CutOptions, ToolBody};
use crate::base::Result;
use crate::stock::CutId;

/// Moves and the tools that make them, for stocks with one step. A stock keeps those that have not cut all of its lines yet.
#[derive(Debug)]
pub struct CutList {
    pub(super) moves: Vec<CutMove>,
    pub(super) tools: Vec<Tool>,
    pub(super) options: CutOptions,
    /// Distance of the lines that the tools are ready for [mm].
    pub(super) step: f64,
}

impl CutList {
    /// Moves of tools in the order in which they are made; `step`: distance of the lines of the stock that they will cut [mm].
    ///
    /// # Errors
    /// `KC0801` for a move whose path is not finite or too far out, or that names no tool, and for options out of range.
    pub fn new(
        bodies: &[ToolBody],
        moves: Vec<CutMove>,
        options: &CutOptions,
        step: f64,
    ) -> Result<Arc<CutList>> {
        check(bodies, &moves, options)?;
        let tools = bodies.iter().map(|b| Tool::new(b, options, step)).collect();
        Ok(Arc::new(CutList { moves, tools, options: *options, step }))
    }

    /// The moves.
    pub fn moves(&self) -> &[CutMove] {
        &self.moves
    }

    /// The number that the cut of a move carries.
    pub(super) fn cut(&self, index: usize) -> CutId {
        self.options.first_cut.wrapping_add(index as u32).wrapping_add(1)
    }

    /// The stretches of a range of moves that are made along one axis, or lean.
    pub(super) fn stretches(&self, range: Range<usize>) -> impl Iterator<Item = Range<usize>> + '_ {
        let mut end = range.start;
        let alike = self.moves[range].chunk_by(|a, b| a.stance.axis() == b.stance.axis());
        alike.map(move |stretch| {
            let start = end;
            end += stretch.len();
            start..end
        })
    }
}
