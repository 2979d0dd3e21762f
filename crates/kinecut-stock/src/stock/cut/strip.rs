//! A piece against a strip of tiles across the tool axis: the lines of sixteen rows at all heights.
//!
//! On a level path a row (same y, all heights) is crossed once for each radius of the section: the side of a cutter
//! cuts all lines of a row at the price of one. A row remembers a stretch that it knows to be void over a run of
//! heights; a crossing that stays in it is done without a look at the lines.

use glam::{DVec3, Vec2Swizzles};

use super::across::{Mark, Span, spans};
use super::across_slope::{Cut, slope_spans, surface};
use super::body::{Body, Part};
use super::edge::from_beside;
use super::effect::{Effects, met};
use super::face::{Face, Station};
use super::plan::Plan;
use super::strip_hollow;
use super::strip_look::{Looked, look};
use super::task::Task;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::{Axis, EndPoint, Interval, fixed};

const EDGE: usize = TILE_EDGE as usize;

/// The tiles of one grid that share sixteen rows.
pub(super) struct Strip<'a> {
    /// In order of height in the stock.
    pub(super) tiles: Vec<&'a mut Tile>,
    /// Direction of the grid along which the height changes: 0 or 1.
    up: usize,
    /// Coordinates of the rows, and of all heights, in the stock.
    rows: Vec<f64>,
    heights: &'a [f64],
    /// By what went through: the cutting part, the shank, the holder.
    voids: [[Void; EDGE]; 3],
}

/// A stretch of a row without material over a run of layers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Void {
    from: i32,
    to: i32,
    layers: (usize, usize),
}

impl Void {
    pub(super) fn holds(&self, lo: i32, hi: i32, layers: (usize, usize)) -> bool {
        self.layers.0 <= layers.0 && layers.1 <= self.layers.1 && self.from <= lo && hi <= self.to
    }

    /// Takes in a stretch that was cut, or was found to be void.
    pub(super) fn widen(&mut self, lo: i32, hi: i32, layers: (usize, usize)) {
        if self.layers == layers && lo <= self.to && self.from <= hi {
            (self.from, self.to) = (self.from.min(lo), self.to.max(hi));
        } else if layers.1 - layers.0 >= self.layers.1 - self.layers.0 {
            *self = Void { from: lo, to: hi, layers };
        }
    }
}

/// A task seen along the lines of a strip: x along the lines, y across, w up along the tool.
pub(super) struct View<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) plan: Plan,
    /// Whether x, y are v, u of the tool frame instead of u, v.
    pub(super) mirrored: bool,
    /// Least and greatest x of the path.
    x: (f64, f64),
    y: (f64, f64),
}

impl View<'_> {
    /// The normal given along x, y, w as an end point.
    pub(super) fn end(&self, at: i32, n: DVec3, face: Face, part: usize) -> EndPoint {
        // Seen mirrored, left is right.
        let face = match (self.mirrored, face) {
            (true, Face::WallLeft) => Face::WallRight,
            (true, Face::WallRight) => Face::WallLeft,
            (true, Face::FootLeft) => Face::FootRight,
            (true, Face::FootRight) => Face::FootLeft,
            (_, face) => face,
        };
        let n = if self.mirrored { DVec3::new(n.y, n.x, n.z) } else { n };
        self.task.end(at, n, face.class(part))
    }

    /// Whether all sections stay at their heights, or widen downwards only.
    pub(super) fn is_level(&self) -> bool {
        self.task.piece.rise() == 0.0 || matches!(self.plan, Plan::Dot(_))
    }

    /// The stretch of a row that discs of a radius on the path may reach.
    pub(super) fn outer(&self, radius: f64, y: f64) -> Option<(f64, f64)> {
        let beside = (self.y.0 - y).max(y - self.y.1).max(0.0);
        let half = ((radius - beside) * (radius + beside)).sqrt();
        (half >= 0.0).then_some((self.x.0 - half, self.x.1 + half))
    }
}

/// The section of a tool part at a layer of a level path.
#[derive(Clone, Copy)]
struct Section<'a> {
    part: usize,
    of: &'a Part,
    /// Height above the tip.
    z: f64,
}

impl<'a> Strip<'a> {
    pub(super) fn new(tiles: Vec<&'a mut Tile>, up: usize, rows: &[f64], heights: &'a [f64]) -> Strip<'a> {
        Strip { tiles, up, rows: rows.to_vec(), heights, voids: [[Void::default(); EDGE]; 3] }
    }

    /// Tile and line of a row at a layer.
    pub(super) fn place(&self, row: usize, layer: usize) -> (usize, usize) {
        let within = layer % EDGE;
        (layer / EDGE, if self.up == 1 { within * EDGE + row } else { row * EDGE + within })
    }

    /// The material of the line of a row at a layer.
    pub(super) fn line(&self, row: usize, layer: usize) -> &[Interval] {
        let (tile, line) = self.place(row, layer);
        self.tiles[tile].line(line)
    }

    /// Coordinate of a row in the stock.
    pub(super) fn row(&self, row: usize) -> f64 {
        self.rows[row]
    }

    /// Height of a layer in the stock.
    pub(super) fn height(&self, layer: usize) -> f64 {
        self.heights[layer]
    }

    /// The voids of a row that a body left or found.
    pub(super) fn void(&mut self, looked: Looked, row: usize) -> &mut Void {
        &mut self.voids[looked as usize][row]
    }

    /// The rows that a body of some radius may reach.
    pub(super) fn rows_within(&self, view: &View, radius: f64) -> std::ops::Range<usize> {
        let first = self.rows.partition_point(|row| *row < view.y.0 - radius);
        let last = self.rows.partition_point(|row| *row <= view.y.1 + radius);
        first..last.max(first)
    }

    /// Takes a task past the lines, which run along `axis`: what it meets is noted, then or before it is cut by the rule
    /// at the head of `tile_axial.rs`.
    pub(super) fn pass(&mut self, axis: Axis, task: &Task, effects: &mut Effects) {
        let mirrored = axis == task.frame.axes[1];
        let (min, max) = task.plan_box;
        let (mut x, mut y) = ((min.x, max.x), (min.y, max.y));
        let mut plan = task.piece.plan;
        if mirrored {
            (x, y, plan) = (y, x, plan.mirrored());
        }
        let view = View { task, plan, mirrored, x, y };
        if self.rows_within(&view, task.tool.radius).is_empty() {
            return;
        }
        let before = task.piece.rise() > 0.0;
        if before {
            self.look_above(&view, effects);
        }
        if task.watch {
            from_beside(self, &view, &task.tool.contact, Looked::Cutting, effects);
        }
        let rows = self.rows_within(&view, task.tool.cutting.radius);
        if let Some((hollow, centre)) = task.hollow() {
            let centre = if mirrored { centre.yx() } else { centre };
            strip_hollow::pass_rows(self, &view, hollow, centre, rows, effects);
        } else {
            if task.watch {
                look(self, &view, &task.tool.contact, Looked::Cutting, effects);
            }
            if task.removes && view.is_level() {
                self.cut_level(&view, rows);
            } else if task.removes {
                self.cut_sloping(&view, rows);
            }
        }
        if !before {
            self.look_above(&view, effects);
        }
        for (body, looked) in [(&task.tool.shank, Looked::Shank), (&task.tool.holder, Looked::Holder)] {
            from_beside(self, &view, body, looked, effects);
        }
    }

    /// Notes what shank and holder meet.
    fn look_above(&mut self, view: &View, effects: &mut Effects) {
        let tool = view.task.tool;
        for (body, looked) in [(&tool.shank, Looked::Shank), (&tool.holder, Looked::Holder)] {
            look(self, view, body, looked, effects);
        }
    }

    /// The layers whose heights in the tool frame are in `[low, high)`.
    pub(super) fn layers(&self, task: &Task, low: f64, high: f64) -> (usize, usize) {
        let of = |w: f64| {
            if task.frame.sign > 0.0 {
                self.heights.partition_point(|h| *h < w)
            } else {
                // Heights fall in the tool frame: -h >= w.
                self.heights.partition_point(|h| -*h >= w)
            }
        };
        let (a, b) = (of(low), of(high));
        (a.min(b), a.max(b))
    }

    fn cut_level(&mut self, view: &View, rows: std::ops::Range<usize>) {
        let task = view.task;
        let body: &Body = &task.tool.cutting;
        let (low, high) = task.tip_range();
        // A tool that moves along its axis shows its widest section: that of its lowest position. From the height at
        // which its widest part is a cylinder all sections are equal.
        let Some((part, widest)) = body.parts.iter().enumerate().max_by(|a, b| a.1.r1.total_cmp(&b.1.r1))
        else {
            return;
        };
        let side = self.layers(task, low + widest.z1, high + body.top);
        let foot = self.layers(task, low + body.bottom, (low + widest.z1).min(high + body.top));
        for row in rows {
            if side.0 < side.1 {
                self.cut_level_row(view, row, side, Section { part, of: widest, z: widest.z1 });
            }
            for layer in foot.0..foot.1 {
                let z = self.heights[layer] * task.frame.sign - low;
                if let Some((part, of)) = body.widest(z) {
                    self.cut_level_row(view, row, (layer, layer + 1), Section { part, of, z });
                }
            }
        }
    }

    /// A row over layers of equal section.
    fn cut_level_row(&mut self, view: &View, row: usize, layers: (usize, usize), section: Section) {
        let (radius, y) = (section.of.radius(section.z), self.rows[row]);
        let Some((from, to)) = view.outer(radius, y) else { return };
        if self.voids[Looked::Cutting as usize][row].holds(fixed(from), fixed(to), layers) {
            return;
        }
        if layers.1 - layers.0 == 1 {
            let (tile, line) = self.place(row, layers.0);
            if met(self.tiles[tile].line(line), fixed(from), fixed(to)).0 == 0 {
                return;
            }
        }
        for span in spans(&view.plan, radius, y).as_slice() {
            let (lo, hi) = (fixed(span.lo.x), fixed(span.hi.x));
            if self.voids[Looked::Cutting as usize][row].holds(lo, hi, layers) {
                continue;
            }
            let mut ends = None;
            for layer in layers.0..layers.1 {
                let (tile, line) = self.place(row, layer);
                if met(self.tiles[tile].line(line), lo, hi).0 > 0 {
                    let [lower, upper] =
                        *ends.get_or_insert_with(|| level_ends(view, &section, span, lo, hi));
                    self.tiles[tile].subtract(line, lower, upper);
                }
            }
            if lo < hi {
                self.voids[Looked::Cutting as usize][row].widen(lo, hi, layers);
            }
        }
    }

    fn cut_sloping(&mut self, view: &View, rows: std::ops::Range<usize>) {
        let task = view.task;
        let piece = &task.piece;
        let body: &Body = &task.tool.cutting;
        let (low, high) = task.tip_range();
        let (first, last) = self.layers(task, low + body.bottom, high + body.top);
        for layer in first..last {
            let w = self.heights[layer] * task.frame.sign;
            for (i, part) in body.parts.iter().enumerate().filter(|(_, p)| w - low >= p.z0) {
                let most = part.radius(w - low);
                for row in rows.clone() {
                    let y = self.rows[row];
                    let Some((from, to)) = view.outer(most, y) else { continue };
                    let (tile, line) = self.place(row, layer);
                    if met(self.tiles[tile].line(line), fixed(from), fixed(to)).0 == 0 {
                        continue;
                    }
                    slope_spans(part, piece, &view.plan, y, w, |found| {
                        let (lo, hi) = (fixed(found.span.lo.x), fixed(found.span.hi.x));
                        if met(self.tiles[tile].line(line), lo, hi).0 == 0 {
                            return;
                        }
                        let end = |at: i32, mark: &Mark, cut: Cut| {
                            let (n, face) = surface(part, piece, &view.plan, w, mark, cut);
                            view.end(at, n, face, i)
                        };
                        let ends = [end(lo, &found.span.lo, found.lo), end(hi, &found.span.hi, found.hi)];
                        self.tiles[tile].subtract(line, ends[0], ends[1]);
                    });
                }
            }
        }
    }
}

/// The end points of a span on layers of equal section.
fn level_ends(view: &View, section: &Section, span: &Span, lo: i32, hi: i32) -> [EndPoint; 2] {
    let (nx, nz) = section.of.side_normal(section.z);
    let end = |at: i32, mark: &Mark| {
        let between = mark.t > 0.0 && mark.t < 1.0;
        let station = if between { Station::Between } else { view.task.piece.station(mark.t) };
        let face = Face::side(section.z < section.of.z1, station, mark.left);
        view.end(at, DVec3::new(-nx * mark.e.x, -nx * mark.e.y, -nz), face, section.part)
    };
    [end(lo, &span.lo), end(hi, &span.hi)]
}
