//! Engagement of a drill's point on its way along its axis, measured in the stock.
//!
//! For proofs of where feed zones begin and end. The lines of the stock along the tool axis that pass through the
//! annulus of the edge represent columns of one grid cell each. If a column at the radius r has material from lo to hi,
//! its piece of edge is engaged while the tool's reference point is between lo - z(r) and hi - z(r). All these ends are
//! sorted once; the share engaged at a height is then a difference of two counts.
//!
//! Heights of the reference point, the lowest cutting point of the edge, are counted along the tool axis
//! ([`PointEngagement::height`]): they fall as the tool advances, whatever the axis.
//!
//! **Error.** See [`PointEngagement::sampling_error`].

use glam::{DVec2, DVec3};

use super::cut::CutAxis;
use super::tri_dexel::LINE_OFFSET;
use super::{Axis, DexelGrid, Interval, unfixed};
use crate::geom::EdgeProfile;

/// The part of a point that is in material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engaged {
    /// Nothing.
    Not,
    /// Some columns.
    Partly,
    /// All columns.
    Fully,
}

/// A stretch of a drill's way with one kind of engagement; heights of the reference point [mm], see
/// [`PointEngagement::height`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointStage {
    /// Height at its beginning: the greater one.
    pub from: f64,
    /// Height at its end.
    pub to: f64,
    /// The engaged part.
    pub engaged: Engaged,
}

/// The engagement of a drill's point over its height, measured in a stock.
#[derive(Clone, Debug, PartialEq)]
pub struct PointEngagement {
    axis: CutAxis,
    columns: usize,
    column_area: f64,
    /// Heights of the reference point at which a column comes into engagement and leaves it again, each falling:
    /// greatest first.
    starts: Vec<f64>,
    ends: Vec<f64>,
}

/// Measures how a point is engaged in the stock as it is, on a tool axis through `at` (part coordinates [mm]).
///
/// Columns of the annulus over which the stock has no line count as air. An edge narrower than the grid may have no
/// column at all: then nothing is ever engaged.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::geom::{Aabb, EdgeProfile};
/// use kinecut::stock::{Engaged, TriDexel, cut::CutAxis, point_engagement};
/// let plate = Aabb { min: [-8.0, -8.0, -10.0].into(), max: [8.0, 8.0, 0.0].into() };
/// let stock = TriDexel::from_box(plate, 0.2).unwrap();
/// let edge = EdgeProfile::polyline(&[[0.0, 0.0], [5.0, 3.0]]).unwrap();
/// let engagement = point_engagement(&stock, &edge, [0.0, 0.0, 5.0].into(), CutAxis::PlusZ);
/// // A cone whose tip is 1.5 below the face is engaged up to half its radius.
/// assert!((engagement.share(-1.5) - 0.25).abs() < 0.02);
/// let kinds: Vec<Engaged> = engagement.stages().iter().map(|s| s.engaged).collect();
/// assert_eq!(kinds, [Engaged::Partly, Engaged::Fully, Engaged::Partly]);
/// ```
pub fn point_engagement<G: DexelGrid + ?Sized>(
    stock: &G,
    edge: &EdgeProfile,
    at: DVec3,
    axis: CutAxis,
) -> PointEngagement {
    let step = stock.lattice().step;
    let mut found =
        PointEngagement { axis, columns: 0, column_area: step * step, starts: Vec::new(), ends: Vec::new() };
    let mut merged: Vec<(f64, f64)> = Vec::new();
    for_columns(stock, edge, at, axis.along(), |[low, high], line| {
        found.columns += 1;
        merged.clear();
        for interval in line {
            let [from, to] = ends(interval, axis);
            let (start, end) = (to - low, from - high);
            match merged.last_mut() {
                // Only at a step of the edge, which is at two heights at once.
                Some(last) if axis.sign() > 0.0 && end <= last.0 => last.0 = start,
                Some(last) if axis.sign() < 0.0 && start >= last.1 => last.1 = end,
                _ => merged.push((start, end)),
            }
        }
        found.starts.extend(merged.iter().map(|m| m.0));
        found.ends.extend(merged.iter().map(|m| m.1));
    });
    for list in [&mut found.starts, &mut found.ends] {
        list.sort_unstable_by(|a, b| b.total_cmp(a));
    }
    found
}

/// Calls for each column of the annulus with the lowest and highest edge there and its line.
fn for_columns<G: DexelGrid + ?Sized>(
    stock: &G,
    edge: &EdgeProfile,
    at: DVec3,
    along: Axis,
    mut each: impl FnMut([f64; 2], &[Interval]),
) {
    let lattice = stock.lattice();
    let (a, b) = along.others();
    let centre = DVec2::new(at[a.index()], at[b.index()]);
    let origin = DVec2::new(lattice.origin[a.index()], lattice.origin[b.index()]) + LINE_OFFSET;
    let counts = [lattice.counts[a.index()], lattice.counts[b.index()]];
    let outer = edge.outer_radius();
    // Also beyond the lattice.
    let first = ((centre - outer - origin) / lattice.step).ceil();
    let last = ((centre + outer - origin) / lattice.step).floor();
    if !(first.is_finite() && last.is_finite()) {
        return;
    }
    let index = |i: f64, count: u32| (i >= 0.0 && i < f64::from(count)).then_some(i as u32);
    let steps =
        |from: f64, to: f64| (0..).map(move |k: u32| from + f64::from(k)).take_while(move |i| *i <= to);
    for j in steps(first.y, last.y) {
        for i in steps(first.x, last.x) {
            let column = origin + DVec2::new(i, j) * lattice.step;
            let Some(heights) = heights(edge, column.distance(centre)) else { continue };
            match (index(i, counts[0]), index(j, counts[1])) {
                (Some(i), Some(j)) => each(heights, stock.line(along, i, j)),
                _ => each(heights, &[]),
            }
        }
    }
}

/// Lowest and highest edge at a radius, which differ at a step; `None` where nothing cuts.
fn heights(edge: &EdgeProfile, r: f64) -> Option<[f64; 2]> {
    let mut range: Option<[f64; 2]> = None;
    for s in edge.segments().iter().filter(|s| r >= s.range()[0] && r <= s.range()[1]) {
        let z = s.height(r);
        range =
            Some(range.map_or([z, z], |[low, high]| {
                [if z < low { z } else { low }, if z > high { z } else { high }]
            }));
    }
    range
}

/// The first of falling heights strictly between two.
fn next(falling: &[f64], from: f64, to: f64) -> Option<f64> {
    let at = falling.partition_point(|z| *z >= from);
    falling.get(at).copied().filter(|z| *z > to)
}

/// Lower and upper end of an interval, heights along the tool axis.
fn ends(interval: &Interval, axis: CutAxis) -> [f64; 2] {
    let [lo, hi] = [unfixed(interval.lo.at), unfixed(interval.hi.at)];
    if axis.sign() > 0.0 { [lo, hi] } else { [-hi, -lo] }
}

impl PointEngagement {
    /// Number of columns of the annulus, those in air too.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Area of a column [mm^2].
    pub fn column_area(&self) -> f64 {
        self.column_area
    }

    /// Height along the tool axis of a point in part coordinates [mm]: minus X for a tool along -X.
    pub fn height(&self, point: DVec3) -> f64 {
        self.axis.vector().dot(point)
    }

    /// Number of columns engaged while the reference point is at a height.
    pub fn engaged(&self, height: f64) -> usize {
        let started = self.starts.partition_point(|start| *start >= height);
        let ended = self.ends.partition_point(|end| *end > height);
        started - ended
    }

    /// Share of the annulus engaged while the reference point is at a height: 0 to 1.
    pub fn share(&self, height: f64) -> f64 {
        if self.columns == 0 { 0.0 } else { self.engaged(height) as f64 / self.columns as f64 }
    }

    /// Greatest height of the reference point at which anything is engaged; `None` when the point meets nothing.
    pub fn first(&self) -> Option<f64> {
        self.starts.first().copied()
    }

    /// Least height at which anything is engaged.
    pub fn last(&self) -> Option<f64> {
        self.ends.last().copied()
    }

    /// The greatest height below `from` and above `to` at which a column comes into engagement.
    pub fn first_start(&self, from: f64, to: f64) -> Option<f64> {
        next(&self.starts, from, to)
    }

    /// The greatest height below `from` and above `to` at which a column leaves engagement.
    pub fn first_end(&self, from: f64, to: f64) -> Option<f64> {
        next(&self.ends, from, to)
    }

    /// The stretches between [`PointEngagement::first`] and [`PointEngagement::last`] with nothing, something or all
    /// engaged, on the way down, each as long as it can be. The columns decide, there is no tolerance.
    pub fn stages(&self) -> Vec<PointStage> {
        let mut stages: Vec<PointStage> = Vec::new();
        let (mut s, mut e) = (0, 0);
        let mut from = f64::NAN;
        // From one height at which something changes to the next.
        while s < self.starts.len() || e < self.ends.len() {
            let next = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(f64::NEG_INFINITY);
            let (start, end) = (next(&self.starts, s), next(&self.ends, e));
            let to = if start > end { start } else { end };
            if to < from {
                let engaged = match s - e {
                    0 => Engaged::Not,
                    n if n == self.columns => Engaged::Fully,
                    _ => Engaged::Partly,
                };
                match stages.last_mut() {
                    Some(last) if last.engaged == engaged => last.to = to,
                    _ => stages.push(PointStage { from, to, engaged }),
                }
            }
            from = to;
            s += usize::from(start == to);
            e += usize::from(end == to && start != to);
        }
        stages
    }

    /// Most that a height of [`PointEngagement::stages`] may be off in a lattice of a step [mm]: heights of first
    /// contact are too low, of the last too high, by no more, since a column can miss the extreme point of the annulus.
    /// `edge` and `surface` are the greatest slopes of the edge and of the surface over the annulus.
    ///
    /// Inside the annulus the nearest column is at most half a diagonal of a cell away. An extreme point at the rim may
    /// have its nearest column outside of it; a point half a diagonal farther in has one inside: a whole diagonal.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::stock::PointEngagement;
    /// // A point of 118 degrees on a face inclined by 12 degrees.
    /// let (edge, surface) = (59f64.to_radians().tan().recip(), 12f64.to_radians().tan());
    /// assert!((PointEngagement::sampling_error(edge, surface, 0.25) - 0.2876).abs() < 1e-4);
    /// ```
    pub fn sampling_error(edge: f64, surface: f64, step: f64) -> f64 {
        (edge.abs() + surface.abs()) * step * std::f64::consts::SQRT_2
    }
}

#[cfg(test)]
mod tests;
