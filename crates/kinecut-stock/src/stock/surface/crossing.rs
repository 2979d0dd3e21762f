//! Crossings of the surface with lattice edges.
//!
//! Indices here are **padded**: the lattice with one more layer of points on every side, which is never material.
//! Lengths are **cells**: the padded lattice point (i, j, k) is at (i, j, k).
//!
//! The signs of the two points of an edge say whether it is crossed; the line's end points say where. Rules:
//! - the end that belongs to the interval that holds the edge's material point (slivers thinner than a step, with
//!   no point in them, are passed over);
//! - if the line itself sees no end of that kind (it was outvoted by the two other directions), the nearest end of the
//!   same kind up to [`REACH`] beyond the edge, moved into the edge;
//! - else the middle of the edge, facing along it.

use glam::DVec3;

use crate::stock::{Axis, CutId, DexelGrid, FIXED_STEP, Interval, Lattice, PackedNormal, fixed};

/// Largest distance of an end point beyond its edge at which it still replaces a missing one [cells]. Three lines
/// disagree about a point only by rounding when the body is sound, so that anything small does; a quarter serves noise
/// too.
const REACH: f64 = 0.25;

/// The surface crosses a lattice edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// Coordinate along the edge's axis [cells], within the edge.
    pub(super) at: f64,
    /// Outward normal.
    pub(super) normal: PackedNormal,
    /// The move that cut it.
    pub(super) cut: CutId,
}

/// The lines of a body by padded indices.
pub(super) struct Lines<'a, G: ?Sized> {
    grid: &'a G,
    lattice: Lattice,
    /// Number of padded points along X, Y, Z.
    pub(super) counts: [u32; 3],
    /// Fixed-point coordinates of the padded points.
    coordinates: [Vec<i32>; 3],
    /// Cells = fixed-point coordinate * scale + shift of the axis.
    scale: f64,
    shift: [f64; 3],
}

impl<'a, G: DexelGrid + ?Sized> Lines<'a, G> {
    /// The lines of a grid.
    pub(super) fn new(grid: &'a G) -> Lines<'a, G> {
        let lattice = *grid.lattice();
        let counts = lattice.counts.map(|n| n.saturating_add(2));
        let coordinates = Axis::ALL.map(|axis| {
            let first = lattice.origin[axis.index()];
            (0..counts[axis.index()]).map(|i| fixed(first + (f64::from(i) - 1.0) * lattice.step)).collect()
        });
        let scale = FIXED_STEP / lattice.step;
        let shift = (1.0 - lattice.origin / lattice.step).to_array();
        Lines { grid, lattice, counts, coordinates, scale, shift }
    }

    /// The intervals of the line through the padded indices `a`, `b` along `axis.others()`; none in the padding.
    pub(super) fn line(&self, axis: Axis, a: u32, b: u32) -> &'a [Interval] {
        let (u, v) = axis.others();
        let (nu, nv) = (self.counts[u.index()], self.counts[v.index()]);
        if a == 0 || b == 0 || a + 1 >= nu || b + 1 >= nv { &[] } else { self.grid.line(axis, a - 1, b - 1) }
    }

    /// The first padded index of an axis, but not the two of the padding, whose point is not below a coordinate.
    pub(super) fn first_at_or_above(&self, axis: Axis, at: i32) -> u32 {
        let table = &self.coordinates[axis.index()];
        let last = table.len() as u32 - 1;
        // Rounded down or up does not matter: the table decides.
        let mut i = (self.cells(axis, at).clamp(1.0, f64::from(last))) as u32;
        while i < last && table[i as usize] < at {
            i += 1;
        }
        while i > 1 && table[i as usize - 1] >= at {
            i -= 1;
        }
        i
    }

    /// Fixed-point coordinate as cells along an axis.
    fn cells(&self, axis: Axis, at: i32) -> f64 {
        f64::from(at) * self.scale + self.shift[axis.index()]
    }

    /// A point in cells in mm.
    pub(super) fn to_mm(&self, p: DVec3) -> DVec3 {
        self.lattice.origin + (p - 1.0) * self.lattice.step
    }

    /// The crossing of the surface with the edge from the padded point `p` one step along `axis`, out of the material
    /// (`leaving`) or into it.
    pub(super) fn crossing(&self, axis: Axis, p: [u32; 3], leaving: bool) -> Crossing {
        let (u, v) = axis.others();
        let line = self.line(axis, p[u.index()], p[v.index()]);
        let k = p[axis.index()];
        let table = &self.coordinates[axis.index()];
        let (below, above) = (table[k as usize], table[k as usize + 1]);
        let inside = if leaving { below } else { above };
        let holder = line.iter().find(|i| i.hi.at > inside).filter(|i| i.lo.at <= inside);
        let end =
            holder.map(|i| if leaving { i.hi } else { i.lo }).filter(|e| below <= e.at && e.at <= above);
        let clamped = |at: i32| self.cells(axis, at).clamp(f64::from(k), f64::from(k) + 1.0);
        if let Some(end) = end {
            return Crossing { at: clamped(end.at), normal: end.normal, cut: end.cut };
        }
        let middle = f64::from(k) + 0.5;
        let off = |at: i32| (self.cells(axis, at) - middle).abs();
        let ends = line.iter().map(|i| if leaving { i.hi } else { i.lo });
        match ends.min_by(|a, b| off(a.at).total_cmp(&off(b.at))) {
            Some(end) if off(end.at) <= 0.5 + REACH => {
                Crossing { at: clamped(end.at), normal: end.normal, cut: end.cut }
            }
            _ => {
                let mut normal = DVec3::ZERO;
                normal[axis.index()] = if leaving { 1.0 } else { -1.0 };
                Crossing { at: middle, normal: PackedNormal::new(normal, 0), cut: 0 }
            }
        }
    }
}
