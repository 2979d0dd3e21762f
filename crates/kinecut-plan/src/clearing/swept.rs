//! The area that a cutter has cleared, and the arc with which it cuts at a place.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use crate::geom::{NearestEdge, Outline};
use crate::num::angle::wrap;

/// Cells along a radius of the cutter.
const CELLS: f64 = 6.0;
/// Places at which the circle of the cutter is looked up in the cells: so many that no place between two is farther from one
/// of them than the margin of a cell.
const SLOTS: usize = 72;
/// Margin by which a cell is larger than its square, in widths of a cell: half the way between two slots.
const MARGIN: f64 = 0.27;
/// Longest piece, in radii of the cutter: what it covers of a circle is one stretch without doubt.
const LONGEST: f64 = 0.5;
/// Number of times by which a cell is halved in the search for slivers: down to a hundredth of the cutter's radius.
const FINEST: u32 = 4;
/// Share of the cutter's radius below which a piece of stock is rounding.
const ROUNDING: f64 = 1e-9;

/// A cleared area: all that a cutter has swept, and what was free before.
///
/// Every piece of motion covers one stretch of the circle of a cutter elsewhere, in closed form; the arc with which the
/// cutter cuts is what is left of it, exactly. Cells tell which pieces matter.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::clearing::{Clearing, Engagement};
/// // A slot of a cutter of radius 5, and a pass beside it, 2.5 mm aside: cos E = 1 - 2.5 / 5.
/// let mut clearing = Clearing::new([dvec2(-40.0, -40.0), dvec2(40.0, 40.0)], 5.0);
/// clearing.sweep(dvec2(-30.0, 0.0), dvec2(30.0, 0.0), 5.0);
/// clearing.sweep(dvec2(-30.0, -2.5), dvec2(-0.1, -2.5), 5.0);
/// let cut: Engagement = clearing.engagement(dvec2(0.0, -2.5), 0.0);
/// assert!((cut.total.to_degrees() - 60.0).abs() < 1e-9);
/// assert!(cut.from_right.to_degrees() < 1e-9);
/// ```
#[derive(Clone, Debug)]
pub struct Clearing {
    /// Radius of the cutter [mm].
    radius: f64,
    low: DVec2,
    /// Width of a cell [mm], and cells along a length of 1 mm.
    width: f64,
    per_width: f64,
    columns: usize,
    rows: usize,
    states: Vec<State>,
    /// For each cell the pieces that reach into it and do not cover it.
    cells: Vec<Vec<u32>>,
    pieces: Vec<Piece>,
    /// Outlines of the stock at first: it is what all of them hold; none: stock everywhere.
    stocks: Vec<Stock>,
    /// Middle of each slot of the circle, from its centre.
    around: [DVec2; SLOTS],
}

/// The stock that stands before anything is cleared.
#[derive(Clone, Debug)]
struct Stock {
    outline: Outline,
    near: NearestEdge,
}

/// What a cell holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Covered by one piece, or free of stock.
    Clear,
    /// The outline of the stock passes it.
    Edge,
    Stock,
}

/// A straight piece of motion of a disc.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: DVec2,
    to: DVec2,
    along: DVec2,
    /// Of the length, squared; 0 without length.
    per_squared: f64,
    radius: f64,
}

/// The arc with which a cutter cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Engagement {
    /// Angle of all of its parts [rad].
    pub total: f64,
    /// Angle of its largest part [rad].
    pub largest: f64,
    /// Angle from the right normal of the travel to where its first part begins, counter-clockwise [rad]; a half turn without
    /// any.
    pub from_right: f64,
    /// Angle from the right normal of the travel to where its first part ends [rad]; 0 without any.
    pub to: f64,
    /// Angle between the travel and the nearest place of all parts [rad]: the largest chip is its cosine, in feeds per tooth; a
    /// quarter turn without any.
    pub ahead: f64,
}

impl Engagement {
    /// Without any part.
    const NONE: Engagement =
        Engagement { total: 0.0, largest: 0.0, from_right: PI, to: 0.0, ahead: FRAC_PI_2 };
}

impl Clearing {
    /// Of a cutter's radius [mm], with stock everywhere; nothing outside of the corners of the area is looked at.
    pub fn new(area: [DVec2; 2], radius: f64) -> Clearing {
        let width = radius / CELLS;
        let low = area[0] - DVec2::splat(radius + width);
        let size = area[1] + DVec2::splat(radius + width) - low;
        let count = |length: f64| (length / width).ceil() as usize + 1;
        let (columns, rows) = (count(size.x), count(size.y));
        let around = std::array::from_fn(|i| radius * DVec2::from_angle((i as f64 + 0.5) * SLOT));
        Clearing {
            radius,
            low,
            width,
            per_width: 1.0 / width,
            columns,
            rows,
            states: vec![State::Stock; columns * rows],
            cells: vec![Vec::new(); columns * rows],
            pieces: Vec::new(),
            stocks: Vec::new(),
            around,
        }
    }

    /// Number of cells that an area needs for a cutter's radius [mm], for a bound on it.
    pub fn cells(area: [DVec2; 2], radius: f64) -> f64 {
        let size = (area[1] - area[0] + DVec2::splat(2.0 * radius)) * (CELLS / radius);
        size.x * size.y
    }

    /// With stock inside an outline only; within those given before, too.
    #[must_use]
    pub fn with_stock(mut self, outline: &Outline) -> Clearing {
        let near = NearestEdge::new(outline.edges());
        let reach = self.reach();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let middle = self.middle(column, row);
                let state = match near.at(middle, reach) {
                    Some(_) => State::Edge,
                    None if outline.contains(middle) => State::Stock,
                    None => State::Clear,
                };
                let known = &mut self.states[row * self.columns + column];
                *known = match (*known, state) {
                    (State::Clear, _) | (_, State::Clear) => State::Clear,
                    (State::Stock, State::Stock) => State::Stock,
                    _ => State::Edge,
                };
            }
        }
        self.stocks.push(Stock { outline: outline.clone(), near });
        self
    }

    /// Whether a point was stock at first.
    fn was_stock(&self, p: DVec2) -> bool {
        self.stocks.iter().all(|s| s.outline.contains(p))
    }

    /// Radius of the circle around a cell with its margin [mm].
    fn reach(&self) -> f64 {
        (0.5 + MARGIN) * self.width * std::f64::consts::SQRT_2
    }

    fn middle(&self, column: usize, row: usize) -> DVec2 {
        self.low + self.width * DVec2::new(column as f64 + 0.5, row as f64 + 0.5)
    }

    /// The cell at a point; beyond the area the nearest one.
    fn cell(&self, p: DVec2) -> usize {
        let at = |x: f64, low: f64, count: usize| (((x - low) * self.per_width) as usize).min(count - 1);
        at(p.y, self.low.y, self.rows) * self.columns + at(p.x, self.low.x, self.columns)
    }

    /// A disc of a radius, that of the cutter at least [mm], has moved straight between two points.
    pub fn sweep(&mut self, from: DVec2, to: DVec2, radius: f64) {
        let parts = (from.distance(to) / (LONGEST * self.radius)).ceil().max(1.0);
        let at = |k: f64| from + (to - from) * (k / parts);
        for k in 0..parts as usize {
            let k = k as f64;
            self.add(at(k), if k + 1.0 < parts { at(k + 1.0) } else { to }, radius);
        }
    }

    fn add(&mut self, from: DVec2, to: DVec2, radius: f64) {
        let index = self.pieces.len() as u32;
        let along = to - from;
        let squared = along.length_squared();
        let per_squared = if squared > 0.0 { 1.0 / squared } else { 0.0 };
        let piece = Piece { from, to, along, per_squared, radius };
        self.pieces.push(piece);
        let reach = self.reach();
        let span = |low: f64, high: f64, base: f64, count: usize| {
            let at = |x: f64| (((x - base) / self.width) as usize).min(count - 1);
            at(low - radius - self.width)..at(high + radius + self.width) + 1
        };
        let (min, max) = (from.min(to), from.max(to));
        let columns = span(min.x, max.x, self.low.x, self.columns);
        for row in span(min.y, max.y, self.low.y, self.rows) {
            for column in columns.clone() {
                let cell = row * self.columns + column;
                if self.states[cell] == State::Clear {
                    continue;
                }
                let middle = self.middle(column, row);
                let away = piece.squared(middle);
                if radius >= reach && away <= (radius - reach) * (radius - reach) {
                    self.states[cell] = State::Clear;
                    self.cells[cell] = Vec::new();
                } else if away < (radius + reach) * (radius + reach) {
                    // Within the cell, what another piece covers too is not kept: few are.
                    let all = &self.pieces;
                    let hides = |a: u32, b: u32| all[a as usize].hides(&all[b as usize], middle, reach);
                    let kept = &mut self.cells[cell];
                    if !kept.iter().any(|&known| hides(known, index)) {
                        kept.retain(|&known| !hides(index, known));
                        kept.push(index);
                    }
                }
            }
        }
    }

    /// Whether a point is cleared.
    pub fn is_clear(&self, p: DVec2) -> bool {
        let cell = self.cell(p);
        self.states[cell] == State::Clear
            || self.cells[cell].iter().any(|&i| self.pieces[i as usize].holds(p))
            || self.states[cell] == State::Edge && !self.was_stock(p)
    }

    /// Points of the middle of cells that are not wholly cleared, where `keep` has them, and are stock.
    pub fn remains(&self, keep: impl Fn(DVec2) -> bool) -> Vec<DVec2> {
        let mut found = Vec::new();
        for row in 0..self.rows {
            for column in 0..self.columns {
                if self.states[row * self.columns + column] == State::Clear {
                    continue;
                }
                let p = self.middle(column, row);
                if !self.is_clear(p) && keep(p) {
                    found.push(p);
                }
            }
        }
        found
    }

    /// Points of stock that no piece has swept, however narrow the place, where `keep` has them: one of a cell.
    pub fn slivers(&self, keep: impl Fn(DVec2) -> bool) -> Vec<DVec2> {
        let mut found = Vec::new();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let cell = row * self.columns + column;
                if self.states[cell] == State::Clear {
                    continue;
                }
                let square = (self.middle(column, row), 0.5 * self.width);
                found.extend(self.uncovered(cell, square, FINEST).filter(|p| keep(*p)));
            }
        }
        found
    }

    /// A point of a square of a cell, by its middle and half its width, that no piece covers; `times`: how often it may be
    /// divided.
    fn uncovered(&self, cell: usize, (middle, half): (DVec2, f64), times: u32) -> Option<DVec2> {
        let pieces = || self.cells[cell].iter().map(|&i| &self.pieces[i as usize]);
        if pieces().any(|piece| piece.covers_around(middle, half * std::f64::consts::SQRT_2)) {
            return None;
        }
        if times == 0 {
            let is_stock = || self.states[cell] != State::Edge || self.was_stock(middle);
            return (!pieces().any(|piece| piece.holds(middle)) && is_stock()).then_some(middle);
        }
        let quarter = 0.5 * half;
        let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        corners.into_iter().find_map(|(x, y)| {
            self.uncovered(cell, (middle + quarter * DVec2::new(x, y), quarter), times - 1)
        })
    }

    /// Whether a circle of a radius [mm] passes stock that nothing has come near to: a quick answer where it does, from the way
    /// ahead [rad] on to both sides.
    pub(super) fn is_in_untouched(&self, centre: DVec2, heading: f64, radius: f64) -> bool {
        let scale = radius / self.radius;
        let ahead = (heading / SLOT).floor() as i64;
        (0..SLOTS as i64).any(|k| {
            // 0, 1, -1, 2, -2 and so on.
            let aside = if k % 2 == 0 { -(k / 2) } else { k / 2 + 1 };
            let slot = (ahead + aside).rem_euclid(SLOTS as i64) as usize;
            let cell = self.cell(centre + scale * self.around[slot]);
            self.states[cell] == State::Stock && self.cells[cell].is_empty()
        })
    }

    /// Width of a cell [mm].
    pub fn cell_width(&self) -> f64 {
        self.width
    }

    /// The arc with which the cutter cuts as it comes to a centre in a direction [rad]; nothing where it has been already.
    pub fn engagement(&self, centre: DVec2, heading: f64) -> Engagement {
        self.engaged(centre, heading, self.radius, &mut Scratch::default())
    }

    /// The same for a circle of a radius, that of the cutter or a little less [mm], with room for the work that is kept from
    /// call to call.
    pub(super) fn engaged(&self, centre: DVec2, heading: f64, radius: f64, work: &mut Scratch) -> Engagement {
        let scale = radius / self.radius;
        // All of a slot lies so near to its middle.
        let half = 0.51 * SLOT * radius;
        work.begin(self.pieces.len());
        // Angles from here on are from the right normal, counter-clockwise, 0 to a half turn.
        let right = heading - FRAC_PI_2;
        let first = (right / SLOT).floor() as i64;
        let mut has_edge = false;
        let mut open = false;
        let mut clear_from: Option<f64> = None;
        let mut hint = None;
        let mut slot = first.rem_euclid(SLOTS as i64) as usize;
        for k in 0..=(SLOTS / 2) as i64 {
            let begin = (first + k) as f64 * SLOT - right;
            let middle = centre + scale * self.around[slot];
            let cell = self.cell(middle);
            let state = self.states[cell];
            if state == State::Clear {
                slot = if slot + 1 < SLOTS { slot + 1 } else { 0 };
                clear_from.get_or_insert(begin);
                continue;
            }
            let pieces = &self.cells[cell];
            let covers_all = |i: u32| self.pieces[i as usize].covers_around(middle, half);
            // Pieces cover many slots, the latest most.
            let covering = hint
                .filter(|&i| covers_all(i))
                .or_else(|| pieces.iter().rev().copied().find(|&i| covers_all(i)));
            slot = if slot + 1 < SLOTS { slot + 1 } else { 0 };
            if covering.is_some() {
                hint = covering;
                clear_from.get_or_insert(begin);
                continue;
            }
            if let Some(from) = clear_from.take() {
                work.covers.push([from, begin]);
            }
            open = true;
            has_edge |= state == State::Edge;
            for &index in pieces {
                let piece = &self.pieces[index as usize];
                if !piece.comes_within(middle, half) || !work.is_new(index) {
                    continue;
                }
                let Some([from, to]) = piece.covers(centre, radius) else { continue };
                // A stretch may reach over the right normal: it then covers both ends of the half turn.
                let first = wrap_turn(from - right);
                let last = first + (to - from);
                work.covers.push([first, last]);
                if last > TAU {
                    work.covers.push([first - TAU, last - TAU]);
                }
            }
        }
        if let Some(from) = clear_from {
            work.covers.push([from, PI]);
        }
        if !open {
            return Engagement::NONE;
        }
        work.covers.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let mut cut = Engagement::NONE;
        let mut gap = |from: f64, to: f64| {
            if to - from <= ROUNDING {
                return;
            }
            if cut.total == 0.0 {
                cut.from_right = from;
                cut.to = to;
            }
            cut.total += to - from;
            cut.largest = cut.largest.max(to - from);
            let aside = if from > FRAC_PI_2 { from - FRAC_PI_2 } else { FRAC_PI_2 - to };
            cut.ahead = cut.ahead.min(aside.max(0.0));
        };
        let mut reached = 0.0;
        let stocks = if has_edge { &self.stocks[..] } else { &[] };
        for [from, to] in work.covers.iter().copied().chain([[PI, PI]]) {
            let from = if from < PI { from } else { PI };
            if from > reached {
                match stocks {
                    [] => gap(reached, from),
                    _ => Stock::between(stocks, (centre, radius), right, [reached, from], &mut gap),
                }
            }
            if to > reached {
                reached = to;
            }
            if reached >= PI {
                break;
            }
        }
        cut
    }
}

/// Angle between two slots [rad].
const SLOT: f64 = TAU / SLOTS as f64;

/// An angle between 0 and a full turn.
fn wrap_turn(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned < TAU { turned } else { 0.0 }
}

/// Room for the work of [`Clearing::engaged`].
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    covers: Vec<[f64; 2]>,
    /// For each piece the call in which it was looked at last.
    seen: Vec<u32>,
    call: u32,
}

impl Scratch {
    fn begin(&mut self, pieces: usize) {
        self.covers.clear();
        self.seen.resize(pieces, 0);
        self.call = self.call.wrapping_add(1);
        if self.call == 0 {
            self.seen.fill(0);
            self.call = 1;
        }
    }

    fn is_new(&mut self, piece: u32) -> bool {
        std::mem::replace(&mut self.seen[piece as usize], self.call) != self.call
    }
}

impl Stock {
    /// Calls `gap` for the parts of a stretch of the cutter's circle that lie in all of some stocks.
    fn between(
        all: &[Stock],
        (centre, radius): (DVec2, f64),
        right: f64,
        [from, to]: [f64; 2],
        gap: &mut impl FnMut(f64, f64),
    ) {
        let mut cuts = vec![from, to];
        for edge in all.iter().flat_map(|stock| stock.outline.edges()) {
            for at in edge.on_circle(centre, radius) {
                let angle = wrap_turn((at - centre).to_angle() - right);
                if from < angle && angle < to {
                    cuts.push(angle);
                }
            }
        }
        cuts.sort_unstable_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let middle = centre + radius * DVec2::from_angle(right + 0.5 * (pair[0] + pair[1]));
            let is_in = |s: &Stock| s.near.at(middle, f64::INFINITY).is_some_and(|n| n.distance < 0.0);
            if all.iter().all(is_in) {
                gap(pair[0], pair[1]);
            }
        }
    }
}

impl Piece {
    /// Square of the distance of a point from the way of the middle [mm2].
    fn squared(&self, p: DVec2) -> f64 {
        let off = p - self.from;
        let share = (off.dot(self.along) * self.per_squared).clamp(0.0, 1.0);
        (off - share * self.along).length_squared()
    }

    /// Whether it surely covers, within a distance of a point [mm], all that another piece covers there.
    ///
    /// One of its ends `c` is nearer than every point of the other's way, `|x - c| <= |x - e|`, for all `x` there: linear in
    /// `x` for an end `e` of that way, and between the ends the square falls short of theirs by a quarter of its length
    /// squared at most.
    fn hides(&self, other: &Piece, middle: DVec2, reach: f64) -> bool {
        if self.radius < other.radius {
            return false;
        }
        let short = 0.25 * other.along.length_squared();
        [self.from, self.to].iter().any(|c| {
            [other.from, other.to].iter().all(|e| {
                let apart = *c - *e;
                let nearer = (middle - 0.5 * (*c + *e)).dot(apart) - reach * apart.length();
                2.0 * nearer >= short
            })
        })
    }

    /// Whether it covers a point.
    fn holds(&self, p: DVec2) -> bool {
        self.squared(p) <= self.radius * self.radius
    }

    /// Whether it covers all within a distance of a point [mm].
    fn covers_around(&self, p: DVec2, distance: f64) -> bool {
        let reach = self.radius - distance;
        self.squared(p) <= reach * reach
    }

    /// Whether it comes within a distance of a point [mm].
    fn comes_within(&self, p: DVec2, distance: f64) -> bool {
        let reach = self.radius + distance;
        self.squared(p) <= reach * reach
    }

    /// The stretch of a circle that the piece covers [rad], counter-clockwise from the first to the second; `None` where it
    /// covers nothing of it. The disc is at least as large as the circle, so that it is one stretch.
    fn covers(&self, centre: DVec2, radius: f64) -> Option<[f64; 2]> {
        let size = self.radius;
        if self.squared(centre).sqrt() + radius <= size {
            return Some([0.0, TAU]);
        }
        let along = self.to - self.from;
        let length = along.length();
        // The part of the way from which the disc reaches the circle.
        let (from, to) = if length > 0.0 {
            let t = along / length;
            let foot = (centre - self.from).dot(t);
            let aside = (centre - self.from).perp_dot(t);
            let reach = radius + size;
            if aside.abs() >= reach {
                return None;
            }
            let half = (reach * reach - aside * aside).sqrt();
            let (a, b) = ((foot - half).max(0.0), (foot + half).min(length));
            if a >= b {
                return None;
            }
            let from = if a > 0.0 { self.from + a * t } else { self.from };
            let to = if b < length { self.from + b * t } else { self.to };
            (from, to)
        } else {
            (self.from, self.to)
        };
        let [mut low, mut high] = disc(from, size, centre, radius)?;
        let ends = disc(to, size, centre, radius)?;
        // The second stretch meets the first: counted on from it.
        let shift = wrap(0.5 * (ends[0] + ends[1] - low - high));
        let (middle, half) = (0.5 * (low + high) + shift, 0.5 * (ends[1] - ends[0]));
        low = low.min(middle - half);
        high = high.max(middle + half);
        if length > 0.0 && high - low < TAU {
            // Where the sides of the swept strip meet the circle.
            let t = along / length;
            for side in [t.perp(), -t.perp()] {
                let off = size - side.dot(centre - from);
                if off.abs() >= radius {
                    continue;
                }
                let half = (radius * radius - off * off).sqrt();
                for along in [half, -half] {
                    let p = centre + off * side + along * t;
                    let foot = (p - from).dot(t);
                    if foot > 0.0 && foot < from.distance(to) {
                        let at = 0.5 * (low + high) + wrap((p - centre).to_angle() - 0.5 * (low + high));
                        low = low.min(at);
                        high = high.max(at);
                    }
                }
            }
        }
        Some(if high - low >= TAU { [0.0, TAU] } else { [low, high] })
    }
}

/// The stretch of a circle that a disc covers, its middle between -pi and pi.
fn disc(at: DVec2, size: f64, centre: DVec2, radius: f64) -> Option<[f64; 2]> {
    let off = at - centre;
    let d = off.length();
    if d + radius <= size {
        let middle = if d > 0.0 { off.to_angle() } else { 0.0 };
        return Some([middle - PI, middle + PI]);
    }
    let cosine = (d * d + radius * radius - size * size) / (2.0 * d * radius);
    if cosine > 1.0 + 1e-12 {
        return None;
    }
    let half = cosine.clamp(-1.0, 1.0).acos();
    let middle = off.to_angle();
    Some([middle - half, middle + half])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn a_piece_covers_one_stretch_of_a_circle() {
        let mut random = Random(3);
        let mut unit = || 2.0 * random.share() - 1.0;
        for round in 0..20_000 {
            let radius = 5.0;
            let size = if round % 4 == 0 { 5.0 + 3.0 * unit().abs() } else { radius };
            let from = DVec2::new(11.0 * unit(), 11.0 * unit());
            let to = from + 2.5 * unit() * DVec2::from_angle(PI * unit());
            let along = to - from;
            let piece = Piece { from, to, along, per_squared: 1.0 / along.length_squared(), radius: size };
            let found = piece.covers(DVec2::ZERO, radius);
            let counted = (0..720)
                .filter(|k| piece.holds(radius * DVec2::from_angle((f64::from(*k) + 0.5) * TAU / 720.0)))
                .count() as f64
                * TAU
                / 720.0;
            let covered = found.map_or(0.0, |[low, high]| high - low);
            assert!((covered - counted).abs() < 0.02, "{round}: {piece:?} {found:?} {counted}");
        }
    }
}
