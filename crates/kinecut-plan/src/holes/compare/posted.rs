//! Number of blocks that a control gets for a path.

use super::Terms;
use super::chain::Chain;
use super::program::program;
use crate::base::Result;
use crate::geom::InvoluteRecord;
use crate::holes::clearing::{Clearing, Disc};
use crate::nc;
use crate::program::Blend;

/// A path as text.
pub(super) struct PostedPath {
    /// Blocks of the path itself.
    pub(super) blocks: usize,
    /// Number of those that are the control's own involutes.
    pub(super) involutes: u32,
    /// Size of these blocks in characters.
    pub(super) characters: usize,
}

/// Posts the path of a strategy with the circles at entry and wall.
pub(super) fn posted(clearing: Clearing, terms: &Terms) -> Result<PostedPath> {
    let settings = terms.settings();
    let native = terms.control.has_involute();
    // A base radius that the control can print keeps the involute where it is; it may move the entry circle by a step.
    let resolution = native.then(|| terms.control.resolution(terms.decimals));
    let most = if terms.entry > 0.0 { terms.entry + 0.5 * terms.step } else { 0.0 };
    let most = if most < terms.wall { most } else { terms.entry };
    let path = clearing.path(&Disc { resolution, inner_most: most, ..terms.disc() })?;
    let mut curves = Vec::new();
    if path.inner > 0.0 {
        curves.push(InvoluteRecord::circle(path.inner, 0.0)?.into());
    }
    curves.extend(path.curves);
    curves.push(path.closing.into());
    let (program, first) = program(&Chain::new(curves).in_space(), terms.limits.feed, Blend::Stop);
    let posted = nc::write(&program, &[], &settings)?;
    let lines = posted.text.lines().zip(&posted.lines).filter(|(_, item)| item.is_some_and(|i| i >= first));
    let (blocks, characters) = lines.fold((0, 0), |(n, c), (line, _)| (n + 1, c + line.len() + 1));
    Ok(PostedPath { blocks, involutes: posted.notes.involutes, characters })
}
