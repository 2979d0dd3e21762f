//! The claims of all patches, and those of some rows of them.

use std::ops::Range;

use super::claims::Claim;
use super::field::OWN;

/// Claims by patch and direction of the lines.
pub(super) struct Gathered {
    pub(super) of_patches: Vec<[Vec<Claim>; 2]>,
    /// Number of patches along the first direction.
    pub(super) across: usize,
}

impl Gathered {
    /// The rows of lines along a direction that patches with claims have.
    pub(super) fn rows(&self, k: usize) -> Range<usize> {
        let own = OWN as usize;
        let some = self.of_patches.iter().enumerate().filter(|(_, claims)| !claims[k].is_empty());
        let band = |(patch, _)| if k == 0 { patch / self.across } else { patch % self.across };
        let ends = some.map(band).fold(None, |all: Option<(usize, usize)>, band| {
            Some(all.map_or((band, band), |(first, last)| (first.min(band), last.max(band))))
        });
        ends.map_or(0..0, |(first, last)| first * own..(last + 1) * own)
    }

    /// The claims on some rows of lines along a direction: one task after the other, and of each by row and layer.
    pub(super) fn on_rows(&self, k: usize, rows: &Range<usize>) -> Vec<Claim> {
        let (own, across) = (OWN as usize, self.across);
        let counts = [across, self.of_patches.len().checked_div(across).unwrap_or(0)];
        let bands = rows.start / own..rows.end.div_ceil(own).min(counts[1 - k]);
        let patch = |band: usize, q: usize| if k == 0 { band * across + q } else { q * across + band };
        let patches = bands.flat_map(|band| (0..counts[k]).map(move |q| patch(band, q)));
        let inside = |claim: &&Claim| rows.contains(&(claim.row as usize));
        let mut claims: Vec<Claim> =
            patches.flat_map(|p| self.of_patches[p][k].iter().filter(inside).copied()).collect();
        claims.sort_unstable();
        claims
    }
}
