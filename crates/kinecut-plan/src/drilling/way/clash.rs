//! Ways on which surfaces run into one another under the drill: a bore that opens into a face or another bore, a
//! pre-hole that ends in one.
//!
//! Of each surface only the places count that bound the part: below the entry, above the exit, outside the pre-hole and
//! outside every other bore. Their greatest and least S - z come from a branch and bound over cells of the annulus
//! (radius by angle): greatest surface less least edge bounds a cell from above, a cell that surely does not count is
//! dropped, the cell of the greatest bound is split next, until that bound is within [`BOUND`] of a value found. The
//! bound is what is reported, no farther out than the exact extreme of the whole surface: never inside the true one.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

use glam::DVec2;

use super::cell::{Cell, bounds, edge_bounds};
use crate::drilling::domain::Laid;
use crate::drilling::{BoundarySurface, CrossBore, Passage, PreHole, Side, Transient};
use crate::geom::{EdgeProfile, EdgeSegment};

/// Largest distance of the result outside the true extreme [mm]: a tenth of what machines post.
const BOUND: f64 = 1e-4;
/// Most cells of one search, some 20 ms; beyond it the bound reached is reported.
const MOST_CELLS: usize = 100_000;
/// Most cells to show that two surfaces do not meet; more are needed only where they nearly touch.
const CELLS_APART: usize = 2000;
/// Columns by which the shares of surfaces that run into one another are counted. All surfaces of a way are counted by
/// the same columns, so that their sums are exact. Each column has a radius of its own: a ring of a few hundredths of a
/// millimetre, between the slot of a point and a pre-hole a little wider, is seen too.
const COLUMNS: u32 = 43_200;
/// Turn from column to column [rad]: the golden angle, by which no line of symmetry meets rows of columns.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// All that is on the way, for one edge.
pub(super) struct WayBody<'a> {
    pub(super) edge: &'a EdgeProfile,
    pub(super) entry: Laid,
    pub(super) exit: Option<Laid>,
    pub(super) bores: &'a [CrossBore],
    pub(super) pre_hole: Option<&'a PreHole>,
}

/// A surface of the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sheet {
    Entry,
    Exit,
    Roof(usize),
    Floor(usize),
    Bottom,
}

/// True if no two surfaces of a way touch under the drill.
pub(super) fn apart(body: &WayBody<'_>) -> bool {
    let whole = Cell { r: [0.0, body.edge.outer_radius()], angle: [0.0, TAU] };
    let above = |upper: &Laid, lower: &Laid| {
        let mut open = vec![whole];
        for _ in 0..CELLS_APART {
            let Some(cell) = open.pop() else { return true };
            if bounds(upper, &cell)[0] <= bounds(lower, &cell)[1] {
                // At the highest place of the lower one, or between: the centre tells at once where they cross.
                if upper.height(cell.centre()) <= lower.height(cell.centre()) {
                    return false;
                }
                open.extend(cell.split(cell.longer_radially()));
            }
        }
        open.is_empty()
    };
    let over = |laid: &Laid| bounds(laid, &whole);
    let met = |b: &&CrossBore| b.offset.abs() - b.radius < body.edge.outer_radius();
    let bores: Vec<[Laid; 2]> = body.bores.iter().filter(met).map(CrossBore::surfaces).collect();
    let below_entry = bores.iter().all(|[roof, _]| above(&body.entry, roof));
    let above_exit = body
        .exit
        .iter()
        .all(|exit| above(&body.entry, exit) && bores.iter().all(|[_, floor]| above(floor, exit)));
    let separate = bores.iter().enumerate().all(|(n, [roof, floor])| {
        bores[..n]
            .iter()
            .all(|[other_roof, other_floor]| above(floor, other_roof) || above(other_floor, roof))
    });
    let bottom = body.pre_hole.and_then(|h| h.bottom).is_none_or(|b| {
        let [low, high] = [b.height, b.height + b.edge.extent()[1]];
        over(&body.entry)[0] > high
            && body.exit.iter().all(|exit| low > over(exit)[1])
            && bores.iter().all(|[roof, floor]| over(floor)[0] > high || over(roof)[1] < low)
    });
    below_entry && above_exit && separate && bottom
}

impl WayBody<'_> {
    /// The passages of what bounds the part. `plain` are those of the whole surfaces.
    pub(super) fn passages(&self, plain: &[Passage]) -> Vec<Passage> {
        let reach = self.edge.outer_radius();
        let mut sheets = vec![Sheet::Entry];
        if self.pre_hole.is_some_and(|h| h.bottom.is_some()) {
            sheets.push(Sheet::Bottom);
        }
        for (n, bore) in self.bores.iter().enumerate() {
            if bore.offset.abs() - bore.radius < reach {
                sheets.extend([Sheet::Roof(n), Sheet::Floor(n)]);
            }
        }
        sheets.extend(self.exit.map(|_| Sheet::Exit));
        let seen = self.columns(&sheets);
        // No passage reaches beyond all of the whole surfaces.
        let limits = plain.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            let t = &p.transient;
            [if t.last < low { t.last } else { low }, if t.first > high { t.first } else { high }]
        });
        let mut passages: Vec<(Sheet, Passage)> = Vec::new();
        for (sheet, seen) in sheets.iter().zip(seen) {
            let whole = self.whole(*sheet).unwrap_or(Transient {
                first: limits[1],
                last: limits[0],
                first_radius: 0.0,
                last_radius: reach,
            });
            let Some(transient) = self.transient(*sheet, &whole, &seen) else { continue };
            let side = match sheet {
                Sheet::Entry | Sheet::Floor(_) | Sheet::Bottom => Side::Entry,
                Sheet::Exit | Sheet::Roof(_) => Side::Exit,
            };
            passages.push((*sheet, Passage { transient, side, share: seen.share }));
        }
        // Roof and floor of a bore that does not swallow the drill are one stretch.
        for n in 0..self.bores.len() {
            let place = |sheet: Sheet| passages.iter().position(|(s, _)| *s == sheet);
            if let (Some(i), Some(j)) = (place(Sheet::Roof(n)), place(Sheet::Floor(n))) {
                let [roof, floor] = self.bores[n].merged(reach, [passages[i].1, passages[j].1]);
                passages[i].1 = roof;
                passages[j].1 = floor;
            }
        }
        passages.into_iter().map(|(_, p)| p).collect()
    }

    fn laid(&self, sheet: Sheet) -> Option<Laid> {
        match sheet {
            Sheet::Entry => Some(self.entry),
            Sheet::Exit => self.exit,
            Sheet::Roof(n) => Some(self.bores[n].surfaces()[0]),
            Sheet::Floor(n) => Some(self.bores[n].surfaces()[1]),
            Sheet::Bottom => None,
        }
    }

    /// The exact transient of the whole surface over the whole annulus.
    fn whole(&self, sheet: Sheet) -> Option<Transient> {
        use crate::drilling::{Cover, transient};
        match self.laid(sheet) {
            Some(laid) => transient(self.edge, &laid.surface, Cover::Part).ok(),
            None => self.pre_hole.and_then(|h| h.bottom_transient(self.edge)),
        }
    }

    /// Height of the pre-hole's bottom over a point [mm]; minus infinity for a hole that goes through, `None` outside
    /// the hole.
    fn bottom(&self, p: DVec2) -> Option<f64> {
        let hole = self.pre_hole?;
        let from = p.distance(DVec2::from(hole.at));
        if from >= 0.5 * hole.diameter {
            return None;
        }
        let Some(bottom) = &hole.bottom else { return Some(f64::NEG_INFINITY) };
        bottom.edge.height(from).map(|z| bottom.height + z)
    }

    /// Bounds of the bottom over a cell [mm], and true if all of the cell lies over the hole; `None` outside the hole.
    fn bottom_bounds(&self, cell: &Cell) -> Option<([f64; 2], bool)> {
        let hole = self.pre_hole?;
        let from = cell.distance(DVec2::from(hole.at));
        if from[0] >= 0.5 * hole.diameter {
            return None;
        }
        let inside = from[1] < 0.5 * hole.diameter;
        let Some(bottom) = &hole.bottom else { return Some(([f64::NEG_INFINITY; 2], inside)) };
        let [low, high] = edge_bounds(&bottom.edge, from)?;
        Some(([bottom.height + low, bottom.height + high], inside))
    }

    /// Height of a surface over a point if it bounds the part there.
    fn bounding(&self, sheet: Sheet, p: DVec2) -> Option<f64> {
        let bottom = self.bottom(p);
        let height = match self.laid(sheet) {
            Some(laid) if !laid.covers(p) => return None,
            Some(laid) => laid.height(p),
            None => bottom?,
        };
        if sheet != Sheet::Entry && height > self.entry.height(p)
            || sheet != Sheet::Bottom && bottom.is_some_and(|b| height > b)
            || sheet != Sheet::Exit && self.exit.is_some_and(|exit| height < exit.height(p))
        {
            return None;
        }
        let hidden = self.bores.iter().enumerate().any(|(n, bore)| {
            let [roof, floor] = bore.surfaces();
            sheet != Sheet::Roof(n)
                && sheet != Sheet::Floor(n)
                && roof.covers(p)
                && height < roof.height(p)
                && height > floor.height(p)
        });
        (!hidden && height.is_finite()).then_some(height)
    }

    /// Bounds of a surface over a cell unless it surely bounds the part nowhere in it.
    fn bounding_cell(&self, sheet: Sheet, cell: &Cell) -> Option<[f64; 2]> {
        let bottom = self.bottom_bounds(cell);
        let covered = |laid: &Laid| match laid.surface {
            BoundarySurface::Plane { .. } => (true, true),
            BoundarySurface::Ridge { radius, offset, .. }
            | BoundarySurface::Valley { radius, offset, .. } => {
                let [a, b] = cell.along(laid.turn).map(|u| offset + u);
                (a <= radius && b >= -radius, a >= -radius && b <= radius)
            }
        };
        let [low, high] = match self.laid(sheet) {
            Some(laid) if !covered(&laid).0 => return None,
            Some(laid) => bounds(&laid, cell),
            None => bottom?.0,
        };
        if sheet != Sheet::Entry && low > bounds(&self.entry, cell)[1]
            || sheet != Sheet::Bottom && bottom.is_some_and(|(b, inside)| inside && low > b[1])
            || sheet != Sheet::Exit && self.exit.is_some_and(|exit| high < bounds(&exit, cell)[0])
        {
            return None;
        }
        let hidden = self.bores.iter().enumerate().any(|(n, bore)| {
            let [roof, floor] = bore.surfaces();
            sheet != Sheet::Roof(n)
                && sheet != Sheet::Floor(n)
                && covered(&roof).1
                && high < bounds(&roof, cell)[0]
                && low > bounds(&floor, cell)[1]
        });
        (!hidden).then_some([low, high])
    }

    /// Greatest and least S - z where a surface bounds the part, no farther out than those of the whole surface.
    fn transient(&self, sheet: Sheet, whole: &Transient, seen: &Seen) -> Option<Transient> {
        let (first, first_radius) = self.extreme(sheet, 1.0, whole.first, seen.first)?;
        let (last, last_radius) = self.extreme(sheet, -1.0, -whole.last, seen.last)?;
        Some(Transient { first, last: -last, first_radius, last_radius })
    }

    /// The greatest `sign (S - z)`, not above `limit`, and the radius of the nearest place found. `best` is a place that
    /// is known.
    fn extreme(
        &self,
        sheet: Sheet,
        sign: f64,
        limit: f64,
        mut best: Option<(f64, f64)>,
    ) -> Option<(f64, f64)> {
        let bound = |cell: &Cell| {
            let [low, high] = self.bounding_cell(sheet, cell)?;
            let z = edge_bounds(self.edge, cell.r)?;
            Some(if sign > 0.0 { high - z[0] } else { z[1] - low })
        };
        // Whether a place of the cell counts.
        let note = |cell: &Cell, best: &mut Option<(f64, f64)>| {
            let corner = |i: usize, k: usize| DVec2::from_angle(cell.angle[i]) * cell.r[k];
            let places = [cell.centre(), corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
            let mut counts = false;
            for p in places {
                if let Some(s) = self.bounding(sheet, p) {
                    counts = true;
                    let r = p.length().clamp(self.edge.inner_radius(), self.edge.outer_radius());
                    keep_greatest(best, self.differences(s, r).map(|z| sign * z), r);
                }
            }
            counts
        };
        let mut heap = BinaryHeap::new();
        // A ring for each segment, so that no cell holds a step of the edge.
        for segment in self.edge.segments() {
            let cell = Cell { r: segment.range(), angle: [0.0, TAU] };
            heap.extend(bound(&cell).map(|bound| Open { bound, depth: 0, cell }));
        }
        let mut count = 0;
        while let Some(open) = heap.pop() {
            let counts = note(&open.cell, &mut best);
            let reached = if open.bound < limit { open.bound } else { limit };
            count += 1;
            let place = open.cell.is_place();
            if let Some((value, radius)) = best
                && (reached <= value + BOUND || place && counts || count > MOST_CELLS)
            {
                return Some((if reached > value { reached } else { value }, radius));
            }
            if count > MOST_CELLS {
                // Less of the surface counts than the search can see: none.
                return None;
            }
            if place {
                continue;
            }
            // By turns where it lowers the bound most, and across the longer side.
            let worst = |cells: &[Cell; 2]| {
                cells.iter().filter_map(bound).fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a })
            };
            let (rings, angles) = (open.cell.split(true), open.cell.split(false));
            let radially = match worst(&rings).total_cmp(&worst(&angles)) {
                _ if open.depth % 2 == 1 => open.cell.longer_radially(),
                Ordering::Less => true,
                Ordering::Greater => false,
                Ordering::Equal => open.cell.longer_radially(),
            };
            for cell in if radially { rings } else { angles } {
                heap.extend(bound(&cell).map(|bound| Open { bound, depth: open.depth + 1, cell }));
            }
        }
        // Every cell was dropped, at the end those about the best value too.
        best
    }

    /// Height of a surface less that of the edge at a radius: of both sides of a step.
    fn differences(&self, height: f64, r: f64) -> impl Iterator<Item = f64> {
        let here = move |s: &&EdgeSegment| r >= s.range()[0] && r <= s.range()[1];
        self.edge.segments().iter().filter(here).map(move |s| height - s.height(r))
    }

    /// Each surface as columns all over the annulus see it. Columns over which nothing can be cut do not count.
    fn columns(&self, sheets: &[Sheet]) -> Vec<Seen> {
        let (inner, outer) = (self.edge.inner_radius(), self.edge.outer_radius());
        let (mut seen, mut all) = (vec![Seen::default(); sheets.len()], 0u32);
        for i in 0..COLUMNS {
            // The same area for each column.
            let t = (f64::from(i) + 0.5) / f64::from(COLUMNS);
            let r = (inner * inner + t * (outer - inner) * (outer + inner)).sqrt();
            let p = DVec2::from_angle(f64::from(i) * GOLDEN_ANGLE) * r;
            // Over a pre-hole that goes through nothing can be cut.
            let below = self.exit.map_or(f64::NEG_INFINITY, |exit| exit.height(p));
            if self.bottom(p).is_some_and(|b| b <= below) {
                continue;
            }
            all += 1;
            for (seen, sheet) in seen.iter_mut().zip(sheets) {
                if let Some(s) = self.bounding(*sheet, p) {
                    seen.share += 1.0;
                    keep_greatest(&mut seen.first, self.differences(s, r), r);
                    keep_greatest(&mut seen.last, self.differences(s, r).map(|z| -z), r);
                }
            }
        }
        let all = if all > 0 { f64::from(all) } else { 1.0 };
        seen.iter_mut().for_each(|s| s.share /= all);
        seen
    }
}

/// A surface as columns see it: its share of them, the greatest S - z and z - S with their radii.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    share: f64,
    first: Option<(f64, f64)>,
    last: Option<(f64, f64)>,
}

fn keep_greatest(best: &mut Option<(f64, f64)>, values: impl Iterator<Item = f64>, radius: f64) {
    for value in values {
        if best.is_none_or(|b| value > b.0) {
            *best = Some((value, radius));
        }
    }
}

/// A cell in the queue, the greatest bound first.
struct Open {
    bound: f64,
    depth: u32,
    cell: Cell,
}

impl Ord for Open {
    fn cmp(&self, other: &Open) -> Ordering {
        let corner = |o: &Open| (o.cell.r[0], o.cell.angle[0]);
        let (a, b) = (corner(self), corner(other));
        self.bound.total_cmp(&other.bound).then(b.0.total_cmp(&a.0)).then(b.1.total_cmp(&a.1))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Open) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Open) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(400))]
        /// Wherever a surface bounds the part, every cell about the place keeps it and its bounds hold its height.
        #[test]
        fn no_cell_loses_a_place(
            slope in -0.8..0.8f64, radius in 0.8..14.0f64, offset in -9.0..9.0f64, height in -10.0..8.0f64,
            turn in 0.0..6.3f64, x in -4.0..4.0f64, y in -4.0..4.0f64, diameter in 0.5..9.0f64, blind in any::<bool>(),
            places in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64), 20),
        ) {
            let edge = EdgeProfile::polyline(&[[0.0, 0.5], [2.0, 0.0], [5.0, 3.0]]).unwrap();
            let plane = |height: f64, slope: f64| BoundarySurface::Plane { height, slope };
            let hole = PreHole::through(diameter).moved([x, y]);
            let made = EdgeProfile::polyline(&[[0.0, 0.0], [0.5 * diameter, 1.0]]).unwrap();
            let hole = if blind { PreHole::blind(diameter, -4.0, made).moved([x, y]) } else { hole };
            let bores = [CrossBore { radius, offset, height, turn }];
            let body = WayBody {
                edge: &edge,
                entry: Laid { surface: plane(0.0, slope), turn: 0.0 },
                exit: Some(Laid { surface: plane(-8.0, 0.3), turn: 1.0 }),
                bores: &bores,
                pre_hole: Some(&hole),
            };
            for (r, angle, wide, long, part) in places {
                let (r, angle) = (5.0 * r, TAU * angle);
                let p = DVec2::from_angle(angle) * r;
                for size in [1.0, 0.1, 0.001] {
                    let cell = Cell {
                        r: [(r - 3.0 * wide * size).max(0.0), (r + 3.0 * part * size).min(5.0)],
                        angle: [angle - 3.0 * long * size, angle + 3.0 * (1.0 - part) * size],
                    };
                    for sheet in [Sheet::Entry, Sheet::Exit, Sheet::Roof(0), Sheet::Floor(0), Sheet::Bottom] {
                        if let Some(h) = body.bounding(sheet, p) {
                            let bounds = body.bounding_cell(sheet, &cell);
                            prop_assert!(
                                bounds.is_some_and(|[low, high]| low <= h + 1e-12 && high >= h - 1e-12),
                                "{sheet:?} at {h} in {bounds:?} over {cell:?}"
                            );
                            let z = edge_bounds(&edge, cell.r).unwrap();
                            let e = edge.height(r).unwrap();
                            prop_assert!(z[0] <= e + 1e-12 && z[1] >= e - 1e-12);
                        }
                    }
                }
            }
        }
    }
}
